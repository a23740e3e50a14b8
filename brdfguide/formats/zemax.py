"""Zemax tabular `.bsdf` (Radiant Imaging's sphere and others): angles about the mirror direction.

Keys Source, Symmetry, SpectralContent, ScatterType; then counts with lists: SampleRotation, AngleOfIncidence, ScatterAzimuth,
ScatterRadial; then for each spectral content `DataBegin`, and for each rotation and incidence `TIS x` and a table of azimuth
times radial angle [1/sr], `DataEnd`. Radial 0 is the mirror direction; azimuth 0 points from there toward the normal.

Source: Rykowski, "BSDF data interchange file format specification" (Radiant Imaging 2008).
"""

import re

import numpy as np

from ..errors import InputError
from ..measurement import Finding, Measurement
from ._base import XYZ_UM, Format, Options, Source, averaged, check_zenith, from_comments, measurement, nominal_colours

LISTS = ("SampleRotation", "AngleOfIncidence", "ScatterAzimuth", "ScatterRadial")
KEYWORDS = {word.lower(): word for word in (*LISTS, "Source", "Symmetry", "SpectralContent", "ScatterType", "DataBegin", "DataEnd", "TIS")}
MOST_ANGLES = 100_000


def recognises(head: bytes) -> bool:
    text = head.decode("latin-1")
    has = lambda key: re.search(rf"^\s*{key}\b", text, re.MULTILINE | re.IGNORECASE)  # noqa: E731
    return all(has(key) for key in LISTS[1:3]) and not has("AOI")


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for transmission and for counts that do not agree. Several rotations give their mean."""
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
    planes, tis = zip(*(_plane(source, words, shape, first=k == 0) for k in range(len(channels))))
    brdf = np.stack([plane.reshape(-1) for plane in planes], axis=-1)
    theta_i, theta_r, phi_r = _directions(lists, shape)
    keep = theta_r < 90 - 1e-6
    notes = [_below(int(np.count_nonzero(~keep)))] if not np.all(keep) else []
    keep &= _once(lists["ScatterRadial"], shape)
    if len(rotations) > 1:
        brdf, theta_i, theta_r, phi_r, keep = _averaged(options, brdf, theta_i, theta_r, phi_r, keep, len(rotations), notes)
    notes.append(Finding("tis", "total integrated scatter as the file states it", numbers=tuple(_stated_tis(lists["AngleOfIncidence"], tis[0]))))
    if len(channels) == 3:
        um, notes = np.array([XYZ_UM[name] for name in channels]), [*notes, nominal_colours(channels)]
    else:
        um, named = from_comments("\n".join(line for line in source.lines if line.lstrip().startswith("#")))
        notes += named
    parts = (theta_i[keep], 0.0, theta_r[keep], phi_r[keep], brdf[keep])
    return measurement(source, "Zemax .bsdf", *parts, channels=channels, wavelength=um, findings=notes)


def _once(radial, shape):
    """Not the mirror direction again for every azimuth."""
    again = np.zeros(shape, bool)
    again[:, :, 1:, np.abs(radial) < 1e-9] = True
    return ~again.reshape(-1)


def _directions(lists, shape):
    """theta_i, theta_r, phi_r [deg] of every cell; the light comes from azimuth 0, so the mirror direction lies at 180."""
    _, theta_i, azimuth, radial = np.broadcast_arrays(
        np.zeros(shape), *(np.radians(lists[key]).reshape([-1 if place == axis else 1 for place in range(4)]) for axis, key in enumerate(LISTS) if axis)
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
        raise source.error(f"its header promises {' x '.join(map(str, shape))} values, more than the file's {len(source.data)} bytes can hold")
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


def _averaged(options, brdf, theta_i, theta_r, phi_r, keep, rotations, notes):
    """The mean over the rotations of the sample, and a note on how far they differ."""
    cells = len(theta_i) // rotations
    turned = brdf.reshape(rotations, cells, -1)
    mean = turned.mean(axis=0)
    lit = keep[:cells] & np.all(turned > 0, axis=(0, 2))
    ratio = np.log(turned[:, lit] / mean[lit])
    notes.append(averaged(rotations, float(np.sqrt(np.mean(ratio**2))) if ratio.size else 0.0, options))
    return mean, theta_i[:cells], theta_r[:cells], phi_r[:cells], keep[:cells]


def _below(count: int) -> Finding:
    text = f"{count} cells about the mirror direction lie below the horizon and were dropped"
    return Finding("below-horizon", text, numbers=(("rows", count),))


def _stated_tis(theta_i, tis):
    return [(f"{angle:g}_deg", value) for angle, value in zip(np.tile(theta_i, len(tis) // len(theta_i)), tis)]


class _Words:
    """The words of the file one after the other, without comments; errors know the line."""

    def __init__(self, source: Source):
        self.source, self.line = source, 0
        body = [text.partition("#")[0] for text in source.lines]
        # a decimal comma: between digits everywhere, and no decimal point
        self.comma = any(re.search(r"\d,\d", text) for text in body) and not any(re.search(r"\d\.\d|\d,\s", text) for text in body)
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
        """The next word, spelt as we spell keywords whatever its case and whether a colon follows; `at_end` where the file ends."""
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


FORMAT = Format("zemax", (".bsdf",), recognises, read)
