"""Parallel round ridges, after Poulin and Fournier: threads, corduroy, turned wood; each element matt with a gloss.

Circular cylinders of radius 1 run along the grain, `spacing` apart, sunk by `sink` into a flat floor (0: half
cylinders, toward 1: flat). In the section across them, t the angle of the normal to the ridge,

    f = [∫ (albedo/π + ks (n·h)^m)(n·i)(n·r) dt + floor · the same with n = z]/(spacing cos θi cos θr)

over what both light and view reach: |t - ψ| <= 90°, |t| <= acos sink, and where a neighbour stands in the way,
t sign ψ <= a + asin(spacing cos a - 1), a = |ψ|, ψ the angle of a direction in the section; of the floor its far or
near end retreats to (1 - sink sin a)/cos a from its ridge. Exact shadows, no light that meets two ridges. Ridges that
meet end where they meet. Reciprocal, bright toward the light: f π is 1.57 at 60° across half cylinders. For cloth and
turned wood, not for polished metal.

Source: after the abstract of Poulin and Fournier 1990, "A model for anisotropic reflection"; its spacing and height may
be scaled otherwise, and it fits polynomials where this integrates.
"""

from functools import cache
from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._grain import AXIS
from .model import Extreme, Model, Parameter, Pin, at

CUTS = (-7.0, -3.0, 0.0, 3.0, 7.0)  # of widths 1/√(m + 1) about the peak of the gloss: pieces of the integral


def brdf(geom: Geometry, *, spacing, sink, albedo, ks, exponent, axis) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    sink = np.maximum(sink, np.sqrt(np.maximum(1 - 0.25 * spacing * spacing, 0.0)))  # where ridges meet
    light, view = _in_section(geom, axis, spacing, sink)
    top = np.arccos(sink)
    low = np.maximum(np.maximum(light.low, view.low), -top)
    high = np.maximum(np.minimum(np.minimum(light.high, view.high), top), low)
    gloss = np.where(ks > 0, ks, 0.0)
    total = albedo / pi * _over([low, high], light, view)
    if np.any(gloss > 0):
        total = total + gloss * _gloss(geom, low, high, light, view, exponent, axis)
    half = np.sqrt((1 - sink) * (1 + sink))
    ends = (np.maximum(light.near, view.near), np.minimum(light.far, view.far))
    floor = np.maximum(np.minimum(ends[1], spacing - half) - np.maximum(ends[0], half), 0.0)
    flat = albedo / pi + gloss * np.exp(-0.5 * exponent * geom.ln_sec2_h)
    return (total / geom.cos_cos + floor * flat) / spacing


class _Section:
    """One direction in the section across the ridges: what of ridge and floor it reaches."""

    def __init__(self, x, z, spacing, sink):
        self.side = np.where(x < 0, -1.0, 1.0)
        self.size = np.hypot(x, z)
        self.rise = np.arctan2(z, np.abs(x))  # 90° - a
        cos_a, sin_a = z / self.size, np.abs(x) / self.size
        behind = (sin_a > sink) & (spacing * cos_a < 2)
        # a + asin(spacing cos a - 1), without a difference of numbers near 1
        blocked = -self.rise + 2 * np.arcsin(np.sqrt(np.where(behind, 0.5 * spacing * cos_a, 1.0)))
        end = np.where(behind, blocked, pi - self.rise)  # else 90° beyond ψ
        self.low = np.where(self.side > 0, -self.rise, -end)
        self.high = np.where(self.side > 0, end, self.rise)
        shade = np.where(sin_a > sink, (1 - sink * sin_a) / cos_a, 0.0)
        self.near = np.where(self.side < 0, shade, 0.0)
        self.far = np.where((self.side > 0) & (sin_a > sink), spacing - shade, spacing)

    def facing(self, t):
        """n·q in the section, nothing cancelling where a ridge turns away."""
        return self.size * np.sin(self.rise + self.side * t)


