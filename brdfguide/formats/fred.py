"""FRED text: blocks of scattered directions about the normal, each under the specular direction that it belongs to.

`type bsdf_data`, then `format angles=deg|sin bsdf=value|log scale=x`; a line of two numbers is a specular direction (polar,
azimuth), lines of three numbers are scattered directions and their value. With `angles=sin` the pairs are direction cosines
along x and y; `bsdf=log` are decimal logarithms.

Source: Photon Engineering's help on "Tabulated BSDF".
"""

import re

import numpy as np

from ..measurement import Finding, Measurement
from ._base import Format, Options, Source, check_zenith, from_comments, measurement


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
            raise source.error(f"found {len(values)} numbers, wanted 2 (a specular direction) or 3 (a scattered direction and its value)", number)
        elif specular is None:
            raise source.error("a value comes before any specular direction of two numbers", number)
        else:
            rows.append((*specular, *values))
            lines.append(number)
    if not rows:
        raise source.error("there is no line of polar angle, azimuth and value")
    table = np.array(rows)
    if not np.all(np.isfinite(table[:, :4])):
        raise source.error("an angle is not finite", lines[int(np.flatnonzero(~np.all(np.isfinite(table[:, :4]), axis=1))[0])])
    theta_i, phi_s, theta_r, phi_r = (_from_cosines(source, table, lines) if angles_are == "sin" else table[:, :4]).T
    for name, column in (("theta_i", theta_i), ("theta_r", theta_r)):
        check_zenith(source, name, column, lines)
    brdf = table[:, 4:] * scale if values_are == "value" else _powers(table[:, 4:], scale)
    note = Finding("specular-azimuth", "each block names its specular direction: the light comes from the opposite azimuth")
    theta_i, phi_s = np.abs(theta_i), np.where(theta_i < 0, phi_s + 180.0, phi_s)
    um, named = from_comments("\n".join(line for line in source.lines if line.lstrip().startswith(("#", "!"))))
    return measurement(source, "FRED text", theta_i, phi_s + 180.0, theta_r, phi_r, brdf, wavelength=um, findings=[note, *named])


def _format(source: Source, words, line: int):
    said = dict(re.findall(r"(\w+)\s*=\s*(\S+)", " ".join(words).lower()))
    angles, values = said.get("angles", "deg"), said.get("bsdf", "value")
    if angles not in ("deg", "sin") or values not in ("value", "log"):
        raise source.error(f"'format {' '.join(words)[:60]}': wanted angles=deg or sin, and bsdf=value or log", line)
    return angles, values, source.numbers([said.get("scale", "1")], line)[0]


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


FORMAT = Format("fred", (".txt",), recognises, read)
