"""A fitted surface from the words and numbers of an answer, evaluated by `textbook`: no code of models or fits.

    f = Σ w Σ_terms law(r_w) + ρ(θi)/(cos θi Ω)    over the detector's cone, if it has one

The expression is parsed anew, so that a mistake in how the program understands its own answers shows as well.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import field, replace
from functools import cached_property

from mpmath import asin, cos, fabs, mpf, pi, radians, sin, sqrt

from ..records import dataclass
from . import textbook_grain, textbook_more, textbook_shaders
from .textbook import ExactDirections

GRAINED = {"ggx-aniso", "stam", *textbook_grain.LAWS, *textbook_grain.ROUGHER, *textbook_shaders.LAWS}
# told in degrees, meant in radians
ANGLES = {"tilt": {"lafortune"}, "spread": {"oren-nayar"}, "theta0": {"sgd-published"}, "axis": GRAINED}
SHORT = {"he": "he-torrance"}
KNOWN = {*textbook_more.LAWS, *textbook_more.ROUGHER} - {"cylinders"}  # which take a minute
# laws of which the program keeps a series: how far from ours ln f may be, and from which alpha on; with narrower ones
# too few digits of what several facets send are told beside the lobe
SERIES = {"ggx-ms": (1e-4, 0.12)}
WAVES = {"he-torrance", "he-torrance-aniso", "stam"}  # sums of a hundred terms and more
IN_DOUBLES = 1e-11  # of ln f, what the program loses of these; 3e-12 is the most that was found (ours)
COAT = ("coat.n", "coat.depth")
STEP = mpf("1e-15")  # relative, for differences: of 30 digits fifteen are left
ENDING = {"phong", "phong-lewis"}  # lobes that end at right angles to the mirror direction
EDGE = mpf("1e-12")  # cosine to that direction, below which a double does not tell its sign
SEEN = mpf("1e-10")  # share of what is read from which on a lobe counts there
LINEAR = {"ks", "rho_s", "scale", "flake", "rho"}  # which laws are proportional to


class NoLaw(Exception):
    """A law that is not written down a second time."""


class TooNarrow(Exception):
    """A lobe of which the program's series tells too few digits."""


class RoundingDecides(Exception):
    """A lobe about the mirror direction ends, or does not, in a direction at right angles to that."""


@dataclass(frozen=True, eq=False)
class TermInAnswer:
    """One term: a law, where its numbers stand in the answer, and whether a coat lies over it."""

    law: str
    keys: tuple[tuple[str, str], ...]  # bare name -> key of the answer
    coated: bool


