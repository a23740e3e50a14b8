"""What a file may mean by a number: which side has the mirror direction, which quantity, which marks say "no data"."""

from dataclasses import replace

import numpy as np

from ..finding import Finding
from ..physics.geometry import Geometry
from ..records import dataclass
from .measurement import Measurement

SIDES = ("positive", "negative", "phi=180", "phi=0")
QUANTITIES = ("brdf", "brdf-cos", "brdf-cos-i", "reflectance-factor", "brf", "hdrf", "radf")
NEAR_PLANE_DEG = 20.0  # how far from the plane of incidence a direction still counts for one side
BLOCKED_DEG = 6.0  # a lamp in front of the detector covers at least this
UNDONE = {
    "brdf-cos": "divided by cos theta_r",
    "brdf-cos-i": "divided by cos theta_i",
    "reflectance-factor": "divided by pi",
    "dark-level": "taken out",
}
ENOUGH = 1000  # values that tell how many digits all have
RESOLVED = 4  # values of a lobe that a floor cuts
BELOW_NOISE = 10.0  # times the largest value: what lies so far below zero is no noise about it
NO_BRDF = 1e20  # 1/sr; what files have in place of a value reaches from 1e20 to 1e37
OBLIQUE_DEG, NO_LOBE_DEG = 25.0, 15.0  # from this incidence on, a peak so far before the mirror direction is no lobe
LOW_DEG = 15.0, 35.0  # incidences at which a mirror lobe lies within a scan, and so
ABOUT_DEG, BESIDE_DEG = 10.0, (20.0, 45.0)  # brighter about the mirror direction than as far beyond it
STEEP_DEG = 8.0  # below this incidence the two sides are not told apart


def turned_180(geom: Geometry) -> Geometry:
    """Every reflected direction turned by 180 degrees about the normal: the other sign convention."""
    return Geometry.from_degrees(
        geom.theta_i_deg, geom.phi_i_deg, geom.theta_r_deg, geom.phi_i_deg + geom.phi_deg + 180.0, geom.wavelength
    )


def as_brdf(measurement: Measurement, quantity: str) -> Measurement:
    """Values stated as one of `QUANTITIES`, as BRDF [1/sr].

    `brdf-cos` is the BRDF times cos theta_r, `brdf-cos-i` times cos theta_i, `reflectance-factor` and `brf` times pi,
    `hdrf` too where the sun outshines the sky, `radf` (I/F) times pi cos theta_i.
    """
    if quantity == "brdf":
        return measurement
    geom = measurement.geom
    factor = {
        "brdf-cos": 1 / geom.cos_r,
        "brdf-cos-i": 1 / geom.cos_i,
        "reflectance-factor": 1 / np.pi,
        "brf": 1 / np.pi,
        "hdrf": 1 / np.pi,
        "radf": 1 / (np.pi * geom.cos_i),
    }[quantity]
    stderr = None if measurement.stderr is None else measurement.stderr * factor
    measurement = replace(measurement, brdf=measurement.brdf * factor, stderr=stderr)
    if quantity != "hdrf":
        return measurement
    text = "reflectance factors under the whole sky, taken as if all light came from the sun"
    consequence = "skylight fills up lobes and shadows; the more, the hazier the day and the bluer the light"
    return measurement.noting(Finding("skylight", text, "warning", consequence, "--quantity"))


def scaled(measurement: Measurement, factor: float) -> Measurement:
    """Values and standard errors times a factor that the user gives; a level that was relative is then known."""
    stderr = None if measurement.stderr is None else measurement.stderr * factor
    text = f"values multiplied by {factor:g}, as --scale says"
    scaled = replace(measurement, brdf=measurement.brdf * factor, stderr=stderr)
    return scaled.noting(Finding("scale-by-option", text, settles=("scale",)))


# --- marks for "no data" ---------------------------------------------------------------------------------


def without_marks(measurement: Measurement) -> Measurement:
    """Exact zeros, one tiny value repeated, and what no BRDF can be, such as -999, become NaN: they are marks, not
    values. Each kind is noted."""
    brdf, notes = measurement.brdf, []
    zero, odd = brdf == 0, _impossible(brdf)
    floor = _floor(brdf)
    at_floor = np.zeros_like(zero) if floor is None else brdf == floor
    for mask, note in ((zero, _zeros_note), (at_floor, _floor_note), (odd, _marks_note)):
        if np.any(mask):
            notes.append(note(measurement, mask))
    if not notes:
        return measurement
    return replace(measurement, brdf=np.where(zero | at_floor | odd, np.nan, brdf)).noting(*notes)


