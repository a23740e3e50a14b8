"""What a shader's numbers cost, in words: what it cannot hold, why, and what other programs make of the same ones."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..physics import grain, microfacet
from ..physics.geometry import Geometry
from ..printable import off_words_of
from . import _grained
from ._choice import GOOD, ONE_LOBE, Choice, has_body, what_is_lost
from ._directions import judged_over, rms_ln
from ._nodes import Node, choose_node, own_values
from ._smooth import is_smooth
from .exporter import ColouredSurface, Statement, glint

HIGH_DEG = 60.0  # beyond, laws and shaders part over what lies under a surface


def node_statement(
    node: Node, target: str, surface: ColouredSurface, geom: Geometry | None
) -> tuple[Choice, Statement]:
    """The numbers of the node and their Statement."""
    choice = choose_node(node, surface, geom)
    axis = _grained.axis_of(surface)
    notes = readings(node, choice, surface, geom)
    if axis is not None:
        notes += _one_width(node, choice, surface, geom) + _streak(node, axis)
    return choice, choice.statement(target, surface, lost=what_it_costs(node, surface, choice), notes=notes)


def what_it_costs(node: Node, surface: ColouredSurface, choice: Choice) -> tuple[str, ...]:
    """Sentences for what the shader cannot hold, and for what it lacks where the numbers are off by more than GOOD."""
    if own_values(node, surface) is not None:
        return ()
    lacks = () if choice.rms_ln <= GOOD else (_lacks(node, surface, choice),)
    if not node.grain and _grained.axis_of(surface) is not None:
        lacks = ("the surface has a grain, and this shader none: its lobe is a mean over all turns",)
    if is_smooth(surface):
        return lacks
    lost = what_is_lost(surface)
    if np.any(choice.values.get(node.coat, 0.0)):  # one lobe is the coat's
        lost = tuple(each for each in lost if not each.endswith(ONE_LOBE))
    return (() if surface.has_mirror else glint(surface)) + lost + lacks


def _lacks(node: Node, surface: ColouredSurface, choice: Choice) -> str:
    """Why the best numbers are far off, and how far where light and eye stand high."""
    kinds = [term.model for term in surface.model.terms]
    body = any(kind.is_body for kind in kinds) or has_body(surface) and kinds[0].settings
    if any(kind.is_coat for kind in kinds) and len(kinds) > 1:
        why = node.lacks["coat"]
    elif surface.has_mirror and not any(kind.is_mirror for kind in kinds):
        why = "the mirror image of a rough surface becomes a coat's, which does not fade as waves fade it"
    elif body and "body" in node.lacks:
        why = node.lacks["body"]
    elif not body and surface.has_mirror and len(kinds) > 1 and "lobe" in node.lacks:
        why = node.lacks["lobe"]
    elif node.masked_alike and _grained.axis_of(surface) is not None:
        why = "it masks light and view with one width, whichever way they stand"
    elif node.by_schlick:
        why = "F is Schlick's curve, which lies below Fresnel's between 40 and 80 degrees"
    else:
        why = "its lobe is GGX's, and this one has another shape"
    high = _off_up_to(HIGH_DEG, surface, choice)
    return why if high is None else f"{why}; up to {HIGH_DEG:g} degrees {off_words_of(high)} off"


def _off_up_to(most_deg: float, surface: ColouredSurface, choice: Choice) -> float | None:
    """rms ln of the finite part where neither light nor eye stands lower; None where there is none."""
    if choice.brdf is None or is_smooth(surface):
        return None
    geom, wanted, _ = judged_over(surface, None)
    high = (geom.theta_i_deg <= most_deg) & (geom.theta_r_deg <= most_deg)
    return rms_ln(choice.brdf(geom), np.where(high, wanted, np.nan))


def readings(node: Node, choice: Choice, surface: ColouredSurface, geom: Geometry | None) -> tuple[str, ...]:
    """What the same numbers cost in programs that read the shader's text in another published way."""
    if choice.brdf is None or not node.law.readings:
        return ()
    geom, wanted, _ = judged_over(surface, geom)
    found = []
    for words, law in node.law.readings.items():
        other: Callable = replace(node.law, brdf=law)
        error = rms_ln(other(geom, **{**node.law.defaults(), **choice.values}), wanted)
        found.append(
            f"as MaterialX's nodes evaluate it; with {words}, as other programs have it, {off_words_of(error)} off"
        )
    return tuple(found)


def _one_width(node: Node, choice: Choice, surface: ColouredSurface, geom: Geometry | None) -> tuple[str, ...]:
    """What MaterialX's masking, which has one width for light and view, makes of a metal with a grain."""
    values = {**node.law.defaults(), **choice.values}
    if node.widths is None or not np.all(values[node.metalness]) or np.any(values[node.coat]):
        return ()
    geom, wanted, _ = judged_over(surface, geom)
    wide, narrow = node.widths(values[node.roughness], values[node.grain])
    alpha = np.sqrt(wide * narrow)
    alike = microfacet.ggx_shape(geom, alpha) / microfacet.ggx(geom, alpha)
    apart = grain.grained_shape(geom, wide, narrow, values["axis"]) / grain.grained_density(
        geom, wide, narrow, values["axis"]
    )
    off = off_words_of(rms_ln(node.law(geom, **values) * alike / apart, wanted))
    return (f"MaterialX masks light and view with one width, √(across along), however they stand: {off} off",)


def _streak(node: Node, axis: float) -> tuple[str, ...]:
    """Where the streak lies, and what turns the tangent."""
    if not node.grain:
        return ()
    by = "nodes of the file turn" if node.law.name == "openpbr" else "its own rotation turns"
    turned = f"{np.degrees(axis) % 180:.3g} degrees counter-clockwise from the mesh's"
    return (f"the streak lies along the tangent that {by}, {turned}; the grooves run across it",)
