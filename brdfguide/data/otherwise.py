"""How a measurement would read under a fault of the instrument that is too small to be noticed."""

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass


@dataclass(frozen=True, eq=False)
class Otherwise:
    """The same values with one fault at its standard deviation: their directions then, and what it multiplies them
    by, (samples, channels). A fit counts what this changes as doubt."""

    fault: str
    geom: Geometry
    factor: np.ndarray

    def __getitem__(self, rows) -> "Otherwise":
        """The same for some of the rows."""
        return Otherwise(self.fault, self.geom[rows], self.factor[rows])

    def of_channels(self, picked, geom: Geometry) -> "Otherwise":
        """The same for some of the channels, by their numbers; `geom` has their wavelengths."""
        return Otherwise(self.fault, self.geom.at(geom.wavelength), self.factor[:, picked])
