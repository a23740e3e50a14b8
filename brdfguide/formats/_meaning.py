"""What the columns of a table mean: directions, channels and values out of named numbers, with every inference noted."""

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from .. import conventions
from ..errors import InputError, choices
from ..measurement import Finding, Measurement
from . import _columns, _derived
from ._base import RGB_UM, XYZ_UM, Options, Source, check_zenith, degrees, measurement, nominal_colours, wavelength_in
from ._pivot import pivoted
from ._sheet import Sheet
from ._sides import on_its_side

INCIDENCE = r"\b(?:theta_?i(?:n|nc)?(?:_deg)?|aoi|(?:angle of )?incidence(?: angle)?|incident angle)\s*[:=]\s*([-+]?\d+(?:\.\d+)?)\s*(?:deg|°|$)"
SETTABLE = ("theta_i", "phi_i", "theta_r", "phi_r", "dphi", "wavelength", "brdf", "stderr")


def measured(source: Source, table: Sheet, options: Options, *, kind: str = "table", unit: str | None = None) -> Measurement:
    """The measurement in a table of named columns; `unit` is that of angles whose names have none. Raises InputError."""
    notes = [Finding("lines-skipped", f"skipped {text}") for text in table.notes[:5]]
    table = table if options.columns else _derived.plain(table, notes)
    columns, constants = _assigned(table, options, source)
    roles = {column.role: column for column in columns if column.role in SETTABLE}
    angles, table = _angles(source, table, roles, constants, options, unit, notes)
    values = [column for column in columns if column.role == "value"]
    if not values:
        raise _missing("brdf", table, source)
    ignored = [column.name for column in columns if column.role is None]
    if ignored:
        listed = ", ".join(ignored[:6]) + (f" and {len(ignored) - 6} more" if len(ignored) > 6 else "")
        notes.append(Finding("columns-ignored", f"columns ignored: {listed}", option="--columns"))
    angles, brdf, stderr, channels, um = _channels(source, table, columns, roles, constants, values, angles, notes)
    result = measurement(source, kind, *angles, brdf, channels=channels, wavelength=um, stderr=stderr, findings=notes)
    stated = any(re.match(r"mirror-side\s*:\s*phi=180", comment) for comment in table.comments)
    return _stated(on_its_side(result, "phi_r" in roles or "dphi" in roles, options, stated), values, table, options)


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
    if match := re.search(INCIDENCE, text, re.IGNORECASE | re.MULTILINE):
        found["theta_i"] = float(match[1])
    if wave := wavelength_in(text):
        found["wavelength"], found["wavelength said as"] = wave
    return found


def _missing(role: str, table: Sheet, source: Source) -> InputError:
    """The error for a column that is not there, with the nearest name that is."""
    from difflib import get_close_matches

    near = get_close_matches(role, [name.lower() for name in table.names], n=1, cutoff=0.4)
    hint = f"; is it '{table.names[[n.lower() for n in table.names].index(near[0])]}'?" if near else ""
    return source.error(f"no column for {role}{hint} Columns found: {', '.join(table.names)[:120]}; say which with --columns {role}=NAME{' or, if it is one for all, --columns theta_i=30' if role == 'theta_i' else ''}")


# --- angles -----------------------------------------------------------------------------------------------


def _angles(source, table, roles, constants, options, unit, notes):
    """theta_i, phi_i, theta_r, phi_r [deg] for the rows that have them all, and the table of those rows."""
    if "theta_r" not in roles:
        raise _missing("theta_r", table, source)
    if "theta_i" not in roles and "theta_i" not in constants:
        raise _missing("theta_i", table, source)
    raw = {role: table.values[:, roles[role].place] for role in ("theta_i", "phi_i", "theta_r", "phi_r", "dphi") if role in roles}
    factor = _factor(source, raw, roles, options, unit, notes)
    raw = {role: degrees(values) if factor == "rad" else values for role, values in raw.items()}
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
        notes.append(Finding("rows-without-angles", f"{lost} rows without all angles were dropped", numbers=(("rows", lost),)))
        table = replace(table, values=table.values[whole], lines=table.lines[whole])
    signed = "phi_r" not in raw and "dphi" not in raw
    if np.any(angles[0, whole] < 0):
        text = "theta_i is negative: the light comes from the azimuth opposite to phi_i"
        notes.append(Finding("negative-theta-i", text, option="--mirror-side"))
    return _with_signs(angles[:, whole], signed, options), table


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


