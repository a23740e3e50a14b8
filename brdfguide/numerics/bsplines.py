"""Cubic B-splines on clamped uniform knots over 0..1, and how far a row of their coefficients is bent."""

import numpy as np

ORDER = 4  # cubic: so many of them are not 0 at a place


def cubic(x, count: int) -> np.ndarray:
    """The values of `count` cubic B-splines, which add up to 1.

    Takes  x (...) in 0..1, beyond which it counts as the end.    Gives  (N, count) of its N values in a row.
    Source: the recurrence of Cox and de Boor, as Piegl and Tiller's algorithm A2.2 has it.
    """
    x = np.clip(np.ravel(x), 0.0, 1.0)
    spans = count - ORDER + 1
    span = np.minimum((x * spans).astype(int), spans - 1)
    knots = np.concatenate([np.zeros(ORDER - 1), np.linspace(0, 1, spans + 1), np.ones(ORDER - 1)])
    last = span + ORDER - 1
    values = [np.ones_like(x)]
    for degree in range(1, ORDER):
        carried, raised = np.zeros_like(x), []
        for place, value in enumerate(values):
            right = knots[last + place + 1] - x
            left = x - knots[last + 1 - (degree - place)]
            part = value / (right + left)
            raised.append(carried + right * part)
            carried = left * part
        values = [*raised, carried]
    found = np.zeros((len(x), count))
    np.put_along_axis(found, span[:, None] + np.arange(ORDER), np.stack(values, axis=1), axis=1)
    return found


def bends(count: int) -> np.ndarray:
    """Second differences of `count` coefficients, (count - 2, count)."""
    return np.diff(np.eye(count), 2, axis=0)
