"""A measurement and its findings as documents, for every command that reads data."""

import numpy as np

from ..measurement import Finding, Measurement


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


def finding(each: Finding) -> dict:
    """A doubt with its stable code."""
    entry = {"code": each.code, "severity": each.severity, "text": each.text, "consequence": each.consequence, "option": each.option}
    return {key: value for key, value in entry.items() if value} | ({"numbers": dict(each.numbers)} if each.numbers else {})
