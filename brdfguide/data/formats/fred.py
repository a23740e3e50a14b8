"""FRED text: blocks of scattered directions about the normal, each under the specular direction that it belongs to.

`type bsdf_data`, then `format angles=deg|sin bsdf=value|log scale=x`; a line of two numbers is a specular direction
(polar, azimuth), lines of three numbers are scattered directions and their value. With `angles=sin` the pairs are
direction cosines along x and y; `bsdf=log` are decimal logarithms.

Source: Photon Engineering's help on "Tabulated BSDF".
"""

import re

import numpy as np

from ...errors import InputError
from ...finding import Finding
from ..measurement import Measurement
from ._writing import about, angle, only_channel, value
from .format import Format, Options, Source, check_zenith, commented_wavelength, measurement


def recognises(head: bytes) -> bool:
    return re.search(rb"^[ \t]*type[ \t=]+bsdf_data\b", head, re.IGNORECASE | re.MULTILINE) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for an unknown `format`, a value before any direction, and lines of another length."""
    angles_are, values_are, scale = "deg", "value", 1.0
    specular, rows, lines = None, [], []
    begun = False
    for number, text in enumerate(source.lines, 1):
        words = re.split(r"[#!]|//", text)[0].replace(",", " ").split()
        begun = begun or bool(words) and words[0].lower() == "type"
        if not begun or not words or words[0].lower() == "type":
            continue
        if words[0].lower() == "format":
            angles_are, values_are, scale = _format(source, words[1:], number)
            continue
        values = source.numbers(words, number)
        if len(values) == 2:
            specular = values
        elif len(values) != 3:
            raise source.error(
                (
                    f"found {len(values)} numbers, wanted 2 (a specular direction) or 3 (a scattered direction and "
                    f"its value)"
                ),
                number,
            )
        elif specular is None:
            raise source.error("a value comes before any specular direction of two numbers", number)
        else:
            rows.append((*specular, *values))
            lines.append(number)
    if not rows:
        raise source.error("there is no line of polar angle, azimuth and value")
    table = np.array(rows)
    if not np.all(np.isfinite(table[:, :4])):
        raise source.error(
            "an angle is not finite", lines[int(np.flatnonzero(~np.all(np.isfinite(table[:, :4]), axis=1))[0])]
        )
    theta_i, phi_s, theta_r, phi_r = (_from_cosines(source, table, lines) if angles_are == "sin" else table[:, :4]).T
    for name, column in (("theta_i", theta_i), ("theta_r", theta_r)):
        check_zenith(source, name, column, lines)
    with np.errstate(over="ignore"):  # an infinite value is missing
        brdf = table[:, 4:] * scale if values_are == "value" else _powers(table[:, 4:], scale)
    note = Finding(
        "specular-azimuth", "each block names its specular direction: the light comes from the opposite azimuth"
    )
    theta_i, phi_s = np.abs(theta_i), np.where(theta_i < 0, phi_s + 180.0, phi_s)
    um, named = commented_wavelength(source, options, ("#", "!"))
    return measurement(
        source, "FRED text", theta_i, phi_s + 180.0, theta_r, phi_r, brdf, wavelength=um, findings=[note, *named]
    )


def _format(source: Source, words, line: int):
    pairs = (word.partition("=") for word in " ".join(words).lower().replace(" =", "=").replace("= ", "=").split())
    said = {key: value for key, equals, value in pairs if equals}
    angles, values = said.get("angles", "deg"), said.get("bsdf", "value")
    if angles not in ("deg", "sin") or values not in ("value", "log"):
        raise source.error(f"'format {' '.join(words)[:60]}': wanted angles=deg or sin, and bsdf=value or log", line)
    scale = source.numbers([said.get("scale", "1")], line)[0]
    if not 0 < scale < np.inf:
        raise source.error(f"scale={said['scale'][:60]}: wanted a positive number", line)
    return angles, values, scale


def _powers(logarithms, scale: float):
    """Powers of ten, NaN beyond what a BRDF can be."""
    sane = np.abs(logarithms) < 300
    return np.where(sane, 10.0 ** np.where(sane, logarithms, 0.0), np.nan) * scale


def _from_cosines(source: Source, table, lines):
    """Polar angle and azimuth [deg] from direction cosines along x and y."""
    angles = []
    for x, y in (table[:, :2].T, table[:, 2:4].T):
        sine = np.hypot(x, y)
        bad = np.flatnonzero(sine > 1 + 1e-9)
        if len(bad):
            raise source.error(f"direction cosines {x[bad[0]]:g}, {y[bad[0]]:g} are longer than 1", lines[int(bad[0])])
        angles += [np.degrees(np.arcsin(np.minimum(sine, 1))), np.degrees(np.arctan2(y, x))]
    return np.stack(angles, axis=1)


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as FRED text, every direction as it was measured, and sentences on what was left out.

    Raises InputError for several channels, and where no value is positive.
    """
    nm = only_channel(measurement, "FRED")
    geom, values = measurement.geom, measurement.brdf[:, 0]
    theta_i, phi_i, theta_r, phi = (
        each[:, 0] for each in (geom.theta_i_deg, geom.phi_i_deg, geom.theta_r_deg, geom.phi_deg)
    )
    kept = values > 0
    if not np.any(kept):
        raise InputError(f"{measurement.name}: no value is positive, and FRED takes no other")
    left_out = int(np.count_nonzero(~kept))
    notes = [f"{left_out} directions without a positive value were left out: FRED takes no other"] if left_out else []
    specular = np.stack([np.round(theta_i, 5), np.round(np.remainder(phi_i, 360.0), 5)], axis=1)
    lines = [f"!! {text}" for text in about(measurement, f"wavelength_nm: {nm:.9g}", *notes)]
    lines += ["type bsdf_data", "format angles=deg bsdf=value scale=1"]
    one_rotation = np.ptp(specular[:, 1]) < 1e-4
    for theta, light in np.unique(specular[kept], axis=0):
        rows = np.flatnonzero(kept & (specular[:, 0] == theta) & (specular[:, 1] == light))
        azimuth = 0.0 if one_rotation else light + 180.0
        lines.append(f"{angle(theta)}\t{angle(np.remainder(azimuth, 360.0))}")
        for row in rows:
            turned = np.remainder(azimuth - 180.0 + phi[row], 360.0)
            lines.append(f"{angle(theta_r[row])}\t{angle(turned)}\t{value(values[row])}")
    return "\n".join(lines) + "\n", notes


FORMAT = Format("fred", (".txt",), recognises, read, write=write)
