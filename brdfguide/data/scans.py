"""Whole scans that are not what they seem: an arm whose zero is off, and scans that repeat another digit for digit,
noise and all. A law whose lobe keeps its shape about the mirror direction may repeat itself; noise does not."""

from dataclasses import replace
from itertools import combinations

import numpy as np

from ..finding import Finding
from ..physics.geometry import Directions, Geometry, rows
from .measurement import Measurement, row_median
from .noise_model import SIGMA_PER_MEDIAN
from .turning import turn_of_each, turned_parts

LEAST_SCANS = 3  # that are exchanged for each other
MOST_SCANS = 60
LEAST_PAIRS = 4  # of exchanged values
NORMAL_DEG = 25.0  # of incidence, below which no surface's peak lies far off the mirror direction
MOST_ZERO_DEG = 5.0
LEAST_ZERO_DEG = 0.75  # smaller ones are fitted beside the model, where the data ask for it
BETTER = 0.6  # times what exchanged values differ by, to which it must come down (ours)
EXCHANGED = 0.1  # rms of ln to which exchanged values then agree: other faults leave more (ours)
AGREES = 0.35  # of the zero, within which the peak near the normal shows it (ours)
WIDEST_STEP_DEG = 8.0  # between readings that are interpolated
LEAST_PEAK = 2.0  # times the scan's median
LEAST_COMMON = 5  # directions that two scans share
COPIED = 0.9  # of them that are equal
UNEVEN_DEG = 0.1  # of the steps of a scan
LEAST_COPIED = 12  # values of a scan that show whether they are noisy
LEAST_NOISE = 1e-3  # relative: no goniometer repeats so well, and a law that is tabulated does (ours)
ROUNDED = 0.3  # standard deviation of rounding, in units of the last digit (of an even spread: 1/√12)
ABOVE_ROUNDING = 3.0  # times that, which noise has to be
FOURTH = np.sqrt(70.0)  # standard deviations of a value in a fourth difference of such values
WILD = 3.0  # robust standard deviations to which these are cut, lest a lobe decide


def arm_turned(geom: Geometry, zero_deg: float | np.ndarray) -> Geometry:
    """Directions whose detector stands farther from the normal by an angle, or each by its own (samples, 1): on the
    mirror side in a plane of incidence, and everywhere where azimuths vary."""
    theta = geom.signed_theta_r_deg if np.all(geom.off_plane_deg < 0.1) else geom.theta_r_deg
    turned = np.clip(theta + zero_deg, -89.9, 89.9)
    flipped = (turned < 0) != (theta < 0)
    phi = np.where(flipped, geom.phi_deg + 180.0, geom.phi_deg)
    directions = Directions.from_degrees(geom.theta_i_deg, 0.0, np.abs(turned), phi)
    return rows(Geometry(replace(directions, phi_i_deg=geom.phi_i_deg), geom.wavelength))


def scan_findings(measurement: Measurement) -> tuple[Finding, ...]:
    """Scans that repeat another; where none does, the arm's zero. Under the first turn of the sample that shows it."""
    for part in turned_parts(measurement):
        found = copied_finding(part) or zero_finding(part)
        if found:
            return (found,)
    return ()


