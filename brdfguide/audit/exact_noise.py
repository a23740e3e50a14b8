"""What single values are worth, once more, from the values alone: what neighbours, exchanged pairs, values below zero
and floors say of a relative doubt and of the dark level's.

    departure = f (ln f - cubic through ln of two neighbours on either side of a scan) / √(1 + Σ weights²)

of f itself where a value is not positive; of directions mirrored at the plane of incidence half their difference,
where scans tell too few; where no plane is mirrored either each is compared with those around it. In a dense table,
where neighbours stand beside each other in the file, nothing is derived.
"""

from collections import defaultdict
from math import isfinite
from statistics import median

from mpmath import fsum, log, mpf, sqrt

from ..records import dataclass
from .exact_errors import LARGEST, PER_MEDIAN, Readings, turn_azimuths
from .exact_exchange import Undecided, doubts_of_exchange
from .exact_scattered import NearestUndecided, departures_scattered
from .exact_two_parts import Departure, relative_and_absolute
from .rederived import Comparisons

MOST_DIRECTIONS = 200_000  # of a table that is not dense
ENOUGH = 40  # comparisons, beyond which no others are made
FEWEST_OF_SCAN, FEWEST = 5, 20  # directions of a scan; departures whose median is a size by itself
WIDEST_DEG, STEEPEST_DEG = 24.0, 85.0  # of five neighbours, and where the middle one lies
SAME_DEG = 1e-6
NORMAL = 1e-6  # sine of an incidence that has no plane
SPECTRUM = 5  # channels, of which the median is taken
FEW_NEGATIVE = 3
DETECTED = 3  # doubts, that a floor stands for
PLATEAU, LEAST_PLATEAU, ONE_LEVEL = 0.15, 20, 1.6  # share and number of values at one level, and how level it is
BLACKEST, LEAST_RANGE = 2e-4, 1e5  # reflectance of a plateau, and how far values reach from there
CLEAR, DIM, FEW_DIM = 10, 5, 0.01  # doubts from which a value is told; below which scales differ; of how many
LOST = 1e-12  # relative, of a model without noise
CLOSE = 1e-9  # relative, of a doubt
OF_PARABOLAS = 1e-8  # the same where twelve neighbours may nearly stand in a line; 2.4e-10 is the most that was found
PI = 3.141592653589793


@dataclass(frozen=True, eq=False)
class ValuesAsRead:
    """What was measured before anything was left out."""

    data: Readings
    values: list[list]  # (samples, channels) mpf of either sign; None where there is none
    ln: list[list]  # of those that are positive; None elsewhere
    colours: bool  # R, G and B


def compare_noise(answer: dict, data: Readings, found: Comparisons) -> bool:
    """The doubts of single values; False where they do not follow."""
    told = answer["noise"]
    if not told.get("absolute_per_sr") or len(data.angles) > MOST_DIRECTIONS or data.as_read is None:
        return False
    seen = _as_read(answer, data)
    try:
        departures, close = _departures(seen)
    except NearestUndecided:
        return False
    pooled = _pooled(departures)
    relative = _nearest([pair[0] for pair in pooled], told["relative"]) if pooled else None
    pooled = [pair for pair in pooled if pair[0] == relative]
    right = mpf("nan") if relative is None else relative
    found.check("noise.relative", told["relative"], right, close, absolute=LOST)
    try:
        exchanged = doubts_of_exchange(data, seen.values, seen.ln, told.get("dark_level_per_sr") is not None)
    except Undecided:
        return True
    for channel, one in enumerate(exchanged):
        for name, right in (("dark_level", one.offset), ("dark_level_stderr", one.stderr)):
            each = (told.get(f"{name}_per_sr") or {channel: None})[channel]
            found.check(f"noise.{name}_per_sr[{channel}]", each, right, CLOSE)
    _absolute(answer, seen, departures, pooled, [one.doubt for one in exchanged], found)
    return True


def _as_read(answer: dict, data: Readings) -> ValuesAsRead:
    """Values with the dark level that was taken out of them put back."""
    assert data.as_read is not None
    dark = [mpf(each) for each in answer["noise"].get("dark_level_per_sr") or [0.0] * len(data.wavelengths)]
    values: list[list] = []
    for row, sight, up in zip(data.as_read, data.sights, data.lit, strict=True):
        there = [up and abs(v) < LARGEST for v in row]
        added = [each and each / sight.pair.cos_i for each in dark]
        values.append([mpf(v) + d if known else None for v, d, known in zip(row, added, there, strict=True)])
    ln = [[log(v) if v is not None and v > 1 / LARGEST else None for v in row] for row in values]
    return ValuesAsRead(data, values, ln, set(answer["data"]["channels"]) == set("RGB"))


