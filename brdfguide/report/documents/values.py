"""Values in rows, as documents: that an instrument reads at given directions, and of what a fit leaves over."""

from math import exp

import numpy as np

from ...data.measurement import Measurement
from ...fitting.fit import Fit
from ...fitting.reading import reading
from ...models.surface import Surface
from ...physics.aperture import Instrument
from ...physics.geometry import Geometry
from .plain import plain

HEADER = ("theta_i_deg", "theta_r_deg", "phi_deg", "channel", "wavelength_nm", "brdf")


def document(surface: Surface, instrument: Instrument) -> dict:
    """What the instrument reads, a row for each direction and channel; each term by itself beside the whole."""
    geom, channels, nm = instrument.geom, surface.channels, 1e3 * surface.wavelengths
    total, terms = reading(surface, instrument), surface.model.terms
    parts = {term.label: reading(surface.alone(term), instrument) for term in terms} if len(terms) > 1 else {}
    names = [*HEADER, *parts]
    table = []
    for row in range(len(geom)):
        where = _where(geom, row)
        for column, channel in enumerate(channels):
            table.append(
                [
                    *where,
                    channel,
                    round(float(nm[column]), 6),
                    float(total[row, column]),
                    *(float(part[row, column]) for part in parts.values()),
                ]
            )
    aperture = {"solid_angle_sr": instrument.solid_angle} if instrument.solid_angle else {}
    head = {"schema": "brdfguide/evaluate/1", "model": surface.model.name, **aperture}
    return plain({**head, "columns": names, "rows": table})


def _where(geom: Geometry, row: int) -> list[float]:
    """theta_i, theta_r and phi [deg] of a direction, phi from 0 to below 360."""
    phi = float(geom.phi_deg[row, 0]) % 360.0 % 360.0  # once gives 360 of what is next to nothing below 0
    return [float(geom.theta_i_deg[row, 0]), float(geom.theta_r_deg[row, 0]), phi]


def residuals(fit: Fit, measurement: Measurement) -> dict:
    """Data, model and ln(model/data), a row for each direction and channel that was measured."""
    geom, left = measurement.geom, fit.residuals_on(measurement)
    wavelength = np.broadcast_to(np.atleast_1d(geom.wavelength) * 1e3, measurement.brdf.shape[1:])
    table = []
    for row, column in zip(*np.nonzero(np.isfinite(left)), strict=True):
        where = _where(geom, row)
        value, ratio = float(measurement.brdf[row, column]), float(left[row, column])
        channel = measurement.channels[column], float(wavelength[column])
        table.append([*where, *channel, value, value * exp(ratio), ratio])
    columns = [*HEADER, "model", "ln_ratio"]
    return {"candidate": fit.name, "data": measurement.name, "columns": columns, "rows": table}