def zero_finding(measurement: Measurement) -> Finding | None:
    """A zero of the arm without which exchanged scans agree, and which the peak near the normal shows as well.

    A scan at a has at b + zero what that at b has at a + zero (Helmholtz); no model is asked.
    """
    if measurement.settled("arm-zero") or not measurement.in_plane:
        return None
    scans = {theta: _scan(measurement, rows) for theta, rows in measurement.theta_i_groups.items()}
    lowest = min(scans)
    if not LEAST_SCANS <= len(scans) <= MOST_SCANS or lowest > NORMAL_DEG:
        return None
    peak = _peak_offset(*scans[lowest], lowest)
    if peak is None:
        return None
    zeros = np.arange(-MOST_ZERO_DEG, MOST_ZERO_DEG + 0.01, 0.05)
    apart = _apart(scans, zeros)
    if not np.isfinite(apart).any():
        return None
    best, as_reported = int(np.nanargmin(apart)), float(np.interp(0.0, zeros, apart))
    zero = float(zeros[best])
    better = apart[best] < min(BETTER * as_reported, EXCHANGED)
    if abs(zero) < LEAST_ZERO_DEG or not better or abs(peak - zero) > AGREES * abs(zero):
        return None
    where = "beyond" if zero > 0 else "short of"
    text = (
        f"the peak lies {abs(zero):.2g} degrees {where} the mirror direction at every incidence, also near the normal "
        f"({peak:+.2g} at {lowest:g}): the goniometer's zero; exchanged values differ by {np.expm1(as_reported):.0%}, "
        f"and by {np.expm1(apart[best]):.0%} without it"
    )
    consequence = "every lobe would be fitted at the wrong angle"
    numbers = (("zero_deg", zero), ("rms_ln_exchanged", as_reported), ("rms_ln_without", float(apart[best])))
    return Finding(
        "arm-zero", text, "warning", consequence, "--anyway", numbers, settles=("arm-zero",), undo="arm-zero"
    )


def without_zero(measurement: Measurement, finding: Finding) -> Measurement:
    """The directions with the arm where the peaks say that it stood."""
    return replace(measurement, geom=arm_turned(measurement.geom, -dict(finding.numbers)["zero_deg"]))


def copied_finding(measurement: Measurement) -> Finding | None:
    """Scans at several incidences with the same values about the mirror direction, digit for digit."""
    copies = _copies(measurement)
    if not copies:
        return None
    said = "; ".join(f"at {_listed(others)} that at {one:g}" for one, others in copies.items())
    text = f"scans repeat others digit for digit about the mirror direction: {said} degrees"
    consequence = "nothing was measured there: fitted, they would deny that a surface changes toward grazing"
    count = sum(map(len, copies.values()))
    return Finding("copied-scans", text, "warning", consequence, numbers=(("scans", count),), undo="copies")


def without_copies(measurement: Measurement) -> Measurement:
    """The same without the scans that repeat another."""
    turns, kept = turn_of_each(measurement.geom), np.ones(len(measurement.geom), bool)
    for each in [None] if turns is None else np.unique(turns):
        rows = np.arange(len(kept)) if turns is None else np.flatnonzero(turns == each)
        part = measurement[rows]
        for theta in sum(_copies(part).values(), []):
            kept[rows[part.theta_i_groups[theta]]] = False
    return measurement[kept]


def _copies(measurement: Measurement) -> dict[float, list[float]]:
    """Incidence of a scan that was measured -> those of the scans that repeat it. Of several alike the longest was
    measured, of which the others lack what would lie below the horizon; else that nearest the normal."""
    if not measurement.in_plane or not 2 <= len(measurement.theta_i_groups) <= MOST_SCANS:
        return {}
    scans = {theta: _about_mirror(measurement, theta, rows) for theta, rows in measurement.theta_i_groups.items()}
    alike: dict[float, list[float]] = {}
    for one, other in combinations(sorted(scans), 2):
        if other not in sum(alike.values(), []) and _equal(scans[one], scans[other]):
            alike.setdefault(one, []).append(other)
    found = {}
    for one, others in alike.items():
        group = [one, *others]
        longest = max(group, key=lambda theta: (len(scans[theta]), -theta))
        if _noisy(*_scan(measurement, measurement.theta_i_groups[longest])):
            found[longest] = [theta for theta in group if theta != longest]
    return found


