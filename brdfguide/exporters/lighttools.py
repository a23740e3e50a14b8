"""LightTools tabular BSDF: any surface as a table about the normal.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(__name__, ".bsdf", "LightTools tabular BSDF, angles about the normal", several=False)
