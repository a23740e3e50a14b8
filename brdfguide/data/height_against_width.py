"""Whether the peak of a scan is higher than any surface of its width could make it.

    F = 4π alpha² f cos θi cos θr,   alpha the width over slopes in the scan's own plane

is the reflectance that facets without a grain would need, and 1 is the most there is. With a grain a scan across it,
along the streak, has F alpha_x/alpha_y: several times what a mirror reflects on brushed metal. A peak too low proves
nothing: rough surfaces lose light between their facets.
"""

import numpy as np

from ..finding import Finding
from ..formed import formed
from . import lobe_ellipse
from .measurement import Measurement, row_median, rows_by_tenth
from .turning import turn_of_each

IMPOSSIBLE = 1.5  # times a mirror's reflectance: calibration and the shape of the tail explain less (ours)
MOST_DEG = 75.0  # toward grazing, where masking and Fresnel's factor shape a peak as well
FEWEST = 5  # values of a scan's peak


@formed
def reflectance_needed(measurement: Measurement) -> float | None:
    """F, the median over incidences; None where the sample was turned or the scans leave the plane of incidence, and
    where no peak is told."""
    if not measurement.in_plane or turn_of_each(measurement.geom) is not None:
        return None
    incidences, reflected = measurement.theta_i_groups, rows_by_tenth(measurement.geom.signed_theta_r_deg[:, 0])
    # what was scanned finely is the scan; the exchange of light and detector changes nothing of it
    scans = reflected if len(reflected) < len(incidences) else incidences
    found = [each for each in (_of_scan(measurement, rows) for rows in scans.values()) if each is not None]
    return float(np.median(found)) if found else None


def is_too_high(measurement: Measurement) -> bool:
    """Whether nothing without a grain could reflect so much."""
    needed = reflectance_needed(measurement)
    return needed is not None and needed >= IMPOSSIBLE


def height_findings(measurement: Measurement):
    """The finding where nothing could reflect so much."""
    needed = reflectance_needed(measurement)
    if needed is None or needed < IMPOSSIBLE:
        return
    text = (
        f"the peak is {needed:.2g} times as high as a mirror's facets of this width could make it: brushed, and "
        f"scanned across the grain, or the scale is wrong: measure a second azimuth of the sample"
    )
    consequence = "F is held at a metal's 0.8: of laws without a grain the height is free, of others the width along it"
    yield Finding("height-against-width", text, "warning", consequence, "--scale", (("reflectance", needed),))


def _of_scan(measurement: Measurement, rows) -> float | None:
    """F of one scan."""
    geom = measurement.geom
    rows = rows[np.maximum(geom.theta_i_deg, geom.theta_r_deg)[rows, 0] <= MOST_DEG]
    level = np.exp(row_median(measurement.ln[rows]))
    rows, level = rows[np.isfinite(level)], level[np.isfinite(level)]
    if len(rows) < FEWEST:
        return None
    body = float(np.quantile(level, lobe_ellipse.BODY))
    lobe = level - body
    kept = lobe > np.maximum(np.exp(-lobe_ellipse.KEPT) * lobe.max(), lobe_ellipse.CLEAR * body - body)
    if np.count_nonzero(kept) < FEWEST:
        return None
    rows = rows[kept]
    slope = np.copysign(np.sqrt(geom.tan2_h[rows, 0]), geom.signed_theta_r_deg[rows, 0] - geom.theta_i_deg[rows, 0])
    ln = np.log(lobe[kept] * geom.cos_cos[rows, 0]) - 2 * geom.ln_sec2_h[rows, 0]
    if not slope.min() < 0 < slope.max() or len(np.unique(slope)) < FEWEST:
        return None
    bend = np.polyfit(slope, ln, 2)[0]
    if bend >= 0:
        return None
    top = float(ln.max())  # what was read, not what a parabola would have at a shifted peak
    return 4 * np.pi * np.exp(top) / -bend