def _impossible(brdf) -> np.ndarray:
    """Values that can neither be measured nor noise: far further below zero than any lies above it, or immense; none
    where nothing else is there."""
    with np.errstate(invalid="ignore"):
        immense = brdf >= NO_BRDF
        largest = np.nanmax(np.where(immense, np.nan, brdf), initial=0.0)
        return (immense | (brdf < -BELOW_NOISE * largest)) & (largest > 0)


def _marks_note(measurement: Measurement, mask) -> Finding:
    count, value = int(np.count_nonzero(mask)), float(measurement.brdf[mask][0])
    text = f"{count} of {mask.size} values are {value:g}/sr or like it, which no BRDF is: taken as marks for missing"
    numbers = (("values", count), ("of", mask.size), ("first_per_sr", value))
    return Finding("marks-missing", text, consequence="they take no part in a fit", numbers=numbers)


def _zeros_note(measurement: Measurement, zero) -> Finding:
    count = int(np.count_nonzero(zero))
    hit = np.any(zero, axis=1)
    retro = retro_distance_deg(measurement.geom)[:, 0]
    numbers = (("values", count), ("of", zero.size), ("farthest_from_retro_deg", float(retro[hit].max())))
    around = retro <= max(float(retro[hit].max()), 1.0)
    if retro[hit].max() <= 20 and np.count_nonzero(hit) >= 0.5 * np.count_nonzero(around):
        text = (
            f"{count} of {zero.size} values are exactly 0, all within {retro[hit].max():.0f} degrees of the source: "
            f"blocked by the instrument, not black"
        )
        return Finding("blocked-retro-zone", text, consequence="no model is tested there", numbers=numbers)
    text = f"{count} of {zero.size} values are exactly 0: taken as missing, not as black"
    return Finding("zeros-missing", text, consequence="they take no part in a fit", numbers=numbers)


def _floor_note(measurement: Measurement, mask) -> Finding:
    count, value = int(np.count_nonzero(mask)), float(measurement.brdf[mask][0])
    steepest = np.maximum(measurement.geom.theta_i_deg, measurement.geom.theta_r_deg)[np.any(mask, axis=1)]
    text = (
        f"the lowest value, {value:g}/sr, stands {count} times in {mask.size}: the instrument's floor, taken as missing"
    )
    numbers = (("values", count), ("of", mask.size), ("floor_per_sr", value), ("from_theta_deg", float(steepest.min())))
    return Finding("floor", text, consequence="they take no part in a fit", numbers=numbers)


