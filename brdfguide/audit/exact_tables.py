"""Tables of a goniometer that were written beside an answer, of one channel and without grain or mirror, as a reader
interpolates them linearly in incidence, azimuth and polar angle.

Counted from the mirror direction the polar angles begin at a part of the lobe's half width and grow by a factor, up to
steps of five degrees; counted from the normal they are even, and so grow the azimuths from that of the mirror
direction. How many incidences there are says which of the levels a table has.
"""

from bisect import bisect_right
from collections.abc import Mapping
from functools import cached_property

from mpmath import atan2, cos, degrees, fabs, hypot, mpf, radians, sin

from ..records import dataclass
from .exact_judged import Judged
from .textbook import ExactDirections

ABOUT_MIRROR = {"astm", "csv", "fred", "tracepro", "zemax"}
ABOUT_NORMAL = {"lighttools", "speos", "speos-anisotropic"}
# steps of incidence and azimuth [deg], then first step as a part of the half width and growth, or the polar step [deg]
LEVELS = {
    True: ((10.0, 15.0, 0.25, 1.25), (5.0, 10.0, 0.12, 1.12), (2.5, 6.0, 0.06, 1.06), (1.25, 4.0, 0.05, 1.05)),
    False: ((10.0, 10.0, 5.0), (5.0, 6.0, 2.5), (2.5, 5.0, 1.5), (1.25, 4.0, 1.0)),
}
BESIDE_MIRROR, GROWTH, LEAST_AZIMUTH_DEG = 0.12, 1.2, 0.1  # about the normal: of azimuths, from the mirror's away
STEEPEST_DEG, WIDEST_DEG, FINEST_DEG = 89.5, 5.0, 0.02
WIDTH_AT_DEG, MOST_WIDTH_DEG, LEAST_STEP_DEG, STEPS = 30.0, 16.0, 1e-3, 60  # where and how a half width is looked for
NO_MIRROR = mpf("1e-6")  # of the light
ON_A_NODE = mpf("1e-12")  # of a step


@dataclass(frozen=True, eq=False)
class ExactTable:
    """Nodes [deg], and the surface at them, evaluated where it is read."""

    by: Judged
    about_mirror: bool
    nodes: tuple[list[float], list[float], list[float]]

    def __call__(self, pair: ExactDirections) -> list:
        """As it is read, by colour [1/sr]."""
        places = [_cell(x, nodes) for x, nodes in zip(self._angles(pair), self.nodes, strict=True)]
        total = mpf(0)
        for corner in range(8):
            ends = [corner >> place & 1 for place in range(3)]
            weight = mpf(1)
            for end, (_, share) in zip(ends, places, strict=True):
                weight *= share if end else 1 - share
            if weight > ON_A_NODE:
                total += weight * self._at(tuple(low + end for end, (low, _) in zip(ends, places, strict=True)))
        return [total] * 3

    def _angles(self, pair: ExactDirections) -> tuple:
        phi = pair.phi_r - pair.phi_i
        i, r = pair.theta_i, pair.theta_r
        x, y, z = sin(r) * cos(phi), fabs(sin(r) * sin(phi)), cos(r)
        if not self.about_mirror:
            return degrees(i), degrees(atan2(y, x)) if r else mpf(0), degrees(r)
        toward, along = x * cos(i) + z * sin(i), z * cos(i) - x * sin(i)
        return degrees(i), degrees(atan2(y, toward)), degrees(atan2(hypot(toward, y), along))

    @cached_property
    def _known(self) -> dict:
        return {}

    def _at(self, numbers: tuple[int, ...]):
        """The surface at a node; below the horizon its value there goes on."""
        if numbers not in self._known:
            light, azimuth, polar = (nodes[each] for nodes, each in zip(self.nodes, numbers, strict=True))
            theta_r, phi = polar, azimuth
            if self.about_mirror:
                i, a, p = (radians(mpf(each)) for each in (light, azimuth, polar))
                x = cos(i) * sin(p) * cos(a) - sin(i) * cos(p)
                z = sin(i) * sin(p) * cos(a) + cos(i) * cos(p)
                y = sin(p) * sin(a)
                theta_r, phi = degrees(atan2(hypot(x, y), z)), degrees(atan2(y, x))
            pair = ExactDirections(light, 0.0, min(theta_r, STEEPEST_DEG), phi)
            self._known[numbers] = self.by.itself(pair)[0]
        return self._known[numbers]


def table_of_target(target: str, written: Mapping, by: Judged) -> ExactTable | None:
    """The table with so many incidences; None of a target, a size, a grain or a mirror that has none here."""
    about_mirror = target in ABOUT_MIRROR
    grained = any("axis" in dict(part.keys) for part in by.surface.parts)
    if not about_mirror and target not in ABOUT_NORMAL or len(by.data.wavelengths) > 1 or grained:
        return None
    if max(by.mirror(ExactDirections(80.0, 0.0, 80.0, 180.0))) > NO_MIRROR:
        return None
    for level in LEVELS[about_mirror]:
        incidences = sorted({*_even(86.0, level[0]), 85.0 if level[0] > 5 else STEEPEST_DEG - 1})
        if len(incidences) == written.get("theta_i"):
            width = _half_width(by)
            if about_mirror:
                azimuths, polar = _even(180.0 + level[1] / 2, level[1]), _about_mirror(width, *level[2:])
            else:
                azimuths, polar = _beside_mirror(width, level[1]), [*_even(89.0, level[2]), STEEPEST_DEG]
            return ExactTable(by, about_mirror, (incidences, azimuths, polar))
    return None


def _even(end: float, step: float) -> list[float]:
    count = -int(-end // step)
    return [number * step for number in range(count)]


def _beside_mirror(width: float, widest: float) -> list[float]:
    away = _growing(min(max(BESIDE_MIRROR * width, LEAST_AZIMUTH_DEG), widest), GROWTH, widest, 180.0)
    return [0.0, *(round(1000 * (180 - each)) / 1000 for each in reversed(away[:-1]))]


def _about_mirror(width: float, part: float, growth: float) -> list[float]:
    first = min(max(part * width, FINEST_DEG), WIDEST_DEG)
    return [round(each * 1000) / 1000 for each in _growing(first, growth, WIDEST_DEG, 90 + STEEPEST_DEG)]


def _growing(first: float, growth: float, widest: float, end: float) -> list[float]:
    nodes = [0.0, first]
    while nodes[-1] < end:
        nodes.append(nodes[-1] + min((nodes[-1] - nodes[-2]) * growth, widest))
    return nodes


def _half_width(by: Judged) -> float:
    """Degrees from the mirror direction at which the surface falls to half of its value there."""

    def at(step: float):
        return by.itself(ExactDirections(WIDTH_AT_DEG, 0.0, WIDTH_AT_DEG + step, 180.0))[0]

    peak, ratio = at(0.0), MOST_WIDTH_DEG / LEAST_STEP_DEG
    steps = (LEAST_STEP_DEG * ratio ** (number / (STEPS - 1)) for number in range(STEPS))
    return next((step for step in steps if at(step) < peak / 2), MOST_WIDTH_DEG)


def _cell(x, nodes: list[float]) -> tuple[int, mpf]:
    """The node below, and how far beyond it, as a share of the step; at the ends the last there is."""
    low = min(max(bisect_right(nodes, float(x)) - 1, 0), len(nodes) - 2)
    share = (x - nodes[low]) / (mpf(nodes[low + 1]) - nodes[low])
    return low, min(max(share, mpf(0)), mpf(1))
