"""ASTM E1392 text `.astm`: `KEY value` lines, `VARS` with the names of the columns, then comma-separated rows.

Angles are in radians unless the header or a name says degrees; values are the BRDF, or times the cosine where the name
in VARS says so. The mirror direction is phi_s - phi_i = 180 degrees.

Source: ASTM E1392, "Angle resolved optical scatter measurements on specular or diffuse surfaces", as the public Cornell
files follow it, and what the programs that write and read such files do; no measured file was at hand, and the tests
write their own.
"""

import re

import numpy as np

from ...finding import Finding
from ..measurement import Measurement
from . import _meaning
from ._cells import cells_of
from ._sheet import COMMENTS, Sheet, rows_of
from ._writing import about, value, wavelengths
from ._written import Style
from .format import Format, Options, Source


def recognises(head: bytes) -> bool:
    return (
        re.search(rb"^[ \t]*VARS[ \t]{0,99}[:=]?[ \t]{0,99}[^\s]{0,99}theta", head, re.MULTILINE | re.IGNORECASE)
        is not None
    )


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where the rows do not follow VARS, or are fewer than NUM_POINTS promises."""
    header, names = {}, None
    content: list[tuple[int, str]] = []
    for number, text in enumerate(source.lines, 1):
        word, rest = (re.split(r"[\s:=]+", text.strip(), maxsplit=1) + [""])[:2]
        if text.lstrip().startswith(COMMENTS):
            continue
        if names is not None and (content or not word[:1].isalpha()):  # keys may follow VARS, before the rows
            if text.strip():
                content.append((number, text))
        elif word.upper() == "VARS":
            names = [
                name.strip()
                for name in re.split(r"[,;\t]" if re.search(r"[,;\t]", rest) else r"\s+", rest)
                if name.strip()
            ]
        elif word:
            header[word.upper()] = rest.strip()
    if not names or not content:
        raise source.error("no rows after VARS")
    delimiter = next((mark for mark in (",", ";", "\t") if mark in content[0][1]), None)
    names, notes = _with_phi_s(names, len(cells_of(content[0][1], delimiter)))
    values, lines, texts, _ = rows_of(source, content, names, Style(delimiter), [])
    promised = header.get("NUM_POINTS", "")
    if promised.isdecimal() and int(promised) > len(values):
        raise source.error(f"truncated: NUM_POINTS promises {promised} rows; found {len(values)}")
    if promised.isdecimal() and int(promised) < len(values):
        text = f"NUM_POINTS promises {promised} rows, and {len(values)} follow: all were taken"
        numbers = (("promised", int(promised)), ("rows", len(values)))
        notes.append(Finding("rows-beyond-count", text, "warning", numbers=numbers))
    unit, why = _unit(header, names, values)
    comments = [f"{key.lower()}: {value}{_wave_unit(key, value)}" for key, value in header.items()]
    result = _meaning.measurement_of(
        source, Sheet(names, values, lines, comments, [], texts=texts), options, kind="ASTM E1392 text", unit=unit
    )
    return result.noting(*notes, Finding("angle-unit", f"angles in {unit}, {why}", option="--unit"))


def _with_phi_s(names, width: int):
    """VARS that forget phi_s although the rows hold it, as some programs write them."""
    lower = [name.lower() for name in names]
    if width != len(names) + 1 or "theta_s" not in lower or "phi_s" in lower or "phi_i" not in lower:
        return names, []
    place = lower.index("theta_s") + 1
    note = Finding(
        "column-unnamed",
        f"VARS names {len(names)} columns and the rows hold {width}: the one after theta_s is taken as phi_s",
        option="--columns",
    )
    return [*names[:place], "phi_s", *names[place:]], [note]


def _unit(header, names, values):
    """`deg` or `rad`, and why: what the header says, else radians, unless a zenith is far too large for one."""
    if any("deg" in value.lower() for key, value in header.items() if "ANG" in key or "UNIT" in key):
        return "deg", "as its header says"
    zeniths = values[:, [place for place, name in enumerate(names) if name.lower().startswith("theta")]]
    if np.nanmax(np.abs(zeniths), initial=0.0) > 1.6:
        return "deg", "since a zenith angle beyond pi/2 is none in radians"
    return "rad", "since its header does not say degrees"


def _wave_unit(key: str, value: str) -> str:
    """A bare number under WAVELENGTH is in micrometres, as the standard has it, or in nanometres."""
    if "WAVELENGTH" not in key or not re.fullmatch(r"\d+(\.\d+)?", value):
        return ""
    return " um" if float(value) < 50 else " nm"


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as ASTM E1392 text in radians, every direction as it was measured, and sentences on it.

    Missing values are 0, since the standard's rows have no mark for them.
    """
    geom, nm = measurement.geom, wavelengths(measurement)
    names = list(measurement.channels)
    lines = [f"COMMENT{place}\t{text}" for place, text in enumerate(about(measurement), 1)]
    if len(names) == 1:
        names = ["BRDF"]
        lines.append(f"WAVELENGTH\t{nm[0] / 1000:.9g}")
    elif not set(names) <= {"R", "G", "B", "X", "Y", "Z"}:
        names = [f"{each:.9g}nm" for each in nm]
    angles = [geom.theta_i_deg, geom.phi_i_deg, geom.theta_r_deg, geom.phi_i_deg + geom.phi_deg]
    radians = np.concatenate([np.radians(np.round(np.remainder(each, 360.0), 9)) for each in angles], axis=1)
    values = np.nan_to_num(measurement.brdf)
    lines += [
        "ANGLE_UNITS\tradians",
        f"NUM_POINTS\t{len(geom)}",
        f"VARS\ttheta_i,phi_i,theta_s,phi_s,{','.join(names)}",
    ]
    for where, row in zip(radians.tolist(), values.tolist(), strict=True):
        lines.append(",".join([*(f"{each:.12g}" for each in where), *map(value, row)]))
    notes = []
    if missing := int(np.count_nonzero(~np.isfinite(measurement.brdf))):
        notes.append(f"{missing} missing values are written as 0")
    if measurement.stderr is not None:
        notes.append("standard errors have no place in this format: left out")
    return "\n".join(lines) + "\n", notes


FORMAT = Format(
    "astm", (".astm",), recognises, read, own_side=False, options=("columns", "unit", "select"), write=write
)
