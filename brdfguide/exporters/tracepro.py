"""TracePro's table of BSDF: any surface by sines from the mirror direction.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(
    __name__, ".txt", "TracePro table of BSDF, sines from the mirror direction", several=True
)
