"""Errors of a row from its exact residuals: every sum that an answer tells, once more and with no code of the fit.

The orders and shares that the sums are taken in (incidences, blocks of neighbours, rings of a sphere) are formed here
anew from the angles [deg], as the pages on errors say it.
"""

from bisect import bisect_left
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from statistics import median

from mpmath import cbrt, cos, exp, fsum, log, mpf, radians, sqrt

from ..records import dataclass
from .exact_surface import ExactReading, ExactSurface, RoundingDecides

SMALLEST = mpf("1e-300")  # a law that gives less is taken here
LARGEST = 1e100  # [1/sr]; beyond, and below its inverse, is no measurement
PER_MEDIAN = mpf("1.4826")  # standard deviation of a normal distribution over its median size
APART_DEG = 0.25  # between two incidences of scans
HELD_DEG = 1.0  # how far an incidence wanders that was held
MOST_SCANS = 64  # with more incidences the order alone cuts blocks
TILTED_DEG, MOST_TURNS = 1.0, 64  # incidence at which light has an azimuth; more of these are no turns of the sample
PIECES = 8  # blocks of one incidence


@dataclass(frozen=True, eq=False)
class Readings:
    """What was measured: angles [deg] (theta_i, phi_i, theta_r, phi_r), values [1/sr] and where they are told."""

    angles: tuple[tuple[float, float, float, float], ...]
    values: tuple[tuple[float, ...], ...]  # (samples, channels), NaN where there is none
    limits: tuple[float, ...]  # of each channel, below which a value only says that it is small
    wavelengths: tuple[float, ...]  # [µm]
    solid_angle: float | None = None
    by_scan: bool = False  # every incidence counts alike
    doubt: tuple[float, ...] = ()  # of the dark level in each channel
    missed: float | None = None  # relative error expected of bright values, where others are too dim for ln
    stated: tuple[tuple[float, ...], ...] | None = None  # standard errors [1/sr]
    by_error: bool = False  # which values are weighed by
    robust: bool = False  # values far off counted little
    taken: Sequence[Sequence[bool]] | None = None  # where they are told, if that is known already
    faults: bool = False  # what the instrument may do unnoticed was counted as doubt
    beyond: tuple[tuple[float, float], ...] = ()  # what theta_i and theta_r have beyond the digits that are read [deg]
    as_read: tuple[tuple[float, ...], ...] | None = None  # values before any was left out; None where that is not known

    @cached_property
    def least(self) -> list:
        """What a law that gives less is taken at, by channel: where dim values count otherwise, the dark level's
        doubt."""
        if self.missed is None:
            return [SMALLEST] * len(self.wavelengths)
        return [max(mpf(doubt), SMALLEST) for doubt in self.doubt]

    @cached_property
    def sights(self) -> list[ExactReading]:
        pairs = zip(self.angles, self.beyond or [(0.0, 0.0)] * len(self.angles), strict=True)
        return [ExactReading((i + i2, at, r + r2, to), self.solid_angle) for (i, at, r, to), (i2, r2) in pairs]

    @cached_property
    def told(self) -> Sequence[Sequence[bool]]:
        """Where a value is positive, of a size, above the horizon and clear of the dark level."""
        return self.taken or [
            [1 / LARGEST < v < LARGEST and v >= limit and up for v, limit in zip(row, self.limits, strict=True)]
            for row, up in zip(self.values, self.lit, strict=True)
        ]

    @cached_property
    def looked_at(self) -> list[list[bool]]:
        """Where a fit looks: what is told, and where the dark level is in doubt dim and negative values as well."""
        return [
            [
                known or limit > 0 and up and abs(v) < LARGEST
                for v, limit, known in zip(row, self.limits, told, strict=True)
            ]
            for row, told, up in zip(self.values, self.told, self.lit, strict=True)
        ]

    @cached_property
    def lit(self) -> list[bool]:
        return [theta_i < 90 and theta_r < 90 for theta_i, _, theta_r, _ in self.angles]

    @cached_property
    def exact(self) -> list[list]:
        """The values as the doubles they are; None where they are not told."""
        return [
            [mpf(v) if known else None for v, known in zip(row, told, strict=True)]
            for row, told in zip(self.values, self.told, strict=True)
        ]

    @cached_property
    def ln(self) -> list[list]:
        return [[None if v is None else log(v) for v in row] for row in self.exact]

    @cached_property
    def cube_roots(self) -> list[list]:
        return [[None if v is None else cbrt(v) for v in row] for row in self.exact]

    @cached_property
    def cosine_weighed(self) -> list[list]:
        """f cos θi cos θr."""
        cosines = [sight.pair.cos_i * sight.pair.cos_r for sight in self.sights]
        return [[None if v is None else v * c for v in row] for row, c in zip(self.exact, cosines, strict=True)]

    @cached_property
    def mean_cube_root(self):
        return exact_rms(self.cube_roots, self.share)

    @cached_property
    def mean_cosine_weighed(self):
        return exact_rms(self.cosine_weighed, self.share)

    @cached_property
    def share(self) -> list:
        """How much each direction counts, mean 1 over those with a value."""
        known = [any(row) for row in self.told]
        if not self.by_scan:
            return [1] * len(self.angles)
        number = held_numbers([each[0] for each in self.angles])
        count = Counter(place for place, has in zip(number, known, strict=True) if has)
        most = max(count.values())
        raw = [_of_scan(count[place], most) for place in number]
        mean = fsum(each for each, has in zip(raw, known, strict=True) if has) / sum(known)
        return [each / mean for each in raw]

    @cached_property
    def signed_theta_r(self) -> list[float]:
        """[deg], positive on the mirror side."""
        out = []
        for theta_i, phi_i, theta_r, phi_r in self.angles:
            toward = -cos(radians(mpf(phi_r) - mpf(phi_i)))
            out.append(theta_r if toward >= -(mpf(10) ** -14) or theta_i == 0 and toward > 0 else -theta_r)
        return out

    def part(self, rows: Sequence[int], channels: Sequence[int]) -> "Readings":
        """Some directions and channels, by their numbers."""

        def few(table):
            return tuple(tuple(table[row][c] for c in channels) for row in rows) if table is not None else None

        return replace(
            self,
            angles=tuple(self.angles[row] for row in rows),
            values=few(self.values),
            limits=tuple(self.limits[c] for c in channels),
            wavelengths=tuple(self.wavelengths[c] for c in channels),
            doubt=tuple(self.doubt[c] for c in channels) if self.doubt else (),
            stated=few(self.stated),
            taken=few(self.taken),
            beyond=tuple(self.beyond[row] for row in rows) if self.beyond else (),
            as_read=few(self.as_read),
        )


