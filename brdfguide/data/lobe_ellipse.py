"""The shape of a lobe's peak over slopes: round, or an ellipse with a grain, from the values alone.

    ln (f cos θi cos θr/(1 + |s|²)²) = c - s'Ms,   s = (v_x, v_y)/v_z,   v = i + r

in the sample's frame, over what lies within a factor e² of the peak of each scan and stands clear of the body below it.
M's eigenvectors are the axes of the grain, its eigenvalues 1/alpha² of both widths: an isotropic surface of facets has
a round lobe in s wherever the light stands, so that one azimuth of the light tells if the detector left the plane of
incidence; scans in the plane tell from three azimuths on. Gaussian slopes have these widths; longer tails are a little
wider, alike in both.
"""

from math import pi

import numpy as np

from ..formed import formed
from ..records import dataclass
from .conventions import retro_distance_deg
from .measurement import Measurement, row_median
from .turning import turn_of_each

STEEPEST_DEG = 62.0  # incidence beyond which masking and Fresnel's factor shape the peak as well
KEPT = 2.0  # ln below the peak
BODY = 0.1  # quantile of the values of an incidence that is taken for the body's
CLEAR = 1.5  # times the body that the sum must be: the lobe at least half as bright
FEWEST = 8  # values of an incidence
FEWEST_OF_SCAN = 5  # values of the peak of one scan
PLANE_DEG = 1.0  # within which a value lies in the plane of incidence
MOST_INCIDENCES = 24  # of scattered directions, which stand for hundreds
SCATTERED_DEG = 10.0  # of incidence, over which directions are taken together that lie in no scan of one
# ratio of widths and standard errors of its logarithm from which one azimuth of the light shows a grain: masking and
# one-sided scans shape a lobe as well (ours)
SEEN_UNTURNED, SURE_UNTURNED = 2.0, 5.0
FEWEST_UNTURNED = 3  # incidences
LEAST_AXES = 0.02  # of the trace of the design, its least part where the ellipse is determined


@dataclass(frozen=True)
class Ellipse:
    """Widths across and along the grain, and the azimuth across it; standard errors from the spread over incidences."""

    alpha_x: float
    alpha_y: float
    axis: float  # [rad] 0..pi
    ln_ratio_stderr: float
    axis_stderr: float  # [rad]
    incidences: int
    axis_known: bool = True  # False: of two azimuths a quarter of a turn apart, taken as across and along

    @property
    def ratio(self) -> float:
        return self.alpha_x / self.alpha_y


@formed
def lobe_ellipse(measurement: Measurement) -> Ellipse | None:
    """The ellipse that the peaks of all incidences agree on; None where the values do not tell one.

    Of two turns of the sample in the plane of incidence only both widths are told, not the axis.
    """
    two = two_azimuths(measurement)
    theta_i = measurement.geom.theta_i_deg[:, 0]
    each_angle = measurement.theta_i_groups.values()
    groups = [rows for rows in each_angle if len(rows) >= FEWEST and theta_i[rows[0]] <= STEEPEST_DEG]
    if 2 * sum(map(len, groups)) < np.count_nonzero(theta_i <= STEEPEST_DEG):
        groups = _scattered(theta_i)
    picked = np.unique(np.linspace(0, len(groups) - 1, min(len(groups), MOST_INCIDENCES)).round().astype(int))
    each_of = (_of_incidence(measurement, groups[place], two) for place in picked)
    found = [each for each in each_of if each is not None]
    if not found:
        return None
    together = np.mean(found, axis=0)
    alpha_x, alpha_y, axis = _axes(together)
    if not np.isfinite(alpha_x):
        return None
    each = [_axes(m) for m in found]
    each = [one for one in each if np.isfinite(one[0])]
    ln_ratios = [np.log(one[0] / one[1]) for one in each]
    turns = [np.remainder(one[2] - axis + pi / 2, pi) - pi / 2 for one in each]

    def error(values) -> float:
        return float(np.std(values, ddof=1) / np.sqrt(len(values))) if len(values) > 1 else float("inf")

    return Ellipse(alpha_x, alpha_y, axis, error(ln_ratios), error(turns), len(each), two is None)


