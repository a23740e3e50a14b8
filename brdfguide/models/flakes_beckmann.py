"""Flakes whose slopes are Gaussian: `flakes` with Beckmann's distribution and masking. Written `flakes:beckmann`.

    f = flake D/(4 cos θi cos θr (1 + Λi + Λr)),   D and Λ as in `beckmann`, tilt in alpha's place

Without the long tail of `flakes`: well aligned flakes of one kind.

Source: Beckmann and Spizzichino 1963; as `flakes`.
"""

import numpy as np

from ..physics import microfacet
from ..physics.geometry import Geometry
from ._flakes import FLAKE, TILT
from .model import Extreme, Model, Pin, at


def brdf(geom: Geometry, *, flake, tilt) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return flake * microfacet.beckmann_shape(geom, tilt)


def gradient(geom: Geometry, names, *, flake, tilt) -> dict[str, np.ndarray]:
    """d ln f/dtilt as Beckmann's."""
    shape, by_tilt = microfacet.beckmann_shape_and_slope(geom, tilt)
    return {"flake": shape, "tilt": flake * shape * by_tilt}


def unmasked(geom: Geometry, *, flake, tilt) -> np.ndarray:
    """No flake hidden by another: enough where neither light nor eye is low, and under a coat."""
    return flake * microfacet.beckmann(geom, tilt) / (4 * geom.cos_cos)


MODEL = Model(
    __name__,
    brdf,
    parameters=(FLAKE, TILT),
    gradient=gradient,
    without={"masking": unmasked},
    summary="flakes of Gaussian slopes, for coated:flakes:beckmann: well aligned, without a long tail",
    pins=(
        Pin(at(45, 50), {"flake": 0.3, "tilt": 0.4}, f=0.325573977679698526, source="50 digits"),
        Pin(at(75, 60), {"flake": 0.9, "tilt": 0.5}, f=1.80563862147074113, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"tilt": 1e-3}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"tilt": 1e-3}, f=0.0),
    ),
    source="Beckmann and Spizzichino 1963; Heitz, Dupuy, Crassin and Dachsbacher 2015",
    family="flakes",
    cannot="flakes reflect alike at all angles; leaves out light that steep flakes keep under the coat",
    from_facets=lambda facets: {"flake": facets.f0, "tilt": facets.alpha},
)
