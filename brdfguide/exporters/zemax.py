"""Zemax tabular BSDF: any surface as a table about the mirror direction, for OpticStudio.

Which angles, and how close a linear reader comes: `tables.goniometric`. A surface with a grain gets a table for each
rotation of the sample (ASymmetrical4D): `tables.turned_goniometric`.
"""

from dataclasses import replace

from ..data import formats
from ..physics.geometry import Geometry
from . import _grained
from .exporter import ColouredSurface, Export
from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import turned_table_of

ROUND = goniometric_exporter(
    __name__, ".bsdf", "Zemax tabular BSDF, angles about the mirror direction, for OpticStudio", several=False
)


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """The text and its Statement."""
    if not _grained.terms_that_turn(surface):
        return ROUND.export(surface, geom, stem)
    made = turned_table_of("zemax", surface, geom)
    text, notes = formats.write("zemax", made.measurement)
    return Export(text, replace(made.statement, notes=(*made.statement.notes, *notes)))


EXPORTER = replace(ROUND, export=export, grained=True)
