"""A surface as a tree of Mitsuba 3 plugins: diffuse, roughconductor and conductor, side by side in blendbsdf.

`roughconductor` with k = 0 is Fresnel's dielectric reflection without its transmission, so the tree serves paints as
well as metals. A blend weighs its parts, so each part is divided by its weight; a specular factor above 1 is right
there.

Traps, each seen by running Mitsuba 3.9.1: it has no phong, ward or merl plugin; its masking is separable; `eval` is
BRDF times cosine; it accepts alpha = 5, 0 and -0.1, and an rgb specular factor above 1 only as an unbounded srgb.
"""

import numpy as np

from ..physics.fresnel import fresnel
from ..physics.geometry import Geometry
from ..physics.microfacet import ggx_shape_uncorrelated
from . import _grained, _target_models
from ._choice import choose, fresnel_index, has_body, has_lobe, what_is_lost
from ._directions import rms_ln
from .exporter import ColouredSurface, Statement, glint, number, rgb_numbers, status_of

FAINT = 1e-2  # of the mirror's brightest: what is darker is not seen beside it
LEAST_BODY = 0.05  # of the paths, so that a dark body is still sampled
MOST_BODY = 0.95  # of them, so that what lies over a white body is sampled, too


def tree(surface: ColouredSurface, geom: Geometry | None, target: str):
    """The plugin tree and its Statement."""
    choice = choose(surface, geom, _candidates(surface)) if has_finite(surface) else None
    mirror, mirror_rms = _mirror(surface) if surface.has_mirror else (None, 0.0)
    if choice is None and mirror is None:  # a mirror of a reflectance too small to be sent anywhere
        return _diffuse(np.zeros(3), 1.0), _mirror_statement(surface, target, 0.0)
    if choice is None:
        statement = _mirror_statement(surface, target, mirror_rms)
        return _conductor(mirror, 1.0), statement
    lost = what_is_lost(surface) + (() if surface.has_mirror else glint(surface))
    axis = _grained.axis_of(surface)
    notes = () if axis is None else _grained.tangent_note(axis, "u")
    statement = choice.statement(target, surface, lost=lost, notes=notes, mirror=mirror_rms)
    values = choice.values
    bright = float(np.max(values["albedo"])) if "albedo" in values else 0.0
    lobe = bool({"alpha", "alpha_x"} & values.keys())
    body_share = min(max(bright, LEAST_BODY), MOST_BODY) if bright > 0 else 0.0
    if not lobe and mirror is None:
        body_share = 1.0
    rest = (1 - body_share) / ((mirror is not None) + lobe or 1)
    parts = []
    if bright > 0:
        parts.append((body_share, _diffuse(values["albedo"], body_share)))
    if lobe:
        parts.append((rest, _rough(choice.name, values, rest)))
    if mirror is not None:
        parts.append((rest, _conductor(mirror, rest)))
    return _blend(parts or [(1.0, _diffuse(np.zeros(3), 1.0))]), statement


def has_finite(surface: ColouredSurface) -> bool:
    """Whether the surface is more than a mirror."""
    return any(not term.model.is_mirror for term in surface.model.terms)


def _candidates(surface: ColouredSurface) -> dict:
    targets = {}
    if has_body(surface):
        targets["body"] = _target_models.body_alone()
    axis = _grained.axis_of(surface)
    if axis is not None:
        index, target = fresnel_index(surface), _grained.grained_conductor(axis, correlated=False)
        bare = {} if has_body(surface) else {"albedo": 0.0}
        targets = {} if index is None else {"ggx own n, k": target.with_fixed(n=index[0], k=index[1], **bare)}
        return targets or {"ggx fitted n": target.with_fixed(k=0.0, **bare)}
    if has_lobe(surface):
        index = fresnel_index(surface)
        for name, shape in (("ggx", ggx_shape_uncorrelated), ("beckmann", _target_models.beckmann_uncorrelated)):
            target = _target_models.body_and_conductor(shape)
            bare = {} if has_body(surface) else {"albedo": 0.0}
            if index is not None:
                targets[f"{name} own n, k"] = target.with_fixed(n=index[0], k=index[1], **bare)
            if index is None or not np.any(index[1]):
                targets[f"{name} fitted n"] = target.with_fixed(k=0.0, **bare)
    return targets


def _mirror(surface: ColouredSurface):
    """n, k, a factor by colour, and how well that follows the mirror's reflectance over 0 to 80 degrees."""
    theta = np.linspace(0.0, 80.0, 81)
    geom = Geometry.from_degrees(theta, 0.0, theta, 180.0)
    wanted = np.maximum(surface.mirror_rgb(geom), 0.0)
    n, k = fresnel_index(surface) or (np.full(3, 1.5), np.zeros(3))
    smooth = fresnel(geom.cos_i[:, None], n, k)
    counted = wanted > FAINT * wanted.max()
    wanted = np.where(counted, wanted, np.nan)
    factor = np.array(
        [np.exp(np.nanmean(np.log(wanted[:, c] / smooth[:, c]))) if counted[:, c].any() else 0.0 for c in range(3)]
    )
    return {"n": n, "k": k, "scale": factor}, rms_ln(np.maximum(smooth * factor, 1e-300), wanted)


def _mirror_statement(surface, target, rms):
    return Statement(
        target,
        status_of(rms),
        rms,
        81,
        "the mirror direction at theta_i 0..80 deg",
        colour=surface.colour.how,
    )


def _rgb(values, low, high, what) -> dict | float:
    """A colour, or one number where the three agree."""
    values = rgb_numbers(values, low, high, what)
    if values[0] == values[1] == values[2]:
        return values[0]
    if what in ("eta", "k"):
        return {"type": "rgb", "value": values}
    return _colour(values)


def _colour(values: list[float]) -> dict:
    if max(values) <= 1:
        return {"type": "rgb", "value": values}
    return {"type": "srgb", "color": values, "unbounded": True}


def _diffuse(albedo, share) -> dict:
    reflectance = rgb_numbers(np.asarray(albedo) / share, 0.0, 1.001 / MOST_BODY, "reflectance")
    return {"type": "diffuse", "reflectance": _colour(reflectance)}


def _index(of_term) -> dict:
    n = of_term.get("n", 1.5)
    return {"eta": _rgb(n, 1e-3, 100.0, "eta"), "k": _rgb(of_term.get("k", 0.0), 0.0, 100.0, "k")}


def _rough(name: str, values, share) -> dict:
    widths = {"alpha": "alpha"} if "alpha" in values else {"alpha_u": "alpha_x", "alpha_v": "alpha_y"}
    return {
        "type": "roughconductor", "distribution": name.split()[0],
        **{ours: number(values[name], 1e-4, 1.0, ours) for ours, name in widths.items()},
        **_index(values), "specular_reflectance": _rgb(values["scale"] / share, 0.0, 1e5, "specular_reflectance"),
    }  # fmt: skip


def _conductor(of_term, share) -> dict:
    return {
        "type": "conductor",
        **_index(of_term),
        "specular_reflectance": _rgb(of_term["scale"] / share, 0.0, 1e5, "specular_reflectance"),
    }


def _blend(parts) -> dict:
    """Parts with shares that add up to 1, as nested pairs; weight is the share of the second."""
    share, first = parts[0]
    if len(parts) == 1:
        return first
    others = sum(each for each, _ in parts[1:])
    second = _blend([(each / others, plugin) for each, plugin in parts[1:]])
    return {
        "type": "blendbsdf",
        "weight": number(others / (share + others), 0.0, 1.0, "weight"),
        "first": first,
        "second": second,
    }
