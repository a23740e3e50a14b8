"""One number as people write it: `0.10 ± 0.01`, `0.10(1)`, `9.8×10⁻³`, `1,234.5`, `45 %`, `10°30'`, `<0.1`."""

import re
from functools import lru_cache

from ...records import dataclass
from ..columns.facts import Column, facts

OF_PLAIN_ROWS = b'0123456789+-.,;|\t \n\r"eEnaNA'
BLANK = "[ \u00a0\u2009\u202f]"
PLUS_MINUS = re.compile(rf"{BLANK}{{0,3}}(?:±|\+/[-\u2212]|(?<![eEdD])\+[-\u2212]){BLANK}{{0,3}}(?=[\d.])")
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
POWER = re.compile(
    rf"(?<=[\d.)]){BLANK}{{0,2}}[×xX·∙⋅*]{BLANK}{{0,2}}10{BLANK}?"
    r"(?:(?:\^|\*\*)[({]?([-+]?\d{1,3})[)}]?|([-+]\d{1,3})|([⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺]{1,4}))"
)
UNIT_APART = re.compile(
    rf"(?<=[\d.)]){BLANK}{{1,2}}(?=(?:deg(?:rees?)?|[°º]|rad|mrad|gon|nm|[uµμ]m|%|dB|sr\^?-1|sr⁻¹)(?![\w/]))"
)
PER_SR_APART = re.compile(rf"(?<=[\d.)]){BLANK}{{1,2}}1?/sr(?!\w)")
MINUTES = re.compile(
    rf"([-+]?)(\d{{1,3}})°{BLANK}?(\d{{1,2}}(?:\.\d+)?)['′’](?:{BLANK}?(\d{{1,2}}(?:\.\d+)?)(?:″|”|''))?"
)
DEGREES = re.compile(r"(?<=\d) ?[°º](?!\d)")  # behind the numbers of a row
MINUS = re.compile(r"[\u2212\u2010-\u2015\ufe63\uff0d](?=[\d.,])")  # signs that word processors make of a hyphen
APART = re.compile(r"(?<=\d)['’\u00a0\u2009\u202f](?=\d{3}(?!\d))")  # between thousands, where no comma or point is
BLANK_APART = re.compile(r"(?<=\d) (?=\d{3}(?!\d))")
THOUSANDS = {mark: re.compile(rf"(?<![\d.,])[1-9]\d{{0,2}}(?:{re.escape(mark)}\d{{3}})+(?!\d)") for mark in ",."}
BOTH = {  # of two marks the last is decimal
    ",": re.compile(r"(?<![\d.,])[1-9]\d{0,2}(?:,\d{3})+\.\d"),
    ".": re.compile(r"(?<![\d.,])[1-9]\d{0,2}(?:\.\d{3})+,\d"),
}
LONGEST = 80  # letters of a cell
NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)"
CELL = re.compile(
    rf"(?P<limit>[<>≤≥])?[~≈]?{BLANK}?(?P<open>\()?(?P<number>{NUMBER})(?P<exponent>[eE][-+]?\d{{1,3}})?"
    rf"(?:\((?P<last>\d{{1,6}}|\d{{0,6}}\.\d{{1,6}})\)(?P<after>[eE][-+]?\d{{1,3}})?)?"
    rf"(?:(?P<share>%)?±(?P<error>{NUMBER}(?:[eE][-+]?\d{{1,3}})?)(?P<percent>{BLANK}?%)?)?"
    rf"(?P<close>\)(?P<common>[eE][-+]?\d{{1,3}})?)?{BLANK}?(?P<unit>[^\W\d][^,;\t]{{0,20}}|[%°º/][^,;\t]{{0,20}})?"
)


@dataclass(frozen=True)
class Written:
    """What a cell says: NaN beside a limit; `percent` where the error is a share."""

    number: float
    error: float | None = None
    percent: bool = False
    unit: str = ""
    limit: bool = False


@dataclass(frozen=True)
class Style:
    """What parts the cells of a table, None for any white space, and what its decimals."""

    delimiter: str | None
    decimal: str = "."
    thousands: bool = False  # whether the mark that is not decimal parts thousands


def tidy(text: str) -> str:
    """A row with one spelling of signs and powers, and without blanks within what is one cell."""
    if not text.isascii():
        text = DEGREES.sub("", MINUTES.sub(_in_degrees, MINUS.sub("-", text)))
    if "±" in text or "+" in text:
        text = PLUS_MINUS.sub("±", text)
    if "10" in text:
        text = POWER.sub(_as_exponent, text)
    return UNIT_APART.sub("", PER_SR_APART.sub("/sr", text))


def is_tidy(rows: str) -> bool:
    """Whether nothing can be in these rows that `tidy` changes."""
    return not rows.encode().translate(None, OF_PLAIN_ROWS) and "+-" not in rows


def _in_degrees(match: re.Match) -> str:
    degrees = int(match[2]) + float(match[3]) / 60 + float(match[4] or 0) / 3600
    return f"{match[1]}{degrees:.10g}"


def _as_exponent(match: re.Match) -> str:
    return "e" + (match[1] or match[2] or match[3].translate(RAISED))


@lru_cache(maxsize=256)
def unit_of(text: str) -> Column | None:
    """What a unit behind numbers says, with nothing else in it; None where it is none."""
    bare = text.strip().strip('[](){}"')
    if bare in ("", "-", "1"):
        return None
    column, left = facts(f"unit [{bare}]", colours=False)
    says = column.unit or column.per_sr or column.scale
    return column if says and [token.text for token in left] == ["unit"] and column.quantity is None else None


def number_in(cell: str, style: Style) -> Written | None:
    """The number in a cell of a row that is tidy; None where it holds something else."""
    if len(cell) > LONGEST:
        return None
    cell = APART.sub("", cell.removeprefix("=").strip("'"))
    if style.delimiter is not None and style.delimiter != ",":
        cell = BLANK_APART.sub("", cell)
    mark = "," if style.decimal == "." else "."
    if mark in cell and (style.thousands or BOTH[mark].search(cell)):
        cell = THOUSANDS[mark].sub(lambda found: found[0].replace(mark, ""), cell)
    match = CELL.fullmatch(cell.replace(",", ".") if style.decimal == "," else cell)
    if match is None or bool(match["open"]) != bool(match["close"]):
        return None
    unit = (match["unit"] or "").strip()
    return None if unit and unit_of(unit) is None else _said(match, unit)


def _said(match: re.Match, unit: str) -> Written | None:
    common = match["common"] or ""
    power = match["exponent"] or match["after"] or common
    number = float(match["number"] + power)
    if match["limit"]:
        return Written(float("nan"), unit=unit, limit=True)
    if match["error"]:
        if match["share"]:  # 45 % ± 1 %, as many percent as the number is
            return Written(number, float(match["error"]), unit="%") if match["percent"] and not unit else None
        percent = bool(match["percent"])
        return Written(number, float(match["error"] + common * (not percent)), percent, unit)
    if not match["last"]:
        return Written(number, unit=unit)
    places = 0 if "." in match["last"] else len(match["number"].partition(".")[2])
    return Written(number, float(match["last"] + power) / 10**places, unit=unit)


def reads(cell: str, style: Style | None = None) -> bool:
    """Whether a cell of a row that is tidy holds a number as people write it; None: in either style."""
    if not any(map(str.isdigit, cell)):
        return False
    return any(number_in(cell, each) for each in ((style,) if style else (Style("\t"), Style("\t", ","))))
