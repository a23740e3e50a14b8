"""Zemax tabular BSDF: any surface as a table about the mirror direction, for OpticStudio.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(
    __name__, ".bsdf", "Zemax tabular BSDF, angles about the mirror direction, for OpticStudio", several=False
)
