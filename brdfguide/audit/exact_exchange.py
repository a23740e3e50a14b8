"""What directions that light and detector exchange say of the dark level, once more.

    value - exchanged value = d (1/cos θi - 1/cos θr) + noise

d is the weighted median over the pairs, found in three turns with the pairs' noise, and shrunk by its own error; what
pairs leave beyond a relative doubt is the dark level's doubt. Which direction is another's exchange is looked up in the
angles as they are: where two lie so near to it that digits of single precision decide, nothing is derived.
"""

from bisect import bisect_left, bisect_right
from math import cos, inf, log, radians, sin, sqrt
from random import Random

from mpmath import fsum, mpf
from mpmath import sqrt as root

from ..records import dataclass
from .exact_errors import Readings
from .exact_two_parts import Departure, relative_and_absolute

NEAR_DEG, EXACT_DEG = 3.0, 0.05  # of an exchange, and of one to the digits of files
ENOUGH, LEAST_PAIRS, LEAST_SHARE = 12, 20, 1 / 3  # pairs that say something; that tell a dark level; of those there are
LEAST_LN = 0.15  # |ln (cos θr/cos θi)| that could tell a cosine
STEEP = 0.3  # change of ln f over the distance of an exchange, beyond which it tells nothing
APART = 0.1  # of the inverse cosines
MOST, SEED = 1200, 0  # directions that are compared
IN_BIN, TURNS = 12, 3
WIDER = mpf("1.25")  # standard error of a median over that of a mean
FAINTEST = mpf("1e-30")  # 1/sr
SINGLE = 1e-6  # of a squared distance, what single precision leaves open


class Undecided(Exception):
    """Rounding decides which directions are exchanged."""


@dataclass(frozen=True, eq=False)
class DoubtOfExchange:
    """Of one channel [1/sr]; every doubt that is as good where rounding decided."""

    offset: mpf
    stderr: mpf
    doubt: list


def doubts_of_exchange(data: Readings, values: list[list], ln: list[list], needed: bool) -> list[DoubtOfExchange]:
    """By channel; zeros where too few directions are exchanged. `needed` where a dark level was told.

    Raises Undecided.
    """
    nothing = [DoubtOfExchange(mpf(0), mpf(0), [mpf(0)]) for _ in data.wavelengths]
    pairs = _pairs(data, ln)
    if pairs is None or not needed and len(pairs) < 3 * IN_BIN:  # of fewer no doubt follows
        return nothing
    across = [1 / data.sights[here].pair.cos_i - 1 / data.sights[there].pair.cos_i for here, there in pairs]
    found = [_of_channel([(values[a][c], values[b][c]) for a, b in pairs], across) for c in range(len(nothing))]
    telling = [c for c, each in enumerate(found) if each is not None]
    return [_between(telling, found, c) for c in range(len(found))] if telling else nothing


def _between(telling: list[int], found: list, channel: int) -> DoubtOfExchange:
    """Straight between the channels beside one that does not tell. Raises Undecided where their doubts are several."""
    if found[channel] is not None:
        return found[channel]
    place = bisect_left(telling, channel)
    low, high = telling[max(place - 1, 0)], telling[min(place, len(telling) - 1)]
    one, other = found[low], found[high]
    if max(len(one.doubt), len(other.doubt)) > 1:
        raise Undecided
    part = mpf(channel - low) / (high - low) if low < channel < high else mpf(0)

    def at(a, b):
        return (1 - part) * a + part * b

    return DoubtOfExchange(
        at(one.offset, other.offset), at(one.stderr, other.stderr), [at(one.doubt[0], other.doubt[0])]
    )


def _of_channel(pairs: list[tuple], across: list) -> DoubtOfExchange | None:
    """None for too few pairs, or where most have no value. Raises Undecided where rounding decides the dark level."""
    steep = [(one, other, each) for (one, other), each in zip(pairs, across, strict=True) if abs(each) > APART]
    known = [each for each in steep if each[0] is not None and each[1] is not None]
    if len(known) < max(LEAST_PAIRS, LEAST_SHARE * len(steep)):
        return None
    levels = [max((one + other) / 2, mpf(0)) for one, other, _ in known]
    orders = [max(0.5 * (float(one) + float(other)), 0.0) for one, other, _ in known]
    offset, weights = mpf(0), [mpf(1)]
    for _ in range(TURNS):
        left = _left(known, offset)
        noise = relative_and_absolute(list(map(Departure, orders, levels, left)), IN_BIN, shows=1.0)
        if len(noise) > 1:
            raise Undecided
        relative, absolute = noise[0] if noise else (mpf(1), mpf(0))
        sigmas = [root(2) * max(root((relative * level) ** 2 + absolute**2), FAINTEST) for level in levels]
        weights = [abs(each) / sigma for (_, _, each), sigma in zip(known, sigmas, strict=True)]
        offset = _weighted_median(
            [((one - other) / each, w) for (one, other, each), w in zip(known, weights, strict=True)]
        )
    stderr = WIDER / root(fsum(w * w for w in weights))
    doubt = [pair[1] for pair in relative_and_absolute(list(map(Departure, orders, levels, left)), IN_BIN)]
    shrunk = offset / (1 + (stderr / offset) ** 2) if offset else mpf(0)
    return DoubtOfExchange(shrunk, stderr, list(dict.fromkeys(doubt)) or [mpf(0)])


