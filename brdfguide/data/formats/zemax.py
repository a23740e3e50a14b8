"""Zemax tabular `.bsdf` (Radiant Imaging's sphere and others): angles about the mirror direction.

Keys Source, Symmetry, SpectralContent, ScatterType; then counts with lists: SampleRotation, AngleOfIncidence,
ScatterAzimuth, ScatterRadial; then for each spectral content `DataBegin`, and for each rotation and incidence `TIS x`
and a table of azimuth times radial angle [1/sr], `DataEnd`. Radial 0 is the mirror direction; azimuth 0 points from
there toward the normal.

Source: Rykowski, "BSDF data interchange file format specification" (Radiant Imaging 2008).
"""

import re

import numpy as np

from ...errors import InputError
from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from .. import stated_total
from ..measurement import Measurement
from ._product_grid import product_grid
from ._rotations import turns_of
from ._writing import about, angle, only_channel, value
from .format import Format, Options, Source, check_zenith, commented_wavelength, measurement, nominal_colours

LISTS = ("SampleRotation", "AngleOfIncidence", "ScatterAzimuth", "ScatterRadial")
KEYWORDS = {
    word.lower(): word
    for word in (*LISTS, "Source", "Symmetry", "SpectralContent", "ScatterType", "DataBegin", "DataEnd", "TIS")
}
MOST_ANGLES = 100_000