def _in_section(geom: Geometry, axis, spacing, sink) -> tuple[_Section, _Section]:
    found = []
    for sin, cos, phi in ((geom.sin_i, geom.cos_i, geom.phi_i_deg), (geom.sin_r, geom.cos_r, geom.phi_r_deg)):
        found.append(_Section(sin * np.cos(np.radians(phi) - axis), cos, spacing, sink))
    return found[0], found[1]


@cache
def _rule(nodes: int):
    """Gauss' nodes and weights over -1..1; formed when they are asked for, since their package takes 10 ms to load."""
    return np.polynomial.legendre.leggauss(nodes)


def _over(cuts, light: _Section, view: _Section, weight=lambda t: 1.0, nodes: int = 16):
    """∫ weight (n·i)(n·r) dt over consecutive pieces."""
    total: np.ndarray | float = 0.0
    for start, stop in zip(cuts[:-1], cuts[1:], strict=True):
        half, middle = 0.5 * (stop - start), 0.5 * (stop + start)
        if not np.any(half > 0):
            continue
        for node, share in zip(*_rule(nodes), strict=True):
            t = middle + half * node
            total = total + share * half * (light.facing(t) * view.facing(t) * weight(t))
    return total


def _gloss(geom: Geometry, low, high, light: _Section, view: _Section, exponent, axis):
    """The same with (n·h)^m, in pieces about its peak."""
    x, y = geom.offset_from(axis)
    peak, width = np.arctan2(x, geom.v_z), 1 / np.sqrt(exponent + 1)
    ln_tilt = 0.5 * np.log1p(-y * y / geom.v2)  # of h out of the section

    def weight(t):
        return np.exp(exponent * (0.5 * np.log1p(-np.minimum(np.sin(t - peak) ** 2, 1 - 1e-16)) + ln_tilt))

    cuts = [low, *(np.clip(peak + cut * width, low, high) for cut in CUTS), high]
    return _over(cuts, light, view, weight, 12)


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter(
            "spacing", 2.5, 1.0, 100.0, log=True, meaning="from ridge to ridge, in radii", starts=(2.0, 3.0, 6.0)
        ),
        Parameter("sink", 0.3, 0.0, 0.999, meaning="depth of the axes in the floor, in radii", starts=(0.0, 0.4, 0.8)),
        Parameter("albedo", 0.5, 0.0, 1.0, per_channel=True, meaning="of an element", starts=(0.1, 0.5)),
        Parameter(
            "ks", 0.1, 0.0, 1e3, unit="1/sr", per_channel=True, meaning="gloss of an element", starts=(0.05, 1.0)
        ),
        Parameter("exponent", 20.0, 0.3, 1e4, log=True, meaning="m, its narrowness", starts=(10.0, 100.0)),
        AXIS,
    ),
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"spacing": 2.5, "sink": 0.2, "albedo": 0.4, "ks": 0.7, "exponent": 30.0, "axis": 0.4},
            f=0.162957425624933799,
            source="the integral above at 30 digits",
            rtol=1e-11,
        ),
        Pin(
            at(75, 60),
            {"spacing": 3.0, "sink": 0.5, "albedo": 0.7, "ks": 0.2, "exponent": 5.0, "axis": 1.1},
            f=0.263143327726384154,
            source="the same, toward grazing",
            rtol=1e-11,
        ),
    ),
    extremes=(
        Extreme("0.01° from grazing, across", at(89.99, 89.99), {"spacing": 2.0, "sink": 0.0}),
        Extreme("both at the normal", at(0, 0), {"sink": 0.0}),
        Extreme("nearly flat", at(60, 60), {"sink": 0.999, "spacing": 100.0}),
        Extreme("ridges that meet, toward the light", at(80, -80), {"spacing": 1.0}),
    ),
    breaks={"energy": "nothing bounds the gloss of an element", "rotation": "its ridges run along the grain"},
    summary="round ridges with exact shadows: corduroy, threads, turned wood; not polished metal",
    source="after Poulin and Fournier 1990",
    family="ridges",
    cannot="no light that meets two ridges, no Fresnel; a definition after the paper's abstract",
    from_facets=lambda facets: {"albedo": facets.albedo or 0.18},
    beyond_facets=lambda **_: "ridges have no counterpart",
)
