"""What every file in this folder provides: how a kind of file is recognised and how it becomes a Measurement."""

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from pathlib import Path

import numpy as np

from ...errors import InputError, NothingLeft
from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ...physics.geometry import Geometry, rows
from ...records import dataclass
from ..columns import prose
from ..columns.languages import encoding_of
from ..measurement import Measurement

MARK = b"\xef\xbb\xbf"  # of UTF-8; in front of what is none it is no text either
WIDE = (
    (rb"\xff\xfe(?!\0\0)|\xfe\xff", "utf-16"),
    (rb"(?:[\t\n\r -~]\0){6}", "utf-16-le"),
    (rb"(?:\0[\t\n\r -~]){6}", "utf-16-be"),
)
END_OF_FILE = "\x1a"  # as DOS ended texts
OF_TABLES = ("columns", "unit", "select", "rotation_sense")  # options of reading that a table under names takes
TEXT_LIMIT = 160 * 2**20  # bytes of text: a whole MERL table as CSV; a gonioreflectometer fills a hundredth of it
MOST_DEG = 1e5  # no azimuth turns more often
SHORTEST_UM = 0.1  # wavelengths beyond are no optical measurement
LONGEST_UM = 100.0
SAME_WAVELENGTH = 1e-3  # of it: what rounding explains
MARGIN_DEG = 0.005  # how far beyond the horizon a rounded angle may lie
FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d{1,3}\b)")  # the exponent of 1.5D-03
DECIMAL_D = re.compile(r"\.\d{0,40}[dD][-+]\d")  # a number with a decimal point has it


@dataclass(frozen=True)
class Options:
    """What the user says about a file; None: the file decides."""

    columns: Mapping[str, tuple[str, ...]] | tuple[str, ...] | None = None  # role -> columns, or names in order
    unit: str | None = None  # of the angles: deg, rad, gon, ...
    quantity: str | None = None  # brdf, brdf-cos, brdf-cos-i, reflectance-factor, radf, ...
    mirror_side: str | None = None  # positive, negative, phi=180, phi=0
    average_phi_i: bool = False  # an anisotropic table averaged over the rotation of the sample
    rotation_sense: str | None = None  # in which sense the sample was turned: ccw, cw
    wavelength_nm: float | None = None  # of values whose file does not say it
    select: tuple[tuple[str, str], ...] = ()  # (column, value): only the rows that have it
    scale: float | None = None  # what the file's values are multiplied by


@dataclass(frozen=True, eq=False)
class Source:
    """The bytes of a file and the name that errors call it by."""

    name: str
    data: bytes | bytearray
    findings: tuple[Finding, ...] = ()  # about the file as such
    place: Path | None = None  # a file or folder that its format reads where it lies; there are no `data` then

    @cached_property
    def text(self) -> str:
        """The file as text: UTF-8 or UTF-16, else the encoding in which heads in other languages
        are words, else Latin-1; exponents with E.

        Raises InputError for binary.
        """
        encodings: list[str | None] = ["utf-8-sig", None, "latin-1"]
        if wide := wide_encoding(self.data):
            encodings = [wide]
        elif b"\0" in self.data:
            raise self.error(
                "it is binary, and no reader knows it; wanted text with a header row, or a known table format"
            )
        for encoding in encodings:
            plain = self.data.removeprefix(b"" if wide or encoding == "utf-8-sig" else MARK)
            try:
                return with_e(plain.decode(encoding or encoding_of(plain)).rstrip(END_OF_FILE))
            except UnicodeDecodeError:
                continue
        raise self.error("its text is neither UTF-8 nor UTF-16")

    @cached_property
    def lines(self) -> list[str]:
        """The text by lines, whatever ends them."""
        return self.text.replace("\r\n", "\n").replace("\r", "\n").split("\n")

    def error(self, sentence: str, line: int | None = None) -> InputError:
        where = f"{self.name}, line {line}" if line else self.name
        error = InputError(f"{where}: {sentence}")
        error.line = line
        return error

    def numbers(self, cells, line: int) -> list[float]:
        """The cells of one line as numbers. Raises InputError that names the first which is not one."""
        values = []
        for place, cell in enumerate(cells, 1):
            try:
                values.append(float(cell))
            except ValueError:
                raise self.error(f"value {place}: found '{cell[:40]}', wanted a number", line) from None
        return values


def wide_encoding(head) -> str | None:
    """The encoding of text in letters of two bytes, by its mark or since it begins with plain letters."""
    return next((name for pattern, name in WIDE if re.match(pattern, head)), None)


