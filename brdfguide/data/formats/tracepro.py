"""TracePro's surface property as text: a table of scatter angles counted from the mirror direction, as sines.

Lines of a header, then `Table_BSDF_Data`, names of columns and rows: Temperature, Wavelength [µm], IncAngle, AziAngle
[deg], ScatterBeta, ScatterAzimuth [deg], BRDF, BTDF [1/sr]. ScatterBeta is the distance |β - β0| from the mirror
direction in the plane of direction cosines, ScatterAzimuth the angle there, from the direction away from the normal.

Source: "Table BSDF", TracePro user's manual, and files that public programs write for it. Where the azimuth counts from
is stated by neither: of the two ways along the plane of incidence that is taken which leaves fewer values below the
horizon, away from the normal where both leave as many.
"""

import re

import numpy as np

from ...finding import Finding
from ..measurement import Measurement
from ._pivot import pivoted
from ._rotations import ISOTROPIC
from ._sheet import Sheet, rows_of
from ._writing import about, angle, value, wavelengths
from ._written import Style
from .format import Format, Options, Source, averaged, check_angle, check_zenith, measurement

TABLE = "table_bsdf_data"
COLUMNS = ("Wavelength", "IncAngle", "ScatterBeta", "ScatterAzimuth", "BRDF")
OPTIONAL = ("AziAngle", "Temperature", "BTDF")
MOST_BETA = 2.0 + 1e-6
HORIZON = 1 - 1e-9  # of a sine
HEADER = ("Temperature", "Wavelength", "IncAngle", "AziAngle", "ScatterBeta", "ScatterAzimuth", "BRDF", "BTDF")
TEMPERATURE_K = "300"