def _of_scan(count: int, most: int):
    """Scans of fewer than five directions are none, and gain nothing by being few."""
    return min(mpf(most) / (count if count >= 5 else most), mpf(10))


def held_numbers(angles: list[float]) -> list[int]:
    """The number of the held angle that each belongs to."""
    order = sorted(range(len(angles)), key=lambda place: angles[place])
    number, numbers = 0, [0] * len(angles)
    for before, place in zip([order[0], *order], order, strict=False):
        number += angles[place] - angles[before] > APART_DEG
        numbers[place] = number
    spans = defaultdict(list)
    for angle, place in zip(angles, numbers, strict=True):
        spans[place].append(angle)
    if max(max(each) - min(each) for each in spans.values()) > HELD_DEG:
        whole = sorted({round(angle) for angle in angles})
        return [whole.index(round(angle)) for angle in angles]
    return numbers


def exact_residuals(surface: ExactSurface, data: Readings) -> list[list]:
    """ln(model/data) in every channel; None where nothing is told. Raises RoundingDecides."""
    return [residuals_of(surface, data, number) for number in range(len(data.angles))]


def residuals_of(surface: ExactSurface, data: Readings, number: int) -> list:
    """The same of one direction."""
    sight, row = data.sights[number], data.ln[number]
    return [None if ln is None else log(_seen(surface, sight, c, data)) - ln for c, ln in enumerate(row)]