def looks_grained(measurement: Measurement) -> bool:
    """Whether one azimuth of the light already shows a lobe that is not round."""
    if measurement.in_plane or turn_of_each(measurement.geom) is not None:
        return False
    ellipse = lobe_ellipse(measurement)
    if ellipse is None or ellipse.incidences < FEWEST_UNTURNED:
        return False
    return np.log(ellipse.ratio) > max(np.log(SEEN_UNTURNED), SURE_UNTURNED * ellipse.ln_ratio_stderr)


def _scattered(theta_i) -> list[np.ndarray]:
    """Rows of like incidence [deg], where most directions have one of their own."""
    belts = np.floor(theta_i / SCATTERED_DEG)
    found = (np.flatnonzero(belts == each) for each in range(int(STEEPEST_DEG / SCATTERED_DEG)))
    return [rows for rows in found if len(rows) >= FEWEST]


@formed
def widths_of_turns(measurement: Measurement) -> dict[float, float]:
    """Azimuth of the light [rad] -> width over slopes in its plane of incidence, each turn by itself, median over
    incidences; without those whose scans show no peak on both sides."""
    turns, geom = turn_of_each(measurement.geom), measurement.geom
    if turns is None:
        return {}
    in_plane = geom.off_plane_deg[:, 0] < PLANE_DEG
    found: dict[float, float] = {}
    for turn in np.unique(turns):
        azimuth = float(np.radians(np.median(np.remainder(geom.phi_i_deg[turns == turn, 0], 180.0))))
        widths = []
        for theta_i, rows in measurement.theta_i_groups.items():
            mine = rows[(turns[rows] == turn) & in_plane[rows]]
            width = _width_of_scan(measurement, mine, azimuth) if theta_i <= STEEPEST_DEG else None
            widths += [] if width is None else [width]
        if widths:
            found[azimuth] = float(np.median(widths))
    return found


def _width_of_scan(measurement: Measurement, rows, azimuth: float) -> float | None:
    """1/√m of ln = c + d s - m s² over the peak of one scan."""
    if (above := _above_body(measurement, rows)) is None:
        return None
    rows, level, body = above
    lobe = level - body
    kept = (lobe > np.exp(-KEPT) * lobe.max()) & (level > CLEAR * body)
    if np.count_nonzero(kept) < FEWEST_OF_SCAN:
        return None
    x, y, ln = _facets(measurement.geom, rows[kept], lobe[kept])
    slope = x * np.cos(azimuth) + y * np.sin(azimuth)
    if not slope.min() < 0 < slope.max():
        return None
    bend = np.polynomial.polynomial.polyfit(slope, ln, 2)[2]
    return float((-bend) ** -0.5) if bend < 0 else None


def two_azimuths(measurement: Measurement) -> tuple[float, float] | None:
    """Both azimuths [rad] of the light, where a sample was scanned in the plane of incidence under two turns."""
    turns = turn_of_each(measurement.geom)
    if turns is None or turns.max() > 1 or not measurement.in_plane:
        return None
    phi = np.remainder(measurement.geom.phi_i_deg[:, 0], 180.0)
    first, second = (float(np.radians(np.median(phi[turns == each]))) for each in (0, 1))
    return first, second


def _above_body(measurement: Measurement, rows) -> tuple[np.ndarray, np.ndarray, float] | None:
    """The rows that have a value, their level [1/sr], and the body's; None for too few."""
    level = np.exp(row_median(measurement.ln[rows]))
    rows, level = rows[np.isfinite(level)], level[np.isfinite(level)]
    return (rows, level, float(np.quantile(level, BODY))) if len(rows) >= FEWEST else None


