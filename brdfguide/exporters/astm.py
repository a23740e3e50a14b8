"""ASTM E1392 text: any surface as a row for each direction.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(__name__, ".astm", "ASTM E1392 text, a row a direction", several=True)
