"""What the report's simplifications of Fresnel's equations cost (section 5.1): n = 1.5, or a constant for metals."""

from functools import lru_cache

import numpy as np

from .fresnel import f0, fresnel, index_from_f0

ANGLES = np.arange(0.0, 86.0)  # degrees over which a cost is stated


@lru_cache(maxsize=256)
def constant_cost(n, k, highest: float = 85.0) -> tuple[float, float]:
    """(worst relative error, best constant) of a constant in place of F over 0..`highest` degrees."""
    f = fresnel(np.cos(np.radians(ANGLES[highest >= ANGLES])), n, k)
    low, high = float(f.min()), float(f.max())
    return ((high - low) / (high + low), 2 * low * high / (low + high)) if high else (0.0, 0.0)


@lru_cache(maxsize=256)
def index_cost(n: float, k: float = 0.0, guess: float = 1.5) -> float:
    """The largest relative error, with its sign, of F with `guess` in place of n + ik over 0..85 degrees."""
    cos_i = np.cos(np.radians(ANGLES))
    error = fresnel(cos_i, guess) / fresnel(cos_i, n, k) - 1
    return float(error[np.argmax(np.abs(error))])


@lru_cache(maxsize=256)
def equivalent_cost(n: float, k: float) -> tuple[float, float]:
    """(Eq. 2's equivalent real index of a metal, the angle [deg] up to which its F is within 5 % of the metal's)."""
    equivalent = float(index_from_f0(f0(n, k)))
    fine = np.arange(0.0, 90.0, 0.5)
    cos_i = np.cos(np.radians(fine))
    wrong = np.abs(fresnel(cos_i, equivalent) / fresnel(cos_i, n, k) - 1) > 0.05
    return equivalent, float(fine[np.argmax(wrong)]) if wrong.any() else 90.0
