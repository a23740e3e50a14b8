"""ASAM OpenMATERIAL 3D BRDF table in JSON: `brdf.lookupTable` with rows of five numbers.

Wavelength [m], theta_i, theta_r, azimuth of the exit direction counted from the light [rad], BRDF [1/sr]; null is no value.

Source: ASAM OpenMATERIAL 3D 1.1, schema of the BRDF look-up table.
"""

import json
import re

import numpy as np

from ..measurement import Measurement
from ._base import Format, Options, Source, check_zenith, degrees, measurement
from ._pivot import pivoted
from ._sides import on_its_side

COLUMNS = ("wavelength", "theta_i", "theta_r", "phi", "brdf")


def recognises(head: bytes) -> bool:
    """Any JSON object: its description may be longer than what is looked at, and no other reader takes JSON."""
    return re.match(rb'\s*\{\s*"', head) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for JSON that is no such table."""
    try:
        document = json.loads(source.text)
    except (ValueError, RecursionError) as error:
        raise source.error(f"not valid JSON: {error}") from None
    brdf = document.get("brdf") if isinstance(document, dict) else None
    rows = brdf.get("lookupTable") if isinstance(brdf, dict) else None
    if not isinstance(rows, list) or not rows:
        raise source.error("no rows under brdf.lookupTable")
    table = np.array([_row(source, place, row) for place, row in enumerate(rows, 1)])
    whole = np.all(np.isfinite(table[:, :4]), axis=1)
    if not np.any(whole):
        raise source.error("no row has its wavelength and angles")
    metres, theta_i, theta_r, phi, values = table[whole].T
    if np.any(metres <= 0):
        raise source.error(f"lookupTable: wavelength {metres[metres <= 0][0]:g} m; wanted a positive one")
    for name, column in (("theta_i", theta_i), ("theta_r", theta_r)):
        check_zenith(source, name, np.degrees(column))
    angles = [degrees(theta_i), 0.0 * theta_i, degrees(theta_r), degrees(phi)]
    angles, spread, _, um, notes = pivoted(angles, metres * 1e6, values)
    channels = [f"{each * 1000:g}nm" for each in um]
    result = measurement(source, "OpenMATERIAL JSON", *angles, spread, channels=channels, wavelength=um, findings=notes)
    return on_its_side(result, True, options)


def _row(source: Source, place: int, row):
    if not isinstance(row, list) or len(row) != len(COLUMNS):
        raise source.error(f"lookupTable row {place}: found {str(row)[:60]}, wanted [{', '.join(COLUMNS)}]")
    for name, value in zip(COLUMNS, row):
        if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float)) or abs(value) > 1e300):
            raise source.error(f"lookupTable row {place}, {name}: found {str(value)[:40]}, wanted a number or null")
    return [np.nan if value is None else float(value) for value in row]


FORMAT = Format("openmaterial", (".json",), recognises, read, own_side=False)
