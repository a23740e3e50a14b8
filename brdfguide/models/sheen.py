"""Charlie's sheen: the rim of light that fibres standing out of a fabric send back toward grazing.

    f = rho D/(4 (cos θi + cos θr - cos θi cos θr)),   D = (2 + 1/spread) sin^(1/spread) δ/2π

δ lies between normal and half vector. D is a distribution of fibres about the plane of the surface: nothing at the
normal, most at grazing, toward the light as well as away from it. Velvet, felt, dust and down, beside a body. Its
spread, alpha in the source, is what renderers call the sheen's roughness squared. Below 0.25 it would send back more
than it gets at grazing; real fibres shadow each other there.

Source: Estevez and Kulla 2017, "Production friendly microfacet sheen BRDF", masked as by Neubelt and Pettineo 2013.
"""

from math import pi

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions, Geometry
from .facts import Formula
from .model import Extreme, Model, Parameter, Pin, at

# a cloth with a pile of which nothing is measured: ours
USUAL_RHO, USUAL_SPREAD = 0.3, 0.4


def brdf(geom: Geometry, *, rho, spread) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return rho * _shape(geom, spread)


def _shape(geom: Geometry, spread) -> np.ndarray:
    power = 0.5 / spread
    return (2 + 2 * power) * (geom.tan2_h / geom.sec2_h) ** power / _sides(geom)


@formed
def _sides(to: Directions) -> np.ndarray:
    """8π (cos θi + cos θr - cos θi cos θr)."""
    return 8 * pi * (to.cos_i + to.cos_r - to.cos_i * to.cos_r)


def gradient(geom: Geometry, names, *, rho, spread) -> dict[str, np.ndarray]:
    """d ln f/dalpha = -1/alpha² (ln sin δ + 1/(2 + 1/spread)); at the normal, where nothing is, 0."""
    shape, sine2 = _shape(geom, spread), geom.tan2_h / geom.sec2_h
    ln_sine = 0.5 * np.log(np.where(sine2 > 0, sine2, 1.0))
    return {"rho": shape, "spread": -rho * shape * (ln_sine + spread / (1 + 2 * spread)) / spread**2}


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("rho", 0.2, 0.0, 1.0, linear=True, per_channel=True, meaning="colour of the fibres' light"),
        Parameter("spread", 0.5, 0.25, 1.0, log=True, meaning="how far inward the rim reaches", starts=(0.3, 0.5, 0.8)),
    ),
    gradient=gradient,
    summary="the bright rim of fabrics: velvet, felt, down and dust, beside a body",
    pins=(
        Pin(at(70, -60), {"rho": 0.3, "spread": 0.4}, f=0.062597090631829073, source="50 digits"),
        Pin(at(60, 30, phi_i=10, phi_r=75), {"rho": 0.8, "spread": 0.7}, f=0.0632288791145327144, source="50 digits"),
    ),
    extremes=(
        Extreme("both at the normal, where no fibre lies", at(0, 0), {"spread": 0.25}, f=0.0),
        Extreme("both at grazing, toward the light", at(89.99, -89.99), {"spread": 0.25}),
    ),
    source="Estevez and Kulla 2017; Neubelt and Pettineo 2013",
    family="fabric",
    cannot="no weave, no highlight: it stands beside a body",
    from_facets=lambda facets: {"rho": (USUAL_RHO,) * len(facets.albedo or (0.0,)), "spread": USUAL_SPREAD},
    beyond_facets=lambda **_: "a rim that fibres make has no counterpart",
    formula=Formula(
        "{rho} * sheen(ci, cr, q, {spread})",
        (
            (
                "sheen",
                "ci, cr, q, spread",
                "(2.0 + 1.0 / spread) * exp(0.5 / spread * log(most(sin2h(ci, cr, q), 1.0e-37)))"
                " / (8.0 * PI * (ci + cr - ci * cr))",
            ),
        ),
    ),
)