def _noisy(angles, ln) -> bool:
    """Whether successive values of a scan scatter: their fourth differences, from which a smooth curve is all but gone,
    change sign from one to the next. Those over uneven steps do not count."""
    if len(ln) < LEAST_COPIED:
        return False
    even = np.ptp(np.lib.stride_tricks.sliding_window_view(np.diff(angles), 4), axis=1) <= UNEVEN_DEG
    differences, digits = np.diff(ln, 4)[even], max(map(_digits, np.exp(ln)))
    if len(differences) < LEAST_COPIED - 4:
        return False
    scatter = SIGMA_PER_MEDIAN * float(np.median(np.abs(differences))) / FOURTH
    cut = np.clip(differences, -WILD * FOURTH * scatter, WILD * FOURTH * scatter)
    noise = scatter > max(LEAST_NOISE, ABOVE_ROUNDING * ROUNDED * 10.0 ** (1 - digits))
    return noise and float(cut[1:] @ cut[:-1]) < 0


def _digits(value: float) -> int:
    """How many digits a value was told to, of at most twelve."""
    return len(f"{value:.11e}".partition("e")[0].replace(".", "").rstrip("0"))


def _listed(angles) -> str:
    return " and ".join(f"{each:g}" for each in angles)


def _scan(measurement: Measurement, places) -> tuple[np.ndarray, np.ndarray]:
    """Signed angles of the detector [deg], ascending and each once, and ln of the median channel."""
    level = row_median(measurement.ln[places])
    places, level = places[np.isfinite(level)], level[np.isfinite(level)]
    angle, first = np.unique(np.round(measurement.geom.signed_theta_r_deg[places, 0], 3), return_index=True)
    return angle, level[first]


def _apart(scans: dict[float, tuple[np.ndarray, np.ndarray]], zeros) -> np.ndarray:
    """rms of ln between exchanged values, were each of these the arm's zero [deg]; NaN for too few pairs."""
    gaps = [
        _at(*scans[one], side * other + zeros) - _at(*scans[other], side * one + zeros)
        for one, other in combinations(scans, 2)
        for side in (1, -1)
    ]
    squares = np.square(gaps)
    pairs = np.count_nonzero(np.isfinite(squares), axis=0)
    mean = np.nansum(squares, axis=0) / np.maximum(pairs, 1)
    return np.where(pairs >= LEAST_PAIRS, np.sqrt(mean), np.nan)


def _at(angle, ln, places) -> np.ndarray:
    """ln between the readings; NaN outside them and across a gap."""
    if len(angle) < 2:
        return np.full(np.shape(places), np.nan)
    after = np.searchsorted(angle, places)
    inside = (after > 0) & (after < len(angle))
    after = np.clip(after, 1, len(angle) - 1)
    near = inside & (angle[after] - angle[after - 1] <= WIDEST_STEP_DEG)
    return np.where(near, np.interp(places, angle, ln), np.nan)


def _peak_offset(angle, ln, theta: float) -> float | None:
    """How far the peak of a scan lies beyond the mirror direction [deg]; None where it shows none inside."""
    top = int(np.argmax(ln)) if len(ln) else 0
    if not 1 <= top < len(ln) - 1 or ln[top] - np.median(ln) < np.log(LEAST_PEAK):
        return None
    (left, middle, right), (low, high, up) = angle[top - 1 : top + 2], ln[top - 1 : top + 2]
    slopes = (high - low) / (middle - left), (up - high) / (right - middle)
    bend = slopes[1] - slopes[0]
    along = -slopes[0] / bend if bend < 0 else 0.5
    return float(0.5 * (left + middle) + along * 0.5 * (right - left) - theta)


def _about_mirror(measurement: Measurement, theta: float, places) -> dict[float, tuple[float, ...]]:
    """Angle from the mirror direction, to 0.01 degrees -> the values there."""
    away = np.round(measurement.geom.signed_theta_r_deg[places, 0] - theta, 2)
    return dict(zip(away.tolist(), map(tuple, measurement.brdf[places].tolist()), strict=True))


def _equal(one: dict, other: dict) -> bool:
    common = one.keys() & other.keys()
    if len(common) < LEAST_COMMON or len({one[each] for each in common}) < LEAST_COMMON:
        return False
    return sum(one[each] == other[each] for each in common) >= COPIED * len(common)
