"""Blender's Principled, opaque: which law evaluates it, and its own words and numbers for it.

Its bodies are Standard Surface's in MaterialX and its metals OpenPBR's under a coat that does not darken. Widths across
and along a grain are roughness² over and times √(1 - 0.9 Anisotropic); IOR Level times 2 scales F0, so that at 0 a body
is matt; rotations are shares of a turn.

Source: Blender's manual, Principled BSDF; Kutz, Hasan and Edmondson 2021 for metals.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..physics.fresnel import f0, index_from_f0
from ._choice import has_body
from ._grained import axis_of
from ._nodes import Node, node_called
from .exporter import ColouredSurface

MOST = 0.9  # of 1 - (alpha along/alpha across)
USUAL_LEVEL = 0.5  # IOR Level that leaves the index as it is
FIELDS = {
    "base_color": "Base Color",
    "base_metalness": "Metallic",
    "metalness": "Metallic",
    "specular_roughness": "Roughness",
    "specular_ior": "IOR",
    "specular": "IOR Level",
    "specular_color": "Specular Tint",
    "specular_anisotropy": "Anisotropic",
    "specular_roughness_anisotropy": "Anisotropic",
    "coat_weight": "Coat Weight",
    "coat": "Coat Weight",
    "coat_roughness": "Coat Roughness",
    "coat_ior": "Coat IOR",
}
# the same words as they are typed in a command, with what Blender begins with
DEFAULTS = {
    "base_color": 0.8,
    "metallic": 0.0,
    "roughness": 0.5,
    "ior": 1.5,
    "ior_level": USUAL_LEVEL,
    "specular_tint": 1.0,
    "anisotropic": 0.0,
    "anisotropic_rotation": 0.0,
    "coat_weight": 0.0,
    "coat_roughness": 0.03,
    "coat_ior": 1.5,
}
BODY, METAL = "standard-surface", "openpbr"


def node_for(surface: ColouredSurface) -> Node:
    """The shader of another program itself where no grain, coat or weight of a lobe tells them apart."""
    target = BODY if has_body(surface) else METAL
    node = node_called(target)
    apart = (
        axis_of(surface) is not None or surface.has_mirror or any(each.model.is_coat for each in surface.model.terms)
    )
    for each in surface.model.terms:
        if each.model is node.law:
            values = surface.values_of(each)
            weight = np.asarray(values[node.weight])
            apart |= bool(np.any(values[node.coat]) or np.any((weight != 0) & (weight != 1)))
    return _with_its_own(target) if apart else node


@lru_cache(maxsize=2)
def _with_its_own(target: str) -> Node:
    """Its widths, its coat that does not darken; a lobe is there or not, and only its index says how high it is."""
    node, parameters = node_called(target), []
    for p in node.law.parameters:
        if p.name == "coat_darkening":
            p = replace(p, default=0.0)
        parameters.append(replace(p, high=MOST) if p.name == node.grain else p)
    only = {"specular": (0.0, 1.0), "specular_weight": (1.0,), "coat_darkening": (0.0,)}
    return replace(node, law=replace(node.law, parameters=tuple(parameters)), weight="", only=only)


def in_blenders_sense(values: Mapping) -> dict:
    """Roughness and Anisotropic of the two widths that the law has by its own numbers."""
    found = dict(values)
    for name in ("specular_anisotropy", "specular_roughness_anisotropy"):
        if name not in values:
            continue
        share = float(np.ravel(values[name])[0])
        found[name] = share / MOST
        if name == "specular_roughness_anisotropy":
            found["specular_roughness"] = values["specular_roughness"] * _of_mean_width(share)
    return found


def _of_mean_width(share: float) -> float:
    """Root of the geometric mean of OpenPBR's widths, of its roughness."""
    return float((2 * (1 - share) / (1 + (1 - share) ** 2)) ** 0.25)


def of_blender(given: Mapping) -> tuple[str, dict]:
    """The law of Blender's own numbers, and its numbers."""
    has = DEFAULTS | dict(given)
    share, level = MOST * _mean(has["anisotropic"]), _mean(has["ior_level"])
    coat = {name: has[name] for name in ("coat_roughness", "coat_ior")}
    shared = {"base_color": has["base_color"], "specular_color": has["specular_tint"]} | coat
    shared["axis"] = 360.0 * _mean(has["anisotropic_rotation"])
    if _mean(has["metallic"]):
        shared |= {"base_metalness": has["metallic"], "coat_weight": has["coat_weight"], "coat_darkening": 0.0}
        roughness = _mean(has["roughness"]) / _of_mean_width(share)
        return METAL, shared | {"specular_roughness": roughness, "specular_roughness_anisotropy": share}
    index = _mean(has["ior"])
    if level != USUAL_LEVEL:
        index = float(index_from_f0(min(level / USUAL_LEVEL * float(f0(index)), 0.99)))
    shared |= {"specular_roughness": has["roughness"], "specular_anisotropy": share, "coat": has["coat_weight"]}
    return BODY, shared | ({"specular_ior": index} if level else {"specular": 0.0})


def _mean(value) -> float:
    return float(np.mean(value))
