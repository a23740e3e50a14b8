"""Oren and Nayar: Lambertian facets in V-shaped grooves, with the light they send to each other.

    f = albedo/π (C1 + C2 cos φ tan β + C3 (1 - |cos φ|) tan((α + β)/2)) + 0.17 albedo²/π C4 (1 - cos φ (2β/π)²)
    s² = spread²,  α, β the larger and smaller of θi, θr,  φ = φr - φi (0: toward the light)
    C1 = 1 - ½ s²/(s² + 0.33),  C3 = 0.125 s²/(s² + 0.09) (4αβ/π²)²,  C4 = s²/(s² + 0.13)
    C2 = 0.45 s²/(s² + 0.09) (sin α - (2β/π)³ where cos φ < 0)

Clay, unglazed ceramics, matte paper, dust: flatter than Lambert and brighter toward the light. The light between
facets makes it quadratic in the albedo, and the fitted C2 makes it negative at grazing for a spread above 0.66.
`qualitative` is the paper's short form, without the light between facets and without C3.

Source: Oren and Nayar 1994, "Generalization of Lambert's reflectance model".
"""

from math import pi

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions, Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, albedo, spread) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    once, between = _parts(geom, spread * spread)
    return albedo / pi * (once + albedo * between)


def qualitative(geom: Geometry, *, albedo, spread) -> np.ndarray:
    """The paper's short form [1/sr]: albedo/π (C1 + 0.45 s²/(s² + 0.09) max(0, cos φ) sin α tan β)."""
    s2 = spread * spread
    forward = np.maximum(geom.dot_xy, 0.0) / np.maximum(geom.cos_i, geom.cos_r)
    return albedo / pi * (1 - 0.5 * s2 / (s2 + 0.33) + 0.45 * s2 / (s2 + 0.09) * forward)


def smooth(geom: Geometry, *, albedo, spread) -> np.ndarray:
    """Lambert's law as bright as the short form toward the normal [1/sr]."""
    s2 = spread * spread
    return np.broadcast_to(
        albedo / pi * (1 - 0.5 * s2 / (s2 + 0.33)), np.broadcast_shapes(geom.shape, np.shape(albedo))
    )


def gradient(geom: Geometry, names, *, albedo, spread) -> dict[str, np.ndarray]:
    """df/dalbedo, and df/dspread with d(s²/(s² + c))/dspread = 2 spread c/(s² + c)²."""
    s2 = spread * spread
    once, between = _parts(geom, s2)
    rays, grooves = _rays(geom), _grooves(geom)
    slope = {c: 2 * spread * c / (s2 + c) ** 2 for c in (0.33, 0.09, 0.13)}
    by_spread = -0.5 * slope[0.33] + slope[0.09] * rays + albedo * 0.17 * slope[0.13] * grooves
    return {"albedo": (once + 2 * albedo * between) / pi, "spread": albedo / pi * by_spread}


def _parts(geom: Geometry, s2):
    """Light scattered once, per albedo/π, and light between facets, per albedo²/π."""
    once = (1 - 0.5 * s2 / (s2 + 0.33)) + (s2 / (s2 + 0.09)) * _rays(geom)
    return once, (0.17 * s2 / (s2 + 0.13)) * _grooves(geom)


@formed
def _rays(to: Directions) -> np.ndarray:
    """C2 cos φ tan β + C3 (1 - |cos φ|) tan((α + β)/2), per s²/(s² + 0.09).

    sin α tan β cos φ = (i_xy·r_xy)/max(cos θ); sin α - (2β/π)³ from the elevations, since both are near 1 at grazing.
    """
    elevation_i, elevation_r = np.arctan2(to.cos_i, to.sin_i), np.arctan2(to.cos_r, to.sin_r)
    lower, u = np.minimum(elevation_i, elevation_r), (2 / pi) * np.maximum(elevation_i, elevation_r)
    cos_phi = np.cos(np.radians(to.phi_deg))
    toward = np.maximum(to.dot_xy, 0.0) / np.maximum(to.cos_i, to.cos_r)
    away = (
        np.minimum(cos_phi, 0.0)
        * np.minimum(to.tan_i, to.tan_r)
        * (u * (3 - u * (3 - u)) - 2 * np.sin(0.5 * lower) ** 2)
    )
    tan_mean = (to.sin_i + to.sin_r) / to.v_z
    sideways = 0.125 * ((1 - (2 / pi) * lower) * (1 - u)) ** 2 * (1 - np.abs(cos_phi)) * tan_mean
    return 0.45 * (toward + away) + sideways


