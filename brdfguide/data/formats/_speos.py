"""What both of Speos' scattering files are made of: a title, flags, and tables of theta by phi about the normal.

Source: "Structure of BRDF files" and "Structure of Anisotropic BSDF files", Speos user's guide (Ansys 2024).
"""

import numpy as np

from ...records import dataclass
from ._hemisphere import total
from .format import Source, check_angle, check_zenith, holds_number

MOST_ANGLES = 100_000
MIRROR_DEG = 0.0  # azimuth of the mirror direction; there are files in which it is 180


@dataclass(frozen=True, eq=False)
class Table:
    """One incidence: theta (thetas,), phi (phis,) [deg], values (thetas, phis)."""

    theta: np.ndarray
    phi: np.ndarray
    values: np.ndarray

    def scattered(self, kind: int) -> float:
        """∫ values over the hemisphere: of a BSDF (kind 1) with the cosine, of an intensity (kind 0) without."""
        return float(total(self.theta, self.phi, self.values, cosines=kind))

    def rows(self, kind: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """theta_r, phi_r [deg] and values proportional to the BRDF, each (rows,), without the horizon and repetitions.

        The azimuth that repeats the first after a full turn is left out, and those of the normal but one.
        """
        theta, phi = (a.reshape(-1) for a in np.meshgrid(self.theta, self.phi, indexing="ij"))
        again = np.isclose(phi - self.phi[0], 360.0) | ((theta < 1e-9) & (phi != self.phi[0]))
        kept = ~again & (theta < 90 - 1e-6)
        values = self.values.reshape(-1)[kept]
        if kind == 0:
            values = values / np.cos(np.radians(theta[kept]))
        return theta[kept], phi[kept], values


class Words:
    """The lines of a file, and from some line on its numbers one after the other; errors know the line."""

    def __init__(self, source: Source):
        self.source, self.at = source, 0
        self.left: list[str] = []

    def line(self, wanted: str) -> str:
        """The next line. Raises InputError where there is none."""
        if self.at >= len(self.source.lines):
            raise self.source.error(f"truncated: this Speos file ends where {wanted} was wanted")
        self.at += 1
        return self.source.lines[self.at - 1]

    def numbers(self, count: int, wanted: str) -> np.ndarray:
        """The next numbers, across lines. Raises InputError for fewer, and for what is none."""
        found: list[float] = []
        while len(found) < count:
            while not self.left:
                self.left = self.line(wanted).split()[::-1]
            take = min(count - len(found), len(self.left))
            cells = [self.left.pop() for _ in range(take)]
            found += self.source.numbers(cells, self.at)
        return np.array(found)

    def count(self, wanted: str) -> int:
        """The next number, as one of angles or wavelengths. Raises InputError where it is none."""
        number = float(self.numbers(1, wanted)[0])
        if not 0 < number <= MOST_ANGLES or number != int(number):
            raise self.source.error(f"found {number:g}, wanted {wanted}", self.at)
        return int(number)

    def table(self, wanted: str) -> Table:
        """Numbers of theta and phi, a row of phi, then rows of a theta and its values."""
        shape = [self.count(f"the number of {name} angles of {wanted}") for name in ("theta", "phi")]
        if shape[0] * shape[1] > len(self.source.data):
            raise self.source.error(f"{wanted} promises {shape[0]} x {shape[1]} values, more than the file", self.at)
        phi = self.numbers(shape[1], f"azimuth of {wanted}")
        rows = self.numbers(shape[0] * (shape[1] + 1), f"value of {wanted}").reshape(shape[0], shape[1] + 1)
        return ascending(self.source, Table(rows[:, 0], phi, rows[:, 1:]), self.at)


def ascending(source: Source, table: Table, line: int | None = None) -> Table:
    """The same. Raises InputError for angles that are none or do not ascend."""
    lines = None if line is None else np.full(max(len(table.theta), len(table.phi)), line)
    check_zenith(source, "theta", table.theta, lines)
    check_angle(source, "phi", table.phi, lines)
    for name, nodes in (("theta", table.theta), ("phi", table.phi)):
        if np.any(np.diff(nodes) <= 0) or not np.all(np.isfinite(nodes)):
            raise source.error(f"the {name} angles of a table do not ascend", line)
    if table.theta[0] < 0:
        raise source.error(f"theta = {table.theta[0]:g} degrees; wanted 0 to 90 for reflection", line)
    return table


def header(source: Source, words: Words, vector: bool) -> None:
    """Reads title, mode, comment, the description and its length, up to the line of the two flags.

    Raises InputError for binary and for what holds no reflection, or transmission beside it. The length of the
    description is often wrong in files that programs make, so that its end is where the flags stand.
    """
    for wanted in ("the title", "the mode", "the comment", "the length of the description"):
        text = words.line(wanted).strip()
        if wanted == "the mode" and text != "0":
            raise source.error(f"found the mode '{text[:40]}'; wanted 0, which is text", words.at)
    start = words.at
    while not _flags_at(source.lines, words.at, vector):
        words.line("the two flags for reflection and transmission")
        if words.at - start > 1000:
            raise source.error("no line of two flags for reflection and transmission", start)
    if vector:
        words.line("the anisotropy vector")
    reflection, transmission = words.numbers(2, "a flag")
    refuse_transmission(source, bool(reflection), bool(transmission), words.at)


def refuse_transmission(source: Source, reflection: bool, transmission: bool, line: int | None = None) -> None:
    """Raises InputError for what holds no reflection, or transmission beside it."""
    if not reflection:
        raise source.error("it holds transmission alone; this program fits reflection", line)
    if transmission:
        text = "it holds transmission beside the reflection: save the reflection alone in Speos' editor"
        raise source.error(text, line)


def _flags_at(lines: list[str], at: int, vector: bool) -> bool:
    """Whether the flags stand here: two of 0 and 1, before them a vector of three where there is one, then a kind."""
    shape = [line.split() for line in lines[at : at + 2 + vector]]
    if len(shape) < 2 + vector:
        return False
    first = shape.pop(0) if vector else None
    return (first is None or len(first) == 3 and all(map(holds_number, first))) and (
        len(shape[0]) == 2 and set(shape[0]) <= {"0", "1"} and len(shape[1]) == 1 and shape[1][0] in ("0", "1")
    )
