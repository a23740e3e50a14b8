"""Where an instrument can put light and detector, one by one or in whole scans, and how long that takes."""

import numpy as np

from ..errors import InputError
from ..physics.directions import Directions
from ..physics.geometry import Geometry, rows
from ..records import dataclass

SHADOW_DEG = 8.0  # nearer to the light than this the detector stands in its way (ours)
AZIMUTHS_DEG = 22.5  # between planes that are proposed
TILTS_DEG = (0.5, 1.5, 3.0, 5.0, 7.5, 10.5, 14.0, 18.0, 23.0, 29.0, 36.0, 44.0, 53.0, 63.0)  # of the half vector
DIFFERENCES_DEG = np.arange(2.5, 90.0, 7.5)  # from light to half vector
TURNS_DEG = np.arange(0.0, 181.0, 30.0)  # of the light about the half vector
LOBE_SHARE = 0.8  # of what counts: even in tilt, difference and turn, where lobes are; the rest even in angles (ours)


@dataclass(frozen=True)
class Goniometer:
    """The angles that it reaches, and its times."""

    theta_max_deg: float = 80.0
    in_plane: bool = False
    step_deg: float = 5.0  # between the readings of a scan
    solid_angle: float | None = None  # of the detector [sr]
    value_s: float = 0.0  # for one value
    move_s: float = 0.0  # for another incidence or another plane

    def __post_init__(self):
        if not 10 <= self.theta_max_deg <= 89:
            raise InputError(f"angles up to {self.theta_max_deg:g} degrees: wanted 10 to 89")
        if not 0.5 <= self.step_deg <= 30:
            raise InputError(f"a step of {self.step_deg:g} degrees: wanted 0.5 to 30")
        if self.value_s < 0 or self.move_s < 0:
            raise InputError("a time below zero seconds: wanted 0 or more")

    def reaches(self, geom: Geometry) -> np.ndarray:
        """(directions,): whether it can read there."""
        between = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_cos, -1, 1)))[:, 0]
        highest = np.maximum(geom.theta_i_deg, geom.theta_r_deg)[:, 0]
        there = (highest <= self.theta_max_deg + 1e-6) & (between >= SHADOW_DEG - 1e-6)
        return there & (geom.off_plane_deg[:, 0] < 0.1) if self.in_plane else there

    def scans(self) -> list[tuple[float, float, Geometry]]:
        """(theta_i, azimuth of the plane from the mirror's, directions) of every scan of the detector that it makes."""
        highest = np.floor(self.theta_max_deg / self.step_deg) * self.step_deg
        theta_r = np.arange(-highest, highest + 1e-6, self.step_deg)
        planes = (0.0,) if self.in_plane else tuple(np.arange(0.0, 91.0, 30.0))
        found = []
        for theta_i in np.arange(10.0, self.theta_max_deg + 1e-6, 5.0):
            for plane in planes:
                phi = np.where(theta_r < 0, plane, 180.0 - plane if plane else 180.0)
                phi = np.where(theta_r < 0, np.abs(phi), phi)
                geom = rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), phi))
                found.append((float(theta_i), float(plane), geom[self.reaches(geom)]))
        return found

    def seconds(self, geom: Geometry) -> float:
        """For all of some directions, those of one incidence and plane after one another."""
        places = np.round(np.concatenate([geom.theta_i_deg, geom.off_plane_deg * (geom.sin_r > 0)], axis=1), 1)
        return len(geom) * self.value_s + len(np.unique(places, axis=0)) * self.move_s


def hemisphere(theta_max_deg: float) -> tuple[Geometry, np.ndarray]:
    """Directions in whole degrees that stand for every pair up to an angle, and their weights, which add up to 1.

    Most of them evenly in tilt and turns of the half vector, as tables of reflectances are laid out, since lobes are
    where it is small; the rest evenly in the angles themselves.
    """
    tilt, difference, turn = np.radians(TILTS_DEG), np.radians(DIFFERENCES_DEG), np.radians(TURNS_DEG)
    about = Directions.from_half_difference(*(each.ravel() for each in np.meshgrid(tilt, difference, turn)))
    degrees = np.stack(
        [_degrees(about.cos_i), _degrees(about.cos_r), np.abs((about.phi_deg + 180) % 360 - 180)], axis=1
    )
    lobe, counts = np.unique(np.round(degrees), axis=0, return_counts=True)
    kept = np.max(lobe[:, :2], axis=1) <= theta_max_deg
    lobe, counts = lobe[kept], counts[kept] * (LOBE_SHARE / counts[kept].sum())
    angles = np.arange(10.0, theta_max_deg + 1e-6, 10.0)
    even = np.stack(np.meshgrid(angles, np.r_[0.0, angles], np.arange(0.0, 181.0, AZIMUTHS_DEG)), axis=-1).reshape(
        -1, 3
    )
    even = even[(even[:, 1] > 0) | (even[:, 2] == 180)]
    every = np.concatenate([even, lobe])
    weights = np.r_[np.full(len(even), (1 - LOBE_SHARE) / len(even)), counts]
    geom = rows(Geometry.from_degrees(every[:, 0], 0.0, every[:, 1], np.floor(every[:, 2])))
    kept = Goniometer(theta_max_deg).reaches(geom)
    return geom[kept], weights[kept] / weights[kept].sum()


def _degrees(cosine) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))
