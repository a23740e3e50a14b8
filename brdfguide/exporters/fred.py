"""FRED tabulated BSDF text: any surface as directions about the mirror direction.

Which angles, and how close a linear reader comes: `tables.goniometric`; with a grain, whose specular directions have
azimuths, `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import IN_ROWS, with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(__name__, ".txt", "FRED tabulated BSDF text", several=False), levels=IN_ROWS
)
