"""Speos spectral BRDF: any surface as a table for each incidence and wavelength.

Which angles, and how close a linear reader comes: `tables.goniometric`.
"""

from .tables.goniometric import goniometric_exporter

EXPORTER = goniometric_exporter(
    __name__,
    ".brdf",
    "Speos spectral BRDF, a table for each incidence and wavelength",
    several=True,
    turned="speos-anisotropic",
)