def with_e(text: str) -> str:
    """Fortran's 1.5D-03 as 1.5e-03, where the text has such numbers."""
    last = max(text.rfind("D"), text.rfind("d")) + 2  # in most files no letter stands below the names
    marked = any(mark in text[:last] for mark in ("D+", "D-", "d+", "d-"))  # a pattern takes far longer to find nothing
    return FORTRAN.sub("e", text) if marked and DECIMAL_D.search(text) else text


def degrees(radians):
    """Degrees; those that were round before they became radians with six digits are round again."""
    with np.errstate(over="ignore", invalid="ignore"):
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
    in_place: bool = False  # a file that lies there as it is is left there: a library reads of it what it needs
    whole_table: bool = False  # a dense table with marks of its own for missing cells
    # of a dense table: the function (geometry) -> BRDF (samples, channels), NaN where it has none, and the channels'
    # names
    function: Callable[[Source, Options], tuple[Callable[[Geometry], np.ndarray], tuple[str, ...]]] | None = None
    own_side: bool = True  # the format itself says on which side the mirror direction lies
    # the values of a column by which a table's rows may be grouped
    groups: Callable[[Source, Options, str], tuple[str, ...]] | None = None
    options: tuple[str, ...] = ()  # those of Options, beside what serves every format, that such a file heeds
    # the measurement as text of this format, and sentences on what was lost or interpolated; may raise InputError
    write: Callable[[Measurement], tuple[str, list[str]]] | None = None
    beside: Callable[[Source], list[Path]] | None = None  # further files that such a file names and `read` reads
    exact_bytes: int | None = None  # the size by which a file without a header is known
    # what `read` gives in pieces, one after the other, with the notes on the whole; and of which files it is wanted
    parts: Callable[[Source, Options], Iterator[Measurement]] | None = None
    is_large: Callable[[Source], bool] | None = None


def measurement(
    source: Source,
    kind: str,
    theta_i,
    phi_i,
    theta_r,
    phi_r,
    brdf,
    *,
    channels=("brdf",),
    wavelength=None,
    stderr=None,
    findings=(),
    **more,
) -> Measurement:
    """A Measurement from flat lists of angles [deg] and values (samples, channels); a negative zenith angle turns its
    azimuth.

    Directions below the horizon are dropped with a note. Raises InputError where an angle is impossible or nothing is
    left.
    """
    theta_i, phi_i, theta_r, phi_r = (np.asarray(a, float) for a in np.broadcast_arrays(theta_i, phi_i, theta_r, phi_r))
    for role, each in (("theta_i", theta_i), ("phi_i", phi_i), ("theta_r", theta_r), ("phi_r", phi_r)):
        check_angle(source, role, each)
        if np.any(np.isnan(each)):
            raise source.error(f"{role} is missing somewhere")
    phi_i = np.where(theta_i < 0, phi_i + 180.0, phi_i)
    phi_r = np.where(theta_r < 0, phi_r + 180.0, phi_r)
    theta_i, theta_r = np.abs(theta_i), np.abs(theta_r)
    if not len(theta_i):
        raise source.error("no direction above the horizon is left")
    brdf = np.asarray(brdf, float).reshape(len(theta_i), -1)
    keep = (theta_i < 90 - 1e-9) & (theta_r < 90 - 1e-9)
    notes = list(findings)
    if below := int(np.count_nonzero(~keep)):
        notes.append(
            Finding(
                "below-horizon", f"{below} directions at or below the horizon were dropped", numbers=(("rows", below),)
            )
        )
    if not np.any(keep):
        raise NothingLeft(f"{source.name}: no direction above the horizon is left")
    if wavelength is None:
        text = "the file does not say its wavelength: taken as 550 nm"
        consequence = "lengths in micrometres scale with it"
        notes.append(Finding("wavelength-assumed", text, consequence=consequence, option="--wavelength-nm"))
    um = np.broadcast_to(np.asarray(0.55 if wavelength is None else wavelength, float), brdf.shape[1:])
    geom = rows(Geometry.from_degrees(theta_i[keep], phi_i[keep], theta_r[keep], phi_r[keep], um))
    brdf = brdf[keep]
    if infinite := int(np.count_nonzero(np.isinf(brdf))):
        text = f"{infinite} of {brdf.size} values are infinite: taken as missing"
        notes.append(Finding("infinite-values", text, "warning", numbers=(("values", infinite),)))
        brdf = np.where(np.isinf(brdf), np.nan, brdf)
    stderr = None if stderr is None else np.asarray(stderr, float).reshape(len(keep), -1)[keep]
    return Measurement(
        geom, brdf, tuple(channels), stderr=stderr, name=source.name, format=kind, findings=tuple(notes), **more
    )


