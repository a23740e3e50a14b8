"""One number of an answer beside what it should be, and all of them as they are compared."""

from dataclasses import field

from ..records import dataclass

CLOSE = 1e-10  # relative: sixteen digits, less what sums over a thousand values and a steep lobe lose
EXACT = 1e-13  # relative: a double printed and read again
TOLD = 4  # digits of a percentage
EXACT_MODEL, ROUNDED = 1e-8, 1e-12  # percent: of less the last digits are rounding, and how much that is


@dataclass(frozen=True)
class Rederived:
    """One number of the answer, and what it should be."""

    place: str  # such as ranking[0].rms_ln
    found: float | None
    right: float
    allowed: float  # between the two

    @property
    def agrees(self) -> bool:
        if self.found is None:
            return False
        return abs(self.found - self.right) <= self.allowed


@dataclass(eq=False)
class Comparisons:
    """Comparisons as they are made."""

    derived: list[Rederived] = field(default_factory=list)
    slack: float = 0.0  # of ln, and relative to what is larger than 1: what the program itself promises of a series

    def loosened(self, slack: float) -> "Comparisons":
        """For further numbers into the same list."""
        return Comparisons(self.derived, slack)

    def check(self, place: str, found, right, relative: float = CLOSE, absolute: float = 1e-15) -> None:
        """One number; nothing where the answer has none."""
        if found is not None:
            allowed = relative * abs(float(right)) + absolute + self.slack * max(1.0, abs(float(right)))
            self.derived.append(Rederived(place, float(found), float(right), allowed))

    def rounded(self, place: str, found, right, digits: int = TOLD, close: float = CLOSE) -> None:
        """One that was printed with so many digits; either neighbour where it lies between two, `close` to both."""
        if self.slack:
            self.check(place, found, right, 10.0 ** (1 - digits), 100 * self.slack)
            return
        if abs(float(right)) < EXACT_MODEL:
            self.check(place, found, right, absolute=ROUNDED)
            return
        ends = [float(f"{float(right) * (1 + step):.{digits}g}") for step in (-close, close)]
        self.check(place, found, ends[0] if found == ends[0] else ends[1], EXACT)

    def copy(self, place: str, found, original) -> None:
        """Every number of a part that stands in another place as well."""
        if isinstance(found, dict) and isinstance(original, dict):
            for name in found.keys() & original.keys():
                self.copy(f"{place}.{name}", found[name], original[name])
        elif isinstance(found, list) and isinstance(original, list):
            for number, (each, other) in enumerate(zip(found, original, strict=False)):
                self.copy(f"{place}[{number}]", each, other)
        elif _is_number(found) and _is_number(original):
            self.check(place, found, original, EXACT)


def _is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