def _left(known: list[tuple], offset) -> list:
    return [(one - other - offset * each) / root(2) for one, other, each in known]


def _weighted_median(pairs: list[tuple]):
    pairs = sorted(pairs)
    half, so_far = fsum(weight for _, weight in pairs) / 2, mpf(0)
    for value, weight in pairs:
        so_far += weight
        if so_far >= half:
            return value
    return pairs[-1][0]


# --- which directions are exchanged ------------------------------------------------------------------


def _pairs(data: Readings, ln: list[list]) -> list[tuple[int, int]] | None:
    """Rows of each pair once; exact exchanges alone where enough could tell a cosine. Raises Undecided."""
    azimuths = {round(phi_i) for theta_i, phi_i, _, _ in data.angles if theta_i > 1}
    known = [row for row, each in enumerate(ln) if any(v is not None for v in each)]
    if len(known) < ENOUGH:
        return None
    if len(azimuths) > 1:  # a grain would count
        raise Undecided
    here = known if len(known) <= MOST else [known[n] for n in sorted(Random(SEED).sample(range(len(known)), MOST))]
    places = [_place(*each) for each in data.angles]
    among = _Among([(places[row], row) for row in known])
    near: list[tuple[int, int]] = []
    exact: list[tuple[int, int]] = []
    undecided = twice = False
    for row in here:
        theta_i, phi_i, theta_r, phi_r = data.angles[row]
        wanted = _place(theta_r, phi_r, theta_i, phi_i)
        alike = among.nearest(wanted)
        if not alike or alike[0][1] == row and len(alike) == 1:
            continue
        apart, there = alike[0]
        if apart < radians(EXACT_DEG):
            exact += [(row, there)] * (there != row)
            twice |= len(alike) > 1
            continue
        close = {_steady(ln, among, places, other, apart) for _, other in alike}
        undecided |= len(alike) > 1 and close != {False} or None in close
        if close == {True} and there != row:
            near.append((row, there))
    telling = sum(_ln_cosines(data, row) > LEAST_LN for row, _ in exact)
    chosen = exact if telling >= ENOUGH else exact + near
    if twice or undecided and telling < ENOUGH:
        raise Undecided
    if len(exact) + len(near) < ENOUGH:
        return None
    return sorted({(min(pair), max(pair)) for pair in chosen})


def _ln_cosines(data: Readings, row: int) -> float:
    theta_i, _, theta_r, _ = data.angles[row]
    return abs(log(cos(radians(theta_r)) / cos(radians(theta_i))))


def _place(theta_i: float, phi_i: float, theta_r: float, phi_r: float) -> tuple[float, ...]:
    """Five numbers of a pair of directions, the light in one plane and the sides of that plane alike."""
    i, r, phi = radians(theta_i), radians(theta_r), radians(phi_r - phi_i)
    return sin(i), cos(i), sin(r) * cos(phi), sin(r) * abs(sin(phi)), cos(r)


class _Among:
    """Places in order of their incidence, so that few are looked at."""

    def __init__(self, places: list[tuple[tuple[float, ...], int]]):
        self.places = sorted(places)
        self.sines = [place[0] for place, _ in self.places]

    def nearest(self, wanted: tuple[float, ...], but: int = -1) -> list[tuple[float, int]]:
        """Distance and row of the nearest within three degrees, and of those that single precision cannot tell from it;
        never that of `but`."""
        reach = 2 * sin(radians(NEAR_DEG) / 2)
        first, last = bisect_left(self.sines, wanted[0] - reach), bisect_right(self.sines, wanted[0] + reach)
        found = [(_squared(place, wanted), row) for place, row in self.places[first:last] if row != but]
        least = min(found, default=(inf, -1))[0]
        if least > reach**2:
            return []
        return [(sqrt(square), row) for square, row in sorted(found) if square <= least + SINGLE]


def _squared(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    return sum((a - b) ** 2 for a, b in zip(one, other, strict=True))


def _steady(ln: list[list], among: _Among, places: list, row: int, apart: float) -> bool | None:
    """Whether f changes little over the distance of an exchange, by the nearest neighbour; None where rounding decides
    which one that is."""
    beside = among.nearest(places[row], row)
    if not beside:
        return None
    said = set()
    for distance, other in beside:
        changes = [abs(a - b) for a, b in zip(ln[row], ln[other], strict=True) if a is not None and b is not None]
        said.add(float(max(changes, default=mpf(0))) * apart < STEEP * distance)
    return said.pop() if len(said) == 1 else None
