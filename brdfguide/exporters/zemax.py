"""Zemax tabular BSDF: any surface as a table about the mirror direction, for OpticStudio.

Which angles, and how close a linear reader comes: `tables.goniometric`. A surface with a grain gets a table for each
rotation of the sample (ASymmetrical4D): `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(
        __name__, ".bsdf", "Zemax tabular BSDF, angles about the mirror direction, for OpticStudio", several=False
    )
)
