"""Which column of a table is what, after --columns; those that nothing is made of, each with the reason."""

from dataclasses import replace

import numpy as np

from ...errors import InputError, choices, nearest_words
from ...finding import Finding
from ...records import dataclass
from ..columns import prose
from ..columns.facts import Column, facts
from ..columns.grammar import understood
from ..columns.header import by_name, settled
from ..columns.undone import FACTOR, not_undone
from ..columns.vocabulary import ANGLE_UNITS
from . import _options
from ._sheet import Sheet
from .format import Options, Source, wavelength_found

OTHER_WAYS = {"from_mirror", "beta_from_mirror", "beta_r", "theta_h", "x_r", "phase", "rotation"}  # to say directions
SHOWN = 6  # names in a sentence


@dataclass(frozen=True)
class Assigned:
    """The columns of a table with their roles, and what is one number for the whole table."""

    columns: tuple[Column, ...]
    constants: dict[str, float]  # angles [deg], wavelength [µm]
    findings: tuple[Finding, ...] = ()
    of_wavelength: tuple[Finding, ...] = ()  # what is said of the wavelength for the whole table

    def one(self, role: str) -> Column | None:
        return next((column for column in self.columns if column.role == role), None)

    def all(self, role: str) -> list[Column]:
        return [column for column in self.columns if column.role == role]

    def without(self, role: str, why: str) -> "Assigned":
        columns = (replace(each, role=None, why=why) if each.role == role else each for each in self.columns)
        return replace(self, columns=tuple(columns))


def mapped(table: Sheet, options: Options, source: Source) -> list[Column]:
    """The columns with the roles of their names, or those of --columns. Raises InputError where there is none such."""
    columns = by_name(table.names)
    for role, names in _mapping(options).items():
        number = _constant(role, names, table)
        if number is not None:
            _contradicted(columns, role, names[0], table, source)
            columns = _given(columns, role, (), f"--columns {role}={names[0]}")
            continue
        places = [_place(name, table.names) for name in names]
        for name, found in zip(names, places, strict=True):
            if found is None:
                raise choices(f"column in {source.name}", name, table.names)
        _check_undone(role, names, options, source)
        columns = _given(columns, role, places, "--columns names another")
    return settled(columns)


def _check_undone(role: str, names: tuple[str, ...], options: Options, source: Source) -> None:
    """Raises InputError for a column that --columns gives and whose name says that its numbers are not plain ones."""
    for name in names if role not in ("ignore", "wavelength") else ():
        done = not_undone(name)
        if done == FACTOR and options.scale is None:
            raise source.error(
                f"the name '{name[:60]}' has a factor, which may mean either way: say with --scale, such as 0.001 or "
                f"1000, what its values are to be multiplied by"
            )
        if done not in ("", FACTOR):
            raise source.error(
                f"--columns {role}={name[:60]}: its name says '{done}', which is not undone; wanted a column of plain "
                f"values"
            )


def assigned(table: Sheet, columns: list[Column], options: Options, source: Source) -> Assigned:
    """Raises InputError for two columns of one role."""
    constants, notes = _from_comments(table, options, source)
    mapping = _mapping(options)
    detector = _detector_in_comments(table, {column.role for column in columns} | set(mapping))
    constants |= detector
    of_angles = [
        Finding("columns-read", f"the text above the rows gives {role} = {angle:g} degrees for all")
        for role, angle in detector.items()
    ]
    for role, names in mapping.items():
        constants.pop(role, None)
        number = _constant(role, names, table)
        if number is not None:
            constants[role] = number
            if role == "wavelength":
                text = f"wavelength {1000 * number:g} nm, as --columns says"
                notes = [Finding("wavelength-by-option", text)]
    return Assigned(_unique(columns, set(mapping), source), constants, tuple(of_angles), tuple(notes))


def _contradicted(columns, role: str, text: str, table: Sheet, source: Source) -> None:
    """Raises InputError for one wavelength where the rows have several."""
    column = next((each for each in columns if each.role == role), None)
    if role == "wavelength" and column is not None and len(np.unique(table.values[:, column.place])) > 1:
        raise source.error(
            f"--columns wavelength={text}: the column '{column.name[:40]}' says the wavelength of each row; "
            f"--wavelength picks among them"
        )


def _mapping(options: Options) -> dict[str, tuple[str, ...]]:
    return dict(options.columns) if isinstance(options.columns, dict) else {}


def _constant(role: str, names: tuple[str, ...], table: Sheet) -> float | None:
    """The number that --columns gives in place of a column."""
    if len(names) > 1 or _place(names[0], table.names) is not None:
        return None
    return _options.stated_constant(role, names[0])


def missing(role: str, table: Sheet, source: Source) -> InputError:
    """The error for a column that is not there, with the nearest name that is."""
    free = [name for name in table.names if understood(name).role is None]
    lower = [name.lower() for name in free]
    near = nearest_words(role, lower, 1, 0.4)
    hint = _is_it(free[lower.index(near[0])]) if near else "."
    if role == "brdf":
        speaking = [name for name in table.names if facts(name)[0].quantity and not understood(name).role]
        hint = _is_it(speaking[0]) if speaking else hint
    constant = f" or, if it is one for all, --columns {role}=30" if role in ("theta_i", "theta_r", "phi_d") else ""
    return source.error(
        f"no column for {role}{hint} Columns found: {first_names(table.names)}; say which with --columns "
        f"{role}=NAME{constant}"
    )


def _is_it(name: str) -> str:
    """The question whether a column is the one that is missing, and why it was not taken for it."""
    why = understood(name).why
    return f"; is it '{name[:40]}'{f' ({why})' * bool(why)}?"


