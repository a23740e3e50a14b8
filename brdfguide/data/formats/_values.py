"""Values, their doubts and their wavelengths out of the columns of a table, as BRDF [1/sr]."""

from dataclasses import replace

import numpy as np

from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ...records import dataclass
from .. import conventions
from ..columns import prose
from ..columns.facts import Column
from ..columns.inverse_units import INVERSE_UNITS
from ..columns.vocabulary import LENGTH_UNITS
from ..measurement import Measurement
from ._groups import as_channels
from ._marks import without_written_marks
from ._pivot import pivoted
from ._roles import Assigned, missing
from ._sheet import Sheet
from .format import Options, Source, check_wavelength, nominal_colours

LN10 = np.log(10.0)
SAY_LOGARITHM = "say so in its name, such as 'BRDF (dB)' or 'log10(BRDF)'"
# what the numbers of a column are, by its scale
DECODED = {
    "": lambda x: x,
    "%": lambda x: x / 100,
    "dB": lambda x: _power(x / 10 * LN10),
    "log10": lambda x: _power(x * LN10),
    "ln": lambda x: _power(x),
}
SAME_SIZE = {"hdrf": "reflectance-factor", "radiance-factor": "reflectance-factor"}
MANY_READINGS, ONE_LINE = 4, 1.002  # wavelengths that differ by less than a laser's or a filter's reading does
RELATIVE = {"dB": LN10 / 10, "log10": LN10, "ln": 1.0}  # a doubt in such units as a share of the value


@dataclass(frozen=True, eq=False)
class Values:
    angles: np.ndarray  # (4, directions), in the order of the values
    brdf: np.ndarray  # (directions, channels)
    stderr: np.ndarray | None
    channels: list[str]
    um: np.ndarray | None  # where the table says its wavelength
    left: Assigned  # the columns, those that came to nothing with the reason
    by_row: np.ndarray  # the values of each row of the table
    by_constant: bool = False  # whether one wavelength was said for the whole table


def values_of(source: Source, table: Sheet, given: Assigned, angles, notes: list[Finding]) -> Values:
    """Raises InputError where no column holds values, and for values that can only be logarithms."""
    values = given.all("value")
    if not values:
        raise missing("brdf", table, source)
    for column in values:
        if cell := table.bad_cell(column.place):
            raise source.error(f"column '{column.name[:60]}': found '{cell[0][:40]}', wanted a number", cell[1])
    brdf = _decoded(source, table, values, notes)
    single = len(values) == 1 and values[0].channel is None
    bands = _bands(table, given) if single else None
    if bands:
        return _of_bands(table, given, *bands, angles, brdf, notes)
    long_form = given.one("wavelength") or given.one("wavenumber")
    if long_form and single:
        return _long(source, table, given, long_form, angles, brdf, notes)
    if long_form and long_form.role:
        why = "the names of the values say their wavelengths" if values[0].channel else "there are several values a row"
        given = given.without(long_form.role, why)
    stderr, given = _doubts(table, given, values, brdf, notes)
    channels, um, by_constant = [column.channel or "brdf" for column in values], None, False
    if all(column.um is not None for column in values):
        um = np.array([column.um for column in values])
    elif set(channels) <= set(CHANNEL_UM):
        um = np.array([CHANNEL_UM[name] for name in channels])
        notes.append(nominal_colours(channels))
    elif "wavelength" in given.constants:
        um, by_constant = np.full(len(channels), given.constants["wavelength"]), True
    if um is not None:
        check_wavelength(source, um)
    return Values(angles, brdf, stderr, channels, um, given, brdf, by_constant)


def _long(source, table, given: Assigned, column: Column, angles, brdf, notes) -> Values:
    """One value a row and a column of wavelengths, to a channel for each."""
    um = row_wavelengths(source, table, column, notes)
    stderr, given = _doubts(table, given, given.all("value"), brdf, notes)
    brdf_by_row = brdf
    angles, brdf, stderr, um, note = pivoted(angles, um, brdf[:, 0], None if stderr is None else stderr[:, 0])
    notes.extend(note)
    return Values(np.stack(angles), brdf, stderr, [f"{each * 1000:g}nm" for each in um], um, given, brdf_by_row)


