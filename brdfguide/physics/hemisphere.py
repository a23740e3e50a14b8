"""What a surface sends into the whole hemisphere, for light from one direction.

    dhr(θi) = ∫ f cos θr dω = 2 ∫ sin γ dγ ∫ f cos θr dψ,   cos θr = cos γ cos θi + sin γ sin θi cos ψ > 0

γ is the angle from the mirror direction, ψ turns about it from the plane of incidence. The nodes of γ are even in its
logarithm and those of ψ crowd like double exponentials (Takahasi and Mori 1974), at the mirror direction, at the plane
of incidence, at the horizon, toward the light and at 90° from the mirror, so that a lobe of 0.01° and a law that runs
off at grazing are found without being looked for.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial
from itertools import pairwise
from math import pi

import numpy as np

from .geometry import Directions, Geometry

STEP = 1 / 12  # between nodes of ψ's variable; halving it moves no law of ours by more than 1e-4
REACH = 3.6  # of that variable: nodes come to within 1e-24 of an end
FINENESS = 0.3  # between nodes of ln γ, for STEP = 1/12
DEPTH = 21.0  # how far ln γ goes down from the end of a panel: to 1e-9 of it


def dhr(brdf: Callable[[Geometry], np.ndarray], theta_i_deg, step: float = STEP, streaks: bool = False) -> np.ndarray:
    """Directional-hemispherical reflectance of the finite part of a surface.

    Takes  brdf(geom) giving (samples, channels) [1/sr], theta_i_deg (angles) in 0 <= θ < 90; `streaks` has nodes for
    lobes that are eight times as long as wide, along the plane of incidence and across it.    Gives  (angles,
    channels).    Symmetric about the plane of incidence: isotropic laws, and a grain along it or across it;
    `dhr_under_turns` for others.
    """
    nodes = (hemisphere_directions(float(theta), step, streaks) for theta in np.ravel(theta_i_deg))
    return np.stack([weights @ brdf(geom) for geom, weights in nodes])


def dhr_under_turns(brdf, theta_i_deg, turns_deg, step: float = STEP) -> np.ndarray:
    """The same of a surface with a grain that lies anyhow, for each azimuth of the light: both sides of the plane of
    incidence are summed.

    Takes  turns_deg (turns,).    Gives  (turns, angles, channels).
    """

    def both_sides(geom: Geometry, turn: float) -> np.ndarray:
        other = Geometry(replace(geom.directions, phi_deg=-geom.phi_deg), geom.wavelength)
        return 0.5 * (brdf(geom.at_azimuth(turn)) + brdf(other.at_azimuth(turn)))

    whole = (partial(both_sides, turn=float(turn)) for turn in np.ravel(turns_deg))
    return np.stack([dhr(each, theta_i_deg, step, streaks=True) for each in whole])


@lru_cache(maxsize=32)
def hemisphere_directions(theta_i_deg: float, step: float = STEP, streaks: bool = False):
    """Directions (samples, 1) over half the hemisphere, and weights (samples,) that hold 2 cos θr dω."""
    theta = np.radians(theta_i_deg)
    horizon = np.radians(90 - theta_i_deg)
    sin, cos = np.cos(horizon), np.sin(horizon)
    if theta_i_deg < 45:
        sin, cos = np.sin(theta), np.cos(theta)
    ends = sorted({0.0, horizon, 2 * theta, pi / 2, pi / 2 + theta})
    gamma, weight = (
        np.concatenate(parts) for parts in zip(*(_logarithmic(a, b, step) for a, b in pairwise(ends)), strict=True)
    )
    opens = np.full_like(gamma, pi)
    cut = gamma > horizon
    opens[cut] = np.arccos(np.clip(-cos / (np.tan(gamma[cut]) * sin), -1, 1))
    share, of_share = _double_exponential(step)
    if streaks:  # ψ = 90° is an end as well
        share, of_share = np.concatenate([0.5 * share, 0.5 + 0.5 * share]), np.tile(0.5 * of_share, 2)
    psi = opens[:, None] * share
    gamma, weight = np.broadcast_to(gamma[:, None], psi.shape), weight[:, None] * opens[:, None] * of_share
    # what the direction differs from the mirror direction (-sin, 0, cos), exact where it is small
    along = -2 * np.sin(gamma / 2) ** 2
    toward, aside = np.sin(gamma) * np.cos(psi), np.sin(gamma) * np.sin(psi)
    dx, dz = -sin * along + cos * toward, cos * along + sin * toward
    cos_r = cos + dz
    up = cos_r > 0
    dx, dy, dz, cos_r, weight = (a[up] for a in (dx, aside, dz, cos_r, weight * np.sin(gamma)))
    x, y = dx - sin, dy

    def column(a):
        return np.broadcast_to(a, x.shape)[:, None]

    geom = Directions(
        column(cos), column(sin), column(cos_r), column(np.hypot(x, y)), column(dx * dx + dy * dy), column(sin * x),
        column(-dz), column(0.0), column(np.degrees(np.arctan2(y, x))),
    )  # fmt: skip
    return Geometry(geom), 2 * weight * cos_r


def _logarithmic(a: float, b: float, step: float):
    """Nodes and weights on a..b, even in the logarithm of the distance from the nearer end."""
    step = FINENESS * step / STEP
    t = np.arange(-DEPTH, DEPTH + step / 2, step)
    near = 1 / (1 + np.exp(np.abs(t)))  # distance from the nearer end, of the whole
    return np.where(t < 0, a + (b - a) * near, b - (b - a) * near), (b - a) * step * near * (1 - near)


def _double_exponential(step: float):
    """Nodes and weights on 0..1."""
    t = np.arange(-REACH, REACH + step / 2, step)
    near = 1 / (1 + np.exp(pi * np.sinh(np.abs(t))))
    return np.where(t < 0, near, 1 - near), step * pi * np.cosh(t) * near * (1 - near)
