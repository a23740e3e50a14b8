"""What all names of a table say together: letters that mean something beside others, colours, sheets of angles."""

from dataclasses import replace

from .facts import Column, bare_wavelength, facts
from .grammar import understood

ANGLES = ("theta_i", "theta_r")


def columns_of(names: list[str]) -> list[Column]:
    """The columns of a table, each with the role that its name has beside the others."""
    return settled(by_name(names))


def by_name(names: list[str]) -> list[Column]:
    """The columns by their names alone, with letters that mean something beside others."""
    columns = [_corner(name, place) or understood(name, place) for place, name in enumerate(names)]
    if not _colours_are_whole(columns):
        plain = [understood(name, place, colours=False) for place, name in enumerate(names)]
        pairs = zip(columns, plain, strict=True)
        columns = [other if each.colour and each.colour != "Y" else each for each, other in pairs]
    return _letters(columns)


def _corner(name: str, place: int) -> Column | None:
    """The upper left cell of a sheet, `theta_r \\ theta_i`: the first angle stands below it, the other beside it."""
    parts = [part for part in name.replace("\\", "/").split("/") if part.strip()]
    if len(parts) != 2 or {understood(part).role for part in parts} != set(ANGLES):
        return None
    return replace(understood(parts[0]), name=name, place=place)


def settled(columns: list[Column]) -> list[Column]:
    """The columns with what depends on the roles of the others: names that say little, and numbers in names."""
    return _numbers(_azimuths(_weak(columns)))


def _colours_are_whole(columns) -> bool:
    """Whether the colours are red, green and blue or X, Y and Z; a lone `f_r` is no red channel."""
    found = {column.colour for column in columns if column.role == "value" and column.colour}
    return {"R", "G", "B"} <= found or {"X", "Y", "Z"} <= found


def _letters(columns) -> list[Column]:
    """`i, e, g` are incidence, emission and phase; beside `theta_v`, `theta_s` is the source's; `mu` follows `mu0`."""
    keys = ["".join(token.text for token in facts(column.name, colours=False)[1]) for column in columns]
    roles = {column.role for column in columns}
    meant: dict[str, tuple[str, str]] = {}
    if "i" in keys and len(set("erovs") & set(keys)) == 1:
        meant |= {"i": ("theta_i", ""), **dict.fromkeys("erovs", ("theta_r", ""))}
        meant |= dict.fromkeys(("g", "alpha"), ("phase", ""))
    for polar in ("theta", "phi"):
        if polar + "s" in keys and polar + "v" in keys and f"{polar}_i" not in roles:
            meant[polar + "s"] = (f"{polar}_i", "")
    for mu in ("mu", "μ"):
        if f"{mu}i" in keys:
            meant[mu] = ("theta_r", "cos")
    if "betai" in keys:
        meant["beta"] = ("beta_r", "")
    if {"thetai", "phir"} <= set(keys) and "pi" in keys:
        meant["pi"] = ("phi_i", "")
    return [_as(column, *meant[key]) if key in meant else column for column, key in zip(columns, keys, strict=True)]


def _as(column: Column, role: str, form: str) -> Column:
    return Column(name=column.name, place=column.place, role=role, form=form, unit=column.unit)


def _weak(columns) -> list[Column]:
    """A lone `theta` or `incidence` has its role unless another column has it, or two of them would."""
    strong = {column.role for column in columns if not column.weak}
    weak: dict[str | None, list[Column]] = {}
    for column in columns:
        if column.weak:
            weak.setdefault(column.role, []).append(column)
    found = []
    for column in columns:
        rivals = [other for other in weak.get(column.role, ())[:2] if other is not column]
        if column.weak and column.role in strong:
            column = replace(column, role=None, why=f"another column is {column.role}")
        elif column.weak and rivals and column.name.strip().lower() in ("theta", "angle", "polar", "zenith"):
            column = replace(column, role=None, why=f"'{rivals[0].name}' is {column.role}")
        found.append(column)
    return found


def _azimuths(columns) -> list[Column]:
    """`phi` beside `phi_r` is the azimuth of the light."""
    roles = {column.role for column in columns}
    if "phi_r" not in roles or "phi_i" in roles or "theta_h" in roles:
        return columns
    return [replace(column, role="phi_i") if column.role == "dphi" else column for column in columns]


def _numbers(columns) -> list[Column]:
    """Numbers in the names of values: angles where the table has no column for one of the two, else wavelengths."""
    missing = [role for role in ANGLES if role not in {column.role for column in columns}]
    others = {column.role for column in columns} & {"from_mirror", "beta_from_mirror", "beta_r", "theta_h", "x_r"}
    stated = [column for column in columns if column.at is not None or _bare_angle(column) is not None]
    sheet = len(missing) == 1 and not (others and missing[0] == "theta_r") and len(stated) > 1
    if sheet and any(column.at_role not in (None, missing[0]) for column in stated):
        sheet = False
    found = []
    for column in columns:
        angle = _bare_angle(column) if column.at is None else column.at
        if sheet and column.role in ("value", "stderr") and angle is not None:
            column = replace(column, at=angle, at_role=missing[0], bare="")
        elif column.at is not None:
            column = replace(
                column, role=None, why=f"{column.at:g} degrees in its name stand beside columns of all angles"
            )
        elif column.bare:
            um = bare_wavelength(column.bare) if column.role in ("value", "stderr") and column.um is None else None
            column = replace(column, um=um)
            if um is None:
                column = replace(column, role=None, why="the number in its name is not understood")
        found.append(column)
    return found


def _bare_angle(column: Column) -> float | None:
    """The number without unit in a value's name, where it can be an angle."""
    if not column.bare or column.um is not None or column.role not in ("value", "stderr"):
        return None
    number = float(column.bare.replace(",", "."))
    return number if number < 90 else None