def _bands(table: Sheet, given: Assigned) -> tuple[Column, list[str]] | None:
    """A column of text whose every cell is a wavelength or a colour, and the channel of each row."""
    for column in given.columns:
        if column.role in (None, "wavelength") and column.place in table.texts:
            channels = as_channels(table, column.place)
            if channels and len(set(channels)) > 1:
                return column, channels
    return None


def _of_bands(table, given: Assigned, column: Column, channels: list[str], angles, brdf, notes) -> Values:
    """One value a row and a column of bands, to a channel for each."""
    um_of = dict(CHANNEL_UM)
    um_of |= {name: float(name.removesuffix("nm")) / 1000 for name in set(channels) - set(um_of)}
    given = replace(given, columns=tuple(replace(c, role="wavelength") if c is column else c for c in given.columns))
    stderr, given = _doubts(table, given, given.all("value"), brdf, notes)
    um = np.array([um_of[name] for name in channels])
    brdf_by_row = brdf
    angles, brdf, stderr, um, note = pivoted(angles, um, brdf[:, 0], None if stderr is None else stderr[:, 0])
    notes.extend(note)
    name_of = {round(um_of[name], 9): name for name in set(channels)}
    names = [name_of[each] for each in um.tolist()]
    if set(names) <= set(CHANNEL_UM):
        notes.append(nominal_colours(names))
    return Values(np.stack(angles), brdf, stderr, names, um, given, brdf_by_row)


# --- wavelengths ------------------------------------------------------------------------------------------


def row_wavelengths(source: Source, table: Sheet, column: Column, notes) -> np.ndarray:
    """Micrometres of every row. Raises InputError for what is no wavelength, with its line."""
    given = table.values[:, column.place]
    if cell := table.bad_cell(column.place):
        raise source.error(f"column '{column.name[:60]}': found '{cell[0][:40]}', wanted a wavelength", cell[1])
    if column.role == "wavenumber":
        unit = column.unit or "1/cm"
        um = np.divide(INVERSE_UNITS[unit][0], given, out=np.full_like(given, np.nan), where=given > 0)
        what = {"1/cm": "wavenumbers", "THz": "frequencies", "eV": "photon energies"}[unit]
        notes.append(Finding("wavenumbers", f"'{column.name}' holds {what}, taken in {unit}"))
    else:
        um = given * _wave_unit(source, column, given, notes)
    bad = np.flatnonzero(~((um >= 0.1) & (um <= 100)))
    if len(bad):
        text = f"column '{column.name}': found {given[bad[0]]:g}, wanted a wavelength of 100 nm to 100 um"
        raise source.error(text, int(table.lines[bad[0]]))
    return _one_line(column, um, notes)


def _one_line(column: Column, um, notes) -> np.ndarray:
    """One wavelength in place of many readings of it, which would each be a channel."""
    if len(np.unique(um)) < MANY_READINGS or um.max() > ONE_LINE * um.min():
        return um
    middle = float(np.round(um.mean(), 6))
    text = f"'{column.name[:40]}' varies by {1000 * np.ptp(um):.2g} nm: taken as one wavelength, {1000 * middle:g} nm"
    notes.append(Finding("columns-read", text))
    return np.full_like(um, middle)


def _wave_unit(source, column: Column, waves, notes) -> float:
    if column.unit in LENGTH_UNITS:
        return LENGTH_UNITS[column.unit][0]
    known = waves[np.isfinite(waves)]
    middle = float(np.median(known)) if len(known) else float("nan")
    for low, high, unit in ((100, 30000, "nm"), (0.1, 30, "um"), (1e-7, 3e-5, "m")):
        if low <= middle <= high:
            text = f"wavelengths near {middle:g} are taken as {unit}"
            notes.append(Finding("wavelength-unit", text, option="a unit in the column's name"))
            return LENGTH_UNITS[unit][0]
    raise source.error(
        f"column '{column.name}': wavelengths near {middle:g}; wanted nm or um, with the unit in the name"
    )


# --- numbers ----------------------------------------------------------------------------------------------


