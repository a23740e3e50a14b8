"""The energy-preserving Oren-Nayar law of OpenPBR: rough diffusers that neither lose nor gain light.

    f = albedo/π A (1 + r s/t) + ρ/π (1 - E(θi)) (1 - E(θr)) / (1 - Ē)
    s = i_xy · r_xy,  t = max(cos θi, cos θr) where s > 0, else 1,  r = roughness
    A = 1/(1 + c1 r),  c1 = 1/2 - 2/(3π),  E = A (1 + r G/π),  Ē = A (1 + c2 r),  c2 = 2/3 - 28/(15π)
    G = sin θ (θ - sin θ cos θ) + ⅔ (tan θ (1 - sin³θ) - sin θ),  ρ = albedo² Ē/(1 - albedo (1 - Ē))

The first part is Fujii's form of Oren and Nayar's short law; the second gives back what it loses, after as many
bounces as it takes. Where Oren-Nayar is wanted, this one is positive, bounded and reciprocal for every roughness.

Source: Portsmouth, Kutz and Hill 2025, "EON: a practical energy-preserving rough diffuse BRDF".
"""

from math import pi

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions, Geometry
from .facts import Formula
from .model import Extreme, Model, Parameter, Pin, at

C1 = 1 / 2 - 2 / (3 * pi)  # c1 of A above
C2 = 2 / 3 - 28 / (15 * pi)  # c2 of Ē above


def brdf(geom: Geometry, *, albedo, roughness) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    a = 1 / (1 + C1 * roughness)
    mean = a * (1 + C2 * roughness)
    again = albedo * albedo * mean / (1 - albedo * (1 - mean))
    return (albedo * a / pi) * (1 + roughness * _forward(geom)) + (again * a * roughness / pi) * _kept(geom)


def fujii(geom: Geometry, *, albedo, roughness) -> np.ndarray:
    """Fujii's form alone [1/sr], without what returns after further bounces."""
    return albedo / (pi * (1 + C1 * roughness)) * (1 + roughness * _forward(geom))


def smooth(geom: Geometry, *, albedo, roughness) -> np.ndarray:
    """Lambert's law [1/sr]."""
    return np.broadcast_to(albedo / pi, np.broadcast_shapes(geom.shape, np.shape(albedo)))


def gradient(geom: Geometry, names, *, albedo, roughness) -> dict[str, np.ndarray]:
    """Through A' = -c1 A² and Ē' = A' (1 + c2 r) + A c2."""
    a = 1 / (1 + C1 * roughness)
    mean, lost = a * (1 + C2 * roughness), 1 - a * (1 + C2 * roughness)
    by_a, forward, kept = -C1 * a * a, _forward(geom), _kept(geom)
    by_mean = by_a * (1 + C2 * roughness) + a * C2
    left = 1 - albedo * lost
    again, again_by_albedo = albedo**2 * mean / left, albedo * mean * (2 - albedo * lost) / left**2
    again_by_mean = albedo**2 * (1 - albedo) / left**2
    return {
        "albedo": (a / pi) * (1 + roughness * forward) + (again_by_albedo * a * roughness / pi) * kept,
        "roughness": (albedo / pi) * (by_a * (1 + roughness * forward) + a * forward)
        + ((again_by_mean * by_mean * a * roughness + again * (by_a * roughness + a)) / pi) * kept,
    }


@formed
def _forward(to: Directions) -> np.ndarray:
    """s/t."""
    return to.dot_xy / np.where(to.dot_xy > 0, np.maximum(to.cos_i, to.cos_r), 1.0)


@formed
def _kept(to: Directions) -> np.ndarray:
    """(1 - E(θi)) (1 - E(θr)) / ((1 - Ē) A r) = (c1 - Gi/π) (c1 - Gr/π)/(c1 - c2), of which A r stands outside."""
    return _lost(to.cos_i, to.sin_i) * _lost(to.cos_r, to.sin_r) / (C1 - C2)


def _lost(cos, sin):
    """c1 - G/π, which goes to cos θ/π at grazing: π c1 - G with both halves taken apart by hand."""
    rest = cos * cos / (1 + sin)  # 1 - sin θ
    return (
        np.arctan2(cos, sin)
        + np.arctan2(sin, cos) * rest
        + sin * sin * cos
        - (2 / 3) * (rest + sin * cos * (1 + sin + sin * sin) / (1 + sin))
    ) / pi


MODEL = Model(
    __name__,
    brdf,
    roles=("subsurface",),
    parameters=(
        Parameter("albedo", 0.5, 0.0, 1.0, per_channel=True, meaning="reflectance of a facet", starts=(0.1, 0.4, 0.8)),
        Parameter("roughness", 0.4, 0.0, 1.0, meaning="0: Lambert; 1: the roughest", starts=(0.2, 0.7)),
    ),
    gradient=gradient,
    without={"interreflection": fujii, "roughness": smooth},
    summary="rough diffusers without loss or gain of light: clay, matte paper, dust; what OpenPBR calls base diffuse",
    pins=(
        Pin(at(45, 50), {"albedo": 0.75, "roughness": 0.7}, f=0.14751454901569819, source="50 digits"),
        Pin(at(70, -40), {"albedo": 0.2, "roughness": 1.0}, f=0.089594048391691726, source="50 digits"),
        Pin(
            at(60, 30, phi_i=10, phi_r=75),
            {"albedo": 0.9, "roughness": 0.3},
            f=0.29594689257048232,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("at the normal, where the azimuth is undefined", at(0, 0), {"albedo": 1.0, "roughness": 1.0}),
        Extreme("both at grazing, toward the light", at(89.99, -89.99), {"albedo": 1.0, "roughness": 1.0}),
    ),
    source="Portsmouth, Kutz and Hill 2025",
    family="body",
    cannot="no highlight: that takes a second term",
    formula=Formula(
        "eon(ci, cr, p, {albedo}, {roughness})",
        (
            (
                "lost3",
                "c, s, t, rest",
                "(1.57079633 - t + t * rest + s * s * c"
                " - 0.66666667 * (rest + s * c * (1.0 + s + s * s) / (1.0 + s))) / PI",
            ),
            ("lost", "c", "lost3(c, sqrt(sin2(c)), acos(c), c * c / (1.0 + sqrt(sin2(c))))"),
            (
                "eon2",
                "ci, cr, p, albedo, r, a, mean",
                "a * albedo / PI * (1.0 + r * p / choose(p, most(ci, cr), 1.0)) + a * r * albedo * albedo * mean"
                " / (1.0 - albedo * (1.0 - mean)) / PI * lost(ci) * lost(cr) / 0.215305197",
            ),
            (
                "eon",
                "ci, cr, p, albedo, r",
                "eon2(ci, cr, p, albedo, r, 1.0 / (1.0 + 0.287793409 * r),"
                " (1.0 + 0.0724882125 * r) / (1.0 + 0.287793409 * r))",
            ),
        ),
    ),
)
