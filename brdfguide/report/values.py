"""A model's values at given directions, as rows."""

import numpy as np

from ..errors import InputError
from ..geometry import Geometry, rows
from ..misfit import evaluate
from ..models import Sum
from .plain import plain

HEADER = ("theta_i_deg", "theta_r_deg", "phi_deg", "channel", "wavelength_nm", "brdf")


def grid(theta_i: str, theta_r: str, phi: str, wavelength) -> Geometry:
    """Every combination of the angles [deg] in three lists; theta_r is positive on the mirror side, phi counted from it."""
    lists = [angles(text, name) for text, name in ((theta_i, "--theta-i"), (theta_r, "--theta-r"), (phi, "--phi"))]
    incidence, reflection, azimuth = np.meshgrid(*lists, indexing="ij")
    if np.any((incidence < 0) | (incidence > 90)) or np.any(np.abs(reflection) > 90):
        raise InputError("--theta-i lies in 0..90 and --theta-r in -90..90 degrees")
    side = np.where(reflection < 0, 0.0, 180.0)
    return rows(Geometry.from_degrees(incidence, 0.0, np.abs(reflection), side + azimuth, np.atleast_1d(wavelength)))


def angles(text: str, name: str) -> np.ndarray:
    """`45`, `10,45,75` or `low:high:step`."""
    try:
        if ":" in text:
            low, high, step = (float(part) for part in text.split(":"))
            if not (step > 0 and (high - low) / step <= 100_000):
                raise ValueError
            return low + step * np.arange(int(np.floor((high - low) / step + 1e-9)) + 1)
        return np.array([float(part) for part in text.split(",")])
    except ValueError:
        raise InputError(f"{name} {text}: wanted degrees such as 45, 10,45,75 or 0:80:5") from None


def check_channels(values: dict, channels, name: str) -> None:
    """Raises InputError where the values belong to another number of channels."""
    counts = {np.size(value) for value in values.values()} - {1, len(channels)}
    if counts:
        raise InputError(f"{name} has {len(channels)} channels, the fitted values {counts.pop()}; wanted the same")


def document(surface: Sum, values: dict, geom: Geometry, channels) -> dict:
    """One row for each direction and channel; each term by itself beside their sum."""
    wavelength = np.broadcast_to(np.atleast_1d(geom.wavelength) * 1e3, (len(channels),))
    total = np.broadcast_to(evaluate(surface, geom, values), (len(geom), len(channels)))
    parts = {}
    if len(surface.terms) > 1:
        for term in surface.terms:
            part = term.model(geom, **surface.of_term(term, {**surface.defaults(), **values}))
            parts[term.label] = np.broadcast_to(part, total.shape)
    names = [*HEADER, *parts]
    table = []
    for row in range(len(geom)):
        where = [float(angle[row, 0]) for angle in (geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg)]
        for column, channel in enumerate(channels):
            table.append([*where, channel, round(float(wavelength[column]), 6), float(total[row, column]), *(float(part[row, column]) for part in parts.values())])
    return plain({"schema": "brdfguide/evaluate/1", "model": surface.name, "columns": names, "rows": table})


def csv(document: dict) -> str:
    lines = [",".join(document["columns"])]
    lines += [",".join(cell if isinstance(cell, str) else repr(cell) for cell in row) for row in document["rows"]]
    return "\n".join(lines) + "\n"
