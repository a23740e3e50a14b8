"""ASTM E1392 text: any surface as a row for each direction.

Which angles, and how close a linear reader comes: `tables.goniometric`; with a grain, `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import IN_ROWS, with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(__name__, ".astm", "ASTM E1392 text, a row a direction", several=True),
    several=True,
    levels=IN_ROWS,
)
