"""A polished surface, a mirror with or without a Lambertian body, in targets where roughness 0 is a mirror.

Their reflectance is fitted to the mirror's at theta_i 0 to 80 degrees together with the body that they let through.
"""

from math import pi

import numpy as np

from ..geometry import Geometry, rows
from ..optics import f0 as normal_reflectance
from ..optics import fresnel
from . import _laws
from ._base import Surface
from ._choice import Choice, best_of
from ._laws import COLOUR, schlick
from ._refit import Law

MIRROR = np.linspace(0.0, 80.0, 33)


def is_smooth(surface: Surface) -> bool:
    """A mirror that reflects something, and at most a Lambertian body."""
    return surface.laws in (["mirror"], ["lambertian", "mirror"]) and surface.has_mirror


def choose_smooth(surface: Surface, laws) -> Choice:
    """The best of `laws`, each (parameters, reflectance(cos, **values), under(geom, **values))."""
    body = surface.laws != ["mirror"]
    angles = np.array(np.meshgrid(np.arange(0.0, 81.0, 20.0), np.arange(0.0, 81.0, 20.0))).reshape(2, -1) if body else np.empty((2, 0))
    diffuse = rows(Geometry.from_degrees(angles[0], 0.0, angles[1], 120.0))
    mirrored = rows(Geometry.from_degrees(MIRROR, 0.0, MIRROR, 180.0))
    both = rows(Geometry.from_degrees(np.concatenate((angles[0], MIRROR)), 0.0, np.concatenate((angles[1], MIRROR)), 150.0))
    wanted = np.concatenate((surface.rgb(diffuse), surface.mirror_rgb(mirrored)))
    wanted = np.where(wanted > 1e-2 * np.max(wanted), wanted, np.nan)

    def stacked(reflectance, under):
        def brdf(geom, **values):
            above, below = diffuse, mirrored
            finite = under(above, **values) if body else np.empty((0, 1))
            shiny = reflectance(below.cos_i, **values)
            colours = np.broadcast_shapes(finite.shape[1:], shiny.shape[1:])
            return np.concatenate([np.broadcast_to(part, (len(part), *colours)) for part in (finite, shiny)])

        return brdf

    named = {name: Law(parameters, stacked(reflectance, under)) for name, (parameters, reflectance, under) in laws.items()}
    return best_of(named, both, wanted, None, f"{len(MIRROR)} mirror directions" + (f" and {len(diffuse)} of the body" if body else ""))


def gltf(body: bool) -> dict:
    dielectric = _laws.gltf_dielectric().parameters
    dielectric = tuple(p for p in dielectric if p.name != "roughness")

    def f(cos, *, n, specular, albedo=0.0):
        return specular * schlick(cos, normal_reflectance(n))

    laws = {"dielectric": (dielectric, f, lambda geom, *, albedo, **own: (1 - f(geom.cos_d, **own)) * albedo / pi)}
    metal = {"metal": ((METAL,), lambda cos, *, albedo: schlick(cos, albedo), None)}
    return laws if body else metal | {"dielectric": (dielectric[1:], f, None)}


METAL = _laws.openpbr_metal().parameters[0]


def usd(body: bool) -> dict:
    f0 = next(p for p in _laws.usd_specular().parameters if p.name == "f0")
    under = lambda geom, *, albedo, f0: (1 - np.mean(schlick(geom.cos_r, f0), axis=-1, keepdims=True)) * albedo / pi  # noqa: E731
    reflect = lambda cos, *, f0, albedo=0.0: schlick(cos, f0)  # noqa: E731
    return {"specular": ((COLOUR, f0) if body else (f0,), reflect, under)}


def openpbr(body: bool) -> dict:
    n = next(p for p in _laws.openpbr_dielectric().parameters if p.name == "n")
    under = lambda geom, *, albedo, n: (1 - fresnel(geom.cos_r, n)) * albedo / pi  # noqa: E731
    dielectric = {"dielectric": ((COLOUR, n) if body else (n,), lambda cos, *, n, albedo=0.0: fresnel(cos, n), under)}
    return dielectric if body else {"metal": (_laws.openpbr_metal().parameters[:2], _laws.hoffman, None)} | dielectric


def standard(body: bool) -> dict:
    metal = {"metal": (_laws.standard_metal().parameters[:2], lambda cos, *, albedo, edge: fresnel(cos, *_laws.artistic_index(albedo, edge)), None)}
    return openpbr(True) if body else metal | {"dielectric": openpbr(False)["dielectric"]}


def pbrt(body: bool) -> dict:
    albedo, amount, _, n = _laws.mixed().parameters
    under = lambda geom, *, albedo, n, amount=1.0: np.broadcast_to((1 - amount) * albedo / pi, (len(geom), np.size(albedo)))  # noqa: E731
    reflect = lambda cos, *, n, albedo=0.0, amount=1.0: amount * fresnel(cos, n)  # noqa: E731
    return {"mirror": ((albedo, amount, n) if body else (n,), reflect, under)}
