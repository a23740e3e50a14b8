"""UTIA's `.bin` of an anisotropic BRDF: doubles without a header, recognised by their number.

Three planes R, G, B of 288 x 288 values: light (theta 0 to 75 in steps of 15, phi 0 to 352.5 in steps of 7.5) by view
on the same grid, little-endian. The level is not absolute: public readers disagree on it, one undoes a display curve
and multiplies by a hundred. The numbers are taken as they are, linear, and `--scale` says what makes them 1/sr.

Source: Filip and Vavra 2014, "Template-based sampling of anisotropic BRDFs", and the layout of the database's readers.
"""

import numpy as np

from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ..measurement import Measurement
from ._rotations import turns_of
from .format import Format, Options, Source, measurement, nominal_colours

THETA = np.arange(0.0, 76.0, 15.0)
PHI = np.arange(0.0, 360.0, 7.5)
BYTES = 3 * (len(THETA) * len(PHI)) ** 2 * 8
LEAST = 1e-12
CHANNELS = ("R", "G", "B")


def recognises(head: bytes) -> bool:
    """Never by its first bytes: it is what has `BYTES` bytes and no other reader."""
    return False


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where the values are no numbers of a reflectance."""
    shape = (3, len(THETA), len(PHI), len(THETA), len(PHI))
    cube = np.frombuffer(source.data, "<f8").reshape(shape)
    if not np.all(np.isfinite(cube)) or np.abs(cube).max() > 1e6 or cube.max() <= 0:
        raise source.error(f"it has the {BYTES} bytes of a UTIA table, but its values are none of a reflectance")
    count = len(PHI)
    cube = np.where(np.abs(cube) < LEAST, 0.0, cube)  # what no display shows is no value
    # the azimuth of view is counted from that of light
    relative = np.stack([np.roll(cube[:, :, place], -place, axis=3) for place in range(count)])
    turned = np.moveaxis(relative, 1, -1).reshape(count, -1, 3)
    theta_i, theta_r, azimuth = (each.reshape(-1) for each in np.meshgrid(THETA, THETA, PHI, indexing="ij"))
    once = ((theta_i > 0) | (azimuth == 0)) & ((theta_r > 0) | (azimuth == 0))
    light, values, notes = turns_of(turned[:, once], -PHI, np.ones(int(once.sum()), bool), options)
    turns = notes[:1]  # it is the light that turns, and no sample
    phi_i = np.repeat(light, int(once.sum()))
    theta_i, theta_r, azimuth = (np.tile(each[once], len(light)) for each in (theta_i, theta_r, azimuth))
    text = "the level of these tables is relative: their values are not 1/sr"
    level = [] if options.scale else [Finding("relative-scale", text, "warning", option="--scale")]
    return measurement(
        source,
        "UTIA .bin",
        theta_i,
        phi_i,
        theta_r,
        phi_i + azimuth,
        values.reshape(-1, 3),
        channels=CHANNELS,
        wavelength=np.array([CHANNEL_UM[name] for name in CHANNELS]),
        findings=[*turns, *level, nominal_colours(CHANNELS)],
    )


FORMAT = Format("utia", (".bin",), recognises, read, limit=BYTES, options=("average_phi_i",), exact_bytes=BYTES)
