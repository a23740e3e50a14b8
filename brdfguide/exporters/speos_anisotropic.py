"""Speos anisotropic BSDF: any surface as a table about the normal for each rotation of the sample and incidence.

Which angles, and how close a linear reader comes: `tables.goniometric`; with a grain, `tables.turned_goniometric`.
"""

from .tables.goniometric import goniometric_exporter
from .tables.turned_goniometric import ABOUT_NORMAL, with_rotations

EXPORTER = with_rotations(
    goniometric_exporter(
        __name__, ".anisotropicbsdf", "Speos anisotropic BSDF, a table for each rotation and incidence", several=False
    ),
    levels=ABOUT_NORMAL,
)
