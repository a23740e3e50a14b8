"""Where laws are tried, and how far they were missed at worst.

Values come from the whole box of a model's parameters, directions from the whole hemisphere, half of them crowded
toward the mirror direction and toward grazing. Seeds are fixed.
"""

from dataclasses import field

import numpy as np

from ..models import Model
from ..physics.geometry import Geometry, in_plane, rows
from ..records import dataclass

# a scan in the plane of incidence, as instruments make it: every 5°, and closer about the mirror direction
BESIDE = np.concatenate([-np.geomspace(0.02, 10, 10), np.geomspace(0.02, 10, 10)])
SCAN = rows(
    in_plane(
        np.repeat([10.0, 45, 60, 75], 55),
        np.concatenate([np.concatenate([np.arange(-85.0, 86, 5), t + BESIDE]) for t in (10, 45, 60, 75)]),
    )
)
# the same along the grain, across it and between
TURNED_SCAN = rows(
    Geometry.from_degrees(
        *(
            np.broadcast_to(each, (3, len(SCAN))).ravel()
            for each in (
                SCAN.theta_i_deg[:, 0],
                np.array([[0.0], [45.0], [90.0]]),
                SCAN.theta_r_deg[:, 0],
                np.array([[0.0], [45.0], [90.0]]) + SCAN.phi_deg[:, 0],
            )
        )
    )
)


@dataclass(frozen=True)
class Outcome:
    """How often a law was tried, how far it was missed at worst, and there: angles [deg] and parameters."""

    cases: int
    worst: float
    at: dict = field(default_factory=dict)


class Worst:
    """Keeps the largest error and where it was."""

    def __init__(self):
        self.cases, self.error, self.at = 0, 0.0, {}

    def see(self, errors, geom: Geometry | None = None, values=None, **more) -> None:
        """Errors over the directions of `geom`; one that is not a number is infinitely wrong."""
        errors = np.abs(np.atleast_1d(np.asarray(errors, float)))
        errors = np.where(np.isfinite(errors), errors, np.inf)
        self.cases += errors.size
        if errors.size and errors.max() > self.error:
            self.error = float(errors.max())
            self.at = {
                **where(geom, int(np.argmax(errors.reshape(errors.shape[0], -1).max(1)))),
                **six_digits(values or {}),
                **more,
            }

    def outcome(self) -> Outcome:
        return Outcome(self.cases, self.error, self.at)


def where(geom: Geometry | None, row: int) -> dict:
    if geom is None:
        return {}

    def at(a):
        return float(np.ravel(np.broadcast_to(a, geom.shape))[row])

    return {
        "theta_i_deg": at(geom.theta_i_deg),
        "theta_r_deg": at(geom.theta_r_deg),
        "phi_deg": round(at(np.remainder(geom.phi_deg, 360)), 6),
    }


def six_digits(values) -> dict:
    return {name: float(f"{value:.6g}") for name, value in values.items() if np.ndim(value) == 0}


def within(p, share):
    """The value at `share` 0..1 of a parameter's range, even in its logarithm if that is how it is fitted."""
    if not p.log:
        return p.low + share * (p.high - p.low)
    low, high = np.log(p.low - p.origin), np.log(p.high - p.origin)
    return np.clip(p.origin + np.exp(low + share * (high - low)), p.low, p.high)


def parameter_sets(term: Model, seed: int, count: int = 10, amplitude: float = 1.0):
    """The defaults, both corners of the box, `count` points in it; the amplitude as told, or at its bound below it."""
    rng = np.random.default_rng(seed)
    if not term.parameters:  # a surface with its values already in it
        yield {}
        return
    for values in (
        term.defaults(),
        {p.name: p.low for p in term.parameters},
        {p.name: p.high for p in term.parameters},
        *({p.name: within(p, rng.uniform()) for p in term.parameters} for _ in range(count)),
    ):
        yield {**values, **{p.name: min(p.high, amplitude) for p in term.parameters if p.linear}}


def trial_directions(seed: int, count: int = 400, highest: float = 89.9999) -> Geometry:
    """Random pairs as rows; half of either kind near the mirror direction or near grazing."""
    rng = np.random.default_rng(seed)

    def half(a, b):
        return np.where(rng.uniform(size=count) < 0.5, a, b)

    theta_i = half(rng.uniform(0, 90, count), 90 - 10 ** rng.uniform(-4, 1.5, count))
    theta_r = half(rng.uniform(0, 90, count), theta_i + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count))
    phi = half(rng.uniform(0, 360, count), 180 + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count))

    def fold(a):
        return np.clip(np.abs(a), 0, highest)

    return rows(Geometry.from_degrees(fold(theta_i), 0.0, fold(theta_r), phi))