def _pooled(departures: list[list[Departure | None]]) -> list:
    """(relative, absolute) of all channels; of too few departures for both the median alone."""
    every = [each for row in departures for each in row if each is not None]
    if pairs := relative_and_absolute(every):
        return pairs
    sizes = [abs(each.size / each.level) for each in every if each.level > 0]
    return [(PER_MEDIAN * median(sizes), mpf(0))] if len(sizes) >= FEWEST else []


def _absolute(answer: dict, seen: ValuesAsRead, departures, pooled: list, exchanged: list, found: Comparisons) -> None:
    """The dark level's doubt in each channel, and from where on values are told."""
    told, channels = answer["noise"]["absolute_per_sr"], range(len(seen.data.wavelengths))
    several = [_of_channel([row[c] for row in departures], pooled) for c in channels]
    floors = [dict(each["numbers"])["floor_per_sr"] for each in answer["data"]["findings"] if each["code"] == "floor"]
    least = max(mpf(max(floors, default=0.0)) / DETECTED, _plateau(seen))
    below = _negative(seen)
    several = [
        [max(one, other) for one in some for other in more] for some, more in zip(several, exchanged, strict=True)
    ]
    if len(several) >= SPECTRUM:
        if any(len(set(some)) > 1 for some in several):
            return
        several = [[each] for each in _along_spectrum([some[0] for some in several])]
    rights = [
        _nearest([max(each, least, below[c]) for each in some], told[c])
        for c, some in zip(channels, several, strict=True)
    ]
    for c, right in zip(channels, rights, strict=True):
        found.check(f"noise.absolute_per_sr[{c}]", told[c], right, CLOSE)
    matters = _matters(seen, rights)
    for c, limit in enumerate(answer["noise"].get("told_from_per_sr") or ()):
        right = CLEAR * mpf(told[c]) if matters else mpf("nan")
        found.check(f"noise.told_from_per_sr[{c}]", limit, right)


def _of_channel(departures: list[Departure | None], pooled: list) -> list:
    """Absolute doubts of one channel that are as good: its own where it has enough departures, none where all channels
    together show none."""
    of_all = [pair[1] for pair in pooled] or [mpf(0)]
    own = [pair[1] for pair in relative_and_absolute([each for each in departures if each is not None])]
    shown = [each for each in of_all if each]
    return [each for each in of_all if not each] + (own or shown if shown else [])


def _nearest(rights: list, told):
    """Of choices that are as good the one that was taken."""
    return min(rights, key=lambda each: abs(each - mpf(told if told is not None else 0)))


def _along_spectrum(doubts: list) -> list:
    """The median of five neighbouring channels, ends repeated."""
    wide = SPECTRUM // 2
    padded = [doubts[0]] * wide + doubts + [doubts[-1]] * wide
    return [median(padded[place : place + SPECTRUM]) for place in range(len(doubts))]


def _matters(seen: ValuesAsRead, doubts: list) -> bool:
    """Whether more than a few values are so dim that ln is not their scale."""
    assert seen.data.as_read is not None
    known = [(v, doubt) for row in seen.data.as_read for v, doubt in zip(row, doubts, strict=True) if isfinite(v)]
    dim = sum(doubt > 0 and v < DIM * max(doubt, mpf("1e-12")) for v, doubt in known)
    return dim > FEW_DIM * len(known)


def _negative(seen: ValuesAsRead) -> list:
    """Doubt that values below zero show: of colours in each channel of which most are, of other channels together."""
    assert seen.data.as_read is not None
    columns, half = [[-mpf(v) for v in each if v < 0] for each in zip(*seen.data.as_read, strict=True)], 0.5
    if seen.colours:
        columns = [each if len(each) > half * len(seen.data.as_read) else [] for each in columns]
    else:
        columns = [[v for column in columns for v in column]] * len(columns)
    return [PER_MEDIAN * median(column) if len(column) >= FEW_NEGATIVE else mpf(0) for column in columns]