def recognises(head: bytes) -> bool:
    return re.match(rb"\s*TracePro\b", head, re.IGNORECASE) is not None or TABLE.encode() in head.lower()


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where there is no table of values, for several temperatures, and for a row that is none."""
    column = _columns(source)
    um, theta_i = column["Wavelength"], column["IncAngle"]
    beta, azimuth = column["ScatterBeta"], np.radians(column["ScatterAzimuth"])
    check_zenith(source, "IncAngle", theta_i)
    theta_r, phi_r, above, notes = _directions(theta_i, beta, azimuth, column["BRDF"])
    if not np.any(above):
        raise source.error("none of its directions lies above the horizon")
    if np.any(column.get("BTDF", np.zeros(1)) != 0):
        notes.append(Finding("blocks-skipped", "the column BTDF, transmission, was left out"))
    turned = column.get("AziAngle", np.zeros(len(beta)))
    angles = [theta_i[above], np.zeros(int(above.sum())), theta_r[above], phi_r[above]]
    values, angles, um, more = _spread(angles, um[above], turned[above], column["BRDF"][above], options)
    channels = tuple(f"{each * 1000:g}nm" for each in um)
    said = {"channels": channels, "wavelength": um, "findings": [*notes, *more]}
    theta_i, phi_i, theta_r, phi_r = angles
    return measurement(source, "TracePro table", theta_i, phi_i, theta_r, phi_r, values, **said)


def _columns(source: Source) -> dict[str, np.ndarray]:
    """Name -> values of the rows. Raises InputError where a column is missing or the temperatures differ."""
    lines = [(number, text) for number, text in enumerate(source.lines, 1)]
    start = next((place for place, (_, text) in enumerate(lines) if TABLE in text.lower()), None)
    if start is None:
        text = (
            "no Table_BSDF_Data in this TracePro property: one of an ABg model, whose A, B and g `evaluate abg` takes"
        )
        raise source.error(f"{text}; export it as a table")
    content = [(number, text) for number, text in lines[start + 1 :] if text.strip()]
    if len(content) < 2:
        raise source.error("no rows under Table_BSDF_Data", lines[start][0])
    number, head = content[0]
    names = head.split()
    missing = [name for name in COLUMNS if name not in names]
    if missing:
        raise source.error(f"no column {missing[0]} under Table_BSDF_Data; found {', '.join(names)[:80]}", number)
    rows = [(number, " ".join(text.split())) for number, text in content[1:]]
    values, where, texts, _ = rows_of(source, rows, names, Style(None), [])
    sheet = Sheet(names, values, where, [], [], texts=texts)
    for place, name in enumerate(names):
        if bad := sheet.bad_cell(place):
            raise source.error(f"{name}: found '{bad[0][:40]}', wanted a number", bad[1])
    column = {name: values[:, names.index(name)] for name in (*COLUMNS, *OPTIONAL) if name in names}
    temperatures = np.unique(column.get("Temperature", np.zeros(1)))
    if len(temperatures) > 1:
        text = f"it holds {len(temperatures)} temperatures ({temperatures[0]:g} to {temperatures[-1]:g} K)"
        raise source.error(f"{text}: export one of them")
    if not np.all(np.isfinite(np.stack([column[name] for name in (*COLUMNS[:-1], *OPTIONAL[:1]) if name in column]))):
        raise source.error("an angle or a wavelength is missing or infinite")
    check_angle(source, "ScatterAzimuth", column["ScatterAzimuth"])
    check_angle(source, "AziAngle", column.get("AziAngle", np.zeros(1)))
    if np.any(np.abs(column["ScatterBeta"]) > MOST_BETA):
        raise source.error("a ScatterBeta is larger than 2: sines of two directions differ by no more")
    return column


def _directions(theta_i, beta, azimuth, brdf):
    """theta_r, phi_r [deg], which rows lie above the horizon, and the note on where the azimuth counts from."""
    sine = np.sin(np.radians(theta_i))
    ways = []
    for sign in (1.0, -1.0):  # away from the normal, toward it
        x, y = sine + sign * beta * np.cos(azimuth), sign * beta * np.sin(azimuth)
        ways.append((x, y, np.hypot(x, y) < HORIZON))
    lost = [int(np.count_nonzero(~above & (brdf > 0))) for _, _, above in ways]
    toward = lost[1] < lost[0]
    x, y, above = ways[toward]
    theta_r = np.degrees(np.arcsin(np.minimum(np.hypot(x, y), 1.0)))
    where = "toward the normal" if toward else "away from the normal"
    because = f"; the other way {max(lost)} values would lie below the horizon" if lost[0] != lost[1] else ""
    notes = [Finding("mirror-azimuth", f"ScatterAzimuth counts from the direction {where}{because}")]
    if below := int(np.count_nonzero(~above)):
        text = f"{below} rows about the mirror direction lie below the horizon and were dropped"
        notes.append(Finding("below-horizon", text, numbers=(("rows", below),)))
    # x points to the mirror direction, at azimuth 180 of light at 0
    return theta_r, np.degrees(np.arctan2(-y, -x)), above, notes


@np.errstate(over="ignore")  # a wavelength beyond every lamp is refused once directions are told apart
def _spread(angles, um, turned, brdf, options: Options):
    """BRDF (directions, wavelengths), angles, wavelengths and notes; rotations of the sample averaged or kept.

    At normal incidence and in the mirror direction a direction stands once for each azimuth: once is enough.
    """
    turns = np.unique(turned[angles[0] > 0]) if np.any(angles[0] > 0) else np.unique(turned)
    kept = _once([*angles, um, turned])
    angles, um, turned, brdf = [each[kept] for each in angles], um[kept], turned[kept], brdf[kept]
    light = [angles[0], -turned, angles[2], angles[3] - turned]
    if len(turns) < 2:
        (*angles,), values, _, waves, notes = pivoted(angles, um, brdf)
        return values, angles, waves, notes
    (*whole,), values, _, waves, notes = pivoted(light, um, brdf)
    spread = _rms_over_turns(angles, um, brdf)
    note = averaged(len(turns), spread, options)
    if spread >= ISOTROPIC and not options.average_phi_i:
        return values, whole, waves, [*notes, note]
    keys = np.round(np.stack([*angles, um], axis=1), 6)
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    known = np.isfinite(brdf)
    total, count = (np.bincount(place.reshape(-1), each) for each in (np.where(known, brdf, 0.0), known))
    mean = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    (*angles,), values, _, waves, notes = pivoted([each[first] for each in angles], um[first], mean)
    return values, angles, waves, [*notes, note]


def _rms_over_turns(angles, um, brdf) -> float:
    """rms of ln (value / mean) over the rotations of the same direction and wavelength."""
    good = (brdf > 0) & np.isfinite(brdf)
    _, place = np.unique(np.round(np.stack([*angles, um], axis=1), 6), axis=0, return_inverse=True)
    place, level = place.reshape(-1)[good], np.log(brdf[good])
    mean = np.bincount(place, level) / np.maximum(np.bincount(place), 1)
    return float(np.sqrt(np.mean((level - mean[place]) ** 2))) if len(level) else 0.0


def _once(columns):
    """Rows whose numbers were not there before."""
    keys = np.round(np.stack(columns, axis=1), 6)
    keys[:, 3] = np.where(keys[:, 2] < 1e-6, 0.0, np.remainder(keys[:, 3], 360.0))
    return np.sort(np.unique(keys, axis=0, return_index=True)[1])


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as TracePro's table, every direction as it was measured, and sentences on what was left out."""
    geom, nm = measurement.geom, wavelengths(measurement)
    theta_i, theta_r, phi = (np.radians(each[:, 0]) for each in (geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg))
    x, y = -np.sin(theta_r) * np.cos(phi), -np.sin(theta_r) * np.sin(phi)
    beyond = x - np.sin(theta_i)
    beta, azimuth = np.hypot(beyond, y), np.remainder(np.degrees(np.arctan2(y, beyond)), 360.0)
    turned = np.remainder(-geom.phi_i_deg[:, 0], 360.0)
    rotation = np.zeros(len(turned)) if np.ptp(geom.phi_i_deg) < 1e-4 else turned
    lines = ["TracePro Surface Property Data", f"File Name\t{about(measurement)[0]}", "TracePro Release: 7 0 0"]
    lines += ["", "Solve\tBRDF", "", "Table_BSDF_Data", "\t".join(HEADER)]
    for channel, wave in enumerate(nm):
        for row in np.lexsort((azimuth, beta, theta_i, rotation)).tolist():
            number = measurement.brdf[row, channel]
            if np.isfinite(number):
                where = (
                    f"{np.degrees(theta_i[row]):.9g}",
                    angle(rotation[row]),
                    f"{beta[row]:.12g}",
                    f"{azimuth[row]:.9g}",
                )
                lines.append("\t".join((TEMPERATURE_K, f"{wave / 1000:.9g}", *where, value(number), "0")))
    notes = ["temperature 300 K, which no measurement says"]
    if missing := int(np.count_nonzero(~np.isfinite(measurement.brdf))):
        notes.append(f"{missing} missing values were left out")
    return "\n".join(lines) + "\n", notes


FORMAT = Format("tracepro", (".txt",), recognises, read, options=("average_phi_i",), write=write)