def _decoded(source, table: Sheet, columns: list[Column], notes) -> np.ndarray:
    """Values as plain numbers: percent, decibels, logarithms and powers of ten undone."""
    found = np.empty((len(table.values), len(columns)))
    plain = [column.place for column in columns if not column.scale and column.factor == 1]
    highest = float(np.max(table.values[:, plain], where=np.isfinite(table.values[:, plain]), initial=0.0))
    said = set()
    for place, column in enumerate(columns):
        given = without_written_marks(table.values[:, column.place], column.scale, notes)
        found[:, place] = DECODED[column.scale](given) * column.factor
        if not column.scale and column.factor == 1:
            _not_logarithms(source, column, given, highest)
        elif (column.scale, column.factor) not in said:
            said.add((column.scale, column.factor))
            notes.append(_how(column))
    if vague := [column.name for column in columns if column.vague]:
        text = f"'{vague[0]}' does not say what it holds: taken as the BRDF [1/sr]"
        notes.append(Finding("quantity-assumed", text, consequence="examined further on", option="--quantity"))
    return found


def _how(column: Column) -> Finding:
    if column.scale == "%":
        return Finding("percent", f"'{column.name}': given in percent, divided by 100")
    if column.scale == "dB":
        return Finding("decibels", f"'{column.name}': decibels, taken as 10^(x/10)")
    if column.scale:
        base = "decimal" if column.scale == "log10" else "natural"
        powers = "ten" if column.scale == "log10" else "e"
        return Finding("logarithms", f"'{column.name}': {base} logarithms, taken as powers of {powers}")
    return Finding("power-of-ten", f"'{column.name}': given in units of {column.factor:g}")


def _not_logarithms(source, column: Column, given, highest: float) -> None:
    """Raises InputError where most values are negative and by no means small beside the highest of all columns: noise
    about zero is not so, nor a colour outside sRGB."""
    known = given[np.isfinite(given)]
    negative = known[known < 0]
    if len(known) < 4 or len(negative) < 0.5 * len(known):
        return
    if np.median(-negative) > 0.1 * highest + 1e-3:
        raise source.error(
            f"column '{column.name[:60]}': {len(negative)} of {len(known)} values are negative, "
            f"{np.median(negative):.3g} in the middle: decibels or logarithms? Then {SAY_LOGARITHM}"
        )


def _power(logarithms) -> np.ndarray:
    """exp, NaN beyond what a BRDF can be."""
    with np.errstate(invalid="ignore"):
        sane = np.abs(logarithms) < 690
    return np.where(sane, np.exp(np.where(sane, logarithms, 0.0)), np.nan)


# --- doubts -----------------------------------------------------------------------------------------------


def _doubts(table: Sheet, given: Assigned, values: list[Column], brdf, notes):
    """Standard errors (rows, channels) or None, and the columns with those that came to nothing."""
    doubts = given.all("stderr")
    if not doubts:
        return None, given
    by_channel = {column.channel: column for column in doubts}
    if all(column.channel in by_channel for column in values):
        picked = [by_channel[column.channel] for column in values]
    elif len(doubts) == 1 and doubts[0].channel is None and _is_share(doubts[0], values[0]):
        picked = doubts * len(values)
    else:
        return None, given.without("stderr", "not every channel has a doubt of its own")
    if any(table.bad_cell(column.place) for column in picked):
        return None, given.without("stderr", "it holds text")
    if why := next((why for pair in zip(picked, values, strict=True) if (why := _useless(*pair))), ""):
        return None, given.without("stderr", why)
    stderr = np.stack(
        [
            _absolute(table.values[:, doubt.place], doubt, value, brdf[:, place], notes if place == 0 else [])
            for place, (doubt, value) in enumerate(zip(picked, values, strict=True))
        ],
        axis=1,
    )
    unused = [column for column in doubts if column not in picked]
    columns = (
        replace(each, role=None, why="no value goes with it") if each in unused else each for each in given.columns
    )
    return stderr, replace(given, columns=tuple(columns))


def _is_share(doubt: Column, value: Column) -> bool:
    return doubt.proportional or doubt.scale in RELATIVE or doubt.scale == "%" and value.scale != "%"


def _useless(doubt: Column, value: Column) -> str:
    """Why a doubt says nothing of a value; nothing where it does."""
    if value.scale in RELATIVE and not doubt.scale and not doubt.proportional:
        return "whether it is in the unit of the values or of their logarithms is not said"
    of_doubt, of_value = (SAME_SIZE.get(each.quantity or "", each.quantity) for each in (doubt, value))
    if of_doubt and of_value and of_doubt != of_value and not _is_share(doubt, value):
        return f"it is that of {doubt.quantity}, the values are {value.quantity}"
    return ""


