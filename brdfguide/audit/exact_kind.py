"""What decides between metal and dielectric, once more, from the values alone.

    lobe        ∫ (f - least f) cos θi 2π sin d dd up to 25 degrees from the mirror direction, f(d) the mean of ln f by
                tenths of a degree, between these straight in ln, over light up to 35 degrees
    whole       lobe + π (mean f beyond)
    body        median f beyond 35 degrees from the mirror direction, seen up to 65 degrees from the normal
    colours     third largest over third smallest channel of many, largest over smallest of few
    rise        the greatest f within 5 degrees of the mirror direction at the steepest light up to 80, over that at the
                lowest

f is the median of the channels that have a value. Angles from the mirror direction are told apart to nine decimals.
"""

from collections import defaultdict
from functools import cached_property
from math import asin, degrees
from math import sqrt as root
from statistics import median

from mpmath import cos, exp, fsum, log, mpf, pi, radians, sin

from .exact_errors import LARGEST, Readings
from .exact_followers import MOST_HELD
from .rederived import Comparisons

LOW_DEG, STEEP_DEG, HIGHEST_DEG = 35.0, 60.0, 80.0  # of light
LOBE_DEG, BODY_DEG, BESIDE_DEG = 25.0, 35.0, 10.0  # from the mirror direction
GRAZING_DEG = 65.0  # from the normal, up to which a body is looked at
PEAK_DEG, COLOURED_DEG = 5.0, 8.0  # from the mirror direction
COLOURED_LIGHT = 50.0, 76.0  # degrees, where a lobe's colour is read
OVER_BODY = 10  # times, that a lobe is there
DECIMALS = 9
FEWEST, FEWEST_OF_BODY, FEWEST_OF_PROFILE = 5, 4, 3  # values
NEAREST_DEG, COARSE_DEG, STEEP = 3.0, 1.5, 6  # the first of a profile; steps that do not resolve a fall so steep
STEPS = 2000  # of the integral
DARKEST = mpf("1e-12")  # 1/sr
MANY, TRIMMED = 10, 2  # channels, and how many of them at each end are noise


def compare_kind(answer: dict, data: Readings, found: Comparisons) -> None:
    """Every number that the answer tells of it."""
    told = (answer.get("kind") or {"numbers": {}})["numbers"]
    looked = _Looked(data) if told else None
    for key in told:
        right = getattr(looked, key, None) if key in NUMBERS else None
        if right is not None:
            found.check(f"kind.numbers.{key}", told[key], right)


NUMBERS = ("lobe_reflectance", "whole_reflectance", "body_colour", "lobe_colour", "rise", "body_spread")


