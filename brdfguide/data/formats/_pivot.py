"""Long form, one value a row, to directions in rows and channels in columns."""

import numpy as np

from ...finding import Finding


def pivoted(angles, um, values, stderr=None):
    """Angles, brdf and stderr (samples, channels), wavelengths, and notes; NaN where a wavelength was not measured.

    A direction that is measured twice at one wavelength becomes two samples.
    """
    with np.errstate(over="ignore"):  # so is such a wavelength
        wavelengths, channel = np.unique(np.round(um, 9), return_inverse=True)
    with np.errstate(over="ignore"):  # an angle of 1e305 degrees is refused later
        keys = np.round(np.stack(angles, axis=1), 7)
    _, first, row = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    row = row.reshape(-1)
    order = np.lexsort((np.arange(len(row)), channel, row))
    cell = row[order] * len(wavelengths) + channel[order]
    starts = np.flatnonzero(np.r_[True, np.diff(cell) != 0])
    repeat = np.empty(len(row), int)
    repeat[order] = np.arange(len(row)) - np.repeat(starts, np.diff(np.r_[starts, len(row)]))
    slots, place = np.unique(first[row] + repeat * len(row), return_inverse=True)
    origin, spread = slots % len(row), []
    for column in (values, stderr):
        table = None if column is None else np.full((len(slots), len(wavelengths)), np.nan)
        if table is not None:
            table[place, channel] = column
        spread.append(table)
    twice = int(np.count_nonzero(repeat))
    text = f"{twice} rows repeat a direction and wavelength: kept as measurements of their own"
    notes = [Finding("repeated-rows", text, numbers=(("rows", twice),))] if twice else []
    return [each[origin] for each in angles], *spread, wavelengths, notes
