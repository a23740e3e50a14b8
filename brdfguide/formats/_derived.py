"""Columns that hold what is wanted in another form: one for each incidence, angles from the mirror direction, logarithms."""

import re
from dataclasses import replace

import numpy as np

from ..measurement import Finding
from . import _columns
from ._sheet import Sheet

_VALUE = r"(?:(?:brdf|bsdf|f_?r|value|ccbrdf)\b[\s_@,:(]*)?"
_INCIDENCE = r"(?:(?:theta_?i(?:n|nc)?|theta_?0|aoi|angle of incidence|inc(?:idence|ident)?(?:[ _]angle)?|at)[\s_=:@(]*)?"
AT_INCIDENCE = re.compile(rf"{_VALUE}{_INCIDENCE}(\d+(?:\.\d+)?)\s*(?:deg|degs|degrees?|°)?[)\]]?", re.IGNORECASE)
LOGARITHM = re.compile(r"log_?(?:10)?[\s_]*[(\[]?\s*((?:brdf|bsdf|f_?r)\b[^)]*)[)\]]?", re.IGNORECASE)
FROM_MIRROR = re.compile(
    r"(?:scatter(?:ing)? |scattered )?(?:angle|theta|deg(?:rees)?)?[\s_]*(?:from|off|to|about|relative to)[\s_]*(?:the )?(?:specular|mirror)\b.*"
    r"|aspecular\b.*|theta_?[sr]\s*-\s*theta_?(?:i|0|spec)\b.*",
    re.IGNORECASE,
)
FROM_MIRROR_SINE = re.compile(r"\|?\s*(?:beta_?s?|β_?s?)\s*-\s*(?:beta_?(?:0|o|i)|β_?(?:0|₀|o|i))\s*\|?", re.IGNORECASE)


def plain(table: Sheet, notes: list[Finding]) -> Sheet:
    """The table with columns of angles and values in their place; each change is noted."""
    return _from_mirror(_logarithms(_by_incidence(table, notes), notes), notes)


def _by_incidence(table: Sheet, notes) -> Sheet:
    """A column for each incidence, under one column of reflected angles, to one value a row."""
    found = [AT_INCIDENCE.fullmatch(name.strip()) for name in table.names]
    angles = {place: float(match[1]) for place, match in enumerate(found) if match and float(match[1]) < 90}
    roles = {column.role for column in _columns.table([name for place, name in enumerate(table.names) if place not in angles])}
    if len(angles) < 2 or len(set(angles.values())) < len(angles) or "theta_r" not in roles or roles & {"theta_i", "value"}:
        return table
    others = [place for place in range(len(table.names)) if place not in angles]
    blocks = [np.column_stack([table.values[:, others], np.full(len(table.values), angle), table.values[:, place]]) for place, angle in angles.items()]
    text = f"columns for {len(angles)} incidences, {', '.join(f'{angle:g}' for angle in list(angles.values())[:8])} degrees, from their names"
    notes.append(Finding("incidence-columns", text, option="--columns"))
    names = [*(table.names[place] for place in others), "theta_i [deg]", "brdf"]
    return replace(table, names=names, values=np.concatenate(blocks), lines=np.tile(table.lines, len(angles)))


def _logarithms(table: Sheet, notes) -> Sheet:
    for place, name in enumerate(table.names):
        if match := LOGARITHM.fullmatch(name.strip()):
            notes.append(Finding("logarithms", f"'{name}': decimal logarithms, taken as powers of ten"))
            values = table.values.copy()
            values[:, place] = np.where(np.abs(values[:, place]) < 300, 10.0 ** np.clip(values[:, place], -300, 300), np.nan)
            table = replace(table, names=[match[1] if at == place else each for at, each in enumerate(table.names)], values=values)
    return table


def _from_mirror(table: Sheet, notes) -> Sheet:
    """Angles counted from the mirror direction, or differences of sines, to reflected angles; needs a column of incidences."""
    columns = _columns.table(table.names)
    incidence = next((column for column in columns if column.role == "theta_i"), None)
    for place, name in enumerate(table.names):
        sine = FROM_MIRROR_SINE.fullmatch(name.strip())
        if incidence is None or not (sine or FROM_MIRROR.fullmatch(name.strip())):
            continue
        values, rad = table.values.copy(), incidence.unit == "rad"
        theta_i = values[:, incidence.place] if rad else np.radians(values[:, incidence.place])
        with np.errstate(invalid="ignore"):
            theta_r = np.arcsin(np.sin(theta_i) + values[:, place]) if sine else theta_i + (values[:, place] if columns[place].unit == "rad" or rad else np.radians(values[:, place]))
        theta_r[np.abs(theta_r) > 0.5 * np.pi] = np.nan
        values[:, place] = theta_r if rad else np.round(np.degrees(theta_r), 9)
        unit = " [rad]" if rad else " [deg]" if incidence.unit == "deg" else ""
        text = f"'{name}' counts from the mirror direction: added to theta_i" + (" as sines" if sine else "") + ", positive toward grazing"
        notes.append(Finding("angle-from-mirror", text, option="--columns"))
        table = replace(table, names=["theta_r" + unit if at == place else each for at, each in enumerate(table.names)], values=values)
    return table