class _Looked:
    """Each number once; None where the values do not tell it."""

    def __init__(self, data: Readings):
        self.values = [
            [v if 1 / LARGEST < v < LARGEST and up else None for v in row]
            for row, up in zip(data.values, data.lit, strict=True)
        ]
        self.grey = [_median([v for v in row if v is not None]) for row in self.values]
        self.from_mirror = [round(_degrees_from_mirror(sight.pair.cos_m), DECIMALS) for sight in data.sights]
        self.theta_r = [each[2] for each in data.angles]
        self.rows: dict[float, list[int]] = defaultdict(list)
        tenths = [round(10 * each[0]) / 10 for each in data.angles]
        held = len(set(tenths)) <= MOST_HELD
        for row, (tenth, each) in enumerate(zip(tenths, data.angles, strict=True)):
            if self.grey[row] is not None:
                self.rows[tenth if held else float(round(each[0]))].append(row)
        self.low = [theta for theta, rows in sorted(self.rows.items()) if theta <= LOW_DEG and len(rows) >= FEWEST]

    def _body_at(self, theta: float) -> list[int]:
        return [row for row in self.rows[theta] if self.from_mirror[row] > BODY_DEG and self.theta_r[row] < GRAZING_DEG]

    def _within(self, theta: float, most: float) -> list[int]:
        return [row for row in self.rows[theta] if self.from_mirror[row] <= most]

    @cached_property
    def body_spread(self):
        of_each = [self._body_at(theta) for theta in self.rows]
        bodies = [_median([self.grey[row] for row in rows]) for rows in of_each if len(rows) >= FEWEST_OF_BODY]
        return max(bodies) / min(bodies) if bodies else None

    @cached_property
    def _lobes(self) -> dict[float, mpf]:
        found = {theta: self._integral(theta) for theta in self.low}
        return {theta: each for theta, each in found.items() if each is not None}

    @cached_property
    def lobe_reflectance(self):
        return _median(list(self._lobes.values()))

    @cached_property
    def whole_reflectance(self):
        found = []
        for theta, lobe in self._lobes.items():
            beyond = [mpf(self.grey[row]) for row in self.rows[theta] if self.from_mirror[row] > LOBE_DEG]
            found += [lobe + pi * fsum(beyond) / len(beyond)] if beyond else []
        return _median(found)

    def _integral(self, theta: float):
        """None of a profile that is too coarse for its peak."""
        by_place: dict[float, list[int]] = defaultdict(list)
        for row in self._within(theta, LOBE_DEG + BESIDE_DEG):
            by_place[round(10 * self.from_mirror[row]) / 10].append(row)
        profile = {
            place: exp(fsum(log(mpf(self.grey[row])) for row in rows) / len(rows))
            for place, rows in sorted(by_place.items())
        }
        inside = [place for place in profile if place <= LOBE_DEG]
        if len(inside) < FEWEST_OF_PROFILE or inside[0] > NEAREST_DEG:
            return None
        steps = zip(inside, inside[1:], strict=False)
        if any(b - a > COARSE_DEG and profile[a] > STEEP * profile[b] for a, b in steps):
            return None
        least = min(profile.values())
        knots = [(radians(mpf(place)), log(max(profile[place] - least, DARKEST))) for place in inside]
        step = knots[-1][0] / (STEPS - 1)
        lobe = fsum(exp(_straight(knots, n * step)) * sin(n * step) for n in range(STEPS))
        return lobe * 2 * pi * step * cos(radians(mpf(theta)))

    @cached_property
    def rise(self):
        peaks = [(theta, self._within(theta, PEAK_DEG)) for theta in sorted(self.rows) if theta <= HIGHEST_DEG]
        highest = [(theta, max(self.grey[row] for row in rows)) for theta, rows in peaks if rows]
        if len(highest) < 2 or highest[0][0] > LOW_DEG or highest[-1][0] < STEEP_DEG:
            return None
        return mpf(highest[-1][1]) / mpf(highest[0][1])

    @cached_property
    def body_colour(self):
        rows = [row for theta in self.low for row in self._body_at(theta)]
        return _span(self._of_channels(rows)) if len(rows) >= FEWEST_OF_BODY else mpf(1)

    @cached_property
    def lobe_colour(self):
        """None, too, where equal values leave open which are the three brightest."""
        if len(self.values[0]) < 3:
            return None
        for theta in sorted(self.rows, reverse=True):
            near, far = self._within(theta, COLOURED_DEG), self._body_at(theta)
            if not COLOURED_LIGHT[0] <= theta <= COLOURED_LIGHT[1] or not near or not far:
                continue
            if max(self.grey[row] for row in near) > OVER_BODY * _median([self.grey[row] for row in far]):
                order = sorted(near, key=lambda row: -self.grey[row])
                if len(order) > 3 and self.grey[order[2]] == self.grey[order[3]]:
                    return None
                both = zip(self._of_channels(order[:3]), self._of_channels(far), strict=True)
                return _span([None if a is None or b is None else a - b for a, b in both])
        return None

    def _of_channels(self, rows: list[int]) -> list:
        """Median of each channel over the rows that have a value."""
        columns = zip(*(self.values[row] for row in rows), strict=True)
        return [_median([v for v in column if v is not None]) for column in columns]


def _degrees_from_mirror(cosine) -> float:
    """To the digits of a double, also where the cosine is near 1."""
    return degrees(2 * asin(root(max(float(1 - cosine), 0.0) / 2)))


def _median(values: list):
    return mpf(median(values)) if values else None


def _span(channels: list):
    known = sorted(each for each in channels if each is not None and each > 0)
    if len(known) < 2:
        return mpf(1)
    trim = TRIMMED if len(known) >= MANY else 0
    return known[-1 - trim] / known[trim]


def _straight(knots: list, x):
    """Between knots in order; level before the first."""
    if x <= knots[0][0]:
        return knots[0][1]
    place = next((n for n in range(1, len(knots)) if x <= knots[n][0]), len(knots) - 1)
    (a, f), (b, g) = knots[place - 1], knots[place]
    return f + (g - f) * (x - a) / (b - a)
