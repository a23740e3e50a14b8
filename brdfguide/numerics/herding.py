"""A few points that stand for many: their mean of every smooth function is that over a measure.

    E(S) = mean_SS k - 2 mean_S μ + ∫∫ k,   μ(x) = ∫ k(x, y) dw(y),   k a kernel

is the squared distance between a mean over the points S and the integral, the worst over functions of norm 1 in the
kernel's space. Points come in groups that are taken whole. (Chen, Welling and Smola 2010, "Super-samples from kernel
herding"; by exchange, as Mak and Joseph 2018, "Support points".)
"""

import numpy as np

from ..records import dataclass

MOST_SWEEPS = 8


@dataclass(frozen=True, eq=False)
class Groups:
    """Groups of points, by sums of a kernel over them."""

    between: np.ndarray  # (groups, groups) of Σ_a Σ_b k
    toward: np.ndarray  # (groups,) of Σ_a μ
    sizes: np.ndarray  # (groups,) points of each
    whole: float  # ∫∫ k

    @classmethod
    def of_points(cls, kernel, weights, groups) -> "Groups":
        """From a kernel (points, points) and weights (points,) that add up to 1; groups as row numbers."""
        inside = np.zeros((len(groups), len(weights)))
        for number, rows in enumerate(groups):
            np.add.at(inside[number], rows, 1.0)
        toward = kernel @ weights
        return cls(
            between=inside @ kernel @ inside.T,
            toward=inside @ toward,
            sizes=inside.sum(axis=1),
            whole=float(weights @ toward),
        )

    def distance(self, picked) -> float:
        """E of the union of some groups."""
        picked = np.asarray(picked, int)
        size = self.sizes[picked].sum()
        inner = self.between[np.ix_(picked, picked)].sum()
        return float(inner / size**2 - 2 * self.toward[picked].sum() / size + self.whole)

    def across(self, picked) -> np.ndarray:
        """(groups,): `between` summed over some groups."""
        return self.between[:, np.asarray(picked, int)].sum(axis=1)

    def with_each(self, picked, across=None) -> np.ndarray:
        """(groups,): E of the union with one more, for each; `across` where that sum is known."""
        picked = np.asarray(picked, int)
        across = self.across(picked) if across is None else across
        size = self.sizes[picked].sum() + self.sizes
        inner = across[picked].sum() + 2 * across + np.diag(self.between)
        return inner / size**2 - 2 * (self.toward[picked].sum() + self.toward) / size + self.whole


def representatives(groups: Groups, count: int, allowed, near, fixed=(), one_of=None) -> list[int]:
    """Groups that together with the `fixed` ones come closest to the measure, best first.

    Takes  how many to pick of those `allowed`, a mask (groups,); `near` (groups, groups), which of them are too near to
    each other; `one_of`, a mask (groups,) of those of which one at least is picked.    Gives  their numbers: each the
    best beside those before it, then exchanged one by one while that helps, then put in order anew.
    """
    masks = [allowed] * count
    if one_of is not None:
        masks = [one_of, *masks[1:]]
    picked = _greedy(groups, masks, near, list(fixed))
    across, crowd = groups.across([*fixed, *picked]), near[:, picked].sum(axis=1)
    for _ in range(MOST_SWEEPS):
        changed = False
        for place, old in enumerate(picked):
            rest = [*fixed, *picked[:place], *picked[place + 1 :]]
            free = masks[place] & (crowd == near[:, old])
            error = np.where(free, groups.with_each(rest, across - groups.between[:, old]), np.inf)
            best = int(np.argmin(error))
            if error[best] < error[old] * (1 - 1e-9) - 1e-15:
                picked[place], changed = best, True
                across, crowd = groups.across([*fixed, *picked]), near[:, picked].sum(axis=1)
        if not changed:
            break
    return _greedy(groups, [np.isin(np.arange(len(allowed)), picked)] * count, near, list(fixed))


def _free(allowed, near, taken) -> np.ndarray:
    return allowed & ~np.any(near[:, taken], axis=1)


def _greedy(groups: Groups, masks: list, near, fixed: list[int]) -> list[int]:
    picked: list[int] = []
    for mask in masks:
        free = _free(mask, near, picked)
        if not free.any():
            break
        error = np.where(free, groups.with_each([*fixed, *picked]), np.inf)
        picked.append(int(np.argmin(error)))
    return picked