def _seen(surface: ExactSurface, sight: ExactReading, channel: int, data: Readings):
    """What a detector reports, `data.least` at least."""
    read = sight.reading(surface, channel, data.wavelengths[channel])
    if surface.ends_by_rounding(sight.pair, channel, read):
        raise RoundingDecides
    return max(read, data.least[channel])


def exact_rms(rows: list[list], share: list) -> mpf:
    """Root mean square over what is told, each direction by its share."""
    squares = [s * v * v for row, s in zip(rows, share, strict=True) for v in row if v is not None]
    return sqrt(fsum(squares) / len(squares))


def by_incidence(rows: list[list], data: Readings) -> dict[float, mpf]:
    """rms ln at each incidence [deg], in steps of 10 where there are more than twenty."""
    angles = [_tenth(each[0]) for each in data.angles]
    if len(set(angles)) > 20:
        angles = [float(round(angle / 10) * 10) for angle in angles]
    groups: dict[float, list] = defaultdict(list)
    for angle, row in zip(angles, rows, strict=True):
        groups[angle] += [v * v for v in row if v is not None]
    return {angle: sqrt(fsum(each) / len(each)) for angle, each in sorted(groups.items()) if each}


def _tenth(angle: float) -> float:
    return round(10 * angle) / 10


def noise_of_values(data: Readings, relative: float, left):
    """rms of ln by which single values scatter: from their relative doubt and the dark level's, or as it is stated;
    what the first row leaves (`left`; None: not known) where that is much less than the former."""
    told = [(v, doubt) for row in data.exact for v, doubt in zip(row, data.doubt, strict=True) if v is not None]
    scatter = sqrt(mpf(relative) ** 2 + fsum((mpf(doubt) / v) ** 2 for v, doubt in told) / len(told))
    return max(_no_more_than(left, scatter), _stated(data))


def noise_of_residuals(data: Readings, rows: list[list], left):
    """The same where no value can be compared with others: from second differences of residuals along the scans."""
    along = [rows[place] for place in scan_order(data)]
    steps = [
        abs(a - 2 * b + c)
        for three in zip(along, along[1:], along[2:], strict=False)
        for a, b, c in zip(*three, strict=True)
        if a is not None and b is not None and c is not None
    ]
    scatter = PER_MEDIAN * median(steps) / sqrt(6) if steps else mpf(0)
    return max(_no_more_than(left, scatter), _stated(data))


def _no_more_than(left, scatter):
    return left if left is not None and left < scatter / 2 else scatter


def _stated(data: Readings):
    """The relative error that is stated of a value, the median; 0 where none is."""
    stated = [
        error / value
        for errors, values, known in zip(data.stated or (), data.values, data.told, strict=False)
        for error, value, clear in zip(errors, values, known, strict=True)
        if clear and 0 <= error < LARGEST
    ]
    return mpf(median(stated)) if stated else mpf(0)


def on_scales(rows: list[list], data: Readings) -> dict[str, mpf]:
    """The error on every scale, relative to the data's own rms on it where the scale is not logarithmic."""
    third, thrice = mpf(1) / 3, mpf(300)
    parts: dict[str, list] = {"cube-root": [], "relative": [], "cosine": []}
    for row, roots, bright in zip(rows, data.cube_roots, data.cosine_weighed, strict=True):
        thirds = [None if v is None else exp(third * min(v, thrice)) for v in row]
        told = [(q, r, b) for q, r, b in zip(thirds, roots, bright, strict=True) if q is not None]
        parts["cube-root"].append([r * (q - 1) for q, r, _ in told])
        parts["relative"].append([q**3 - 1 for q, _, _ in told])
        parts["cosine"].append([b * (q**3 - 1) for q, _, b in told])
    errors = {name: exact_rms(each, data.share) for name, each in parts.items()}
    errors["cube-root"] /= data.mean_cube_root
    errors["cosine"] /= data.mean_cosine_weighed
    return errors


