"""Mitsuba 3, Python: a module whose `MATERIAL` goes into `mitsuba.load_dict`."""

from pprint import pformat

from ..geometry import Geometry
from ._base import Export, Exporter, Surface, header
from ._mitsuba import tree


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Python text and its Statement."""
    plugins, statement = tree(surface, geom, "mitsuba-dict")
    comment = "\n".join("# " + line for line in header(surface, statement))
    return Export(f"{comment}\n\nMATERIAL = {pformat(plugins, sort_dicts=False, width=110)}\n", statement)


EXPORTER = Exporter(__name__, ".py", "Mitsuba 3 Python dict for mitsuba.load_dict", export)