@formed
def _grooves(to: Directions) -> np.ndarray:
    """1 - cos φ (2β/π)²."""
    return 1 - np.cos(np.radians(to.phi_deg)) * (2 * np.minimum(to.theta_i, to.theta_r) / pi) ** 2


MODEL = Model(
    __name__,
    brdf,
    roles=("subsurface",),
    parameters=(
        Parameter("albedo", 0.5, 0.0, 1.0, per_channel=True, meaning="reflectance of a facet", starts=(0.1, 0.4, 0.8)),
        Parameter(
            "spread",
            0.3,
            0.0,
            0.66,
            unit="rad",
            meaning="standard deviation of the facets' tilt",
            starts=(0.1, 0.3, 0.6),
        ),
    ),
    gradient=gradient,
    without={"interreflection": qualitative, "roughness": smooth},
    summary="rough diffusers: clay, matte paper, dust; flatter than Lambert, brighter toward the light",
    pins=(
        Pin(at(45, 50), {"albedo": 0.75, "spread": 0.4}, f=0.17667271277907862, source="50 digits"),
        Pin(at(70, -40), {"albedo": 0.2, "spread": 0.6}, f=0.066401622655465497, source="50 digits"),
        Pin(
            at(60, 30, phi_i=10, phi_r=75),
            {"albedo": 0.9, "spread": 0.7},
            f=0.25777535232049272,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("at the normal, where the azimuth is undefined", at(0, 0), {"albedo": 1.0, "spread": 0.66}),
        Extreme("both at grazing, where tan β grows without bound", at(89.99, -89.99), {"albedo": 1.0, "spread": 0.66}),
    ),
    breaks={"energy": "tan β sends more than 1 beyond 60°: 1.05 at grazing for albedo 1, spread 0.3"},
    source="Oren and Nayar 1994",
    family="body",
    cannot="no highlight: that takes a second term",
    candidacy=Candidacy(
        20,
        under=("ggx",),
        bare=True,
        contains={"lambertian": {"spread": 0.3}},
        adds="a body whose facets shade each other",
    ),
    formula=Formula(
        "oren_nayar(ci, cr, p, {albedo}, {spread})",
        (
            (
                "oren3",
                "ci, cr, p, albedo, s2, a, b, cphi",
                "albedo / PI * (1.0 - 0.5 * s2 / (s2 + 0.33)"
                " + 0.45 * s2 / (s2 + 0.09) * (p / most(ci, cr) - least(cphi, 0.0) * sqrt(sin2(most(ci, cr)))"
                " / most(ci, cr) * sq(2.0 * b / PI) * 2.0 * b / PI)"
                " + 0.125 * s2 / (s2 + 0.09) * sq(4.0 * a * b / (PI * PI)) * (1.0 - choose(cphi, cphi, -cphi))"
                " * (sqrt(sin2(ci)) + sqrt(sin2(cr))) / (ci + cr)"
                " + albedo * 0.17 * s2 / (s2 + 0.13) * (1.0 - cphi * sq(2.0 * b / PI)))",
            ),
            (
                "oren2",
                "ci, cr, p, albedo, s2, ss",
                "oren3(ci, cr, p, albedo, s2, acos(least(ci, cr)), acos(most(ci, cr)),"
                " choose(ss - 1.0e-6, most(least(p / most(ss, 1.0e-6), 1.0), -1.0), 0.0))",
            ),
            (
                "oren_nayar",
                "ci, cr, p, albedo, spread",
                "oren2(ci, cr, p, albedo, spread * spread, sqrt(sin2(ci) * sin2(cr)))",
            ),
        ),
    ),
)