def _factor(source, raw, roles, options, unit, notes) -> str:
    """`deg` or `rad`: the option, the names, or the values."""
    if options.unit:
        return options.unit
    units = {roles[role].unit for role in raw if roles[role].unit in ("deg", "rad")}
    if len(units) == 2:
        raise source.error("some angle columns are named in degrees and some in radians; say which with --unit deg or --unit rad")
    if units:
        return units.pop()
    if unit:
        return unit
    theta = np.concatenate([raw[role] for role in ("theta_i", "theta_r") if role in raw])
    theta = np.abs(theta[np.isfinite(theta)])
    azimuth = np.concatenate([raw[role] for role in raw if role not in ("theta_i", "theta_r")] or [np.zeros(1)])
    largest, turn = float(theta.max(initial=0.0)), float(np.abs(azimuth[np.isfinite(azimuth)]).max(initial=0.0))
    if not len(theta) or largest > 1.58 or turn > 6.3:
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
        return _pivot(source, table, roles["wavelength"], values[0], errors, angles, notes)
    brdf = _plain(table.values[:, [column.place for column in values]], values, notes)
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
        what = constants.get("wavelength said as", "wavelength")
        notes.append(Finding("wavelength-from-comment", f"{what} {um * 1000:g} nm, from the comments", option="--columns wavelength=NM"))
    return angles, brdf, stderr, channels, None if um is None else np.full(len(channels), um)


def _plain(numbers, columns, notes):
    """Values given in percent, as numbers; names that only hint at the BRDF are noted."""
    if vague := [column.name for column in columns if re.fullmatch(r"(reflectance|intensity|val(ue)?s?)\W*", column.name.strip().lower())]:
        text = f"'{vague[0]}' does not say what it holds: taken as the BRDF [1/sr]"
        notes.append(Finding("quantity-assumed", text, consequence="examined further on", option="--quantity"))
    percent = np.array([column.unit == "%" for column in columns])
    if not np.any(percent):
        return numbers
    notes.append(Finding("percent", f"'{columns[int(np.argmax(percent))].name}': given in percent, divided by 100"))
    return np.where(percent, numbers / 100, numbers)


def _absolute(stderr, brdf, column):
    """Standard errors given in percent, relative or expanded by a factor k, as 1/sr."""
    if expanded := re.search(r"\bk\s*=?\s*([123])\b", column.name, re.IGNORECASE):
        stderr = stderr / float(expanded[1])
    if column.unit == "%":
        return stderr / 100 * np.abs(brdf)
    return stderr * np.abs(brdf) if "rel" in column.name.lower() else stderr


def _pivot(source, table, column, value, errors, angles, notes):
    """Long form to (samples, channels)."""
    waves = table.values[:, column.place]
    um = waves * _wave_unit(source, column, waves, notes)
    bad = np.flatnonzero(~(um > 0))
    if len(bad):
        raise source.error(f"column '{column.name}': found {waves[bad[0]]:g}, wanted a wavelength", int(table.lines[bad[0]]))
    values = _plain(table.values[:, [value.place]], [value], notes)[:, 0]
    stderr = _absolute(table.values[:, errors[0].place], values, errors[0]) if len(errors) == 1 else None
    angles, brdf, stderr, um, note = pivoted(angles, um, values, stderr)
    notes.extend(note)
    return angles, brdf, stderr, [f"{each * 1000:g}nm" for each in um], um


def _wave_unit(source, column, waves, notes) -> float:
    if column.unit in _columns.TO_UM:
        return _columns.TO_UM[column.unit]
    middle = float(np.nanmedian(waves))
    for low, high, unit in ((100, 30000, "nm"), (0.1, 30, "um"), (1e-7, 3e-5, "m")):
        if low <= middle <= high:
            notes.append(Finding("wavelength-unit", f"wavelengths near {middle:g} are taken as {unit}", option="a unit in the column's name"))
            return _columns.TO_UM[unit]
    raise source.error(f"column '{column.name}': wavelengths near {middle:g}; wanted nm or um, with the unit in the name")


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
