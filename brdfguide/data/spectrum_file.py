"""Spectra of heights as profilometers and microscopes write them: two columns, a frequency and a density.

    f (1/um), S (um^3)

The units in the header decide: a density of length³ is a profile's spectrum (one-sided), of length⁴ a surface's.
"""

import re
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..opening import content
from ..physics.height_spectrum import TabulatedSpectrum

MOST_BYTES = 50_000_000
FREQUENCIES = ("f", "fx", "fr", "nu", "frequency", "spatial frequency", "spatial_frequency", "freq")
DENSITIES = ("s", "s1", "s2", "psd", "psd1", "psd2", "psd1d", "psd2d", "power spectral density")
IN_UM = {"nm": 1e-3, "um": 1.0, "mm": 1e3, "cm": 1e4, "m": 1e6, "a": 1e-4, "angstrom": 1e-4}
UNITLESS = ("cycles", "cycle", "lines", "line", "lp", "periods", "1", "")
PLAIN = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻µμÅ·*", "0123456789-uuA  ")
EXAMPLE = "`f (1/um), S (um^3)` for a profile's or `f (1/um), S (um^4)` for a surface's"


def is_spectrum(path) -> bool:
    """Whether a file's header names a spatial frequency and a spectral density. False where it cannot be read."""
    try:
        with Path(path).open("rb") as stream:
            heads, _ = _header(stream.read(4096).decode("utf-8", "replace"))
    except (OSError, ValueError):
        return False
    return len(heads) == 2 and heads[0][0] in FREQUENCIES and heads[1][0] in DENSITIES


def read_spectrum(path) -> TabulatedSpectrum:
    """The spectrum in a file. Raises InputError with the line and what was wanted."""
    name = str(path)
    text = content(path, MOST_BYTES, name).decode("utf-8", "replace")
    heads, line = _header(text)
    if len(heads) != 2:
        raise InputError(f"{name} line {line}: found {len(heads)} columns; wanted two, {EXAMPLE}")
    frequency, dimension = _factor(heads[0][1], name, line)
    if dimension != -1:
        raise InputError(
            f"{name} line {line}: '{heads[0][1]}' is no unit of a spatial frequency; wanted 1/um or the like"
        )
    density, dimension = _factor(heads[1][1], name, line)
    if dimension not in (3, 4):
        raise InputError(f"{name} line {line}: '{heads[1][1]}' is no unit of a spectral density; wanted {EXAMPLE}")
    rows = np.array(_rows(text, name, line))
    rows = rows[rows[:, 0] > 0]
    order = np.argsort(rows[:, 0], kind="stable")
    return TabulatedSpectrum(frequency * rows[order, 0], density * rows[order, 1], dimension == 3)


def _lines(text: str):
    """Numbered lines that say something."""
    for number, line in enumerate(text.splitlines(), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, line.strip()


def _header(text: str) -> tuple[list[tuple[str, str]], int]:
    """(name, unit) of every column, and the line that says so."""
    number, line = next(_lines(text), (1, ""))
    cells = [cell for cell in re.split(r"[,;\t]|\s{2,}", line) if cell.strip()]
    heads = []
    for cell in cells:
        found = re.fullmatch(r"\s*([^(\[]*?)\s*(?:[(\[](.*)[)\]])?\s*", cell.strip("\"' "))
        heads.append((found[1].strip().lower(), found[2] or "") if found else (cell.strip().lower(), ""))
    return heads, number


def _factor(unit: str, name: str, line: int) -> tuple[float, int]:
    """What a number of this unit is in powers of µm, and in which; each `/` turns the sign of what follows.

    Raises InputError for a unit that is no power of lengths.
    """
    factor, dimension, sign = 1.0, 0, 1
    for token in re.findall(r"/|[A-Za-z]+(?:\^?-?\d+)?|\d+", unit.translate(PLAIN)):
        if token == "/":
            sign = -sign
            continue
        word, power = re.fullmatch(r"([A-Za-z]*)\^?(-?\d+)?", token).groups()  # type: ignore[union-attr]
        if word.lower() in UNITLESS:
            continue
        if word.lower() not in IN_UM:
            raise InputError(f"{name} line {line}: unknown unit '{word}' in '{unit}'; wanted {EXAMPLE}")
        exponent = sign * int(power or 1)
        factor *= IN_UM[word.lower()] ** exponent
        dimension += exponent
    return factor, dimension


def _rows(text: str, name: str, header: int) -> list[tuple[float, float]]:
    rows = []
    for number, line in _lines(text):
        if number <= header:
            continue
        cells = [cell for cell in re.split(r"[,;\t\s]+", line) if cell]
        try:
            frequency, density = map(float, cells)
        except ValueError:
            raise InputError(f"{name} line {number}: found '{line}', wanted two numbers") from None
        if not (frequency >= 0 and (density > 0 or frequency == 0) and np.isfinite(frequency + density)):
            raise InputError(f"{name} line {number}: found {line}; wanted a frequency and a density above zero")
        rows.append((frequency, density))
    if len(rows) < 2:
        raise InputError(f"{name}: {len(rows)} points; wanted two or more")
    return rows
