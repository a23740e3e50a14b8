"""Closed forms that bound, before any sampling, how much a part can matter in a scene.

Each bound is on |Δ ln f| at the worst angles of the scene's box, for a term that makes up all of what is seen; where an
amplitude can make up for a change, it does so within its range. A bound below a tenth of the tolerance leaves the part
out of every ablation that is tried; anything else is for the samples to say.

    Fresnel     ln(max F / min F) over the range of θd
    coupling    -ln of what the interface lets through at the lowest light and the lowest view
    masking     |ln| of the lobe with over without shadows, over the angles at three azimuths
    mirror      ln(1 + ρ),  ρ = R E/(π a²) over what a body alone sends, nothing where there is none
"""

from collections.abc import Mapping
from math import inf, log, pi

import numpy as np

from ..physics import fresnel
from ..physics.geometry import Geometry, in_plane
from .difference import Picture
from .features import MIRROR, Feature

ENOUGH = 0.1  # of the tolerance
STEPS = 64


def analytic_bounds(picture: Picture) -> dict[Feature, float]:
    """Upper bounds [JND] for the parts that have a closed form."""
    scene = picture.quadrature.scene
    if scene.colour != "grey" or picture.channels > 1:
        return {}  # ΔE_ITP has no such closed form
    box = picture.quadrature.angular_range_deg
    found = {}
    for term in picture.features.terms:
        values = picture.features.surface.values_of(term)
        for name in picture.features.of(term):
            bound = _bound(picture, term, name, values, box)
            if bound is not None:
                found[Feature(term.label, name)] = bound / scene.display.jnd
    return found


def negligible(picture: Picture) -> frozenset[Feature]:
    """Parts that a closed form alone rules out."""
    enough = ENOUGH * min(picture.tolerance.worst, picture.tolerance.p95)
    return frozenset(feature for feature, bound in analytic_bounds(picture).items() if bound <= enough)


def _bound(picture: Picture, term, name: str, values: Mapping, box) -> float | None:
    low, high = np.radians(box["theta_d_deg"])
    if name == "fresnel" and term.model.has_index:
        f = fresnel.fresnel(np.cos(np.linspace(low, high, STEPS)), values["n"], values["k"])
        return log(f.max() / f.min()) if f.min() > 0 else inf
    if name == "coupling":
        # the amplitude can take the middle of the range, but no more than all of it
        lowest = in_plane(box["theta_i_deg"][1], box["theta_r_deg"][1])
        own = {**values, term.model.amplitude: 1.0}
        let_through = float(term.model(lowest, **own) / term.model(in_plane(0.0, 0.0), **own))
        return -log(let_through) if let_through > 1e-12 else inf
    if name == "masking":
        if max(box["theta_i_deg"][1], box["theta_r_deg"][1]) > 89.9:
            return inf
        theta_i, theta_r = (np.linspace(box[name][0], box[name][1], STEPS) for name in ("theta_i_deg", "theta_r_deg"))
        geom = Geometry.from_degrees(theta_i[:, None, None], 0.0, theta_r[None, :, None], np.array([0.0, 90.0, 180.0]))
        shadowed, bare = (
            np.log(np.maximum(brdf(geom, **values), 1e-300))
            for brdf in (term.model.brdf, term.model.without["masking"])
        )
        return float(np.abs(shadowed - bare).max())
    if name == MIRROR:
        return _mirror_bound(picture, term, values, box)
    return None


def _mirror_bound(picture: Picture, term, values: Mapping, box) -> float:
    """ln(1 + ρ) against the darkest body; infinite where nothing else is sure to shine."""
    q = picture.quadrature
    low, high = max(box["theta_i_deg"][0], box["theta_r_deg"][0]), min(box["theta_i_deg"][1], box["theta_r_deg"][1])
    edge = float(np.degrees(q.radii.max(initial=0.0)))
    if q.scene.around is None and low > high + 2 * edge:
        return 0.0  # no light is ever seen mirrored
    theta = np.clip(np.linspace(low - edge, high + edge, STEPS), 0.0, 89.99)[:, None]
    rho = float(term.model.mirror(in_plane(theta, theta), **values).max())
    lamps = [light.irradiance / (pi * radius**2) for light, radius in zip(q.scene.lights, q.radii, strict=True)]
    light = max(lamps, default=0.0) + (q.scene.around.brightest if q.scene.around else 0.0)
    bodies = [each for each in picture.features.terms if each.model.is_body]
    dimmest = [np.min(np.add(*picture.layer(each, frozenset()))[picture.weights > 0]) for each in bodies]
    floor = sum(dimmest) * q.scene.display.exposure + q.scene.display.floor
    return log(1 + rho * light * q.unit * q.scene.display.exposure / floor)
