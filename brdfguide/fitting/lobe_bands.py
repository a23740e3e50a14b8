"""The directions of a file from which a plan sees how high a narrow lobe is, and how wide.

A mean over all directions hardly needs them, since few lie there; but a law fitted without them may have any lobe, or
none, where none was measured, and then be off by many times.
"""

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass

MIRROR_DEG = 0.1  # tilt of the half vector within which a direction is the mirror's
BANDS_DEG = ((0.0, 0.5), (0.5, 2.0), (2.0, 6.0))  # of the tilt: the height of a narrow lobe, its flank, its foot (ours)
WITHIN_DEG = (0.0, 1.0, 4.0)  # the tilt that is looked for in each
INCIDENCE_DEG = (20.0, 45.0, 65.0)  # least, best and most: beyond, laws miss most (ours)
CROWDED = 0.01  # of a file's directions in the first band: it was laid out for a lobe so narrow (ours)
FEW = 8  # directions of a plan, from which on it sees that lobe


@dataclass(frozen=True, eq=False)
class LobeBand:
    """A band about the mirror direction, and the direction to take where a plan has none in it."""

    band_deg: tuple[float, float]
    best: int  # its number among those that are offered

    def holds(self, geom: Geometry) -> bool:
        """Whether any of some directions lies in it."""
        tilt = tilts_deg(geom)
        return bool(np.any((tilt >= self.band_deg[0]) & (tilt <= self.band_deg[1])))


def tilts_deg(geom: Geometry) -> np.ndarray:
    """(directions,): of the half vector."""
    return np.degrees(np.arctan(np.sqrt(geom.tan2_h)))[:, 0]


def lobe_bands(offered: Geometry, count: int) -> list[LobeBand]:
    """What a plan of so many of these directions is to see where they crowd about the mirror direction: height, flank
    and foot of a narrow lobe. None elsewhere: one of few would count a lobe that hardly any of all directions has."""
    crowded = count >= FEW and np.mean(tilts_deg(offered) <= BANDS_DEG[0][1]) >= CROWDED
    return _bands(offered) if crowded else []


def lobe_rows(geom: Geometry) -> list[int]:
    """Numbers of the directions of a file that `lobe_bands` would take."""
    return [each.best for each in _bands(geom)]


def _bands(geom: Geometry) -> list[LobeBand]:
    tilt, incidence = tilts_deg(geom), np.maximum(geom.theta_i_deg, geom.theta_r_deg)[:, 0]
    least, middle, most = INCIDENCE_DEG
    found: list[LobeBand] = []
    for (low, high), wanted in zip(BANDS_DEG, WITHIN_DEG, strict=True):
        free = (tilt >= low) & (tilt <= (high if low else MIRROR_DEG)) & (incidence >= least) & (incidence <= most)
        if not low and not free.any():
            return []
        if free.any():
            off = np.abs(tilt - wanted) / high + np.abs(incidence - middle) / middle
            found.append(LobeBand((low, high), int(np.argmin(np.where(free, off, np.inf)))))
    return found
