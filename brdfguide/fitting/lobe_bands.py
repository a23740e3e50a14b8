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
FEW, MANY = 8, 16  # directions of a plan: from which on it sees a crowded highlight, and any mirror direction


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
    """What a plan of so many of these directions is to see: the mirror direction, from sixteen on; where the file
    crowds there, from eight on, and the flank and the foot of the lobe as well. None where no direction is the
    mirror's."""
    tilt = tilts_deg(offered)
    crowded = np.mean(tilt <= BANDS_DEG[0][1]) >= CROWDED
    found = _bands(offered) if count >= FEW else []
    found = found if crowded else found[: int(count >= MANY)]
    return [each for each in found if each is not None]


def lobe_rows(geom: Geometry) -> list[int]:
    """Numbers of the directions of a file that `lobe_bands` would take."""
    return [each.best for each in _bands(geom) if each is not None]


def _bands(geom: Geometry) -> list[LobeBand | None]:
    tilt, incidence = tilts_deg(geom), np.maximum(geom.theta_i_deg, geom.theta_r_deg)[:, 0]
    least, middle, most = INCIDENCE_DEG
    found: list[LobeBand | None] = []
    for (low, high), wanted in zip(BANDS_DEG, WITHIN_DEG, strict=True):
        free = (tilt >= low) & (tilt <= (high if low else MIRROR_DEG)) & (incidence >= least) & (incidence <= most)
        if not low and not free.any():
            return []
        off = np.abs(tilt - wanted) / high + np.abs(incidence - middle) / middle
        found.append(LobeBand((low, high), int(np.argmin(np.where(free, off, np.inf)))) if free.any() else None)
    return found
