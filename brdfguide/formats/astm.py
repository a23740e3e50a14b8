"""ASTM E1392 text `.astm`: `KEY value` lines, `VARS` with the names of the columns, then comma-separated rows.

Angles are in radians unless the header or a name says degrees; values are the BRDF, or times the cosine where the name in
VARS says so. The mirror direction is phi_s - phi_i = 180 degrees.

Source: ASTM E1392, "Angle resolved optical scatter measurements on specular or diffuse surfaces", as the public Cornell files
follow it; no measured file was at hand, and the tests write their own.
"""

import re

from ..measurement import Finding, Measurement
from . import _meaning
from ._base import Format, Options, Source
from ._sheet import Sheet, rows_of


def recognises(head: bytes) -> bool:
    return re.search(rb"^\s*VARS\s+\S*theta", head, re.MULTILINE | re.IGNORECASE) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where the rows do not follow VARS, or are fewer than NUM_POINTS promises."""
    header, names, content = {}, None, []
    for number, text in enumerate(source.lines, 1):
        word, _, rest = text.strip().partition(" ")
        if names is not None:
            if text.strip():
                content.append((number, text))
        elif word.upper() == "VARS":
            names = [name.strip() for name in rest.replace("\t", ",").split(",") if name.strip()]
        elif word:
            header[word.upper().rstrip(":=")] = rest.strip()
    if not names or not content:
        raise source.error("no rows after VARS")
    values, lines = rows_of(source, content, names, ",", ".", [])
    promised = header.get("NUM_POINTS", "")
    if promised.isdigit() and int(promised) > len(values):
        raise source.error(f"truncated: NUM_POINTS promises {promised} rows; found {len(values)}")
    unit = "deg" if any("deg" in value.lower() for key, value in header.items() if "ANG" in key or "UNIT" in key) else "rad"
    comments = [f"{key.lower()}: {value}" for key, value in header.items()]
    result = _meaning.measured(source, Sheet(names, values, lines, comments, []), options, kind="ASTM E1392 text", unit=unit)
    said = "as its header says" if unit == "deg" else "since its header does not say degrees"
    return result.noting(Finding("angle-unit", f"angles in {unit}, {said}", option="--unit"))


FORMAT = Format("astm", (".astm",), recognises, read, own_side=False)
