"""Our own CSV: any surface as a goniometer's table.

Which angles, and how close a linear reader comes: `tables.goniometric`; with a grain, `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import IN_ROWS, with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(__name__, ".csv", "our own CSV, as a goniometer's table", several=True),
    several=True,
    levels=IN_ROWS,
)
