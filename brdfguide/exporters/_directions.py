"""Which directions an export is judged over, and the metric: rms of ln(target's model / surface).

The data's own directions where the caller has them. Otherwise a grid: theta_i and theta_r 0 to 80 degrees by 10 with
seven azimuths, and steps about each mirror direction of 0.25 to 16 degrees and of 0.3 to 3 times the half width that
the lobe has at 30 degrees, so that a lobe of a hundredth of a degree is seen.
"""

from functools import lru_cache

import numpy as np

from ..errors import NoAnswer
from ..physics.geometry import Geometry, in_plane, rows

# what is below both is not seen beside the highlight, and a logarithm would count it in full
FAINTEST = 1e-3  # of the brightest value at the same incidence
DARKEST = 1e-3  # 1/sr: a body of albedo 0.003
TURNS_DEG = (0.0, 45.0, 90.0, 135.0)  # azimuths of the light, for a surface that changes as it turns
WIDTHS = np.array([0.3, 0.6, 1.0, 1.7, 3.0])
JUDGED = 6000  # directions off the peak
JUDGED_DEG = 80.0  # up to this theta_i and theta_r
OFF_PEAK_DEG = 3.0  # and this far from the mirror direction
NEAR = np.array([0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0])  # degrees from the mirror direction


def standard_directions(surface=None) -> Geometry:
    """The grid above, (samples, 1); without a surface, without the steps that follow its width."""
    theta = np.arange(0.0, 81.0, 10.0)
    azimuth = np.array([0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0])
    regular = np.array(np.meshgrid(theta, theta, azimuth, indexing="ij")).reshape(3, -1)
    steps = NEAR if surface is None else np.unique(np.concatenate((NEAR, half_width(surface) * WIDTHS)))
    about = []
    for theta_i in theta:
        for step in steps:
            about += [(theta_i, abs(theta_i - step), 180.0 if theta_i >= step else 0.0)]
            about += [(theta_i, theta_i + step, 180.0)] if theta_i + step < 90 else []
            sideways = 2 * np.degrees(
                np.arcsin(min(1.0, np.sin(np.radians(step / 2)) / max(np.sin(np.radians(theta_i)), 1e-9)))
            )
            about += [(theta_i, theta_i, 180.0 - sideways)] if 0 < sideways < 90 else []
    theta_i, theta_r, phi = np.concatenate([regular, np.array(about).T], axis=1)
    turns = (0.0,) if surface is None or not surface.model.turns else TURNS_DEG
    turn = np.repeat(turns, len(phi))
    theta_i, theta_r, phi = (np.tile(each, len(turns)) for each in (theta_i, theta_r, phi))
    return rows(Geometry.from_degrees(theta_i, turn, theta_r, phi + turn))


def half_width(surface) -> float:
    """Degrees from the mirror direction at which the surface falls to half of its value there, at 30°; at most 16."""
    steps = np.concatenate(([0.0], np.geomspace(1e-3, 16.0, 60)))
    value = np.sum(surface.spectral(in_plane(30.0, 30.0 + steps)), axis=-1)
    below = np.nonzero(value < 0.5 * value[0])[0]
    return float(steps[below[0]]) if len(below) else 16.0


STANDARD_WORDS = "directions with theta_i 0..80 deg"


def judged_over(surface, geom: Geometry | None, spectral: bool = False) -> tuple[Geometry, np.ndarray, str]:
    """Directions, linear sRGB or channels there (samples, colours), NaN where it does not count, and words."""
    if geom is None and not spectral:
        return _over_the_standard(surface)
    words = STANDARD_WORDS if geom is None else "of the data's directions"
    return _judged(surface, standard_directions(surface) if geom is None else rows(geom), spectral, words)


@lru_cache(maxsize=4)  # of the few candidates for one surface, which every shader is asked for
def _over_the_standard(surface) -> tuple[Geometry, np.ndarray, str]:
    return _judged(surface, standard_directions(surface), False, STANDARD_WORDS)


def _judged(surface, geom: Geometry, spectral: bool, words: str) -> tuple[Geometry, np.ndarray, str]:
    rgb = surface.spectral(geom) if spectral else surface.rgb(geom)
    counted = geom.lit & (rgb > 0)
    incidence = np.round(geom.theta_i_deg[:, 0], 1)
    for theta_i in np.unique(incidence):
        here = incidence == theta_i
        brightest = np.max(np.where(counted[here], rgb[here], 0.0), axis=0)
        counted[here] &= rgb[here] >= np.minimum(FAINTEST * brightest, DARKEST)
    kept = counted.any(axis=1)
    if not kept.any():
        raise NoAnswer(
            "the surface reflects nothing in any of the directions that it is judged by; there is nothing to write"
        )
    wanted = np.where(counted[kept], rgb[kept], np.nan)
    return geom[kept], wanted, f"{int(kept.sum())} {words}, brighter than 1e-3 of that incidence's peak or 1e-3/sr"


def off_peak(brdf) -> tuple[Geometry, np.ndarray, str]:
    """Where a table is judged besides: directions, the BRDF there, NaN where it is too dark to count, and words.

    Spread evenly by an additive sequence (Roberts 2018), off the round angles of nodes; half anywhere, half within 20
    degrees of the mirror direction.
    """
    x, y, z = (np.arange(1, JUDGED + 1)[:, None] * 1.2207440846 ** -np.arange(1.0, 4.0) % 1).T
    near = np.arange(JUDGED) % 2 == 0
    theta_i = JUDGED_DEG * x
    theta_r = np.where(near, np.abs(theta_i + 40 * (y - 0.5)), JUDGED_DEG * y)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, 180 + np.where(near, 40, 360) * (z - 0.5)))
    geom = geom[(theta_r <= JUDGED_DEG) & (geom.mirror_distance2[:, 0] > np.radians(OFF_PEAK_DEG) ** 2)]
    value = brdf(geom)
    counted = (value > 0) & (value >= too_dark(value))
    words = (
        f"theta_i and theta_r to {JUDGED_DEG:g} deg and {OFF_PEAK_DEG:g} deg or more from the mirror direction "
        f"({int(counted.any(axis=1).sum())} directions tried)"
    )
    return geom, np.where(counted, value, np.nan), words


def too_dark(values) -> float:
    """What is below does not count: DARKEST, or FAINTEST of the brightest where all is dark."""
    return min(DARKEST, FAINTEST * float(values.max()))


def rms_ln(written: np.ndarray, wanted: np.ndarray) -> float:
    """rms of ln(written / wanted) where wanted counts; infinite where what is written is 0 and the surface is not."""
    counted = np.isfinite(wanted)
    written = np.broadcast_to(written, wanted.shape)[counted]
    if not written.size:
        return 0.0
    if np.any(written <= 0):
        return float("inf")
    return float(np.sqrt(np.mean(np.log(written / wanted[counted]) ** 2)))
