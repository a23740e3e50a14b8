"""Flakes: mirror-like platelets tilted out of the surface, whose slopes follow GGX's distribution.

    f = flake D/(4 cos θi cos θr (1 + Λi + Λr)),   D and Λ as in `ggx`, tilt in alpha's place

flake is their reflectance times the share of the light that meets one, alike at every angle: a metal's F, or a
pigment's over it. The denominator is that of correlated heights and also what a deep layer of aligned flakes sends by
single scattering. Made to lie under a coat, as `coated:flakes` or over a body as `coated:lambertian+flakes`: there the
lobe does not grow toward grazing, and looks 1.5 times wider than the flakes lie (n of the coat).

Source: Heitz, Dupuy, Crassin and Dachsbacher 2015, "The SGGX microflake distribution"; ours in this form.
"""

import numpy as np

from ..physics import microfacet
from ..physics.geometry import Geometry
from ._flakes import FLAKE, SHAPE, TILT
from .facts import Candidacy, Formula
from .model import Extreme, Model, Pin, at


def brdf(geom: Geometry, *, flake, tilt) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return flake * microfacet.ggx_shape(geom, tilt)


def gradient(geom: Geometry, names, *, flake, tilt) -> dict[str, np.ndarray]:
    """d ln f/dtilt as GGX's."""
    shape, by_tilt = microfacet.ggx_shape_and_slope(geom, tilt)
    return {"flake": shape, "tilt": flake * shape * by_tilt}


def unmasked(geom: Geometry, *, flake, tilt) -> np.ndarray:
    """No flake hidden by another: enough where neither light nor eye is low, and under a coat."""
    return flake * microfacet.ggx(geom, tilt) / (4 * geom.cos_cos)


MODEL = Model(
    __name__,
    brdf,
    parameters=(FLAKE, TILT),
    gradient=gradient,
    without={"masking": unmasked},
    summary="platelets of metal or pearl, for coated:flakes: metallic paint whose lobe does not grow toward grazing",
    pins=(
        Pin(at(45, 50), {"flake": 0.3, "tilt": 0.12}, f=2.83083766165774663, source="50 digits"),
        Pin(at(75, 60), {"flake": 0.9, "tilt": 0.5}, f=1.16494517715342804, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"tilt": 1e-3}),
        Extreme("light from where it is seen", at(60, -60), {"tilt": 1.0}),
    ),
    source="Heitz, Dupuy, Crassin and Dachsbacher 2015",
    family="flakes",
    cannot="flakes reflect alike at all angles; leaves out light that steep flakes keep under the coat",
    candidacy=Candidacy(110, grown="coated", adds="flakes under a clear coat in place of the lobes"),
    from_facets=lambda facets: {"flake": facets.f0, "tilt": facets.alpha},
    formula=Formula("{flake} * ggx_shape(ci, cr, q, {tilt})", (SHAPE,)),
)
