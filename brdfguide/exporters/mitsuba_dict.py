"""Mitsuba 3, Python: a module whose `MATERIAL` goes into `mitsuba.load_dict`."""

from pprint import pformat

from ..physics.geometry import Geometry
from ._mitsuba import tree
from .exporter import ColouredSurface, Export, Exporter, comment_lines


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Python text and its Statement."""
    plugins, statement = tree(surface, geom, "mitsuba-dict")
    first = "coding: utf-8"  # else a name that says `coding: utf-7` would choose how the file is read
    comment = "\n".join("# " + line for line in (first, *comment_lines(surface, statement)))
    return Export(f"{comment}\n\nMATERIAL = {pformat(plugins, sort_dicts=False, width=110)}\n", statement)


EXPORTER = Exporter(__name__, ".py", "Mitsuba 3 Python dict for mitsuba.load_dict", export, grained=True)