@dataclass(frozen=True, eq=False)
class ExactSurface:
    """The model of one row with its values, channel by channel."""

    parts: tuple[TermInAnswer, ...]
    values: dict  # key -> one number, or one for each channel, as printed
    moved: str = ""  # the key of a number that is a step larger
    known: dict = field(default_factory=dict)  # (part, pair, first channel of that shape) -> f, of amplitude 1

    @cached_property
    def slack(self) -> float:
        """How far from ours ln f may be in the program, by what it says of its series."""
        return max((SERIES[each.law][0] for each in self.parts if each.law in SERIES), default=0.0)

    @cached_property
    def lost(self) -> float:
        """What doubles may lose of an error of it, beside what any sum loses."""
        return IN_DOUBLES if any(each.law in WAVES for each in self.parts) else 1e-15

    @cached_property
    def _told(self) -> dict:
        """(key, channel) -> the number; filled as they are asked for."""
        return {}

    def at(self, key: str, channel: int):
        """One number as the double it is."""
        if (key, channel) not in self._told:
            self._told[key, channel] = self._exact(key, channel)
        return self._told[key, channel]

    def _exact(self, key: str, channel: int):
        value = self.values[key]
        if isinstance(value, list):
            value = value[channel if len(value) > 1 else 0]
        exact = mpf(float(value))
        return exact + (abs(exact) or 1) * STEP if key == self.moved else exact

    def slope(self, key: str, sight: "ExactReading", channel: int, wavelength):
        """d reading/d p of one of its numbers."""
        here, there = self._around[key]
        size = self.at(key, channel)
        read = sight.reading(here, channel, wavelength)
        if key.rpartition(".")[2] in LINEAR and size:
            return read / size
        return (sight.reading(there, channel, wavelength) - read) / (there.at(key, channel) - size)

    @cached_property
    def _around(self) -> "dict[str, tuple[ExactSurface, ExactSurface]]":
        return {key: self._beside(key) for key in self.values}

    def _beside(self, key: str) -> "tuple[ExactSurface, ExactSurface]":
        """Its parts that know a number, and the same with the number a step larger: they differ as the whole does."""
        parts = tuple(each for each in self.parts if key in COAT and each.coated or key in dict(each.keys).values())
        return replace(self, parts=parts), replace(self, parts=parts, moved=key, known={})

    @cached_property
    def _inside(self) -> dict:
        """(part, channel) -> its law's numbers, angles in radians; filled as they are asked for."""
        return {}

    def _numbers_of(self, part: TermInAnswer, channel: int) -> dict:
        if (part, channel) not in self._inside:
            values = {name: self.at(key, channel) for name, key in part.keys}
            turned = {name: radians(v) for name, v in values.items() if part.law in ANGLES.get(name, ())}
            self._inside[part, channel] = values | turned
        return self._inside[part, channel]

    def brdf(self, pair: ExactDirections, channel: int, wavelength):
        """The finite part [1/sr] in one channel; wavelength [µm]."""
        if len(self.parts) == 1:
            return self._once(self.parts[0], pair, channel, wavelength)
        return sum((self._once(each, pair, channel, wavelength) for each in self.parts), mpf(0))

    def _once(self, part: TermInAnswer, pair, channel: int, wavelength):
        """What channels share is evaluated once: most laws are proportional to a number that each has for itself."""
        if self.moved and not self._has_channels:
            return self._part(part, pair, channel, wavelength)
        amplitude, first = self._shape_of(part, channel)
        at = part, pair, first
        if at not in self.known:
            self.known[at] = self._part(part, pair, channel, wavelength, amplitude)
        return self.known[at] * self._numbers_of(part, channel)[amplitude] if amplitude else self.known[at]

    @cached_property
    def _has_channels(self) -> bool:
        return any(isinstance(each, list) and len(each) > 1 for each in self.values.values())

    @cached_property
    def _shapes(self) -> dict:
        """(part, channel) -> what `_shape_of` gives; filled as it is asked for."""
        return {}

    def _shape_of(self, part: TermInAnswer, channel: int) -> tuple[str, int]:
        """The number that a law is proportional to, "" for none, and the first channel that has all others alike; a law
        that knows the wavelength has another shape in each."""
        if (part, channel) not in self._shapes:
            amplitude = next((name for name, _ in part.keys if name in LINEAR), "")
            wanted, first = self._others(part, channel, amplitude), channel
            if part.law not in textbook_more.WAVES:
                first = next(c for c in range(channel + 1) if self._others(part, c, amplitude) == wanted)
            self._shapes[part, channel] = amplitude, first
        return self._shapes[part, channel]

    def _others(self, part: TermInAnswer, channel: int, amplitude: str) -> list:
        over = [self.at(key, channel) for key in COAT] if part.coated else []
        return over + [value for name, value in self._numbers_of(part, channel).items() if name != amplitude]

    def _part(self, part: TermInAnswer, pair, channel: int, wavelength, amplitude: str = ""):
        """One term; with 1 for the number that `amplitude` names."""
        values = self._numbers_of(part, channel)
        values = values | {amplitude: mpf(1)} if amplitude else values
        if not part.coated:
            return textbook_more.evaluated(part.law, pair, values, wavelength)
        n, depth = (self.at(key, channel) for key in COAT)
        return textbook_more.coated(pair, part.law, values, n, depth, wavelength)

    def ends_by_rounding(self, pair: ExactDirections, channel: int, read) -> bool:
        """Whether a lobe ends in this direction, or does not, by less than a double tells."""
        if fabs(pair.cos_m) > EDGE:
            return False
        ending = (self._numbers_of(each, channel) for each in self.parts if each.law in ENDING)
        return any(each["ks"] * EDGE ** each["exponent"] > SEEN * read for each in ending)

    def mirror(self, pair: ExactDirections, channel: int, wavelength):
        """Reflectance left to the mirror direction."""
        total = mpf(0)
        for part in self.parts:
            law = textbook_more.MIRRORS.get(part.law)
            if law is not None and not part.coated:
                total += law(pair, **self._numbers_of(part, channel), wavelength=wavelength)
        if "coat.sigma" in self.values:
            values = {"n": self.at("coat.n", channel), "k": mpf(0), "sigma": self.at("coat.sigma", channel)}
            total += textbook_more.smooth_mirror(pair, **values, wavelength=wavelength)
        return total


