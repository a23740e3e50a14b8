"""What Low's laws share: f = a F(c) before (1 + b q)^-c, which differ in the distance q, the angle of F and what stands
before.
"""

from math import pi

import numpy as np

from ..physics import fresnel
from ..physics.geometry import Geometry
from .facts import Facets
from .model import Parameter

PARAMETERS = (
    Parameter("a", 30.0, 0.0, 1e8, unit="1/sr", linear=True, per_channel=True, meaning="height of the lobe, F apart"),
    Parameter(
        "b",
        1e3,
        1e-2,
        1e10,
        log=True,
        meaning="narrowness of the shoulder",
        starts=(10.0, 100.0, 1e3, 1e4, 1e5, 1e6),
    ),
    Parameter("c", 1.0, 0.01, 20.0, log=True, meaning="slope of the tail", starts=(0.4, 0.7, 1.0, 1.6, 2.5)),
    Parameter(
        "n",
        1.5,
        1.0001,
        100.0,
        log=True,
        origin=1.0,
        given_low=0.01,
        meaning="refractive index: the growth toward grazing alone, since the height is free",
        starts=(1.2, 1.6, 2.5),
    ),
    Parameter("k", 0.0, 0.0, 100.0, free=False, meaning="absorption index"),
)
ENERGY = "its height is free, and Fresnel's growth toward grazing comes on top of it"


def brdf(cosine, q, before, *, a, b, c, n, k) -> np.ndarray:
    """BRDF [1/sr]."""
    return a * fresnel.fresnel(cosine, n, k) * before * np.exp(-c * np.log1p(b * q))


def shared_gradient(cosine, q, before, names, *, a, b, c, n, k) -> dict[str, np.ndarray]:
    """d ln f/db = -c q/(1 + b q), d ln f/dc = -ln(1 + b q), and by n and k as far as `names` asks for them."""
    f, *by_index = (
        fresnel.fresnel_with_slopes(cosine, n, k) if "n" in names or "k" in names else (fresnel.fresnel(cosine, n, k),)
    )
    bent = np.log1p(b * q)
    bare = before * np.exp(-c * bent)
    shape = f * bare
    lobe = a * shape
    return {
        "a": shape,
        "b": lobe * (-c * q / (1 + b * q)),
        "c": -lobe * bent,
        **{name: a * by * bare for name, by in zip("nk", by_index, strict=False)},
    }


def from_facets(facets: Facets) -> dict:
    """The lobe of GGX's peak and width: b x² = t/alpha² near the normal, where x² is 4 t, and c = 2."""
    alpha2 = facets.alpha**2
    return {"a": 1 / (4 * pi * alpha2), "b": 1 / (4 * alpha2), "c": 2.0, "n": facets.n[0], "k": facets.k[0]}


def with_fixed_fresnel(distance, before=lambda geom: 1.0):
    """The law with F at its normal-incidence value: what a scene that never looks near grazing needs."""

    def reduced(geom: Geometry, *, a, b, c, n, k):
        return a * fresnel.f0(n, k) * before(geom) * np.exp(-c * np.log1p(b * distance(geom)))

    return reduced
