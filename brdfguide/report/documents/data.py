"""A measurement as a document, for every command that reads data."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...data.measurement import Measurement
from .findings import finding


def data_block(measurement: Measurement) -> dict:
    """What the file was taken to be."""
    theta_i = measurement.geom.theta_i_deg
    return {
        "file": measurement.name,
        "format": measurement.format,
        "samples": len(measurement.brdf),
        "channels": list(measurement.channels),
        "wavelength_nm": np.round(np.atleast_1d(measurement.geom.wavelength) * 1e3, 6).tolist(),
        "theta_i_deg": [float(theta_i.min()), float(theta_i.max())],
        "theta_r_deg": [float(measurement.geom.theta_r_deg.min()), float(measurement.geom.theta_r_deg.max())],
        "in_plane": measurement.in_plane,
        "values": int(measurement.brdf.size),
        "missing": measurement.censored,
        "solid_angle_sr": measurement.solid_angle,
        "findings": [finding(each) for each in measurement.findings],
    }


def read_with_block(options: Mapping[str, Any]) -> dict:
    """What was said of a file's meaning, as it is typed: a range of wavelengths [nm] as LOW:HIGH."""
    wavelength = options.get("wavelength")
    typed = {"wavelength": ":".join(f"{end:g}" for end in wavelength)} if isinstance(wavelength, tuple) else {}
    return {name: value for name, value in {**options, **typed}.items() if value is not False}