def _facets(geom, rows, lobe) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Both slopes of facets, and ln of their density in what they send: without masking f cos θi cos θr/(1 + |s|²)²."""
    geom = geom[rows]  # of a large table nothing is formed for all
    x, y = (each[:, 0] / geom.v_z[:, 0] for each in geom.v_xy)
    return x, y, np.log(lobe * geom.cos_cos[:, 0]) - 2 * geom.ln_sec2_h[:, 0]


def _of_incidence(measurement: Measurement, rows, two) -> np.ndarray | None:
    """M, (2, 2), of one incidence; None where its values do not tell it."""
    if (above := _above_body(measurement, rows)) is None:
        return None
    rows, level, body = above
    top = measurement.geom[rows[[np.argmax(level)]]]
    if retro_distance_deg(top)[0, 0] < np.degrees(np.sqrt(top.mirror_distance2[0, 0])):
        return None  # it is brightest toward the light, and no lobe of facets
    turns = turn_of_each(measurement.geom)
    scan = np.zeros(len(rows), int) if turns is None else turns[rows]
    lobe = np.where(level > CLEAR * body, level - body, np.nan)
    peak = np.array([np.nanmax(lobe[scan == each], initial=0.0) for each in range(scan.max() + 1)])
    with np.errstate(divide="ignore", invalid="ignore"):
        kept = lobe > np.exp(-KEPT) * peak[scan]
    if np.count_nonzero(kept) < FEWEST:
        return None
    rows, scan = rows[kept], scan[kept]
    x, y, ln = _facets(measurement.geom, rows, lobe[kept])
    if two is not None:
        return _along_two(x, y, scan, ln, two)
    of_scan = (scan[:, None] == np.unique(scan)).astype(float)
    if turns is None:  # what shifts a peak off the mirror direction does so in the plane of incidence alone
        azimuth = np.radians(measurement.geom.phi_i_deg[rows, 0])
        of_scan = np.column_stack([of_scan, x * np.cos(azimuth) + y * np.sin(azimuth)])
    squares = np.stack([-x * x, -2 * x * y, -y * y], axis=1)
    free = squares - of_scan @ np.linalg.lstsq(of_scan, squares, rcond=None)[0]
    ln = ln - of_scan @ np.linalg.lstsq(of_scan, ln, rcond=None)[0]
    strength = np.linalg.eigvalsh(free.T @ free)
    if strength[0] < LEAST_AXES**2 * strength[-1]:
        return None
    xx, xy, yy = np.linalg.lstsq(free, ln, rcond=None)[0]
    return np.array([[xx, xy], [xy, yy]])


def _along_two(x, y, scan, ln, two) -> np.ndarray | None:
    """M with its axes along both azimuths, which must be a quarter of a turn apart."""
    if abs(abs(two[1] - two[0]) - pi / 2) > np.radians(5.0):
        return None
    found = []
    for number, azimuth in enumerate(two):
        mine = scan == number
        if np.count_nonzero(mine) < 4:
            return None
        along = x[mine] * np.cos(azimuth) + y[mine] * np.sin(azimuth)
        found.append(-np.polynomial.polynomial.polyfit(along * along, ln[mine], 1)[1])
    cos, sin = np.cos(two[0]), np.sin(two[0])
    turn = np.array([[cos, -sin], [sin, cos]])
    return turn @ np.diag(found) @ turn.T


def _axes(m) -> tuple[float, float, float]:
    """Widths and axis of M; NaN where the values do not fall along both axes."""
    strengths, vectors = np.linalg.eigh(m)
    if strengths[0] <= 0:
        return float("nan"), float("nan"), 0.0
    wide = vectors[:, 0]
    axis = float(np.remainder(np.arctan2(wide[1], wide[0]), pi))
    return float(strengths[0] ** -0.5), float(strengths[1] ** -0.5), axis
