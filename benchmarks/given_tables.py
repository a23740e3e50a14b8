"""The tables that measurements at hand make: what the benchmarks on plans and on the plane of incidence judge by.

Real measurements lie in the folder named by BRDFGUIDE_DATA; the examples' samples are there always.
"""

import os
from pathlib import Path

import numpy as np

from brdfguide.data import subsample
from brdfguide.data.measurement import Measurement
from brdfguide.fitting.job import Job, read_for_fit
from brdfguide.physics.geometry import Geometry

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("BRDFGUIDE_DATA", ROOT.parent / "shared" / "data"))
TABLES = {
    "garnet red (Cornell)": "cornell/garnet_red.brdf",
    "cayman (Cornell)": "cornell/cayman.brdf",
    "white paper (RGL)": "rgl/paper_white_rgb.bsdf",
    "sunflower vinyl (RGL)": "rgl/cg_sunflower_rgb.bsdf",
    "yellow chrome (RGL)": "rgl/vch_golden_yellow_rgb.bsdf",
    "colour change (RGL)": "rgl/cc_ibiza_sunset_rgb.bsdf",
    "red plastic (MERL)": "merl_format/red-plastic.binary",
    "bronze (MERL)": "merl_format/alum-bronze.binary",
    "PTFE (NIST)": "nist/PTFE.data.csv",
}
THETA_MAX_DEG = 80.0
MOST, JUDGED = 40_000, 4_000  # directions to choose from, and to judge by
CHANNELS = 3
MOVED_DEG = 2.0


def tables():
    """(name, Measurement to choose from, Measurement to judge by) of every table that is there, up to 80 degrees."""
    for name, path in TABLES.items():
        file = next((each for each in (DATA / path, DATA / f"{path}.xz") if each.exists()), None)
        if file is None:
            continue
        whole = read_for_fit(file, Job(reading=(("theta_max", THETA_MAX_DEG),), anyway=True))
        count = len(whole.channels)
        if count > CHANNELS:
            whole = whole.of_channels(np.array([count // 6, count // 2, 5 * count // 6]))
        whole = at_most(whole[whole.has_value], MOST)
        yield name, whole, at_most(whole, JUDGED)


def at_most(measurement: Measurement, most: int) -> Measurement:
    """Rows that stand for all of a table, where it has more."""
    if len(measurement.brdf) <= most:
        return measurement
    return measurement[subsample.representative_rows(measurement, most)]


def nearest(table: Measurement, geom, either_way: bool = False) -> np.ndarray:
    """Rows of the table nearest to some directions, each once; light and detector count alike.

    Either way they may be exchanged where that is nearer: it is the same reflectance.
    """
    return np.unique(nearest_rows(table.geom, geom, either_way))


def nearest_rows(offered: Geometry, geom: Geometry, either_way: bool = False) -> list[int]:
    """For each direction the number of the nearest of those that are offered."""
    ways = [vectors(offered), *([vectors(offered.swapped())] if either_way else [])]
    apart = (np.min([np.sum((way - each) ** 2, axis=1) for way in ways], axis=0) for each in vectors(geom))
    return [int(np.argmin(each)) for each in apart]


def moved(geom: Geometry, random: np.random.Generator) -> Geometry:
    """Directions with each angle moved by about `MOVED_DEG`, within the hemisphere that tables are judged in."""
    off = MOVED_DEG * random.standard_normal((3, len(geom), 1))
    theta_i, theta_r = (
        np.clip(np.abs(angle + by), 0.0, THETA_MAX_DEG)
        for angle, by in ((geom.theta_i_deg, off[0]), (geom.theta_r_deg, off[1]))
    )
    return Geometry.from_degrees(theta_i, 0.0, theta_r, geom.phi_deg + off[2] / np.maximum(geom.sin_r, 0.2))


def vectors(geom) -> np.ndarray:
    """(directions, 5), whose distances are angles."""
    turn = np.radians(geom.phi_deg)
    parts = (geom.sin_i, geom.cos_i, geom.sin_r * np.cos(turn), geom.sin_r * np.abs(np.sin(turn)), geom.cos_r)
    return np.concatenate(np.broadcast_arrays(*parts), axis=1)


def rms(residuals) -> float:
    return float(np.sqrt(np.nanmean(np.asarray(residuals, float) ** 2)))
