"""A surface as files of it are judged: in linear sRGB, in the directions of the data.

    error = √(mean ln²(file/surface))   over colours and directions that are lit, and not dark beside the brightest
    value at the same incidence;   against the measurement over all that both show

A mirror beside a finite part is judged at 33 incidences from 0 to 80 degrees; against the measurement it shows as the
image of a lamp.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import cached_property

from mpmath import cos, fsum, inf, log, mpf, pi, radians, sin, sqrt

from ..records import dataclass
from .exact_errors import Readings
from .exact_surface import ExactSurface
from .textbook import ExactDirections
from .textbook_more import MIRRORS

OfPair = Callable[[ExactDirections], Sequence]  # -> one number for each colour
# of an incidence's peak, and 1/sr: what is darker than both does not count
FAINTEST, DARKEST = mpf("1e-3"), mpf("1e-3")
LAMP = radians(mpf("1.35"))  # half angle of the lamp's cap
RGB = {"r": 0, "red": 0, "g": 1, "green": 1, "b": 2, "blue": 2}
LEAST_MIRROR, GLINT = mpf("1e-6"), mpf("1e-2")  # of the light, below which one is none, or may be left out
FAINT = mpf("1e-2")  # of a mirror's highest value
MIRRORED = [2.5 * step for step in range(33)]  # incidences [deg]


@dataclass(frozen=True, eq=False)
class Judged:
    """`channels` are those of red, green and blue."""

    surface: ExactSurface
    data: Readings
    channels: tuple[int, int, int]

    def itself(self, pair: ExactDirections) -> list:
        """The finite part by colour [1/sr]."""
        found = {c: self.surface.brdf(pair, c, self.data.wavelengths[c]) for c in set(self.channels)}
        return [found[c] for c in self.channels]

    def mirror(self, pair: ExactDirections) -> list:
        """Reflectance at θi by colour."""
        found = {c: self.surface.mirror(pair, c, self.data.wavelengths[c]) for c in set(self.channels)}
        return [found[c] for c in self.channels]

    @cached_property
    def _finite(self) -> list[list]:
        """By direction and colour [1/sr]; nothing where none is lit."""
        return [
            self.itself(sight.pair) if up else [] for sight, up in zip(self.data.sights, self.data.lit, strict=True)
        ]

    @cached_property
    def _counted(self) -> list[list[bool]]:
        peaks: dict[tuple[int, float], mpf] = defaultdict(mpf)
        incidences = [round(10 * each[0]) / 10 for each in self.data.angles]
        for theta, row in zip(incidences, self._finite, strict=True):
            for place, f in enumerate(row):
                peaks[place, theta] = max(peaks[place, theta], f)
        return [
            [f > 0 and f >= min(FAINTEST * peaks[place, theta], DARKEST) for place, f in enumerate(row)]
            for theta, row in zip(incidences, self._finite, strict=True)
        ]

    @cached_property
    def directions(self) -> int:
        """How many count."""
        return sum(map(any, self._counted))

    @cached_property
    def has_mirror(self) -> bool:
        """Whether its mirror is part of how it looks, not only of its glint at grazing."""
        own_term = "coat.sigma" in self.surface.values or any(each.law == "mirror" for each in self.surface.parts)
        most = {theta: max(self.mirror(_at_mirror(theta))) for theta in range(0, 81, 5)}
        low = max(each for theta, each in most.items() if theta <= 60)
        return own_term and max(most.values()) > LEAST_MIRROR or low > GLINT

    def error(self, law: OfPair) -> mpf:
        """rms ln of a file's finite part against the surface's; infinite where it has none."""
        squares = []
        for sight, row, counted in zip(self.data.sights, self._finite, self._counted, strict=True):
            if any(counted):
                squares += _squares(law(sight.pair), row, counted)
        return _root_mean(squares)

    def against_mirror(self, law: OfPair) -> tuple[int, mpf]:
        """How many mirror directions count, and rms ln of the reflectances there."""
        pairs = [_at_mirror(theta) for theta in MIRRORED]
        wanted = [self.mirror(pair) for pair in pairs]
        least = FAINT * max(map(max, wanted))
        counted = [[each >= least for each in row] for row in wanted]
        squares = [
            square
            for pair, row, counts in zip(pairs, wanted, counted, strict=True)
            for square in _squares(law(pair), row, counts)
        ]
        return sum(map(any, counted)), _root_mean(squares)

    def off_the_data(self, law: OfPair, mirror: OfPair | None = None) -> mpf:
        """rms ln of what a file shows against the values that are above 0, with the lamp's image in its mirror."""
        squares = []
        solid_angle = 4 * pi * sin(LAMP / 2) ** 2
        for number, (sight, up) in enumerate(zip(self.data.sights, self.data.lit, strict=True)):
            values = [self.data.values[number][c] for c in self.channels]
            if not up or not any(each > 0 for each in values):
                continue
            shown = law(sight.pair)
            if mirror is not None and sight.pair.cos_m >= cos(LAMP):
                beam = 1 / (sight.pair.cos_i * solid_angle)
                shown = [f + beam * each for f, each in zip(shown, mirror(sight.pair), strict=True)]
            squares += [log(f / mpf(value)) ** 2 for f, value in zip(shown, values, strict=True) if value > 0 and f > 0]
        return _root_mean(squares)


def judged(surface: ExactSurface, data: Readings, channels: tuple[int, int, int]) -> Judged | None:
    """None of a law under a coat that has a mirror itself, which is not written down a second time."""
    hidden = any(each.coated and each.law in MIRRORS for each in surface.parts)
    return None if hidden else Judged(surface, data, channels)


def colours_of(channels: Sequence[str]) -> tuple[int, int, int] | None:
    """The channels of red, green and blue, or the one of grey; None where colours are mixed of wavelengths."""
    names = [RGB.get(name.strip().lower(), -1) for name in channels]
    if len(names) == 1:
        return 0, 0, 0
    return (names.index(0), names.index(1), names.index(2)) if sorted(names) == [0, 1, 2] else None


def _at_mirror(theta: float) -> ExactDirections:
    return ExactDirections(theta, 0.0, theta, 180.0)


def _squares(written: Sequence, wanted: Sequence, counted: Sequence[bool]) -> list:
    return [
        log(f / right) ** 2 if f > 0 else inf
        for f, right, counts in zip(written, wanted, counted, strict=True)
        if counts
    ]


def _root_mean(squares: list) -> mpf:
    return sqrt(fsum(squares) / len(squares)) if squares else mpf(0)
