"""A polished surface, a mirror with or without a Lambertian body, in targets where roughness 0 is a mirror.

Their reflectance is fitted to the mirror's at theta_i 0 to 80 degrees together with the body that they let through.
"""

from dataclasses import replace
from math import pi

import numpy as np

from ..physics.fresnel import fresnel
from ..physics.geometry import Geometry, rows
from ..physics.shader_optics import schlick
from . import _target_models
from ._choice import Choice, best_of
from ._refit import Goal, TargetModel
from ._target_models import COLOUR
from .exporter import ColouredSurface

MIRROR = np.linspace(0.0, 80.0, 33)


def is_smooth(surface: ColouredSurface) -> bool:
    """A mirror that reflects something, and at most a Lambertian body."""
    return surface.term_names in (["mirror"], ["lambertian", "mirror"]) and surface.has_mirror


def choose_smooth(surface: ColouredSurface, targets) -> Choice:
    """The best of `targets`, each (parameters, reflectance(cos, **values), under(geom, **values))."""
    body = surface.term_names != ["mirror"]
    angles = (
        np.array(np.meshgrid(np.arange(0.0, 81.0, 20.0), np.arange(0.0, 81.0, 20.0))).reshape(2, -1)
        if body
        else np.empty((2, 0))
    )
    diffuse = rows(Geometry.from_degrees(angles[0], 0.0, angles[1], 120.0))
    mirrored = rows(Geometry.from_degrees(MIRROR, 0.0, MIRROR, 180.0))
    both = rows(
        Geometry.from_degrees(np.concatenate((angles[0], MIRROR)), 0.0, np.concatenate((angles[1], MIRROR)), 150.0)
    )
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

    named = {
        name: TargetModel(parameters, stacked(reflectance, under))
        for name, (parameters, reflectance, under) in targets.items()
    }
    choice = best_of(
        named,
        Goal(both, wanted),
        None,
        f"{len(MIRROR)} mirror directions" + (f" and {len(diffuse)} of the body" if body else ""),
    )
    return replace(choice, brdf=None)  # of reflectances, which are no BRDF


def usd(body: bool) -> dict:
    f0 = next(p for p in _target_models.usd_specular().parameters if p.name == "f0")

    def under(geom, *, albedo, f0):
        return (1 - np.mean(schlick(geom.cos_r, f0), axis=-1, keepdims=True)) * albedo / pi

    def reflect(cos, *, f0, albedo=0.0):
        return schlick(cos, f0)

    return {"specular": ((COLOUR, f0) if body else (f0,), reflect, under)}


def pbrt(body: bool) -> dict:
    albedo, amount, _, n = _target_models.mixed().parameters

    def under(geom, *, albedo, n, amount=1.0):
        return np.broadcast_to((1 - amount) * albedo / pi, (len(geom), np.size(albedo)))

    def reflect(cos, *, n, albedo=0.0, amount=1.0):
        return amount * fresnel(cos, n)

    return {"mirror": ((albedo, amount, n) if body else (n,), reflect, under)}