def recognises(head: bytes) -> bool:
    text = head.decode("latin-1")

    def has(key):
        return re.search(rf"^[ \t]*{key}\b", text, re.MULTILINE | re.IGNORECASE)

    return all(has(key) for key in LISTS[1:3]) and not has("AOI")


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for transmission and for counts that do not agree."""
    words = _Words(source)
    header, lists = {}, {}
    while (word := words.keyword("a keyword")) != "DataBegin":
        if word in LISTS:
            count = int(words.number(f"the count of {word}"))
            if not 0 < count <= MOST_ANGLES:
                raise source.error(f"{word} promises {count} angles", words.line)
            lists[word] = np.array([words.number(f"angle {k + 1} of {count} of {word}") for k in range(count)])
        elif word in ("Source", "Symmetry", "SpectralContent", "ScatterType"):
            header[word] = words.next(f"a word after {word}")
    for key in LISTS[1:]:
        if key not in lists:
            raise source.error(f"no {key} before DataBegin; found {', '.join([*header, *lists])}")
    if header.get("ScatterType", "BRDF").upper() != "BRDF":
        raise source.error(f"ScatterType {header['ScatterType']}: transmission; this program fits reflection (BRDF)")
    rotations = lists.get("SampleRotation", np.zeros(1))
    check_zenith(source, "AngleOfIncidence", lists["AngleOfIncidence"])
    shape = (len(rotations), len(lists["AngleOfIncidence"]), len(lists["ScatterAzimuth"]), len(lists["ScatterRadial"]))
    channels = ("X", "Y", "Z") if header.get("SpectralContent", "Monochrome").upper().startswith("XYZ") else ("brdf",)
    planes, tis = zip(*(_plane(source, words, shape, first=k == 0) for k in range(len(channels))), strict=True)
    brdf = np.stack([plane.reshape(-1) for plane in planes], axis=-1)
    theta_i, theta_r, phi_r = _directions(lists, shape)
    keep = theta_r < 90 - 1e-6
    notes = [_below(int(np.count_nonzero(~keep)))] if not np.all(keep) else []
    keep &= _once(lists["ScatterRadial"], shape)
    phi_i = np.zeros(1)
    if len(rotations) > 1:
        cells = len(theta_i) // len(rotations)
        theta_i, theta_r, phi_r, keep = (each[:cells] for each in (theta_i, theta_r, phi_r, keep))
        phi_i, turned, turns = turns_of(brdf.reshape(len(rotations), cells, -1), rotations, keep, options)
        notes += turns
        brdf = turned.reshape(-1, len(channels))
    notes.append(stated_total.total_note(np.tile(lists["AngleOfIncidence"], len(rotations)), tis[0]))
    if len(channels) == 3:
        um, notes = np.array([CHANNEL_UM[name] for name in channels]), [*notes, nominal_colours(channels)]
    else:
        um, named = commented_wavelength(source, options)
        notes += named
    light = np.repeat(phi_i, int(np.count_nonzero(keep)))
    theta_i, theta_r, phi_r = (np.tile(each[keep], len(phi_i)) for each in (theta_i, theta_r, phi_r))
    parts = (theta_i, light, theta_r, light + phi_r, brdf[np.tile(keep, len(phi_i))])
    return measurement(source, "Zemax .bsdf", *parts, channels=channels, wavelength=um, findings=notes)


def _once(radial, shape):
    """Not the mirror direction again for every azimuth."""
    again = np.zeros(shape, bool)
    again[:, :, 1:, np.abs(radial) < 1e-9] = True
    return ~again.reshape(-1)


def _directions(lists, shape):
    """theta_i, theta_r, phi_r [deg] of every cell; light comes from azimuth 0, the mirror direction is at 180."""
    _, theta_i, azimuth, radial = np.broadcast_arrays(
        np.zeros(shape),
        *(
            np.radians(lists[key]).reshape([-1 if place == axis else 1 for place in range(4)])
            for axis, key in enumerate(LISTS)
            if axis
        ),
    )
    toward_normal, across = np.sin(radial) * np.cos(azimuth), np.sin(radial) * np.sin(azimuth)
    x = -np.sin(theta_i) * np.cos(radial) + np.cos(theta_i) * toward_normal
    z = np.cos(theta_i) * np.cos(radial) + np.sin(theta_i) * toward_normal
    theta_r = np.degrees(np.arctan2(np.hypot(x, across), z))
    return np.degrees(theta_i).reshape(-1), theta_r.reshape(-1), np.degrees(np.arctan2(across, x)).reshape(-1)


def _plane(source: Source, words: "_Words", shape, first: bool):
    """One spectral content: values (rotations, incidences, azimuths, radials) and the stated TIS."""
    if not first:
        while words.keyword("DataBegin of the next colour") != "DataBegin":
            pass
    if np.prod(shape, dtype=float) > len(source.data):
        raise source.error(
            f"its header promises {' x '.join(map(str, shape))} values, more than the file's {len(source.data)} "
            f"bytes can hold"
        )
    values, tis = np.empty((shape[0] * shape[1], shape[2] * shape[3])), []
    for block in range(len(values)):
        word = words.keyword("TIS")
        if word != "TIS":
            raise source.error(f"found '{word[:40]}', wanted TIS of table {block + 1} of {len(values)}", words.line)
        tis.append(words.number("the value of TIS"))
        values[block] = words.numbers(values.shape[1], f"value of table {block + 1}")
    word = words.keyword("DataEnd", at_end="DataEnd")
    if word != "DataEnd":
        raise source.error(f"found '{word[:40]}' after the last table, wanted DataEnd", words.line)
    return values.reshape(shape), tis


def _below(count: int) -> Finding:
    text = f"{count} cells about the mirror direction lie below the horizon and were dropped"
    return Finding("below-horizon", text, numbers=(("rows", count),))


class _Words:
    """The words of the file one after the other, without comments; errors know the line."""

    def __init__(self, source: Source):
        self.source, self.line = source, 0
        body = [text.partition("#")[0] for text in source.lines]
        # a decimal comma: between digits everywhere, and no decimal point
        self.comma = any(re.search(r"\d,\d", text) for text in body) and not any(
            re.search(r"\d\.\d|\d,\s", text) for text in body
        )
        self.rows = iter(enumerate(body, 1))
        self.left: list[str] = []

    def next(self, wanted: str) -> str:
        while not self.left:
            try:
                self.line, text = next(self.rows)
            except StopIteration:
                raise self.source.error(f"truncated: it ends where {wanted} was wanted") from None
            self.left = text.replace(",", "." if self.comma else " ").split()[::-1]
        return self.left.pop()

    def keyword(self, wanted: str, at_end: str | None = None) -> str:
        """The next word, spelt as we spell keywords, whatever its case and with or without a colon; or `at_end`."""
        try:
            word = self.next(wanted).rstrip(":=")
        except InputError:
            if at_end is None:
                raise
            return at_end
        return KEYWORDS.get(word.lower(), word)

    def number(self, wanted: str) -> float:
        word = self.next(wanted)
        try:
            value = float(word)
        except ValueError:
            value = np.nan
        if not np.isfinite(value):
            raise self.source.error(f"found '{word[:40]}', wanted {wanted}", self.line)
        return value

    def numbers(self, count: int, wanted: str) -> list[float]:
        return [self.number(wanted) for _ in range(count)]


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as a Zemax `.bsdf`, and sentences on what was made of it.

    Raises InputError for several channels, and where the directions lie on no grid about the mirror direction.
    """
    nm = only_channel(measurement, "Zemax")
    grid = product_grid(measurement, about_mirror=True, what="Zemax")
    symmetry = "PlaneSymmetrical" if grid.half else "Asymmetrical"
    if len(grid.rotations) > 1:
        symmetry = "ASymmetrical4D"
    totals = grid.totals()[..., 0]
    lines = [f"# {text}" for text in about(measurement, f"wavelength_nm: {nm:.9g}", *grid.sentences)]
    lines += ["Source Measured", f"Symmetry {symmetry}", "SpectralContent Monochrome", "ScatterType BRDF"]
    axes = (grid.rotations, grid.theta_i, grid.azimuth, grid.polar)
    for key, nodes in zip(LISTS, axes, strict=True):
        lines += [f"{key} {len(nodes)}", "\t".join(map(angle, nodes))]
    lines += ["", "Monochrome", "DataBegin"]
    for rotation, of_rotation in enumerate(grid.values[..., 0]):
        for incidence, rows in enumerate(of_rotation):
            lines.append(f"TIS {totals[rotation, incidence]:.6g}")
            lines += ["\t".join(map(value, row)) for row in rows]
    lines.append("DataEnd")
    return "\n".join(lines) + "\n", list(grid.sentences)


FORMAT = Format("zemax", (".bsdf",), recognises, read, options=("average_phi_i", "rotation_sense"), write=write)
