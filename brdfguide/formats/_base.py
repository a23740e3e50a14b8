"""What every file in this folder provides: how a kind of file is recognised and how it becomes a Measurement."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import InputError
from ..geometry import Geometry, rows
from ..measurement import Finding, Measurement

RGB_UM = {"R": 0.610, "G": 0.550, "B": 0.465}  # nominal wavelengths of sRGB primaries, for laws that need one
XYZ_UM = {"X": 0.600, "Y": 0.555, "Z": 0.446}  # peaks of the CIE 1931 colour matching functions
TEXT_LIMIT = 160 * 2**20  # bytes of text: a whole MERL table as CSV; a gonioreflectometer fills a hundredth of it
MOST_DEG = 1e5  # no azimuth turns more often
MARGIN_DEG = 0.005  # how far beyond the horizon a rounded angle may lie
FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d{1,3}\b)")  # the exponent of 1.5D-03


@dataclass(frozen=True)
class Options:
    """What the user says about a file; None: the file decides."""

    columns: Mapping[str, str] | tuple[str, ...] | None = None  # role -> column, or the roles in order
    unit: str | None = None  # deg, rad
    quantity: str | None = None  # brdf, brdf-cos, brdf-cos-i, reflectance-factor
    mirror_side: str | None = None  # positive, negative, phi=180, phi=0
    average_phi_i: bool = False  # an anisotropic table averaged over the rotation of the sample


@dataclass(frozen=True, eq=False)
class Source:
    """The bytes of a file and the name that errors call it by."""

    name: str
    data: bytes

    @cached_property
    def text(self) -> str:
        """The file as text: UTF-8 or UTF-16 with a byte order mark, else Latin-1; exponents with E. Raises InputError for binary."""
        if self.data[:2] in (b"\xff\xfe", b"\xfe\xff"):
            encodings = ("utf-16",)
        elif b"\0" in self.data:
            raise self.error("it is binary, and no reader knows it; wanted text with a header row, or a known table format")
        else:
            encodings = ("utf-8-sig", "latin-1")
        for encoding in encodings:
            try:
                return with_e(self.data.decode(encoding))
            except UnicodeDecodeError:
                continue
        raise self.error("its text is neither UTF-8 nor UTF-16")

    @cached_property
    def lines(self) -> list[str]:
        """The text by lines, whatever ends them."""
        return self.text.replace("\r\n", "\n").replace("\r", "\n").split("\n")

    def error(self, sentence: str, line: int | None = None) -> InputError:
        where = f"{self.name}, line {line}" if line else self.name
        printable = "".join(letter if letter.isprintable() else "?" for letter in sentence)
        return InputError(f"{where}: {printable}")

    def numbers(self, cells, line: int) -> list[float]:
        """The cells of one line as numbers. Raises InputError that names the first which is not one."""
        values = []
        for place, cell in enumerate(cells, 1):
            try:
                values.append(float(cell))
            except ValueError:
                raise self.error(f"value {place}: found '{cell[:40]}', wanted a number", line) from None
        return values


def with_e(text: str) -> str:
    """Fortran's 1.5D-03 as 1.5e-03, where the text has such numbers."""
    marked = any(mark in text for mark in ("D+", "D-", "d+", "d-"))  # a pattern takes a hundred times as long to find nothing
    return FORTRAN.sub("e", text) if marked and re.search(r"\d\.\d*[dD][-+]\d", text) else text


def degrees(radians):
    """Degrees; those that were round before they became radians with six digits are round again."""
    values = np.degrees(radians)
    nearest = np.round(np.where(np.isfinite(values), values, 0.0), 2)
    return np.where(np.abs(values - nearest) < 6e-5, nearest, values)


@dataclass(frozen=True)
class Format:
    """One kind of file. `recognises` looks at the first 64 kB only; `read` may raise InputError."""

    name: str
    suffixes: tuple[str, ...]
    recognises: Callable[[bytes], bool]
    read: Callable[[Source, Options], Measurement]
    limit: int = TEXT_LIMIT  # bytes beyond which such a file is not believed
    whole_table: bool = False  # a dense table with marks of its own for missing cells
    # of a dense table: the function (geometry) -> BRDF (samples, channels), NaN where it has none, and the channels' names
    function: Callable[[Source, Options], tuple[Callable[[Geometry], np.ndarray], tuple[str, ...]]] | None = None
    own_side: bool = True  # the format itself says on which side the mirror direction lies


