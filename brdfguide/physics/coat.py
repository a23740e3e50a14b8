"""A clear coat: where light goes inside it, what gets through its surface, and what comes back from below.

    sin θ' = sin θ/n, azimuths stay        gate T(θi) T(θr)/n²        K = 1 - (1 - F̄)/n²

n² since radiance is compressed on entering and expanded on leaving; without it every coated surface is 2.25 times too
bright for n = 1.5. K is the share of diffuse light from below that the coat's surface sends down again.

Source: Fresnel; Saunderson 1942.
"""

from functools import cached_property, lru_cache

import numpy as np

from ..records import dataclass
from . import fresnel
from .directions import Directions
from .geometry import Geometry

KEPT = 3  # an index and those on either side of it


@dataclass(frozen=True, eq=False)
class Inside:
    """Directions as they are under a coat, and what gets there and back."""

    directions: Directions
    gate: np.ndarray  # T(θi) T(θr)/n²

    @cached_property
    def path(self):
        """1/cos θi' + 1/cos θr': the way through the coat and back, in its thickness."""
        return 1 / self.directions.cos_i + 1 / self.directions.cos_r


def _refracted(outside: Directions, n) -> Inside:
    """Each component without a difference of near numbers; T without 1 - F."""
    square = (n - 1) * (n + 1)
    square_i, square_r = square + outside.cos2_i, square + outside.cos2_r
    q_i, q_r = np.sqrt(square_i), np.sqrt(square_r)
    cos_i, cos_r = q_i / n, q_r / n
    share = outside.v_z / (n * n * (cos_i + cos_r))  # cos θi' - cos θr' over cos θi - cos θr
    shape = np.shape(cos_i)
    inside = Directions(
        cos_i=cos_i,
        sin_i=outside.sin_i / n,
        cos_r=cos_r,
        sin_r=outside.sin_r / n,
        vxy2=outside.vxy2 / (n * n),
        dot_xy=outside.dot_xy / (n * n),
        cos_difference=outside.cos_difference * share,
        phi_i_deg=np.broadcast_to(outside.phi_i_deg, shape),
        phi_deg=np.broadcast_to(outside.phi_deg, shape),
    )
    if np.all(square > 0):
        sine2_i, sine2_r = outside.formed(_sines)
        through_i = _through(outside.cos_i, outside.cos2_i, sine2_i, square_i, q_i)
        through_r = _through(outside.cos_r, outside.cos2_r, sine2_r, square_r, q_r)
    else:
        through_i, through_r = (fresnel.one_minus_fresnel(cos, n) for cos in (outside.cos_i, outside.cos_r))
    return Inside(inside, through_i * through_r / (n * n))


def _sines(outside: Directions):
    """sin² and its square, of the light and of the detector."""
    return [(s2, s2 * s2) for s2 in ((1 - cos) * (1 + cos) for cos in (outside.cos_i, outside.cos_r))]


def _through(c, c2, sine2, q2, q):
    """`fresnel.one_minus_fresnel` of a clear coat, to the last digit, from what is known: q = n cos θ'."""
    s2, s4 = sine2
    rise = q * c
    rise += rise
    total = q2 + c2
    total += rise
    share = q2 * c2
    share += s4
    all_of_it = rise * s2
    all_of_it += share
    share += share
    share /= total
    share += s2
    share *= rise
    share /= all_of_it
    return np.minimum(share, 1.0)


class _Lately:
    """The Insides of the last few indices, kept with the directions: the terms of a sum ask for the same one, and so do
    the differences on either side of it.
    """

    def __init__(self, _: Directions):
        self.kept: dict[tuple, Inside] = {}

    def under(self, outside: Directions, n) -> Inside:
        key = np.shape(n), np.asarray(n, float).tobytes()
        inside = self.kept.get(key)
        if inside is None:
            inside = _refracted(outside, n)
            self.kept = dict([*self.kept.items(), (key, inside)][-KEPT:])
        return inside


def under(geom: Geometry, n) -> tuple[Inside, Geometry]:
    """What lies under a coat of index n, a number or one for each channel; and with the shorter wavelength there."""
    inside = geom.formed(_Lately).under(geom.directions, n if np.ndim(n) else float(n))
    return inside, Geometry(inside.directions, geom.wavelength / n)


def returned(n):
    """K; 0 without a coat. Takes  n >= 1 (...)."""
    return _returned(np.asarray(n, float)) if np.ndim(n) else _returned_once(float(n))


def _returned(n):
    return ((n - 1) * (n + 1) + fresnel.mean_fresnel(n)) / (n * n)


_returned_once = lru_cache(maxsize=16)(_returned)  # a coat's index is mostly held


def seen_albedo(albedo, n):
    """Share of light at normal incidence that a Lambertian body of some albedo sends back through a coat.

    (1 - F0)(1 - K) rho/(1 - rho K): 0.5 under n = 1.5 looks like 0.276.
    """
    k = returned(n)
    return (1 - fresnel.f0(n)) * (1 - k) * albedo / (1 - albedo * k)


def dry_albedo(seen, n):
    """The albedo of a Lambertian body that sends back the share `seen` through a coat; the inverse of `seen_albedo`."""
    k = returned(n)
    return seen / (seen * k + (1 - fresnel.f0(n)) * (1 - k))
