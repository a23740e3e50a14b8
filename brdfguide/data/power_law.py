"""Whether what was measured is a power law of the distance from the mirror direction, as of polished surfaces.

    ln f = p + (s/2) ln(1 + (x/l)²)  [+ ln cos θi cos θr],   x = |β - β0| = |i_xy + r_xy|

Facets fall as x⁻⁴ or faster, and each incidence has its own lobe; heights with the spectrum of a polish fall as x^-1 to
x^-3.5, and all incidences lie on one line. What a body adds is taken off first. The brightest few rows do not count,
which may have seen the mirror beam.
"""

import numpy as np

from ..records import dataclass
from .measurement import Measurement

STEEPEST, FLATTEST = -3.6, -0.5  # s: between facets and a body (ours)
LEAST_RANGE = np.log(100)  # of ln f
LEAST_REACH = 5.0  # x beyond the shoulder, in units of it
MOST_OFF = 0.3  # rms ln, once the worst twentieth is left out (ours)
TRIMMED = 0.05
LEAST_ROWS, MOST_ROWS = 15, 2000  # the latter evenly spread over a larger table
SHOULDERS = 40
BODIES = (0.0, 0.5, 0.8, 0.95)  # of the dimmest values


@dataclass(frozen=True)
class PowerLaw:
    """ln f against ln x in one channel."""

    slope: float  # s
    shoulder: float  # l
    rms_ln: float
    decades: float  # of x that were measured


def power_law(measurement: Measurement) -> PowerLaw | None:
    """The line in the channel with the widest range; None where the values are no power law of x."""
    channel = int(np.argmax(np.count_nonzero(measurement.clear, axis=0)))
    x = np.sqrt(measurement.geom.vxy2[:, 0])
    beam = measurement.instrument.beam[:, 0] > 0
    rows = np.flatnonzero(measurement.clear[:, channel] & (x > 0) & ~beam)
    if len(rows) < LEAST_ROWS:
        return None
    rows = rows[:: -(-len(rows) // MOST_ROWS)]
    x, value = x[rows], measurement.brdf[rows, channel]
    if np.log(np.quantile(value, 0.98) / np.quantile(value, 0.02)) < LEAST_RANGE or x.max() < 10 * x.min():
        return None
    cosines = np.log(measurement.geom.cos_cos[rows, 0])
    floor = np.quantile(value, 0.02)
    tried = (
        _line(np.log(x[above]), np.log(value[above] - share * floor) - tilt[above])
        for share in BODIES
        for tilt in (np.zeros_like(cosines), cosines)
        for above in [value > 1.2 * share * floor]
        if np.count_nonzero(above) >= LEAST_ROWS and x[above].max() > 10 * x[above].min()
    )
    best = min(tried, key=lambda each: each.rms_ln)
    steep = STEEPEST <= best.slope <= FLATTEST
    return best if steep and best.rms_ln < MOST_OFF and x.max() > LEAST_REACH * best.shoulder else None


def _line(ln_x, ln_f) -> PowerLaw:
    """The best slope and shoulder of many shoulders; p and s by least squares."""
    lines, decades = [], float(np.ptp(ln_x)) / np.log(10)
    for shoulder in np.geomspace(0.3 * np.exp(ln_x.min()), np.exp(ln_x.max()), SHOULDERS):
        bent = 0.5 * np.logaddexp(0.0, 2 * (ln_x - np.log(shoulder)))
        across, up = bent - bent.mean(), ln_f - ln_f.mean()
        slope = float(across @ up / (across @ across))
        left = np.sort(np.abs(up - slope * across))
        kept = left[: max(int((1 - TRIMMED) * len(left)), 2)]
        lines.append(PowerLaw(slope, float(shoulder), float(np.sqrt(np.mean(kept**2))), decades))
    return min(lines, key=lambda each: each.rms_ln)