def measurement(
    source: Source, kind: str, theta_i, phi_i, theta_r, phi_r, brdf, *, channels=("brdf",), wavelength=None, stderr=None, findings=(), **more
) -> Measurement:
    """A Measurement from flat lists of angles [deg] and values (samples, channels); a negative zenith angle turns its azimuth.

    Directions below the horizon are dropped with a note. Raises InputError where an angle is impossible or nothing is left.
    """
    theta_i, phi_i, theta_r, phi_r = (np.asarray(a, float) for a in np.broadcast_arrays(theta_i, phi_i, theta_r, phi_r))
    for name, degrees in (("theta_i", theta_i), ("phi_i", phi_i), ("theta_r", theta_r), ("phi_r", phi_r)):
        if not np.all(np.abs(degrees) < MOST_DEG):
            raise source.error(f"{name} = {degrees[~(np.abs(degrees) < MOST_DEG)][0]:g} degrees is no angle")
    phi_i = np.where(theta_i < 0, phi_i + 180.0, phi_i)
    phi_r = np.where(theta_r < 0, phi_r + 180.0, phi_r)
    theta_i, theta_r = np.abs(theta_i), np.abs(theta_r)
    brdf = np.asarray(brdf, float).reshape(len(theta_i), -1)
    keep = (theta_i < 90 - 1e-9) & (theta_r < 90 - 1e-9)
    notes = list(findings)
    if below := int(np.count_nonzero(~keep)):
        notes.append(Finding("below-horizon", f"{below} directions at or below the horizon were dropped", numbers=(("rows", below),)))
    if not np.any(keep):
        raise source.error("no direction above the horizon is left")
    um, said = (0.55, False) if wavelength is None else (wavelength, True)
    if not said:
        text = "the file does not say its wavelength: taken as 550 nm"
        notes.append(Finding("wavelength-assumed", text, consequence="lengths in micrometres scale with it", option="--wavelength"))
    um = np.broadcast_to(np.asarray(um, float), brdf.shape[1:])
    geom = rows(Geometry.from_degrees(theta_i[keep], phi_i[keep], theta_r[keep], phi_r[keep], um))
    stderr = None if stderr is None else np.asarray(stderr, float).reshape(brdf.shape)[keep]
    return Measurement(geom, brdf[keep], tuple(channels), stderr=stderr, name=source.name, format=kind, findings=tuple(notes), **more)


WAVE_UNITS = {"nm": 1e-3, "um": 1.0, "µm": 1.0, "micron": 1.0, "microns": 1.0}
_UNIT = r"(nm|um|µm|microns?)"
_WAVE = re.compile(rf"(?:wave ?length|lambda|λ)s?[ _]*[\[(]?{_UNIT}?[\])]?\s*(?:[:=]|is|of|at)?\s*(?:lambda)?\s*[:=]?\s*(\d+(?:\.\d+)?)\s*{_UNIT}?\b", re.IGNORECASE)
_BAND = re.compile(rf"(\d+(?:\.\d+)?)\s*(?:-|–|to|\.\.)\s*(\d+(?:\.\d+)?)\s*{_UNIT}\b", re.IGNORECASE)
_ALONE = re.compile(r"(?<![\d.])(\d{3,5}(?:\.\d+)?)\s*nm\b", re.IGNORECASE)


def wavelength_in(text: str) -> tuple[float, str] | None:
    """Micrometres out of `wavelength_nm: 633`, `Wavelength (nm) = 550`, `lambda = 532 nm`, `2-5.7 um band` or `650 nm`, and in what words."""
    for match in _WAVE.finditer(text):
        if unit := match[3] or match[1]:
            return float(match[2]) * WAVE_UNITS[unit.lower()], "wavelength"
    if match := _BAND.search(text):
        return 0.5 * (float(match[1]) + float(match[2])) * WAVE_UNITS[match[3].lower()], "middle of the band"
    if match := _ALONE.search(text):
        return float(match[1]) / 1000, "wavelength"
    return None


def from_comments(text: str):
    """The wavelength [µm] that free text names, or None, and the notes about it."""
    found = wavelength_in(text)
    if found is None:
        return None, []
    return found[0], [Finding("wavelength-from-comment", f"{found[1]} {found[0] * 1000:g} nm, from the comments")]


def check_zenith(source: Source, name: str, degrees, lines=None) -> None:
    """Raises InputError for the first zenith angle [deg] beyond ±90."""
    bad = np.flatnonzero(~(np.abs(degrees) <= 90 + MARGIN_DEG))
    if len(bad):
        row = int(bad[0])
        raise source.error(f"{name} = {degrees[row]:g} degrees; a zenith angle lies within -90..90", None if lines is None else int(lines[row]))


def averaged(turns: int, spread: float, options: Options) -> Finding:
    """The note on a mean over `turns` rotations of a sample whose values spread by `spread` (rms of ln) about it."""
    numbers = (("rotations", turns), ("rms_ln_over_rotation", spread))
    if spread < 0.05:
        return Finding("isotropic", f"{turns} rotations of the sample differ by {np.expm1(spread):.1%} (rms): their mean is taken", numbers=numbers)
    if options.average_phi_i:
        return Finding("averaged-over-rotation", f"mean over {turns} rotations of an anisotropic sample", "warning", option="--average-phi-i", numbers=numbers)
    text = f"anisotropic: {turns} rotations of the sample differ by {np.expm1(spread):.0%} (rms)"
    return Finding("anisotropic", text, "outside", "the guide's models are isotropic", "--average-phi-i", numbers)


def nominal_colours(channels) -> Finding:
    """The note that colours stand for a band, and which."""
    table = {**RGB_UM, **XYZ_UM}
    text = "the channels are colours: taken at " + ", ".join(f"{name} {table[name] * 1000:g} nm" for name in channels)
    return Finding("nominal-wavelengths", text, consequence="only laws that contain the wavelength depend on it")
