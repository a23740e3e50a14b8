"""Directions that lie in no scan beside those around them, once more: ln f less a parabola through the twelve nearest.

    departure = f̄ (ln f - Σ w ln f_k) / √(1 + Σ w²),   w the first row of (XᵀX + 1e-9)⁻¹ Xᵀ

X has 1, x, y, x², xy and y² of the twelve about the direction, in sin θr (cos φ, |sin φ|) over the farthest of them;
f̄ is their mean. Squared distances are told apart to nine decimals, and of places as near the first in the file counts.
"""

from collections import defaultdict
from math import ceil, floor

from mpmath import cos, exp, fdot, fsum, lu_solve, matrix, mpf, radians, sin, sqrt

from .exact_errors import Readings
from .exact_two_parts import Departure

ASKED, AROUND, FEWEST = 1000, 12, 20  # directions that are compared; neighbours of each; of one incidence
DECIMALS = 9  # of a squared distance
UNSURE = 1e-5  # of its last decimal, what doubles may lose of it
RIDGE, LEAST_REACH = mpf("1e-9"), mpf("1e-12")


class NearestUndecided(Exception):
    """Rounding decides which directions are the nearest."""


def departures_scattered(data: Readings, ln: list[list]) -> list[list[Departure | None]]:
    """By comparison and channel; none where no incidence has enough directions. Raises NearestUndecided."""
    groups = defaultdict(list)
    for row, ((theta_i, *_), each) in enumerate(zip(data.angles, ln, strict=True)):
        if any(v is not None for v in each):
            groups[round(10 * theta_i)].append(row)
    rows = [(row, members) for _, members in sorted(groups.items()) if len(members) >= FEWEST for row in members]
    places = {row: _place(*data.angles[row]) for row, _ in rows}
    rough = {row: (float(x), float(y)) for row, (x, y) in places.items()}
    asked = rows[:: ceil(len(data.angles) / ASKED)]
    return [_departure(row, _nearest(row, members, rough), places, ln) for row, members in asked]


def _place(theta_i: float, phi_i: float, theta_r: float, phi_r: float):
    phi = radians(mpf(phi_r) - mpf(phi_i))
    out = sin(radians(mpf(theta_r)))
    return out * cos(phi), out * abs(sin(phi))


def _departure(row: int, near: list[int], places: dict, ln: list[list]) -> list[Departure | None]:
    about = [(places[each][0] - places[row][0], places[each][1] - places[row][1]) for each in near]
    reach = max(max(sqrt(x * x + y * y) for x, y in about), LEAST_REACH)
    weights = _parabola([(x / reach, y / reach) for x, y in about])
    size = sqrt(1 + fsum(w * w for w in weights))
    out: list[Departure | None] = []
    for channel, here in enumerate(ln[row]):
        around = [ln[each][channel] for each in near]
        if here is None or any(v is None for v in around):
            out.append(None)
            continue
        level = fsum(map(exp, around)) / AROUND
        out.append(Departure(float(level), level, (here - fdot(zip(weights, around, strict=True))) / size * level))
    return out


def _nearest(row: int, members: list[int], places: dict[int, tuple[float, float]]) -> list[int]:
    """Raises NearestUndecided."""
    x, y = places[row]
    steps = [
        (10**DECIMALS * ((places[each][0] - x) ** 2 + (places[each][1] - y) ** 2), rank)
        for rank, each in enumerate(members)
        if each != row
    ]
    order = sorted(steps, key=lambda each: (round(each[0]), each[1]))
    last = round(order[AROUND - 1][0])
    for step, _ in steps:
        if abs(step - floor(step) - 0.5) < UNSURE and abs(step - last) < 1.5:
            raise NearestUndecided
    return sorted(members[rank] for _, rank in order[:AROUND])


def _parabola(about: list[tuple]) -> list:
    """Weights of twelve values in the value at the middle of the parabola closest to them."""
    design = [(mpf(1), x, y, x * x, x * y, y * y) for x, y in about]
    normal = matrix(6, 6)
    for i in range(6):
        for j in range(i + 1):
            normal[i, j] = normal[j, i] = fdot((each[i], each[j]) for each in design) + (RIDGE if i == j else 0)
    first = lu_solve(normal, matrix([1, 0, 0, 0, 0, 0]))
    return [fdot(zip(first, each, strict=True)) for each in design]
