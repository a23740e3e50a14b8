"""One scatter told in every law of polished optics: fits of each to a curve or a scan, with what the fit costs.

What a stray-light program calls ABg has not Harvey and Shack's shoulder, and neither has a wavelength. So a law is
turned into another by a fit over a stated range of |β - β0|, never by a formula, and its error is told.
"""

from dataclasses import replace

import numpy as np

from .. import models
from ..data.measurement import Measurement
from ..physics.geometry import Geometry, in_plane, rows
from ..records import dataclass
from .fit import Fit, FitOptions, fit

LAWS = ("abg", "harvey-shack", "abc")
PER_DECADE = 20
FARTHEST = 0.98  # of the way to the horizon, where cosines still leave something


@dataclass(frozen=True, eq=False)
class Told:
    """A scatter in one law."""

    law: str
    fit: Fit

    @property
    def worst(self) -> float:
        """The largest |ln(law/curve)|."""
        return float(np.nanmax(np.abs(self.fit.residuals)))


def directions(theta_i_deg: float, low: float, high: float, wavelength: float) -> Geometry:
    """Directions in the plane of incidence with |β - β0| even in its logarithm from low to high; beyond the mirror
    direction as far as the horizon allows, then back toward the light.
    """
    x = np.geomspace(low, high, max(int(PER_DECADE * np.log10(high / low)), 8))
    sine = np.sin(np.radians(theta_i_deg))
    beta = np.where(sine + x <= FARTHEST, sine + x, sine - x)
    return rows(in_plane(theta_i_deg, np.degrees(np.arcsin(beta)), wavelength))


def widest(theta_i_deg: float) -> float:
    """The greatest |β - β0| of `directions`."""
    return FARTHEST + float(np.sin(np.radians(theta_i_deg)))


def as_measurement(geom: Geometry, brdf) -> Measurement:
    """Values of a law or a theory in the shape of a measurement."""
    wavelength = np.atleast_1d(geom.wavelength)
    channels = tuple(f"{1000 * each:g} nm" for each in wavelength)
    return Measurement(geom.at(wavelength), np.asarray(brdf), channels, name="a curve")


def beyond_mirror(measurement: Measurement, low: float, high: float) -> Measurement:
    """The rows with low <= |β - β0| <= high."""
    x = np.sqrt(measurement.geom.vxy2[:, 0])
    return measurement[(x >= low) & (x <= high)]


def in_laws(measurement: Measurement, reflectance: float) -> tuple[Told, ...]:
    """The three laws fitted; `abc` with this reflectance of the smooth surface."""
    told = []
    for law in LAWS:
        model = models.get(law)
        if law == "abc":
            model = replace(model, fixed={"abc.f0": reflectance})
        told.append(Told(law, fit(model, measurement, FitOptions(weights="none"))))
    return tuple(told)