def _absolute(given, doubt: Column, value: Column, brdf, notes) -> np.ndarray:
    """Standard errors given in percent, as shares, in decibels or expanded by a coverage factor, as those of values."""
    size, how = np.abs(brdf), []
    if doubt.scale in RELATIVE:
        stderr = given * RELATIVE[doubt.scale] * size
        how.append(f"in {doubt.scale}, times value")
    elif doubt.scale == "%" and (doubt.proportional or value.scale != "%"):
        stderr = given / 100 * size
        how.append("percent of the value")
    elif doubt.scale == "%":
        stderr = given / 100
        how.append("percent as the values are")
    elif doubt.proportional:
        stderr = given * size
        how.append("times value")
    else:
        stderr = given * (doubt.factor if doubt.factor != 1 else value.factor)
        stderr = stderr / 100 if value.scale == "%" else stderr
        how += ["percent as the values are"] if value.scale == "%" else []
    k = 2.0 if doubt.expanded else 1.0
    if doubt.k is not None:
        k = doubt.k
    if not 0 < k < 100:
        k = 1.0
    if k != 1:
        how.append(
            f"divided by k = {k:g}" + ("" if doubt.k is not None else ", the usual factor, which it does not say")
        )
    if how:
        text = f"'{doubt.name}' is the standard error: {', '.join(how)}"
        notes.append(Finding("stderr-read", text, option="--columns", numbers=(("coverage_factor", k),)))
    return stderr / k


# --- quantities -------------------------------------------------------------------------------------------


def with_stated_quantity(
    source: Source, result: Measurement, given: Assigned, table: Sheet, options: Options
) -> Measurement:
    """The quantity that a column's name, a title or a comment states, undone; --quantity comes before it.

    Raises InputError where the values' names state different ones.
    """
    if options.quantity:
        return result
    values = given.all("value")
    by_name = {column.quantity for column in values if column.quantity}
    if len(by_name) > 1:
        both = " and ".join(sorted(by_name))
        raise source.error(f"its columns hold different quantities, {both}: give one kind with --columns brdf=NAME")
    named = next(iter(by_name), None)
    if (outright := prose.quantity_stated(table.comments)) in conventions.QUANTITIES:
        return _converted(result, f"'{values[0].name}' states {outright}", outright)
    spoken = prose.quantities_in(table.comments)
    others = [quantity for quantity in spoken if quantity != "brdf"]
    if named not in (None, "brdf"):
        quantity = _of_field(named, given)
        return _converted(result, f"'{values[0].name}' states {quantity}", quantity, named)
    if not others or named and "brdf" in spoken:
        return result
    says = f"the text above the rows says '{spoken[others[0]]}'"
    if named is None and len(spoken) == 1:
        return _converted(result, f"{says}", _of_field(others[0], given), others[0])
    text = f"{says}, the column's name BRDF" if named else f"{says} and others"
    option = f"--quantity {_of_field(others[0], given)}"
    return result.noting(Finding("quantity-unclear", text, "warning", "taken as the BRDF [1/sr]", option))


def _of_field(quantity: str, given: Assigned) -> str:
    """`radiance factor` is I/F beside incidence, emission and phase, and pi times the BRDF to everybody else."""
    if quantity != "radiance-factor":
        return quantity
    detector = given.one("theta_r")
    planetary = given.one("phase") is not None or detector is not None and "em" in detector.name.lower()
    return "radf" if planetary else "reflectance-factor"


def _converted(result: Measurement, text: str, quantity: str, said: str = "") -> Measurement:
    """Undone what was stated; a warning where two fields mean different things by the word."""
    severity, consequence = "note", ""
    if said == "radiance-factor":
        meant = "I/F, pi f cos theta_i" if quantity == "radf" else "pi f"
        severity = "warning"
        consequence = f"the words mean pi f in colorimetry and I/F in planetary work: taken as {meant}"
    text += "" if quantity == "brdf" else ": converted to BRDF"
    settles = ("cosine", "scale")
    note = Finding("quantity-stated", text, severity, consequence, option="--quantity", settles=settles)
    return conventions.as_brdf(result, quantity).noting(note)
