"""A finished figure turned over for a dark ground: paper and ink change places, every colour keeps its name."""

from copy import deepcopy

import numpy as np
from matplotlib.axis import Axis
from matplotlib.collections import Collection
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Annotation, Text
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .palette import INK, RULE, SWAPPED


def darken(fig: Figure) -> None:
    """Every colour of a figure that has a dark twin becomes it. Pictures keep theirs."""
    for axis in fig.findobj(Axis):  # ticks that are made while it is drawn
        axis.set_tick_params(which="both", color=SWAPPED[INK], labelcolor=SWAPPED[INK], grid_color=SWAPPED[RULE])
    found = fig.findobj(lambda artist: True)
    arrows = [each.arrow_patch for each in found if isinstance(each, Annotation) and each.arrow_patch is not None]
    for each in [*found, *arrows]:
        if isinstance(each, Line2D):
            each.set_color(_twin(each.get_color()))
            each.set_markerfacecolor(_twin(each.get_markerfacecolor()))
            each.set_markeredgecolor(_twin(each.get_markeredgecolor()))
        elif isinstance(each, Patch):
            each.set_facecolor(_twin(each.get_facecolor()))
            each.set_edgecolor(_twin(each.get_edgecolor()))
        elif isinstance(each, Poly3DCollection):
            continue  # its shades are its own, and are given back in the order of their depth
        elif isinstance(each, Collection):
            each.set_facecolor(_twins(each.get_facecolor()))
            each.set_edgecolor(_twins(each.get_edgecolor()))
        elif isinstance(each, Text):
            each.set_color(_twin(each.get_color()))
        if halos := each.get_path_effects():
            each.set_path_effects([_dark_halo(effect) for effect in halos])


def _dark_halo(effect):
    """A copy, since figures share theirs; a halo's colour has no setter."""
    made = deepcopy(effect)
    behind = getattr(made, "_gc", {})
    if "foreground" in behind:
        behind["foreground"] = _twin(behind["foreground"])
    return made


def _twin(colour):
    if isinstance(colour, str) and colour == "none":
        return colour
    *_, alpha = to_rgba(colour)
    found = SWAPPED.get(to_hex(colour))
    return colour if found is None else (*to_rgba(found)[:3], alpha)


def _twins(colours) -> list:
    return [_twin(tuple(each)) for each in np.atleast_2d(colours)] if len(colours) else []
