"""Gonioreflectometer tables: rows of numbers under named columns, separated by anything sensible.

Long form has one value a row (and perhaps a wavelength column), wide form a column for each wavelength or colour. Without
azimuth columns the scan lies in the plane of incidence and theta_r carries a sign, positive on the mirror side.
What a name does not say is inferred from the values, and noted.
"""

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from .. import conventions
from ..errors import InputError, choices
from ..measurement import Finding, Measurement
from . import _columns
from ._base import RGB_UM, XYZ_UM, Format, Options, Source, check_zenith, measurement, nominal_colours
from ._sheet import Sheet, sheet

SETTABLE = ("theta_i", "phi_i", "theta_r", "phi_r", "dphi", "wavelength", "brdf", "stderr")


def recognises(head: bytes) -> bool:
    """Any text: this reader takes what no other claims."""
    return b"\0" not in head or head[:2] in (b"\xff\xfe", b"\xfe\xff")


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError naming line and column, what was found and what was wanted."""
    headerless = options.columns if isinstance(options.columns, tuple) else None
    table = sheet(source, headerless)
    columns, constants = _assigned(table, options, source)
    notes = [Finding("lines-skipped", f"skipped {text}") for text in table.notes[:5]]
    roles = {column.role: column for column in columns if column.role in SETTABLE}
    angles, lost = _angles(source, table, columns, roles, constants, options, notes)
    values = [column for column in columns if column.role == "value"]
    if not values:
        raise _missing("brdf", table, source)
    ignored = [column.name for column in columns if column.role is None]
    if ignored:
        listed = ", ".join(ignored[:6]) + (f" and {len(ignored) - 6} more" if len(ignored) > 6 else "")
        notes.append(Finding("columns-ignored", f"columns ignored: {listed}", option="--columns"))
    if lost:
        notes.append(Finding("rows-without-angles", f"{lost} rows without all angles were dropped", numbers=(("rows", lost),)))
    angles, brdf, stderr, channels, um = _channels(source, table, columns, roles, constants, values, angles, notes)
    result = measurement(source, "table", *angles, brdf, channels=channels, wavelength=um, stderr=stderr, findings=notes)
    return _stated(_on_its_side(result, "phi_r" in roles or "dphi" in roles, options), values, table, options)


# --- which column is what ---------------------------------------------------------------------------------


def _assigned(table: Sheet, options: Options, source: Source):
    """Columns with their roles, after --columns; and angles that are one number for the whole file."""
    columns = _columns.table(table.names)
    constants = _from_comments(table.comments)
    if isinstance(options.columns, Mapping):
        lower = [name.lower() for name in table.names]
        for role, name in options.columns.items():
            if role not in SETTABLE and role != "value":
                raise choices("column role", role, SETTABLE)
            role = "value" if role == "brdf" else role
            if re.fullmatch(r"[-+]?\d+(\.\d*)?", name) and name not in table.names:
                constants[role] = float(name)
                columns = [_renamed(column, None) if column.role == role else column for column in columns]
                continue
            if name.lower() not in lower:
                raise choices(f"column in {source.name}", name, table.names)
            place = lower.index(name.lower())
            columns = [_renamed(column, role if column.place == place else None if column.role == role else column.role) for column in columns]
    for role in SETTABLE:
        same = [column.name for column in columns if column.role == role and column.channel is None]
        if len(same) > 1:
            raise source.error(f"the columns {' and '.join(repr(name) for name in same)} both look like {role}; say which with --columns {role}={same[0]}")
    single = [column for column in columns if column.role == "value" and column.channel is None]
    if len(single) > 1:
        raise source.error(f"the columns {' and '.join(repr(c.name) for c in single)} both look like the BRDF; say which with --columns brdf={single[0].name}")
    if single and any(column.channel for column in columns if column.role == "value"):
        columns = [_renamed(column, None) if column is single[0] else column for column in columns]
    return columns, constants


def _renamed(column: _columns.Column, role: str | None) -> _columns.Column:
    return replace(column, role=role)


def _from_comments(comments) -> dict[str, float]:
    """`# theta_i: 45`, `# wavelength_nm = 532`, `lambda = 532 nm`, `2-5.7 um band` among the comments."""
    found = {}
    text = "\n".join(comments)
    if match := re.search(r"\btheta_?i(?:_deg)?\s*[:=]\s*([-+]?\d+(?:\.\d+)?)\s*(?:deg|°|$)", text, re.IGNORECASE | re.MULTILINE):
        found["theta_i"] = float(match[1])
    wave = r"(?:wavelength|lambda|λ)(?:_?(nm|um|µm))?\s*(?:[:=]|is|of)?\s*(?:lambda)?\s*[:=]?\s*(\d+(?:\.\d+)?)\s*(nm|um|µm|microns?)?"
    if (match := re.search(wave, text, re.IGNORECASE)) and (unit := match[3] or match[1]):
        found["wavelength"] = float(match[2]) * _columns.TO_UM[_columns.UNITS[unit.lower()]]
    elif match := re.search(r"(\d+(?:\.\d+)?)\s*(?:-|to|\.\.)\s*(\d+(?:\.\d+)?)\s*(nm|um|µm)\b", text, re.IGNORECASE):
        found["wavelength"] = 0.5 * (float(match[1]) + float(match[2])) * _columns.TO_UM[_columns.UNITS[match[3].lower()]]
        found["band"] = 1.0
    return found


def _missing(role: str, table: Sheet, source: Source) -> InputError:
    """The error for a column that is not there, with the nearest name that is."""
    from difflib import get_close_matches

    near = get_close_matches(role, [name.lower() for name in table.names], n=1, cutoff=0.4)
    hint = f"; is it '{table.names[[n.lower() for n in table.names].index(near[0])]}'?" if near else ""
    return source.error(f"no column for {role}{hint} Columns found: {', '.join(table.names)[:120]}; say which with --columns {role}=NAME")


# --- angles -----------------------------------------------------------------------------------------------


def _angles(source, table, columns, roles, constants, options, notes):
    """theta_i, phi_i, theta_r, phi_r [deg] for the rows that have them all, and how many do not. Shortens `table` in place of a copy."""
    if "theta_r" not in roles:
        raise _missing("theta_r", table, source)
    if "theta_i" not in roles and "theta_i" not in constants:
        raise _missing("theta_i", table, source)
    raw = {role: table.values[:, roles[role].place] for role in ("theta_i", "phi_i", "theta_r", "phi_r", "dphi") if role in roles}
    factor = _factor(source, raw, roles, options, notes)
    raw = {role: np.degrees(values) if factor == "rad" else values for role, values in raw.items()}
    if "theta_i" not in raw:
        raw["theta_i"] = np.full(len(table.values), constants["theta_i"])
        notes.append(Finding("theta-i-constant", f"theta_i = {constants['theta_i']:g} degrees for the whole file"))
    raw = _unswapped(raw, notes)
    for name in ("theta_i", "theta_r"):
        finite = np.isfinite(raw[name])
        check_zenith(source, name, np.where(finite, raw[name], 0.0), table.lines)
    phi_i = raw.get("phi_i", np.zeros_like(raw["theta_i"]))
    if "phi_r" in raw:
        phi_r = raw["phi_r"]
        if "dphi" in raw and "phi_i" not in raw:  # `phi` beside `phir`: the azimuth of the light
            phi_i = raw["dphi"]
    elif "dphi" in raw:
        phi_r = phi_i + raw["dphi"]
    else:
        phi_r = phi_i + 180.0
        notes.append(Finding("in-plane-assumed", "no azimuth column: taken as a scan in the plane of incidence", option="--columns"))
    angles = np.stack(np.broadcast_arrays(raw["theta_i"], phi_i, raw["theta_r"], phi_r))
    whole = np.all(np.isfinite(angles), axis=0)
    if not np.any(whole):
        raise source.error("no row has all its angles")
    lost = int(np.count_nonzero(~whole))
    if lost:
        object.__setattr__(table, "values", table.values[whole])
        object.__setattr__(table, "lines", table.lines[whole])
    signed = "phi_r" not in raw and "dphi" not in raw
    if np.any(angles[0, whole] < 0):
        text = "theta_i is negative: the light comes from the azimuth opposite to phi_i"
        notes.append(Finding("negative-theta-i", text, option="--mirror-side"))
    return _with_signs(angles[:, whole], signed, options), lost


def _with_signs(angles, signed: bool, options: Options):
    """Negative incidence: the light comes from the other side, so the mirror direction has the opposite sign as well."""
    theta_i, phi_i, theta_r, phi_r = angles
    if options.mirror_side:
        theta_i = np.abs(theta_i)
        if options.mirror_side in ("negative", "phi=0"):
            phi_r = phi_r + 180.0
    elif signed and np.all(theta_i <= 0):  # in one plane and always negative: theta_r > 0 is the mirror side
        theta_i = np.abs(theta_i)
    return theta_i, phi_i, theta_r, phi_r


def _factor(source, raw, roles, options, notes) -> str:
    """`deg` or `rad`: the option, the names, or the values."""
    if options.unit:
        return options.unit
    units = {roles[role].unit for role in raw if roles[role].unit in ("deg", "rad")}
    if len(units) == 2:
        raise source.error("some angle columns are named in degrees and some in radians; say which with --unit deg or --unit rad")
    if units:
        return units.pop()
    theta = np.concatenate([raw[role] for role in ("theta_i", "theta_r") if role in raw])
    theta = np.abs(theta[np.isfinite(theta)])
    azimuth = np.concatenate([raw[role] for role in raw if role not in ("theta_i", "theta_r")] or [np.zeros(1)])
    largest, turn = float(theta.max(initial=0.0)), float(np.abs(azimuth[np.isfinite(azimuth)]).max(initial=0.0))
    if largest > 1.58 or turn > 6.3:
        return "deg"
    tidy = lambda values: float(np.mean(np.abs(values * 4 - np.round(values * 4)) < 4e-3))  # noqa: E731  multiples of a quarter
    as_degrees, as_radians = tidy(theta), tidy(np.degrees(theta))
    if as_radians > 0.9 and as_degrees < 0.5 or (largest > 0.5 and 3.1 < turn < 6.3):
        notes.append(Finding("radians-inferred", f"no angle exceeds {max(largest, turn):.3g}: taken as radians", option="--unit deg"))
        return "rad"
    if largest < 1e-9:
        return "deg"
    raise source.error(f"no angle exceeds {max(largest, turn):.3g} and no column names a unit; say --unit deg or --unit rad")


def _unswapped(raw, notes):
    """Laboratories that call the zenith phi and the azimuth theta: told by zeniths beyond 90 degrees, or by their standing still."""
    if "phi_i" not in raw or "phi_r" not in raw:
        return raw
    thetas = np.concatenate([raw["theta_i"], raw["theta_r"]])
    phis = np.concatenate([raw["phi_i"], raw["phi_r"]])
    thetas, phis = thetas[np.isfinite(thetas)], phis[np.isfinite(phis)]
    if not len(phis) or np.abs(phis).max() > 90.005:
        return raw
    still = all(len(np.unique(raw[name][np.isfinite(raw[name])])) == 1 for name in ("theta_i", "theta_r"))
    if np.abs(thetas).max() <= 90.005 and not (still and len(np.unique(phis)) > 3):
        return raw
    text = "the columns named phi hold the zenith angles and those named theta the azimuths: exchanged"
    notes.append(Finding("phi-is-zenith", text, consequence="read as named, no direction would be possible", option="--columns"))
    return {**raw, "theta_i": raw["phi_i"], "phi_i": raw["theta_i"], "theta_r": raw["phi_r"], "phi_r": raw["theta_r"]}


# --- values -----------------------------------------------------------------------------------------------


def _channels(source, table, columns, roles, constants, values, angles, notes):
    """Angles, brdf and stderr (samples, channels), channel names and wavelengths [µm] or None."""
    errors = [column for column in columns if column.role == "stderr"]
    if "wavelength" in roles and len(values) == 1:
        return _pivoted(source, table, roles["wavelength"], values[0], errors, angles, notes)
    brdf = table.values[:, [column.place for column in values]]
    channels = [column.channel or "brdf" for column in values]
    by_channel = {column.channel: column for column in errors}
    stderr = None
    if errors and all(column.channel in by_channel for column in values):
        stderr = table.values[:, [by_channel[column.channel].place for column in values]]
        stderr = _absolute(stderr, brdf, errors[0])
    if all(column.um is not None for column in values):
        return angles, brdf, stderr, channels, np.array([column.um for column in values])
    if all(name in {**RGB_UM, **XYZ_UM} for name in channels):
        notes.append(nominal_colours(channels))
        return angles, brdf, stderr, channels, np.array([{**RGB_UM, **XYZ_UM}[name] for name in channels])
    um = constants.get("wavelength")
    if um is not None:
        what = "middle of the band" if "band" in constants else "wavelength"
        notes.append(Finding("wavelength-from-comment", f"{what} {um * 1000:g} nm, from the comments", option="--columns wavelength=NM"))
    return angles, brdf, stderr, channels, None if um is None else np.full(len(channels), um)


def _absolute(stderr, brdf, column):
    """Standard errors given in percent or relative, as 1/sr."""
    if column.unit == "%":
        return stderr / 100 * np.abs(brdf)
    return stderr * np.abs(brdf) if "rel" in column.name.lower() else stderr


def _pivoted(source, table, column, value, errors, angles, notes):
    """Long form to (samples, channels): one row for each direction, NaN where a wavelength was not measured there."""
    waves = table.values[:, column.place]
    um = waves * _wave_unit(source, column, waves, notes)
    keep = np.isfinite(um) & (um > 0)
    if not np.all(keep):
        raise source.error(f"column '{column.name}': found {waves[~keep][0]:g}, wanted a wavelength", int(table.lines[~keep][0]))
    wavelengths, channel = np.unique(np.round(um, 9), return_inverse=True)
    keys = np.round(np.stack(angles, axis=1), 7)
    directions, first, row = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    row = row.reshape(-1)
    order = np.lexsort((np.arange(len(row)), channel, row))
    cell = row[order] * len(wavelengths) + channel[order]
    starts = np.flatnonzero(np.r_[True, np.diff(cell) != 0])
    repeat = np.empty(len(row), int)
    repeat[order] = np.arange(len(row)) - np.repeat(starts, np.diff(np.r_[starts, len(row)]))
    slots, place = np.unique(first[row] + repeat * len(row), return_inverse=True)
    shape = (len(slots), len(wavelengths))
    brdf, origin = np.full(shape, np.nan), slots % len(row)
    brdf[place, channel] = table.values[:, value.place]
    stderr = None
    if len(errors) == 1:
        stderr = np.full(shape, np.nan)
        stderr[place, channel] = _absolute(table.values[:, errors[0].place], table.values[:, value.place], errors[0])
    if repeat.max():
        text = f"{int(np.count_nonzero(repeat))} rows repeat a direction and wavelength: kept as measurements of their own"
        notes.append(Finding("repeated-rows", text, numbers=(("rows", int(np.count_nonzero(repeat))),)))
    return [each[origin] for each in angles], brdf, stderr, [f"{each * 1000:g}nm" for each in wavelengths], wavelengths


def _wave_unit(source, column, waves, notes) -> float:
    if column.unit in _columns.TO_UM:
        return _columns.TO_UM[column.unit]
    middle = float(np.nanmedian(waves))
    for low, high, unit in ((100, 30000, "nm"), (0.1, 30, "um"), (1e-7, 3e-5, "m")):
        if low <= middle <= high:
            notes.append(Finding("wavelength-unit", f"wavelengths near {middle:g} are taken as {unit}", option="a unit in the column's name"))
            return _columns.TO_UM[unit]
    raise source.error(f"column '{column.name}': wavelengths near {middle:g}; wanted nm or um, with the unit in the name")


# --- conventions that the names leave open ----------------------------------------------------------------


def _on_its_side(result: Measurement, azimuths: bool, options: Options) -> Measurement:
    """Turns the directions by 180 degrees where the values say so; notes what was decided, and from what."""
    if options.mirror_side:
        text = f"mirror side {options.mirror_side}, as --mirror-side says"
        return result.noting(Finding("mirror-side-by-option", text))
    side = conventions.side_of(result.geom, result.brdf)
    numbers = (("ln_ahead_over_behind", side.contrast), ("largest", side.largest), ("growth", side.growth))
    turn = side.verdict == "turned" and (side.certain or not azimuths)
    if turn:
        result = replace(result, geom=conventions.turned(result.geom))
        where, option = ("phi_r - phi_i = 0", "--mirror-side phi=180") if azimuths else ("negative theta_r", "--mirror-side positive")
    else:
        where, option = ("phi_r - phi_i = 180", "--mirror-side phi=0") if azimuths else ("positive theta_r", "--mirror-side negative")
    doubtful = side.verdict in ("retro", "untold") and not azimuths or side.verdict == "turned" and not side.certain
    code = "mirror-side-turned" if turn else "mirror-side"
    severity = "warning" if doubtful else "note"
    return result.noting(Finding(code, f"mirror direction at {where}: {side.text}", severity, option=option, numbers=numbers))


def _stated(result: Measurement, values, table: Sheet, options: Options) -> Measurement:
    """The quantity that a column's name or a comment states, undone; --quantity comes before it."""
    stated = values[0].quantity
    for comment in table.comments:
        if match := re.match(r"quantity\s*[:=]\s*([\w-]+)", comment, re.IGNORECASE):
            stated = match[1].lower()
    if options.quantity or stated not in ("brdf-cos", "reflectance-factor", "brdf"):
        return result
    text = f"'{values[0].name}' states {stated}" + ("" if stated == "brdf" else ": converted to BRDF")
    return conventions.as_brdf(result, stated).noting(Finding("quantity-stated", text, option="--quantity"))


FORMAT = Format("table", (".csv", ".txt", ".dat", ".tsv"), recognises, read, own_side=False)
