"""What the user says about a file, checked: words that options take, roles of columns, options without effect."""

import math
from dataclasses import replace

from ...errors import InputError, choices
from .. import conventions
from ..columns.vocabulary import ANGLE_UNITS, LENGTH_UNIT_OF, LENGTH_UNITS
from ..measurement import Measurement
from .format import LONGEST_UM, SHORTEST_UM, Format, Options

# what a column may be, by --columns; those of ANGLES may be one number for the whole table instead
ANGLES = ("theta_i", "phi_i", "theta_r", "phi_r", "dphi", "theta_h", "phi_h", "theta_d", "phi_d", "rotation")
ROLES = (*ANGLES, "phase", "from_mirror", "wavelength", "brdf", "stderr", "ignore")
REPEATABLE = ("brdf", "stderr", "ignore")  # several columns: a channel each, or all of them left out
SENSES = ("ccw", "cw")  # counter-clockwise, clockwise, seen from above the sample
OF_SOME = {  # options that some formats heed, and why the others do not
    "columns": "--columns is for tables; the format of this file ({}) leaves nothing to say",
    "unit": "--unit is for tables; the format of this file ({}) leaves nothing to say",
    "select": "--select is for tables; this format ({}) has no columns",
    "rotation_sense": "--rotation-sense has no effect: this format ({}) says in which sense the sample is turned",
    "average_phi_i": "--average-phi-i has nothing to average: this format ({}) has no rotations",
}


def checked(options: Options) -> Options:
    """The options with columns as a mapping or a list. Raises InputError for a word that no option takes."""
    for word, kind, known in (
        (options.unit, "unit", tuple(ANGLE_UNITS)),
        (options.quantity, "quantity", conventions.QUANTITIES),
        (options.mirror_side, "mirror side", conventions.SIDES),
        (options.rotation_sense, "rotation sense", SENSES),
    ):
        if word is not None and word not in known:
            raise choices(kind, word, known)
    if options.wavelength_nm is not None and not 100 <= options.wavelength_nm <= 100_000:
        raise InputError(f"--wavelength-nm {options.wavelength_nm:g}: wanted 100 to 100000 nm")
    if options.scale is not None and not (1e-12 <= options.scale <= 1e12 and options.scale != 1):
        raise InputError(f"--scale {options.scale:g}: wanted a positive factor other than 1, such as 0.001")
    if isinstance(options.columns, str):
        options = replace(options, columns=_roles(options.columns))
    elif isinstance(options.columns, dict):
        columns = {role: (name,) if isinstance(name, str) else tuple(name) for role, name in options.columns.items()}
        options = replace(options, columns=columns)
    if isinstance(options.columns, dict):
        _check_roles(options.columns)
    return replace(options, select=tuple(_condition(each) for each in options.select or ()))


def heeded(options: Options, format: Format, name: str) -> None:
    """Raises InputError for an option that such a file does not heed."""
    for field, why in OF_SOME.items():
        if getattr(options, field) and field not in format.options:
            raise InputError(f"{name}: {why.format(format.name)}")


def without_effect(options: Options, measurement: Measurement) -> None:
    """Raises InputError for an option about rotations where the file has none, or none that matters."""
    codes = {finding.code: finding for finding in measurement.findings}
    if options.average_phi_i and "averaged-over-rotation" not in codes:
        why = codes["isotropic"].text if "isotropic" in codes else "it holds one rotation of the sample"
        raise InputError(f"{measurement.name}: --average-phi-i has no effect: {why}")
    if options.rotation_sense and "sample-rotation" not in codes:
        raise InputError(f"{measurement.name}: --rotation-sense has no effect: no rotation of the sample is kept")


def _roles(text: str):
    """`theta_i=AOI,brdf=value` as a mapping, `theta_i,theta_r,brdf` as the names of a table without header."""
    parts = [part.strip() for part in text.split(",")]
    if not any("=" in part for part in parts):
        return tuple(parts)
    pairs: list[list[str]] = []
    for part in parts:
        role, equals, name = (each.strip() for each in part.partition("="))
        if pairs and not equals:
            pairs[-1][1] += f",{part}"  # a comma in a column's name
            continue
        if not role or not name:
            raise InputError(
                f"--columns {text}: wanted role=column, such as theta_i=AOI,brdf=value, or names in order for a table "
                f"without header"
            )
        pairs.append([role, name])
    found: dict[str, tuple[str, ...]] = {}
    for role, name in pairs:
        role = "brdf" if role == "value" else role
        found[role] = (*found.get(role, ()), name)
    return found


def _check_roles(columns: dict[str, tuple[str, ...]]) -> None:
    for role, names in columns.items():
        if role not in ROLES:
            raise choices("column role", role, ROLES)
        if len(names) > 1 and role not in REPEATABLE:
            raise InputError(f"--columns gives {role} twice: {' and '.join(names)[:80]}")
        if len(set(names)) < len(names):
            raise InputError(f"--columns gives {role} the same column twice: {names[0][:60]}")


def stated_constant(role: str, text: str) -> float | None:
    """What stands in place of a column, `theta_i=30` [deg], `wavelength=633nm` [µm]; None where it is a name.

    Raises InputError for a role that no number can have, and for a wavelength that no light has.
    """
    number, unit = _number_and_unit(text)
    if number is None:
        return None
    if role == "wavelength" and (unit == "" or unit in LENGTH_UNIT_OF):
        um = number * LENGTH_UNITS[LENGTH_UNIT_OF.get(unit, "nm")][0]
        if not SHORTEST_UM <= um <= LONGEST_UM:
            raise InputError(
                f"--columns wavelength={text}: {1000 * um:g} nm; wanted 100 to 100000 nm, as 633, 633nm or 0.633um"
            )
        return um
    if unit not in ("", "deg", "°"):
        return None
    if role not in ANGLES:
        raise InputError(f"--columns {role}={text}: wanted a column's name; one number for all rows is no {role}")
    return number


def _number_and_unit(text: str) -> tuple[float | None, str]:
    end = len(text)
    while end and (text[end - 1].isalpha() or text[end - 1] in " °"):
        end -= 1
    try:
        number = float(text[:end])
    except ValueError:
        return None, ""
    return (number, text[end:].strip().lower().replace("µ", "μ")) if math.isfinite(number) else (None, "")


def _condition(each) -> tuple[str, str]:
    """`sample=white` as (column, value)."""
    if not isinstance(each, str):
        return tuple(each)
    column, equals, value = (part.strip() for part in each.partition("="))
    if not equals or not column:
        raise InputError(f"--select {each}: wanted column=value, such as sample=white")
    return column, value