def surface_of(expression: str, parameters: dict) -> ExactSurface:
    """A row's `model` and its `parameters`. Raises NoLaw for a law that is not written down here, TooNarrow."""
    values = {key: entry["value"] for key, entry in parameters.items() if not entry.get("derived")}
    parts: list[TermInAnswer] = []
    words = list(_words(expression))
    total, so_far = Counter[str](), Counter[str]()
    for law, count, _ in words:
        total[law] += count
    for law, count, coated in words:
        first = so_far[law] + 1
        labels = [f"{law}.{place}" for place in range(first, first + count)] if total[law] > 1 else [law]
        parts += [TermInAnswer(law, _keys(label, labels[0], values), coated) for label in labels]
        so_far[law] += count
    for part in parts:
        told = values[dict(part.keys)["alpha"]] if part.law in SERIES else []
        if any(each < SERIES[part.law][1] for each in (told if isinstance(told, list) else [told])):
            raise TooNarrow
    return ExactSurface(tuple(parts), values)


def _words(expression: str) -> Iterator[tuple[str, int, bool]]:
    """Of each word its law, how many lobes it has, and whether a coat lies over it. Raises NoLaw."""
    coated = False
    for word in map(str.strip, expression.split("+")):
        coated = coated or word.startswith("coated:")
        name, _, count = word.removeprefix("coated:").partition(":")
        law = SHORT.get(name, name)
        if law not in KNOWN or "(" in name or not (count or "1").isdecimal():
            raise NoLaw(word)
        yield law, int(count or 1), coated


def _keys(label: str, first: str, values: dict) -> tuple[tuple[str, str], ...]:
    """Its own numbers, and those that it has from the first lobe of its kind."""
    own = {key.removeprefix(label + "."): key for key in values if key.startswith(label + ".")}
    names = (key.removeprefix(first + ".") for key in values if key.startswith(first + "."))
    own |= {name: f"{first}.{name}" for name in names if name not in own}
    if "k" in own and "n" not in own and COAT[0] in values:
        own["n"] = COAT[0]  # of a lobe on the coat, which is its rough upper side
    if not own:
        raise NoLaw(f"{label}, whose numbers stand elsewhere")
    return tuple(own.items())


@dataclass(frozen=True, eq=False)
class ExactReading:
    """One pair of directions [deg] as a detector of solid angle Ω [sr] sees it; None: a point."""

    angles: tuple[float, float, float, float]
    solid_angle: float | None = None

    @cached_property
    def pair(self) -> ExactDirections:
        return ExactDirections(*self.angles)

    @cached_property
    def views(self) -> list:
        """Weights and directions: the seven-point rule of a disc (Abramowitz and Stegun 25.4.61) on the cap."""
        radius = sqrt(mpf(2) / 3) * self._half_angle
        theta, phi, (x, y, z) = self.pair.theta_r, self.pair.phi_r, self.pair.r
        down = (cos(theta) * cos(phi), cos(theta) * sin(phi), -sin(theta))
        across = (-sin(phi), cos(phi), mpf(0))
        ring = []
        for turn in (place * pi / 3 for place in range(6)):
            toward = [cos(turn) * a + sin(turn) * b for a, b in zip(down, across, strict=True)]
            moved = [cos(radius) * a + sin(radius) * b for a, b in zip((x, y, z), toward, strict=True)]
            ring.append((mpf(1) / 8, ExactDirections.from_vectors(self.pair.i, moved)))
        return [(mpf(1) / 4, self.pair), *ring]

    @cached_property
    def _half_angle(self):
        return 2 * asin(sqrt(mpf(self.solid_angle) / (4 * pi)))

    def reading(self, surface: ExactSurface, channel: int, wavelength):
        """What the detector reports [1/sr]; 0 where the light or the detector is below the horizon."""
        if self.solid_angle is None:
            return surface.brdf(self.pair, channel, wavelength) if self._is_lit else mpf(0)
        lit = [(weight, pair) for weight, pair in self.views if pair.cos_i > 0 and pair.cos_r > 0]
        total = sum((weight * surface.brdf(pair, channel, wavelength) for weight, pair in lit), mpf(0))
        if self._sees_mirror:
            total += surface.mirror(self.pair, channel, wavelength) / (self.pair.cos_i * mpf(self.solid_angle))
        return total

    @cached_property
    def _is_lit(self) -> bool:
        return self.pair.cos_i > 0 and self.pair.cos_r > 0

    @cached_property
    def _sees_mirror(self) -> bool:
        """Whether the mirror direction lies in the cone."""
        return 2 - 2 * self.pair.cos_m <= mpf(self.solid_angle) / pi
