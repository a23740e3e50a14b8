"""TracePro's table of BSDF: any surface by sines from the mirror direction.

Which angles, and how close a linear reader comes: `tables.goniometric`; with a grain, whose rotations are TracePro's
AziAngle, `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import IN_ROWS, with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(__name__, ".txt", "TracePro table of BSDF, sines from the mirror direction", several=True),
    several=True,
    levels=IN_ROWS,
)
