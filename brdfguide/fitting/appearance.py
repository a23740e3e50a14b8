"""How far fits look from the measurement, and from each other: S in lightness L* (`physics.seen`).

It orders finished fits; no fit makes it small.
"""

from collections.abc import Sequence

import numpy as np

from ..data.measurement import LARGEST, Measurement
from ..data.seen_weights import seen_weights, steps
from ..finding import Finding
from ..formed import formed
from ..models.surface import Surface
from ..physics import seen
from ..physics.aperture import Instrument
from ..physics.geometry import in_plane, rows
from ..records import dataclass
from .fit import Fit
from .reading import reading

TOO_NARROW = 2.0  # steps of the scan; a lobe of less is read at too few angles to say how bright it looks
LOBE_AT_DEG = 30.0  # incidence at which the width of a lobe is taken


@dataclass(frozen=True, eq=False)
class Appearance:
    """Lightness [L*] of a measurement and of the fits to it, on the directions that stand for a sphere."""

    data: np.ndarray  # (directions, colours)
    fits: tuple[np.ndarray, ...]
    weights: np.ndarray  # (directions,)
    kind: str  # of the weights: quadrature, ring, neighbours

    def seen(self, place: int) -> float:
        """S [L*] of one fit."""
        return seen.apart(self.fits[place], self.data, self.weights)

    def between(self, place: int, other: int) -> float:
        """S [L*] between two fits."""
        return seen.apart(self.fits[place], self.fits[other], self.weights)


def of_fits(fits: Sequence[Fit], residuals: Sequence[np.ndarray], measurement: Measurement) -> Appearance:
    """Fits with their `residuals` ln(model/data) on a measurement; values that are not positive count as black."""
    standing = seen_weights(measurement)
    colours = seen.colours(measurement.channels, measurement.geom.wavelength)
    counted = np.flatnonzero(np.any(colours != 0, axis=1))
    kept = np.flatnonzero((standing.of_rows > 0) & (np.abs(measurement.brdf[:, counted]) < LARGEST).all(axis=1))
    data = measurement.brdf[np.ix_(kept, counted)] if len(counted) < len(colours) else measurement.brdf[kept]
    geom, mixing = measurement.geom[kept], _mixing(colours[counted])
    told = measurement.clear[kept][:, counted]
    dark = np.flatnonzero(~told.all(axis=1))
    shown = []
    for fit, each in zip(fits, residuals, strict=True):
        value = np.exp(np.minimum(each[kept][:, counted], 300.0))
        value *= data
        if len(dark):
            value[dark] = reading(fit.surface, Instrument(geom[dark], measurement.solid_angle))[:, counted]
        shown.append(seen.lightness(mixing(value), geom.cos_i))
    return Appearance(seen.lightness(mixing(data), geom.cos_i), tuple(shown), standing.of_rows[kept], standing.kind)


def _mixing(colours):
    """Channels to colours; as they are where each is one."""
    if np.array_equal(colours, np.eye(len(colours))):
        return lambda value: value
    return lambda value: value @ colours


def too_coarse(surface: Surface, measurement: Measurement) -> Finding | None:
    """Says where a scan's steps are too wide for L*: the lobe is narrower than two of them."""
    step = _step_about_mirror_deg(measurement)
    if step is None:
        return None
    width = lobe_width_deg(surface)
    if width is None or width >= TOO_NARROW * step:
        return None
    text = f"the lobe is {width:.2g} degrees wide and the readings beside the mirror direction lie {step:.2g} apart"
    return Finding("coarse-scan", text, "note", "L* is rough here; the order of the models is not in doubt")


@formed
def _step_about_mirror_deg(measurement: Measurement) -> float | None:
    """Between readings about the mirror direction; None where there are none in the plane of incidence."""
    if not measurement.in_plane or len(measurement.geom) < 3:
        return None
    near = measurement[np.abs(measurement.geom.signed_theta_r_deg - measurement.geom.theta_i_deg)[:, 0] < 20]
    return float(np.degrees(np.median(steps(near)[0]))) if len(near.geom) else None


def lobe_width_deg(surface: Surface) -> float | None:
    """Full width at half height of the lobe in the plane of incidence; None where there is none within 30 degrees."""
    off = np.geomspace(1e-3, 30.0, 90)
    f = np.mean(surface.middle.brdf(rows(in_plane(LOBE_AT_DEG, LOBE_AT_DEG + np.r_[0.0, off]))), axis=1)
    below = np.flatnonzero(f < 0.5 * (f[0] + f[-1]))
    return 2 * float(off[below[0] - 1]) if f[0] > 1.2 * f[-1] and below.size and below[0] > 0 else None
