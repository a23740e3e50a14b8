"""FRED tabulated BSDF text: any surface as directions about the mirror direction.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(__name__, ".txt", "FRED tabulated BSDF text", several=False)
