"""ASAM OpenMATERIAL 3D BRDF table in JSON: `brdf.lookupTable` with rows of five numbers.

Wavelength [m], theta_i, theta_r, azimuth of the exit direction counted from the light [rad], BRDF [1/sr]; null is no
value. `brdf.receiverSolidAngles` [sr], since version 1.1, are those of the detector, a wavelength each.

Source: ASAM OpenMATERIAL 3D 1.1, schema of the BRDF look-up table.
"""

import json
import re
from dataclasses import replace

import numpy as np

from ...finding import Finding
from ...printable import short
from ..measurement import Measurement
from ._json import is_table
from ._pivot import pivoted
from ._sides import azimuths_on_their_side
from ._unread import AS_CSV
from .format import Format, Options, Source, check_zenith, degrees, measurement

LARGEST_SR = 2.0  # a cone of 47 degrees: no receiver of a goniometer sees more
ALIKE = 0.01  # solid angles that differ by less are one
COLUMNS = ("wavelength", "theta_i", "theta_r", "phi", "brdf")


def recognises(head: bytes) -> bool:
    """Any JSON object that is no table: its description may be longer than what is looked at."""
    return re.match(rb'\s*\{\s*"', head) is not None and not is_table(head)


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for JSON that is no such table."""
    try:
        document = json.loads(source.text)
    except (ValueError, RecursionError) as error:
        raise source.error(f"not valid JSON: {error}") from None
    schema = document.get("schema") if isinstance(document, dict) else None
    if isinstance(schema, str) and schema.startswith("brdfguide/"):
        raise source.error(f"found what this program printed, {short(schema)}; wanted measured data")
    stated = document.get("brdf") if isinstance(document, dict) else None
    brdf: dict = stated if isinstance(stated, dict) else {}
    rows = brdf.get("lookupTable")
    if not isinstance(rows, list) or not rows:
        raise source.error(f"no rows under brdf.lookupTable, where OpenMATERIAL has them; of other JSON {AS_CSV}")
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
    (theta_i, phi_i, theta_r, phi_r), spread, _, um, notes = pivoted(angles, metres * 1e6, values)
    said = {"channels": [f"{each * 1000:g}nm" for each in um], "wavelength": um, "findings": notes}
    solid_angle, more = _receiver(source, brdf.get("receiverSolidAngles"))
    result = measurement(source, "OpenMATERIAL JSON", theta_i, phi_i, theta_r, phi_r, spread, **said)
    return azimuths_on_their_side(replace(result, solid_angle=solid_angle).noting(*more), options)


def _receiver(source: Source, stated) -> tuple[float | None, list[Finding]]:
    """The detector's solid angle [sr] and the note on it; None where the file states none.

    Raises InputError for what is none.
    """
    if stated is None:
        return None, []
    rows = stated if isinstance(stated, list) else [stated]
    angles: list[float] = []
    for place, row in enumerate(rows, 1):
        angle = row.get("solidAngle") if isinstance(row, dict) else row
        if isinstance(angle, bool) or not isinstance(angle, (int, float)) or not 0 < angle < LARGEST_SR:
            text = f"receiverSolidAngles, entry {place}: found {str(angle)[:40]}, wanted steradians above 0"
            raise source.error(f"{text}, below {LARGEST_SR:g}")
        angles.append(float(angle))
    if not angles:
        return None, []
    mean = float(np.mean(angles))
    half = np.degrees(np.sqrt(mean / np.pi))
    text = f"the detector sees {mean:.3g} sr, a cone of {half:.2g} degrees half angle, as the file states it"
    if np.ptp(angles) > ALIKE * mean:
        text += f": the mean of {min(angles):.3g} to {max(angles):.3g} sr over its wavelengths"
    return mean, [Finding("receiver-solid-angle", text, option="--aperture-deg", numbers=(("solid_angle_sr", mean),))]


def _row(source: Source, place: int, row):
    if not isinstance(row, list) or len(row) != len(COLUMNS):
        raise source.error(f"lookupTable row {place}: found {str(row)[:60]}, wanted [{', '.join(COLUMNS)}]")
    for name, value in zip(COLUMNS, row, strict=True):
        if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float)) or abs(value) > 1e300):
            raise source.error(f"lookupTable row {place}, {name}: found {str(value)[:40]}, wanted a number or null")
    return [np.nan if value is None else float(value) for value in row]


FORMAT = Format("openmaterial", (".json",), recognises, read, own_side=False)
