"""Whether the values depend on how the sample is turned, and what grain they tell of."""

import numpy as np

from ..finding import Finding
from .lobe_ellipse import Ellipse, lobe_ellipse, looks_grained
from .measurement import Measurement, row_median
from .noise import noise
from .turning import FEWEST, spread_over_turns, turn_of_each

SEEN_RATIO = 1.1  # of widths, below which a mounting explains it
SURE = 3.0  # standard errors of its logarithm
ONE_WAY = 0.2  # rms of ln between values half a turn apart, beyond which facets lean to one side (ours)
APART_DEG = 22.5  # within a quarter of a turn, of two pairs of turns: one grain half way between one pair is as a weave
LIKE = 0.3  # of the change over a quarter of a turn to that over an eighth, below which a period is a quarter (ours)


def rotation_findings(m: Measurement):
    """Does the value depend on how the sample is turned?"""
    if not m.settled("rotation"):  # else the reader saw the rotations
        yield from _spread_findings(m)
    yield from grain_findings(m)


def _spread_findings(m: Measurement):
    spread = spread_over_turns(m)
    if spread is not None:
        numbers, scatter = (("rms_ln_over_rotation", spread),), noise(m) or 0.02
        if spread > max(0.2, 5 * scatter):
            text = f"anisotropic: turning the sample changes values by {np.expm1(spread):.0%} (rms)"
            consequence, settles = "a law without a grain is an average over the turns", ("rotation",)
            yield Finding("anisotropic", text, "warning", consequence, "--average-phi-i", numbers, settles=settles)
        elif not turned_grain(m):
            text = (
                f"isotropic, the same from all sides: turning the sample changes values by {np.expm1(spread):.1%} (rms)"
            )
            yield Finding("isotropic", text, numbers=numbers)
        return
    text = "the sample was not turned: whether it looks the same from all sides (isotropic) cannot be told" + (
        " from the plane of incidence" if m.in_plane else ""
    )
    yield Finding(
        "rotation-untold", text, consequence="a brushed surface would be fitted for this one direction of its grain"
    )


def grain_findings(m: Measurement):
    """The ellipse of the lobe, where it is none by chance; a sample that was turned and is round; other symmetries."""
    turned, ellipse = turn_of_each(m.geom) is not None, lobe_ellipse(m)
    if turned:
        yield from _symmetry_findings(m)
    if ellipse is None or not (turned or looks_grained(m)):
        return
    if turned and not is_grained(ellipse):
        text = f"round to within {100 * (ellipse.ratio - 1):.2g} %: across and along, the lobe is as wide"
        yield Finding("isotropic", text, numbers=_numbers(ellipse))
        return
    where = np.degrees(ellipse.axis) % 180
    error = "" if not np.isfinite(ellipse.axis_stderr) else f" ± {np.degrees(ellipse.axis_stderr):.2g}"
    axis = f"its axis, across the grain, lies at {where:.3g}{error} degrees, the grooves at {(where + 90) % 180:.3g}"
    if not ellipse.axis_known:
        axis = f"the axis is taken along the wider of both scans, at {where:.3g} degrees"
    text = (
        f"a grain: near its peak the lobe is {ellipse.ratio:.2g} times as wide across it as along it; {axis}; "
        f"the highlight is a streak along the axis"
    )
    yield Finding("grain", text, numbers=_numbers(ellipse))


def is_grained(ellipse: Ellipse) -> bool:
    """Whether an ellipse is no circle by chance or by mounting."""
    return np.log(ellipse.ratio) > max(np.log(SEEN_RATIO), SURE * _finite(ellipse.ln_ratio_stderr))


def turned_grain(m: Measurement) -> bool:
    """Whether turning the sample shows a grain, however little of the light its lobe is."""
    ellipse = lobe_ellipse(m) if turn_of_each(m.geom) is not None else None
    return ellipse is not None and is_grained(ellipse)


def _finite(error: float) -> float:
    return error if np.isfinite(error) else 0.0


def _numbers(ellipse: Ellipse) -> tuple[tuple[str, float], ...]:
    return (
        ("ratio", ellipse.ratio),
        ("ln_ratio_stderr", ellipse.ln_ratio_stderr),
        ("axis_deg", float(np.degrees(ellipse.axis) % 180)),
        ("axis_stderr_deg", float(np.degrees(ellipse.axis_stderr))),
        ("alpha_x", ellipse.alpha_x),
        ("alpha_y", ellipse.alpha_y),
    )


def _symmetry_findings(m: Measurement):
    """Half a turn that changes values; a quarter that does not, where an eighth does."""
    half, _ = _change_over(m, 180.0)
    if half is not None and half > max(ONE_WAY, 5 * (noise(m) or 0.02)):
        text = f"half a turn of the sample changes values by {np.expm1(half):.0%} (rms): its facets lean to one side"
        yield Finding("grain-one-way", text, "warning", "every law here has the same from both sides of its grain")
    (quarter, turns), (eighth, _) = _change_over(m, 90.0), _change_over(m, 45.0)
    if quarter is None or eighth is None or not _are_apart(turns):
        return
    if eighth > ONE_WAY and quarter < LIKE * eighth:
        text = (
            f"a quarter of a turn changes values by {np.expm1(quarter):.0%}, an eighth by {np.expm1(eighth):.0%} "
            f"(rms): woven or crossed, not one grain"
        )
        yield Finding("grain-period", text, "warning", "no law here has two grains")


def _are_apart(turns) -> bool:
    """Whether two of these turns [deg] are not nearly the same within a quarter of a turn."""
    apart = np.remainder(np.subtract.outer(turns, turns), 90.0)
    return bool(np.any((apart >= APART_DEG) & (apart <= 90.0 - APART_DEG)))


def _change_over(m: Measurement, turn_deg: float) -> tuple[float | None, np.ndarray]:
    """rms of ln between values that differ by this turn of the sample and by nothing else, None for too few; and from
    which turns [deg] they were turned."""
    geom = m.geom
    azimuth = np.remainder(np.round(geom.phi_i_deg[:, 0], 1), 360.0)
    phi = np.abs(np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0)
    rest = np.round(np.stack([geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0], phi], axis=1), 1)
    level = row_median(m.ln)
    known = np.isfinite(level) & (geom.theta_i_deg[:, 0] > 1.0)
    here = {
        (*place, turn): ln
        for place, turn, ln in zip(
            map(tuple, rest[known].tolist()), azimuth[known].tolist(), level[known].tolist(), strict=True
        )
    }
    apart = [
        (ln - here[other], turn)
        for (*place, turn), ln in here.items()
        if (other := (*place, round((turn + turn_deg) % 360.0, 1))) in here
    ]
    if len(apart) < FEWEST:
        return None, np.zeros(0)
    changes, turns = np.array(apart).T
    return float(np.sqrt(np.mean(np.square(changes)))), np.unique(turns)
