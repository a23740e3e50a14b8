"""Angles of a table in degrees, out of every unit, elevation, cosine or sine that tables give them in."""

import numpy as np

from ...finding import Finding
from ..columns import prose
from ..columns.facts import Column
from ..columns.vocabulary import ANGLE_UNITS
from .format import Options, degrees

OF_DIRECTIONS = (
    "theta_i", "phi_i", "theta_r", "phi_r", "dphi", "theta_h", "phi_h", "theta_d", "phase", "from_mirror", "rotation",
)  # fmt: skip
NAME_IT = "write the unit into its name, such as (deg) or (rad)"
SMALL = {"mrad", "arcmin", "arcsec"}  # units of small angles: who names one of a column means that one
UNNAMED = ("theta_i", "theta_r", "theta_h", "theta_d")  # zeniths whose values tell degrees from radians


def in_degrees(source, table, columns: dict[str, Column], options: Options, unit: str | None, notes):
    """Each column of angles in degrees, cosines and components as they are; and the units, and how they are known."""
    raw = {role: table.values[:, column.place] for role, column in columns.items()}
    plain = {role: raw[role] for role in columns if role in OF_DIRECTIONS and columns[role].form in ("", "elevation")}
    units, said = _units(source, {role: columns[role] for role in plain}, plain, table, options, unit, notes)
    if units:
        said = f"angles in {' and '.join(sorted(set(units.values())))}, {said}"
    for role in plain:
        factor = ANGLE_UNITS[units[role]][0]
        if units[role] == "rad":
            raw[role] = degrees(raw[role])
        elif factor != 1:
            with np.errstate(over="ignore", invalid="ignore"):
                raw[role] = np.round(raw[role] * factor, 9)
        if columns[role].form == "elevation":
            raw[role] = 90.0 - raw[role]
            notes.append(Finding("elevation", f"'{columns[role].name}' is an elevation: zenith angle 90 minus it"))
    for role, column in columns.items():
        if column.form in ("cos", "sin"):
            raw[role] = _of_function(source, table, column)
            notes.append(Finding("angle-function", f"'{column.name}' is the {_FUNCTION[column.form]} of {role}"))
    return raw, said


_FUNCTION = {"cos": "cosine", "sin": "sine"}


def _of_function(source, table, column: Column) -> np.ndarray:
    """Degrees out of a cosine or sine. Raises InputError beyond 1."""
    values = table.values[:, column.place]
    bad = np.flatnonzero(np.abs(values) > 1 + 1e-6)
    if len(bad):
        text = f"column '{column.name}': found {values[bad[0]]:g}; a {_FUNCTION[column.form]} lies within -1..1"
        raise source.error(text, int(table.lines[bad[0]]))
    inverse = np.arccos if column.form == "cos" else np.arcsin
    return degrees(inverse(np.clip(values, -1, 1)))


def _units(source, columns, raw, table, options: Options, unit: str | None, notes) -> tuple[dict[str, str], str]:
    """The unit of each column of angles, and how it is known: the option, its name, the others, comments or values."""
    if not columns:
        if options.unit:
            raise source.error(f"--unit {options.unit} has no effect: no column holds angles as such")
        return {}, ""
    if options.unit:
        return dict.fromkeys(columns, options.unit), "as --unit says"
    named = {role: column.unit for role, column in columns.items() if column.unit in ANGLE_UNITS}
    if len(named) == len(columns):
        return named, "as the names say"
    if named:
        chosen, said = _as_its_like(source, columns, named), "as the names say"
    elif unit:
        chosen, said = dict.fromkeys(columns, unit), "as the header says"
    elif commented := prose.angle_unit_in(table.comments):
        chosen, said = dict.fromkeys(columns, commented), "as a comment says"
    else:
        chosen, said = dict.fromkeys(columns, _inferred(source, raw, notes)), "from their values"
    for role in columns.keys() - named.keys():
        if chosen[role] == "deg" and _are_radians(raw[role], role in UNNAMED):
            text = f"column '{columns[role].name}' names no unit, and its values look like radians beside degrees"
            raise source.error(f"{text}; {NAME_IT}, or say --unit deg if all are")
    return chosen, said


def _as_its_like(source, columns: dict[str, Column], named: dict[str, str]) -> dict[str, str]:
    """The unit of each column: its own, or that of others, first of zeniths among zeniths and azimuths among azimuths.
    Raises InputError where these differ, and where the others' is one for small angles alone."""
    chosen = dict(named)
    for role in columns.keys() - named.keys():
        like = {unit for other, unit in named.items() if (other in UNNAMED) == (role in UNNAMED)} or set(named.values())
        if len(like) > 1 or like <= SMALL:
            text = f"column '{columns[role].name}' names no unit, and others are in {' and '.join(sorted(like))}"
            raise source.error(f"{text}; {NAME_IT}, or say --unit for all")
        chosen[role] = next(iter(like))
    return chosen


def _are_radians(values, is_zenith: bool) -> bool:
    """Whether these are steps of quarter degrees in radians and not in degrees, or end at a half or a whole turn."""
    told = np.abs(values[np.isfinite(values) & (values != 0)])
    largest = float(told.max(initial=0.0))
    if not 0.1 < largest < (1.58 if is_zenith else 6.3) or _share_of_quarters(told) > 0.5:
        return False
    at_a_turn = not is_zenith and any(0.98 * end < largest < 1.001 * end for end in (np.pi, 2 * np.pi))
    return at_a_turn or _share_of_quarters(np.degrees(told)) > 0.9


def _inferred(source, raw, notes) -> str:
    """`deg` or `rad`, from the values."""
    zeniths = [raw[role] for role in UNNAMED if role in raw] or list(raw.values())
    theta = np.abs(np.concatenate(zeniths or [np.zeros(0)]))
    theta = theta[np.isfinite(theta)]
    azimuth = np.concatenate([raw[role] for role in raw if role not in UNNAMED] or [np.zeros(1)])
    largest, turn = float(theta.max(initial=0.0)), float(np.abs(azimuth[np.isfinite(azimuth)]).max(initial=0.0))
    if not len(theta) or largest > 1.58 or turn > 6.3:
        return "deg"
    as_degrees, as_radians = _share_of_quarters(theta), _share_of_quarters(np.degrees(theta))
    if as_radians > 0.9 and as_degrees < 0.5 or (largest > 0.5 and 3.1 < turn < 6.3):
        text = f"no angle exceeds {max(largest, turn):.3g}: taken as radians"
        notes.append(Finding("radians-inferred", text, option="--unit deg"))
        return "rad"
    if largest < 1e-9:
        return "deg"
    text = f"no angle exceeds {max(largest, turn):.3g} and no column names a unit; say --unit deg or --unit rad"
    raise source.error(text)


def _share_of_quarters(values) -> float:
    """How many are multiples of a quarter, as instruments step."""
    return float(np.mean(np.abs(values * 4 - np.round(values * 4)) < 4e-3))
