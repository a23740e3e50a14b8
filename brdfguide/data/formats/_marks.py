"""Numbers that instruments and programs write for too bright or missing, taken out before anything is made of a column:
full scales, nines, and one negative number again and again.
"""

import numpy as np

from ...finding import Finding

BITS = {1023.0, 4095.0, 16383.0, 32767.0, 65535.0}  # all bits of 10 to 16
FULL_SCALES = BITS | {10.0**n - 1 for n in range(3, 10)} | {99.99, 999.9, 999.99, 9999.99}
LEAST_MARKS = 4  # negative values that are digit for digit the same
LOGARITHMIC = ("dB", "log10", "ln")  # scales whose numbers are negative below 1/sr


def without_written_marks(given, scale: str, notes: list[Finding]) -> np.ndarray:
    """A column's values (rows,), NaN where they are marks; noted."""
    given = _without_nines(given, notes)
    return given if scale in LOGARITHMIC else _without_negative_marks(given, notes)


def _without_nines(given, notes) -> np.ndarray:
    """The values without a full scale or a row of nines that stands several times far above all others."""
    known = given[np.isfinite(given)]
    largest = float(known.max(initial=0.0))
    rest = known[known < largest]
    marks = given == largest
    count = int(np.count_nonzero(marks))
    if largest not in FULL_SCALES or count < 2 or not len(rest) or largest < 10 * rest.max():
        return given
    notes.append(_note(largest, count, len(given), "far above all others"))
    return np.where(marks, np.nan, given)


def _without_negative_marks(given, notes) -> np.ndarray:
    """The values without the one negative number that there is, where it stands several times, as no noise about zero
    does unless it counts in steps of it."""
    with np.errstate(invalid="ignore"):
        below, above = given[given < 0], given[given > 0]
    if not LEAST_MARKS <= len(below) < len(given) - LEAST_MARKS or np.any(below != below[0]):
        return given
    steps = above / -below[0]
    if np.mean((np.abs(steps - np.round(steps)) < 1e-3) & (steps > 0.5)) > 0.5:
        return given
    notes.append(_note(float(below[0]), len(below), len(given), "and no other is negative"))
    return np.where(given < 0, np.nan, given)


def _note(mark: float, count: int, of: int, why: str) -> Finding:
    text = f"{count} of {of} values are {mark:g}, {why}: taken as marks for missing"
    numbers = (("values", count), ("of", of), ("first_per_sr", mark))
    return Finding("marks-missing", text, consequence="they take no part in a fit", numbers=numbers)
