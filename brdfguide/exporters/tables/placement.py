"""Where the nodes of a table go, so that linear interpolation between them costs no more than a tolerance everywhere.

A straight line over a step h misses a smooth S by at most h² |S''| / 8, so nodes of one error per interval lie with the
density √(|S''| / 8 e S), and their number is its integral (de Boor 1973, "Good approximation by splines with variable
knots"). Incidences are taken one by one instead, each as far from the last as the error allows.
"""

import numpy as np

from ...records import dataclass

GROWTH = 0.08  # of a step, per step: a straight line in s is one in u only where steps are alike


@dataclass(frozen=True, eq=False)
class Warp:
    """s = C(u), C the integral of a density that is linear between its nodes on 0..1, scaled to C(1) = 1."""

    density: np.ndarray  # (nodes,)

    @property
    def _integral(self) -> np.ndarray:
        steps = 0.5 * (self.density[1:] + self.density[:-1])
        return np.concatenate(([0.0], np.cumsum(steps) / np.sum(steps)))

    def at(self, u: np.ndarray) -> np.ndarray:
        """The density at u."""
        return np.interp(u, np.linspace(0, 1, len(self.density)), self.density)

    def to(self, u: np.ndarray) -> np.ndarray:
        """s of u."""
        d, c = self.density, self._integral
        x = np.clip(u, 0.0, 1.0) * (len(d) - 1)
        cell = np.minimum(x.astype(int), len(d) - 2)
        t = x - cell
        part = t * (d[cell] + 0.5 * t * (d[cell + 1] - d[cell]))
        return c[cell] + (c[cell + 1] - c[cell]) * part / (0.5 * (d[cell] + d[cell + 1]))

    def back(self, s: np.ndarray) -> np.ndarray:
        """u of s."""
        d, c = self.density, self._integral
        cell = np.clip(np.searchsorted(c, s, side="right") - 1, 0, len(d) - 2)
        area = (s - c[cell]) / (c[cell + 1] - c[cell]) * 0.5 * (d[cell] + d[cell + 1])
        t = 2 * area / (d[cell] + np.sqrt(np.maximum(d[cell] ** 2 + 2 * area * (d[cell + 1] - d[cell]), 0.0)))
        return np.clip((cell + t) / (len(d) - 1), 0.0, 1.0)


def density(values: np.ndarray, counted: np.ndarray, tolerance: float, nodes: int, least: float) -> np.ndarray:
    """Nodes of a table per unit of u wanted at `nodes` places in 0..1; values (u, samples) evenly over u, NaN-free.

    The greatest of all samples; where one of three neighbours does not count there is no slope to know.
    """
    steps = len(values) - 1
    bend = np.abs(values[2:] - 2 * values[1:-1] + values[:-2]) * steps**2
    known = counted[2:] & counted[1:-1] & counted[:-2]
    wanted = np.sqrt(np.where(known, bend / (8 * tolerance * np.where(known, values[1:-1], 1.0)), 0.0).max(axis=1))
    wanted = np.concatenate((wanted[:1], wanted, wanted[-1:]))
    # the greatest within each coarse cell and its neighbours
    place = np.minimum((np.arange(steps + 1) * (nodes - 1)) // steps, nodes - 2)
    cells = np.zeros(nodes - 1)
    np.maximum.at(cells, place, wanted)
    beside = np.concatenate(([0.0], cells, [0.0]))
    step = 1 / np.maximum(np.maximum(beside[1:], beside[:-1]), least)
    for one_way in (step, step[::-1]):  # in place
        for k in range(1, nodes):
            one_way[k] = min(one_way[k], one_way[k - 1] + GROWTH / (nodes - 1))
    return 1 / step


def march(x: np.ndarray, values: np.ndarray, allowed: np.ndarray, longest: np.ndarray) -> list[int]:
    """Places in x (n,) between which values (n, samples) are straight within `allowed`, first and last among them;
    `longest` (n,) from each."""
    chosen = [0]
    while chosen[-1] < len(x) - 1:
        a = b = chosen[-1]
        b += 1
        while b + 1 < len(x) and x[b + 1] - x[a] <= longest[a]:
            t = ((x[a + 1 : b + 1] - x[a]) / (x[b + 1] - x[a]))[:, None]
            off = np.abs((1 - t) * values[a] + t * values[b + 1] - values[a + 1 : b + 1])
            if np.any(off > allowed[a + 1 : b + 1]):
                break
            b += 1
        chosen.append(b)
    return chosen
