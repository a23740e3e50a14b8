"""An ideal mirror for targets that hold finite values alone: spread over a narrow lobe that keeps its energy.

    f = rho(θd) D(δ) / (4 cos θi cos θr),   D Beckmann's with alpha = 0.01: 1.9 degrees wide at half height

A table cannot hold a spike; left out, a polished surface would turn matt.
"""

from dataclasses import fields

import numpy as np

from ...physics import microfacet
from ...physics.geometry import Geometry, rows
from ..exporter import ColouredSurface

ALPHA = 0.01


class Blurred(ColouredSurface):
    """The surface with its mirror spread."""

    def spectral(self, geom: Geometry) -> np.ndarray:
        geom = rows(geom)
        theta = np.degrees(np.arctan2(0.5 * np.sqrt(4 - np.minimum(geom.v2, 4.0)), geom.cos_d))
        met = rows(Geometry.from_degrees(theta, 0.0, theta, 180.0))
        lobe = np.zeros(geom.shape)
        lobe[geom.lit] = microfacet.beckmann(geom, ALPHA)[geom.lit] / (4 * geom.cos_i * geom.cos_r)[geom.lit]
        return super().spectral(geom) + self.mirror(met) * lobe


def blurred(surface: ColouredSurface) -> tuple[ColouredSurface, tuple[str, ...]]:
    """The surface as a table can hold it, and the sentence that says so."""
    if surface.mirror_most[1] <= 1e-6:
        return surface, ()
    made = Blurred(**{field.name: getattr(surface, field.name) for field in fields(ColouredSurface)})
    return made, (f"the mirror image, up to {surface.mirror_most[1]:.1g} of the light, is blurred to 1.9 deg",)
