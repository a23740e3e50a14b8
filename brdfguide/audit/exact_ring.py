"""How different two surfaces look, once more: S of one channel in the plane of incidence."""

from collections import Counter, defaultdict
from functools import cached_property

from mpmath import cbrt, exp, fsum, mpf, pi, radians, sin, sqrt

from ..records import dataclass
from .exact_errors import LARGEST, Readings, held_numbers
from .exact_surface import ExactSurface

LIMIT_DEG = 80  # beyond, S does not look


@dataclass(frozen=True, eq=False)
class Ring:
    """S of grey scans in the plane of incidence: rows that count, their weights, and how bright each looks [L*]."""

    data: Readings

    @cached_property
    def rows(self) -> list[int]:
        return [
            place
            for place, (angles, row) in enumerate(zip(self.data.angles, self.data.values, strict=True))
            if max(angles[0], angles[2]) <= LIMIT_DEG + 1e-7 and abs(row[0]) < LARGEST
        ]

    @cached_property
    def weights(self) -> list:
        """cos θi cos θr max(sin min(|r - i|, 90°), sin(step/4)) step over the readings that share an angle."""
        light = [self.data.angles[place][0] for place in self.rows]
        view = [self.data.signed_theta_r[place] for place in self.rows]
        steps = self._steps(light, view)
        out = []
        for place, i, r, (step, alike) in zip(self.rows, light, view, steps, strict=True):
            pair = self.data.sights[place].pair
            ring = max(sin(radians(min(abs(mpf(r) - mpf(i)), mpf(90)))), sin(step / 4))
            out.append(pair.cos_i * pair.cos_r * ring * step / alike)
        return out

    def _steps(self, light, view) -> list:
        held, moved = held_numbers(light), view
        sizes = sorted(Counter(held).values())
        if sizes[len(sizes) // 2] < 3 and max(held_numbers(view)) < max(held):
            held, moved = held_numbers(view), light
        scans = defaultdict(list)
        for rank, place in enumerate(self.rows):
            scans[held[rank], round(self.data.angles[place][1] % 360) % 360].append(rank)
        out: list = [None] * len(self.rows)
        for members in scans.values():
            alike = Counter(moved[rank] for rank in members)
            angles = sorted(alike)
            for rank in members:
                out[rank] = _gradient(angles, angles.index(moved[rank])), alike[moved[rank]]
        return out

    def lightness(self, row_residuals: list[list] | None, surface: ExactSurface | None = None) -> list:
        """116 ∛(π f cos θi) of the data, or of a model by its residuals, by the model itself where nothing is told."""
        out = []
        for place in self.rows:
            value = mpf(self.data.values[place][0])
            sight = self.data.sights[place]
            if row_residuals is not None and row_residuals[place][0] is not None:
                value *= exp(min(row_residuals[place][0], mpf(300)))
            elif surface is not None:
                value = sight.reading(surface, 0, self.data.wavelengths[0])
            out.append(116 * cbrt(max(value, mpf(0)) * pi * sight.pair.cos_i))
        return out

    def apart(self, one: list, other: list) -> mpf:
        """S [L*] of two lightnesses."""
        squares = (w * (a - b) ** 2 for w, a, b in zip(self.weights, one, other, strict=True))
        return sqrt(fsum(squares) / fsum(self.weights))


def _gradient(angles: list[float], place: int):
    """[rad] between neighbours: half of the two steps beside it, the one step at an end; 1 where it stands alone."""
    if len(angles) == 1:
        return mpf(1)
    before, after = max(place - 1, 0), min(place + 1, len(angles) - 1)
    return radians(mpf(angles[after]) - mpf(angles[before])) / (after - before)
