"""Tables under several rotations of the sample: their mean where it is isotropic or asked for, else all of them."""

import numpy as np

from ...finding import Finding
from .format import Options, averaged

ISOTROPIC = 0.05  # rms of ln over the rotations, below which mounting explains it


def spread_over(turned, lit) -> float:
    """rms of ln (value / mean) over rotations; turned (rotations, cells, channels), lit (cells,) where it counts."""
    lit = lit & np.all(turned > 0, axis=(0, 2))
    if not np.any(lit):
        return 0.0
    return float(np.sqrt(np.mean(np.log(turned[:, lit] / turned[:, lit].mean(axis=0)) ** 2)))


def turns_of(turned, rotations, lit, options: Options) -> tuple[np.ndarray, np.ndarray, list[Finding]]:
    """Azimuths of the light [deg] (kept,), tables (kept, cells, channels), and the notes on what was done.

    A sample turned by +psi, counter-clockwise, has its light at -psi. Takes  turned (rotations, cells, channels),
    rotations [deg].
    """
    spread = spread_over(turned, lit)
    note = averaged(len(rotations), spread, options)
    if spread < ISOTROPIC or options.average_phi_i:
        return np.zeros(1), turned.mean(axis=0)[None], [note]
    sign, how = light_for(options)
    return sign * np.asarray(rotations, float), turned, [note, how]


def light_for(options: Options, stated: tuple[str, str] | None = None) -> tuple[float, Finding]:
    """The sign that makes a rotation of the sample the azimuth of the light, and the note on it.

    `stated` is the sense that the file gives, cw or ccw, and what says so; --rotation-sense comes before it.
    """
    sense, who = (options.rotation_sense, "--rotation-sense") if options.rotation_sense else stated or ("ccw", "")
    said = f", as {who} says" if who else ""
    if sense == "cw":
        text = f"the sample was turned clockwise{said}: light at +psi of it"
        return 1.0, Finding("sample-rotation", text, option="--rotation-sense")
    text = f"the sample was turned by +psi, counter-clockwise{said}: the light stands at -psi of it"
    return -1.0, Finding("sample-rotation", text, option="--rotation-sense")