def _floor(brdf) -> float | None:
    """The lowest positive value, if it is repeated as no measured value is.

    A smooth surface whose lobe has died out repeats its diffuse value as well; but then the values just above
    crowd toward it, while a floor cuts through them: those within 0.2 % are not denser than those within 10 %. Numbers
    of two or three digits have no values so near; their next one and a half steps count in place of that.
    """
    with np.errstate(invalid="ignore"):
        positive = brdf[brdf > 0]
        if positive.size < 20:
            return None
        low = float(positive.min())
        count = np.count_nonzero(positive == low)
        if count < 4 or count == positive.size:
            return None
        rest = positive[positive > low]
        digits = _digits(rest[:: 1 + len(rest) // ENOUGH])
        step = 10 ** (np.floor(np.log10(low)) + 1 - digits)
        just = max(0.002, 1.5 * float(step) / low)
        near = np.count_nonzero(rest <= (1 + just) * low)
        beyond = np.count_nonzero((rest > (1 + just) * low) & (rest <= 1.1 * low))
        if count > 0.5 * positive.size and not _cuts_lobes(brdf, low, digits):
            return None
    denser = 5 if digits > 3 else 3
    if near >= 2 and near > denser * beyond * just / max(0.1 - just, just):
        return None
    commonest = np.unique(
        rest[rest <= np.partition(rest, min(200, rest.size - 1))[min(200, rest.size - 1)]], return_counts=True
    )[1].max()
    return low if count > 3 * commonest else None


def _digits(values) -> int:
    """How many significant digits most values are written with, 2 to 5; 5 stands for more."""
    scaled = values / 10 ** np.floor(np.log10(values))
    for digits in (2, 3, 4):
        steps = scaled * 10 ** (digits - 1)
        if np.mean(np.abs(steps - np.round(steps)) < 1e-6) > 0.9:
            return digits
    return 5


def _cuts_lobes(brdf, low: float, digits: int) -> bool:
    """Whether the lowest value, which most have, cuts through lobes instead of being what they fall to.

    A lobe that falls to a body passes values just above it, where it is several samples wide and the numbers are fine
    enough: a Gaussian one is a fifth as wide between 1e-4 and 0.2 % above the body as between that and twice the body,
    and half as wide between 1e-6 and 0.2 %.
    """
    above = brdf[brdf > low]
    near, beyond = np.count_nonzero(above <= 1.002 * low), np.count_nonzero(above <= 2 * low)
    lobes = np.count_nonzero(np.diff((brdf > low).astype(int), axis=0, prepend=0) > 0)
    enough = {4: 16}.get(digits, 8)
    return bool(digits > 3 and beyond >= enough and near < 0.05 * beyond and len(above) >= RESOLVED * lobes)


# --- the side of the mirror direction --------------------------------------------------------------------


@dataclass(frozen=True)
class Side:
    """Which side has the mirror direction by the values: `as_read`, `turned`, `retro` (toward the source), `untold`."""

    verdict: str
    text: str
    certain: bool
    contrast: float = 0.0  # median over incidences of ln(brightest ahead / brightest behind)
    largest: float = 0.0  # the same where it is largest in size
    growth: float = 0.0  # ln of the brighter side's peak, from the steepest to the most grazing incidence


def retro_distance_deg(geom: Geometry):
    """Angle between light and detector [deg]."""
    cosine = geom.dot_xy + geom.cos_i * geom.cos_r
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def side_of(geom: Geometry, brdf) -> Side:
    """Judges the mirror side from the values alone; `geom` holds the directions as the file is read by default."""
    brdf = np.where(_impossible(brdf), np.nan, brdf)
    if blocked := _blocked(geom, brdf):
        return blocked
    ahead, behind, angles, beyond, falls = _peaks(geom, brdf)
    if not len(angles):
        return Side("untold", "no incidence is far enough from the normal to tell the mirror side", False)
    both = np.isfinite(ahead) & np.isfinite(behind)
    if not np.any(both):
        return _of_one_side(bool(np.any(np.isfinite(ahead))), angles, beyond)
    return _of_two_sides(ahead, behind, falls)


def _of_one_side(is_ahead: bool, angles: np.ndarray, beyond: np.ndarray) -> Side:
    if is_ahead:
        return Side("as_read", "only the mirror side was measured", True)
    oblique = beyond[angles >= OBLIQUE_DEG]
    if len(oblique) and np.median(oblique) < -NO_LOBE_DEG:
        return Side(
            "untold",
            "only the other side was measured, that of the light, and nothing there is brightest where a mirror would "
            "send it",
            False,
        )
    return Side(
        "turned",
        "only one side was measured, and it is brightest where a mirror would send the light",
        bool(np.all(beyond > -5)),
    )


def _of_two_sides(ahead: np.ndarray, behind: np.ndarray, falls: np.ndarray) -> Side:
    """By ln of the brightest values on each side, at each incidence, and how they fall off about the mirror's."""
    both = np.isfinite(ahead) & np.isfinite(behind)
    contrast = ahead[both] - behind[both]
    middle, largest = float(np.median(contrast)), float(np.clip(contrast[np.argmax(np.abs(contrast))], -300, 300))
    brighter = ahead if middle > 0 else behind
    order = np.flatnonzero(both)
    growth = float(brighter[order[-1]] - brighter[order[0]]) if len(order) > 1 else 0.0
    numbers = {"contrast": middle, "largest": largest, "growth": growth}
    if middle >= 0.02 and largest > 0:
        return Side(
            "as_read",
            f"the mirror side is {_times(largest)} times brighter than the side of the light",
            True,
            **numbers,
        )
    if middle > -0.1:
        return Side(
            "untold", "both sides are equally bright: the mirror side cannot be told from the values", False, **numbers
        )
    times = _times(-largest)
    if (low := falls[both & np.isfinite(falls)]).size and np.mean(low) < 0:
        return Side(
            "untold",
            f"the other side is {times} times brighter, but not about the mirror direction: matt facets that shade "
            f"each other send light back so",
            False,
            **numbers,
        )
    if growth > 0.1 or len(order) == 1:
        certain = largest < -np.log(4) and len(order) > 1
        return Side(
            "turned",
            f"the other side is {times} times brighter and grows toward grazing, as a mirror lobe does",
            certain,
            **numbers,
        )
    if growth < -0.1:
        return Side(
            "retro",
            f"brightest toward the source, {times} times the mirror side, and weaker toward grazing",
            largest < -np.log(2),
            **numbers,
        )
    return Side("untold", f"one side is {times} times brighter but does not change toward grazing", False, **numbers)


def _times(ln_ratio: float) -> str:
    """A ratio to three digits, without an exponent up to a million."""
    return f"{float(f'{np.exp(ln_ratio):.3g}'):g}"


def _blocked(geom: Geometry, brdf) -> Side | None:
    """Values missing around one of the two directions only: the lamp stood in front of the detector, or vice versa."""
    with np.errstate(invalid="ignore"):
        lost = ~np.any(np.isfinite(brdf) & (brdf > 0), axis=1)
    if not np.any(lost):
        return None
    steep = geom.theta_i_deg[:, 0] >= 2 * BLOCKED_DEG
    source = steep & (retro_distance_deg(geom)[:, 0] < BLOCKED_DEG)
    mirror = steep & (geom.mirror_distance2[:, 0] < np.radians(BLOCKED_DEG) ** 2)
    elsewhere = steep & ~source & ~mirror
    if not (np.any(source) and np.any(mirror) and np.any(elsewhere)) or lost[elsewhere].mean() > 0.3:
        return None
    if lost[source].mean() > 0.7 and lost[mirror].mean() < 0.2:
        return Side("as_read", "values are missing around the source, where the lamp stands in the way", True)
    if lost[mirror].mean() > 0.7 and lost[source].mean() < 0.2:
        return Side("turned", "values are missing around the other direction, so the lamp stood there", True)
    return None


def _peaks(geom: Geometry, brdf):
    """ln of the brightest value ahead and behind for each incidence, the incidences, how far the peak behind lies
    beyond theta_i, and by how much in ln the values behind fall from about there to farther on: NaN but at low ones."""
    with np.errstate(invalid="ignore", divide="ignore"):
        good = np.isfinite(brdf) & (brdf > 0)
        value = np.where(good, np.log(np.where(good, brdf, 1.0)), np.nan)
    counted = np.count_nonzero(good, axis=1)
    level = np.where(counted > 0, np.nansum(value, axis=1) / np.maximum(counted, 1), np.nan)
    theta_i, theta_r = geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0]
    forward = geom.dot_xy[:, 0] < 0
    near = (geom.off_plane_deg[:, 0] <= NEAR_PLANE_DEG) & (theta_r >= STEEP_DEG) & np.isfinite(level)
    groups = np.round(theta_i)
    angles = np.unique(groups[near & (groups >= STEEP_DEG)])
    ahead, behind, beyond, falls = (np.full(len(angles), np.nan) for _ in range(4))
    for place, angle in enumerate(angles):
        rows = near & (groups == angle)
        for peak, side in ((ahead, rows & forward), (behind, rows & ~forward)):
            if np.any(side):
                peak[place] = level[side].max()
        if np.any(rows & ~forward):
            found = np.flatnonzero(rows & ~forward)
            beyond[place] = theta_r[found[np.argmax(level[found])]] - angle
            past = theta_r[found] - angle
            about, farther = np.abs(past) <= ABOUT_DEG, (past >= BESIDE_DEG[0]) & (past <= BESIDE_DEG[1])
            if LOW_DEG[0] <= angle <= LOW_DEG[1] and about.any() and farther.any():
                falls[place] = level[found[about]].mean() - level[found[farther]].mean()
    return ahead, behind, angles, beyond, falls