def _plateau(seen: ValuesAsRead):
    """Doubt of an instrument whose dimmest values all stand at one level, darker than any surface."""
    found = mpf(0)
    for column in zip(*seen.values, strict=True):
        dim = sorted(v for v in column if v is not None and v > 1 / LARGEST)
        count = int(PLATEAU * len(dim))
        if count < LEAST_PLATEAU or sum(PI * v < BLACKEST for v in dim) < count:
            continue
        lowest = dim[:count]
        level = lowest[-1] < ONE_LEVEL * lowest[count // 20]
        if level and PI * lowest[-1] < BLACKEST and dim[-1] > LEAST_RANGE * lowest[-1]:
            found = max(found, median(lowest))
    return found


# --- neighbours --------------------------------------------------------------------------------------


def _departures(seen: ValuesAsRead) -> tuple[list[list[Departure | None]], float]:
    """By comparison and channel, None where a value lacks, and to what share of its value the relative doubt that they
    show is kept in doubles. Raises NearestUndecided."""
    found = [row for scan in _scans(seen.data) for row in _along(seen, *scan)]
    if len(found) < ENOUGH:
        found += _mirrored(seen)
    if len(found) >= ENOUGH:
        return found, CLOSE
    return found + departures_scattered(seen.data, seen.ln), OF_PARABOLAS


def _scans(data: Readings) -> list[tuple[list[int], list[float]]]:
    """Rows in order and their angle [deg], over the reflected angle at one incidence, and over the incidence at one
    reflected angle; under each turn of the sample by itself."""
    keys = []
    turned = zip(data.angles, data.sights, turn_azimuths(data), strict=True)
    for (theta_i, phi_i, theta_r, phi_r), sight, turn in turned:
        phi = phi_r - phi_i + SAME_DEG
        upright = 1 - sight.pair.cos_i**2 < NORMAL**2
        plane = 0 if upright else round(phi % 180) % 180
        signed = theta_r if phi % 360 >= 179.5 else -theta_r
        keys.append(((turn, round(10 * theta_i), plane, signed), (turn, round(10 * signed), plane, theta_i)))
    out = []
    for way in (0, 1):
        groups = defaultdict(list)
        for row, each in enumerate(keys):
            groups[each[way][:3]].append((each[way][3], row))
        for key in sorted(groups, key=lambda each: (each[0], 1000 * each[1] + each[2])):
            members = groups[key]
            if len(members) >= FEWEST_OF_SCAN:
                members.sort(key=lambda member: member[0])
                out.append(([row for _, row in members], [angle for angle, _ in members]))
    return out


def _along(seen: ValuesAsRead, rows: list[int], angles: list[float]) -> list[list[Departure | None]]:
    """Each value beside the cubic through its four neighbours."""
    apart = [True, *(b - a > SAME_DEG for a, b in zip(angles, angles[1:], strict=False))]
    known = [(row, angle) for row, angle, keep in zip(rows, angles, apart, strict=True) if keep]
    out = []
    for first in range(len(known) - 4):
        five = known[first : first + 5]
        middle, beside = five[2], [*five[:2], *five[3:]]
        if beside[3][1] - beside[0][1] >= WIDEST_DEG or abs(middle[1]) >= STEEPEST_DEG:
            continue
        weights = _cubic(middle[1], [angle for _, angle in beside])
        size = sqrt(1 + fsum(w * w for w in weights))
        around = [row for row, _ in beside]
        out.append([_departure(seen, middle[0], around, weights, size, c) for c in range(len(seen.values[0]))])
    return out


def _cubic(at: float, angles: list[float]) -> list:
    """Weights of four values, of the cubic through them (Lagrange)."""
    weights = [mpf(1)] * 4
    for i, one in enumerate(angles):
        for other in (*angles[:i], *angles[i + 1 :]):
            weights[i] *= (mpf(at) - mpf(other)) / (mpf(one) - mpf(other))
    return weights


def _departure(seen: ValuesAsRead, row: int, around: list[int], weights: list, size, channel: int) -> Departure | None:
    here, values = seen.values[row][channel], [seen.values[each][channel] for each in around]
    if here is None or any(v is None for v in values):
        return None
    level = max(fsum(values) / 4, mpf(0))
    a, b, c, d = (float(v) for v in values)
    order = max((a + b + c + d) / 4, 0.0)
    in_ln = [seen.ln[each][channel] for each in (row, *around)]
    if any(v is None for v in in_ln):
        return Departure(order, level, (here - fsum(w * v for w, v in zip(weights, values, strict=True))) / size)
    ahead = in_ln[0] - fsum(w * v for w, v in zip(weights, in_ln[1:], strict=True))
    return Departure(order, level, ahead * level / size)


def _mirrored(seen: ValuesAsRead) -> list[list[Departure | None]]:
    """Half differences of values at +phi and -phi; of several directions alike the last on one side, the first on the
    other."""
    groups = defaultdict(list)
    for row, (theta_i, phi_i, theta_r, phi_r) in enumerate(seen.data.angles):
        phi = (phi_r - phi_i + 180) % 360 - 180
        groups[round(100 * theta_i), round(100 * theta_r), round(100 * abs(phi))].append((phi, row))
    out = []
    for _, members in sorted(groups.items()):
        members.sort(key=lambda member: member[0])
        for (before, other), (after, one) in zip(members, members[1:], strict=False):
            if before < -SAME_DEG and after > SAME_DEG:
                out.append([_half(seen, one, other, channel) for channel in range(len(seen.values[0]))])
    return out


def _half(seen: ValuesAsRead, one: int, other: int, channel: int) -> Departure | None:
    a, b = seen.values[one][channel], seen.values[other][channel]
    if a is None or b is None:
        return None
    level = max((a + b) / 2, mpf(0))
    ln_a, ln_b = seen.ln[one][channel], seen.ln[other][channel]
    apart = a - b if ln_a is None or ln_b is None else (ln_a - ln_b) * level
    return Departure(max(0.5 * (float(a) + float(b)), 0.0), level, apart / sqrt(2))
