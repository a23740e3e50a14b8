"""Our own CSV: any surface as a goniometer's table.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(__name__, ".csv", "our own CSV, as a goniometer's table", several=True)
