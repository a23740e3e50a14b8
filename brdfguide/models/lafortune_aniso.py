"""One generalised cosine lobe of Lafortune with a grain: a coefficient for each axis of the sample.

    f = ks (max(0, c_x i_x r_x + c_y i_y r_y + c_z cos θi cos θr)/m)^n,   m = max(|c_x|, |c_y|, |c_z|)

i and r in the frame of `axis`. Only the direction of (c_x, c_y, c_z) shapes a lobe; its length is left to ks, the
greatest value. (-1, -1, 1) is Phong's mirror lobe; unequal c_x, c_y make it elliptic, about a direction that stays put
in the sample: it does not follow facets toward grazing, and nothing bounds its energy. Fits hold c_z at 1. With
c_x = c_y it is `lafortune`.

Source: Lafortune et al. 1997, "Non-linear approximation of reflectance functions", anisotropic case.
"""

import numpy as np

from ..physics.geometry import Geometry
from ._grain import AXIS
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, ks, c_x, c_y, c_z, exponent, axis) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    above, ln_base, _ = _ln_base(geom, c_x, c_y, c_z, axis)
    return ks * np.where(above, np.exp(exponent * ln_base), 0.0)


def _ln_base(geom: Geometry, c_x, c_y, c_z, axis):
    """Where the base is positive, its logarithm (0 elsewhere), and i_x r_y + i_y r_x.

    base - 1 = ((c_x + m) i_x r_x + (c_y + m) i_y r_y + (c_z - m) cos θi cos θr)/m - ½ d²,   d the chord from the mirror
    direction
    """
    turn_i, turn_r = np.radians(geom.phi_i_deg) - axis, np.radians(geom.phi_r_deg) - axis
    sines = geom.sin_i * geom.sin_r
    cos_i, sin_i, cos_r, sin_r = np.cos(turn_i), np.sin(turn_i), np.cos(turn_r), np.sin(turn_r)
    xx, yy = sines * (cos_i * cos_r), sines * (sin_i * sin_r)
    m = _greatest(c_x, c_y, c_z)
    away = (c_x + m) * xx + (c_y + m) * yy + (c_z - m) * geom.cos_cos
    excess = away / m - 0.5 * geom.mirror_distance2
    above = excess > -1.0
    return above, np.log1p(np.where(above, excess, 0.0)), sines * (cos_i * sin_r + sin_i * cos_r)


def gradient(geom: Geometry, names, *, ks, c_x, c_y, c_z, exponent, axis) -> dict[str, np.ndarray]:
    """df/dn = f ln base; df/daxis = f n (c_x - c_y)(i_x r_y + i_y r_x)/(m base). By the coefficients, where m has
    creases, it is left to differences."""
    above, ln_base, both = _ln_base(geom, c_x, c_y, c_z, axis)
    lobe = np.where(above, np.exp(exponent * ln_base), 0.0)
    by_axis = (c_x - c_y) / _greatest(c_x, c_y, c_z) * both * np.exp(-ln_base)
    return {"ks": lobe, "exponent": ks * lobe * ln_base, "axis": ks * exponent * lobe * by_axis}


def _greatest(c_x, c_y, c_z):
    return np.maximum(np.maximum(np.abs(c_x), np.abs(c_y)), np.abs(c_z))


def _coefficient(name: str, meaning: str) -> Parameter:
    return Parameter(name, -0.95, -1.2, 1.2, meaning=meaning, starts=(-0.99, -0.95, -0.85))


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter(
            "ks", 0.2, 0.0, 1e6, unit="1/sr", linear=True, per_channel=True, meaning="greatest value of the lobe"
        ),
        _coefficient("c_x", "before i_x r_x, along `axis`; the farther from -c_z, the wider across it"),
        _coefficient("c_y", "before i_y r_y"),
        Parameter("c_z", 1.0, 0.01, 1.2, free=False, meaning="before cos θi cos θr"),
        Parameter("exponent", 10.0, 0.3, 1e5, log=True, meaning="n: narrowness", starts=(3.0, 20.0, 100.0, 600.0)),
        AXIS,
    ),
    gradient=gradient,
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"ks": 0.7, "c_x": -1.05, "c_y": -0.8, "c_z": 0.9, "exponent": 12.0, "axis": 0.4},
            f=0.286645064572948251,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, 60),
            {"ks": 1.7, "c_x": -0.6, "c_y": -0.9, "exponent": 4.5, "axis": 1.1},
            f=0.737577347162476065,
            source="the same, toward grazing",
        ),
    ),
    extremes=(
        Extreme(
            "mirror lobe, largest exponent, 0.01° from grazing",
            at(89.99, 89.99),
            {"c_x": -1.0, "c_y": -1.0, "exponent": 1e5},
            f=0.2,
        ),
        Extreme("negative base", at(80, -70), {"exponent": 3.7}, f=0.0),
        Extreme("back to the light, largest exponent", at(60, -60), {"c_x": 1.0, "c_y": 1.0, "exponent": 1e5}, f=0.2),
    ),
    breaks={
        "energy": "a lobe that rises toward grazing has no bound on what it sends",
        "rotation": "it has a grain, unless c_x and c_y are alike",
    },
    summary="elliptic cosine lobe about a direction fixed in the sample: published fits; energy unbounded",
    source="Lafortune et al. 1997",
    family="Lafortune",
    about_mirror=True,
    cannot="its lobe does not follow facets toward grazing; nothing bounds its energy",
    from_facets=lambda facets: {"ks": facets.peak, "exponent": facets.mirror_exponent},
    beyond_facets=lambda *, c_x, c_y, **_: "its grain has no counterpart" if np.any(np.not_equal(c_x, c_y)) else "",
)