def commented_wavelength(source: Source, options: Options, marks: tuple[str, ...] = ("#",)):
    """The wavelength [µm] that comments state, or None, and the notes about it; --wavelength-nm comes before it.

    Raises InputError for one that no light has.
    """
    lines = [(number, text) for number, text in enumerate(source.lines, 1) if text.lstrip().startswith(marks)]
    found = prose.wavelength_in([text for _, text in lines])
    if options.wavelength_nm is not None:
        return None, overruled(found, options.wavelength_nm)
    return wavelength_found(source, found, [number for number, _ in lines])


def overruled(found: prose.Wavelength | None, nm: float) -> list[Finding]:
    """The doubt where a comment names another wavelength than --wavelength-nm does."""
    if found is None or not found.told or abs(found.um * 1000 - nm) <= SAME_WAVELENGTH * nm:
        return []
    text = f"the comments say {found.um * 1000:g} nm, --wavelength-nm says {nm:g}: taken as {nm:g} nm"
    return [Finding("wavelength-overruled", text, "warning", option="--wavelength-nm")]


def wavelength_found(source: Source, found: prose.Wavelength | None, numbers: list[int]):
    """The wavelength [µm] that was found in some lines, or None, and the notes about it."""
    if found is None:
        return None, []
    line = numbers[found.line] if found.line < len(numbers) else None
    check_wavelength(source, found.um, line)
    text = f"{found.said_as} {found.um * 1000:g} nm, from the comments"
    return found.um, [Finding("wavelength-from-comment", text, option="--wavelength-nm")]


def beyond_arithmetic() -> np.errstate:
    """While a file is read: what comes of numbers beyond arithmetic is none, and is dropped or refused as such."""
    return np.errstate(over="ignore", invalid="ignore", divide="ignore")


def check_wavelength(source: Source, um, line: int | None = None) -> None:
    """Raises InputError for wavelengths [µm] outside 100 nm to 100 um."""
    um = np.atleast_1d(np.asarray(um, float))
    bad = um[~((um >= SHORTEST_UM) & (um <= LONGEST_UM))]
    if len(bad):
        raise source.error(f"found a wavelength of {1000 * float(bad[0]):g} nm; wanted 100 to 100000 nm", line)


def holds_number(word: str) -> bool:
    """Whether a word is a number as Python writes them."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def check_angle(source: Source, name: str, degrees, lines=None) -> None:
    """Raises InputError for the first angle [deg] that no turning gives; those that are missing are none."""
    bad = np.flatnonzero(np.abs(degrees) >= MOST_DEG)
    if len(bad):
        line = None if lines is None else int(lines[bad[0]])
        raise source.error(f"{name} = {degrees[bad[0]]:g} degrees is no angle", line)


def check_zenith(source: Source, name: str, degrees, lines=None) -> None:
    """Raises InputError for the first zenith angle [deg] beyond ±90."""
    bad = np.flatnonzero(~(np.abs(degrees) <= 90 + MARGIN_DEG))
    if len(bad):
        row = int(bad[0])
        raise source.error(
            f"{name} = {degrees[row]:g} degrees; a zenith angle lies within -90..90",
            None if lines is None else int(lines[row]),
        )


def averaged(turns: int, spread: float, options: Options) -> Finding:
    """The note on a mean over `turns` rotations of a sample whose values spread by `spread` (rms of ln) about it."""
    numbers = (("rotations", turns), ("rms_ln_over_rotation", spread))
    if spread < 0.05:
        return Finding(
            "isotropic",
            f"{turns} rotations of the sample differ by {np.expm1(spread):.1%} (rms): their mean is taken",
            numbers=numbers,
            settles=("rotation",),
        )
    if options.average_phi_i:
        return Finding(
            "averaged-over-rotation",
            f"mean over {turns} rotations of an anisotropic sample",
            "warning",
            option="--average-phi-i",
            numbers=numbers,
            settles=("rotation",),
        )
    text = f"anisotropic: {turns} rotations of the sample differ by {np.expm1(spread):.0%} (rms)"
    return Finding(
        "anisotropic",
        text,
        "warning",
        "a law without a grain is an average over the turns",
        "--average-phi-i",
        numbers,
        settles=("rotation",),
    )


def nominal_colours(channels) -> Finding:
    """The note that colours stand for a band, and which."""
    text = "the channels are colours: taken at " + ", ".join(
        f"{name} {CHANNEL_UM[name] * 1000:g} nm" for name in channels
    )
    return Finding("nominal-wavelengths", text, consequence="only laws that contain the wavelength depend on it")