def exact_behind(one: list[list], best: list[list], data: Readings) -> tuple[mpf, mpf]:
    """How far one rms lies behind the other, and the standard error of that between blocks of neighbours."""
    roots = [sqrt(each) for each in data.share] if data.by_scan else data.share
    pairs = [
        [(root * a, root * b) for a, b in zip(row, other, strict=True) if a is not None and b is not None]
        for row, other, root in zip(one, best, roots, strict=True)
    ]
    count = max(sum(map(len, pairs)), 1)
    total = sum(sqrt(fsum(pair[end] ** 2 for row in pairs for pair in row) / count) for end in (0, 1))
    power = fsum((a - b) ** 2 for row in pairs for a, b in row)
    if total == 0 or power == 0:
        return mpf(0), mpf(0)
    share = fsum(b * (a - b) for row in pairs for a, b in row) / power
    sums: dict = defaultdict(mpf)
    leverage: dict = defaultdict(mpf)
    for block, row in zip(neighbours_of_scans(data), pairs, strict=True):
        for a, b in row:
            sums[block] += 2 * (a - b) * (b - share * (a - b))
            leverage[block] += (a - b) ** 2 / power
    freedom = max(1 / fsum(each**2 for each in leverage.values()) - 1, mpf(1))
    student = 1 + mpf("1.25") / freedom + mpf("1.53") / freedom**2
    spread = sqrt(fsum(sums[block] ** 2 / max(1 - leverage[block], mpf("1e-3")) for block in sums))
    return power * (1 + 2 * share) / count / total, student * spread / count / total


def neighbours_of_scans(data: Readings) -> list[int]:
    """Which neighbours along a scan err together: a number for each row."""
    order, theta = scan_order(data), [_tenth(each[0]) for each in data.angles]
    groups: dict[int, list[int]] = defaultdict(list)
    number, before = 0, theta[order[0]]
    for place in order:
        number += theta[place] != before
        before = theta[place]
        groups[number].append(place)
    blocks = [0] * len(order)
    if len(groups) > MOST_SCANS:
        for rank, place in enumerate(order):
            blocks[place] = block_number(rank, len(order))
        return blocks
    each = PIECES if len(groups) > 1 else _pieces(len(order))
    for number, members in enumerate(groups.values()):
        for rank, place in enumerate(members):
            blocks[place] = number * each + rank * each // len(members)
    return blocks


def scan_order(data: Readings) -> list[int]:
    """Rows by turn of the sample, incidence, azimuth and reflected angle; those alike in the order of the file."""
    turn, theta = numbers_of_turns(data), [_tenth(each[0]) for each in data.angles]
    azimuth = [_tenth(abs((each[3] - each[1] + 180) % 360 - 180)) for each in data.angles]
    keys = list(zip(turn, theta, azimuth, data.signed_theta_r, strict=True))
    return sorted(range(len(theta)), key=lambda place: keys[place])


def block_number(rank: int, count: int) -> int:
    """Of a row in an order of `count` that is cut evenly."""
    return rank * _pieces(count) // count


def _pieces(count: int) -> int:
    return min(max(count // 50, 4 * PIECES), 256)


def numbers_of_turns(data: Readings) -> list[int]:
    """The number of the turn of each row; 0 throughout where the sample was not turned, or was not held."""
    of_each = turn_azimuths(data)
    known = sorted(set(of_each))
    return [known.index(each) for each in of_each]


def turn_azimuths(data: Readings) -> list[int]:
    """The azimuth of the light [deg] that stands for each row's turn, to a degree, half a turn being none; 0 throughout
    where the sample was not turned, or was not held."""
    azimuth = [round(phi_i) % 180 for _, phi_i, _, _ in data.angles]
    known = sorted({turn for turn, each in zip(azimuth, data.angles, strict=True) if each[0] > TILTED_DEG})
    if not 2 <= len(known) <= MOST_TURNS:
        return [0] * len(azimuth)
    return [known[min(bisect_left(known, turn), len(known) - 1)] for turn in azimuth]