def first_names(names: list[str], quoted: bool = False) -> str:
    """The first names of a list, whole, and how many more there are."""
    shown: list[str] = []
    for name in names:
        if len(shown) == SHOWN or sum(map(len, shown)) > 80:
            break
        short = name if len(name) <= 40 else name[:37] + "..."
        shown.append(f"'{short}'" if quoted else short)
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")


def ignored(columns) -> list[Finding]:
    """The note on columns that nothing is made of, with the reason of each."""
    by_reason: dict[str, list[str]] = {}
    for column in columns:
        if column.role in (None, "ignore"):
            by_reason.setdefault(column.why or "not understood", []).append(column.name)
    if not by_reason:
        return []
    parts = [f"{first_names(names, quoted=True)} ({why})" for why, names in list(by_reason.items())[:SHOWN]]
    more = ", and others" if len(by_reason) > SHOWN else ""
    return [Finding("columns-ignored", f"columns ignored: {', '.join(parts)}{more}", option="--columns")]


def _place(name: str, names: list[str]) -> int | None:
    """Where a column stands that is called so, whatever the case of its letters."""
    if name in names:
        return names.index(name)
    lower = [each.lower().strip() for each in names]
    return lower.index(name.lower().strip()) if name.lower().strip() in lower else None


def _given(columns, role: str, places, why: str) -> list[Column]:
    """The columns with those at `places` in this role and no other in it; they keep what their names say."""
    role = {"brdf": "value", "phi_d": "dphi"}.get(role, role)
    found = []
    for column in columns:
        if column.place in places:
            left_out = "left out by --columns" if role == "ignore" else ""
            strange = column.role is None and len(places) == 1  # a number beside words that are not understood
            column = replace(column, role=role, weak=False, why=left_out, bare="" if strange else column.bare)
        elif column.role == role and role != "ignore":
            column = replace(column, role=None, why=why)
        found.append(column)
    return found


def _from_comments(table: Sheet, options: Options, source: Source):
    """`# theta_i: 45`, `# wavelength_nm = 532`, `lambda = 532 nm`, `2-5.7 um band` among the comments."""
    found: dict[str, float] = {}
    incidence = prose.incidence_in(table.comments, _unit_of_angles(table, options))
    if incidence is not None:
        found["theta_i"] = incidence
    if options.wavelength_nm is not None or "wavelength" in _mapping(options):
        return found, []
    um, notes = wavelength_found(source, prose.wavelength_in(table.comments), table.comment_lines)
    if um is not None:
        found["wavelength"] = um
    return found, notes


def _unit_of_angles(table: Sheet, options: Options) -> str:
    """The unit of an angle that names none: that of --unit, of a comment, or of all columns that name one; degrees."""
    named = {unit for name in table.names if (unit := understood(name).unit) in ANGLE_UNITS}
    return options.unit or prose.angle_unit_in(table.comments) or (named.pop() if len(named) == 1 else None) or "deg"


def _detector_in_comments(table: Sheet, roles: set[str | None]) -> dict[str, float]:
    """The one zenith or azimuth [deg] of the detector that comments state, where no column tells it otherwise.

    A scan in the plane of incidence shows its mirror side: 0 and 180 are not needed, and mean different things.
    """
    if roles & OTHER_WAYS:
        return {}
    found = prose.angles_of_detector_in(table.comments)
    azimuths = {role: angle for role, angle in found.items() if role != "theta_r" and angle % 180}
    if "theta_r" in roles:
        return azimuths if len(azimuths) == 1 and not roles & {"dphi", "phi_d", "phi_r"} else {}
    return {role: angle for role, angle in found.items() if role == "theta_r"}


def _unique(columns: list[Column], given: set[str], source: Source) -> tuple[Column, ...]:
    """One column for each angle, and one for each channel of values and doubts.

    Of an angle the plain one comes before its cosine or elevation, of values the BRDF as such before its logarithm.
    """
    columns = [replace(column, place=place) for place, column in enumerate(columns)]
    groups: dict[tuple, list[Column]] = {}
    for column in columns:
        if column.role not in (None, "ignore"):
            several = column.role in ("value", "stderr")
            groups.setdefault((column.role, (column.channel, column.at) if several else None), []).append(column)
    for (role, _), same in groups.items():
        if len(same) < 2:
            continue
        ranks = [_rank(column) for column in same]
        best = same[ranks.index(min(ranks))]
        if ranks.count(min(ranks)) > 1:
            word = "the BRDF" if role == "value" else role
            both = " and ".join(repr(each.name[:60]) for each in same if _rank(each) == min(ranks))
            shown = "brdf" if role == "value" else role
            raise source.error(
                f"the columns {both} both look like {word}; say which with --columns {shown}={best.name}"
            )
        for column in same:
            if column is not best:
                columns[column.place] = replace(column, role=None, why=f"'{best.name[:30]}' says it outright")
    values = [column for column in columns if column.role == "value"]
    if any(column.channel for column in values) and not all(column.channel for column in values):
        lone = [column for column in values if not column.channel]
        if "brdf" in given:
            raise source.error(
                f"'{lone[0].name[:60]}' names no wavelength or colour, so it is no channel beside the others of "
                f"--columns"
            )
        for column in lone:
            columns[column.place] = replace(column, role=None, why="the others are channels, and it names none")
    return tuple(columns)


def _rank(column: Column) -> tuple:
    """How directly a column says what its role is: the least comes first."""
    if column.role == "value":
        return (column.vague, column.quantity not in ("brdf", None), bool(column.scale))
    return (bool(column.form), column.weak)
