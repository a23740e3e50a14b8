r"""Table of a LaTeX document: the rows of a `tabular`, `longtable` or `array`, cells parted by `&`, read as a table of
text is; captions count as comments.

Of several tables one is chosen with `--select table=2`. Rows alone, without `\begin{tabular}`, are read as well.
"""

import re

from ..columns.vocabulary import word_set
from . import _sheets
from ._sheet import check_lengths
from .format import Source

KINDS = rb"tabular|tabularx|tabulary|longtable|xltabular|supertabular|tabu|array|tblr|longtblr"
BEGINS = re.compile(r"\\begin\{(" + KINDS.decode() + r")\*?\}")
ENDS = re.compile(r"\\end\{(?:" + KINDS.decode() + r")\*?\}")
RULE = re.compile(
    r"\\(?:[hc]line|toprule|midrule|bottomrule|cmidrule|specialrule|addlinespace|endfirsthead|endhead|endfoot|"
    r"endlastfoot|noalign|rowcolor|centering|small|footnotesize)\b\*?(?:\([lr]{0,2}\))?(?:\[[^\]]{0,20}\])?"
    r"(?:\{[^{}]{0,40}\}){0,3}"
)
ROW = re.compile(rb"&[^\n&]{1,200}\\\\[ \t]{0,9}(?:\\[a-z]{1,20}[ \t]{0,9}){0,3}\r?\n")
SPANNING = re.compile(r"\\multicolumn\{(\d{1,3})\}\{[^{}]{0,40}\}\{")
ROWS_SPANNED = re.compile(
    r"\\multirow(?:cell)?(?:\[[^\]]{0,10}\])?\{[^{}]{0,10}\}(?:\[[^\]]{0,10}\])?\{[^{}]{0,20}\}\{"
)
QUANTITY = re.compile(r"\\(?:SI|qty)\{([^{}]{0,80})\}\{([^{}]{0,80})\}")
ANGLE = re.compile(r"\\ang\{([^{}]{0,40})\}")
CAPTION = re.compile(r"\\caption(?:\[[^\]]{0,80}\])?\{(.{0,400})")
LABEL = re.compile(r"\\(?:label|cite|footnote|tnote|ref|vspace|hspace|rule)\{[^{}]{0,80}\}")
COMMAND = re.compile(r"\\([A-Za-z]{1,30})\*?")
MEANT = {  # command -> what it stands for; others stand for nothing but what is in their braces
    "pm": "±",
    "times": "×",
    "cdot": "·",
    "circ": "°",
    "degree": "°",
    "textdegree": "°",
    "degreeCelsius": "C",
    "percent": "%",
    "per": " 1/",
    "steradian": "sr",
    "sr": "sr",
    "radian": "rad",
    "nano": "n",
    "micro": "u",
    "milli": "m",
    "metre": "m",
    "meter": "m",
    "nm": "nm",
    "um": "um",
    "deg": "deg",
    "textminus": "-",
    "textsuperscript": "^",
    "textsubscript": "_",
    "quad": " ",
    "qquad": " ",
    "langle": "",
    "textbackslash": "",
    "varphi": "phi",
    "vartheta": "theta",
    "le": "≤",
    "leq": "≤",
    "lt": "<",
    "sim": "~",
    "approx": "~",
    "textasciitilde": "~",
    "ldots": "",
    "dots": "",
    "textendash": "-",
    "textemdash": "-",
    **{word: word for word in word_set("theta phi lambda alpha beta mu sigma pi psi rho cos sin log ln Delta delta")},
}
LONGEST_ROW = 10_000  # letters, on all its lines
ESCAPED = str.maketrans({"\x01": "%", "\x02": "&", "\x03": "#", "\x04": "_"})
PLAIN = {
    "\\%": "\x01",
    "\\&": "\x02",
    "\\#": "\x03",
    "\\_": "\x04",
    "\\,": "",
    "\\;": "",
    "\\:": "",
    "\\!": "",
    "\\ ": " ",
}


def recognises(head: bytes) -> bool:
    """A table's beginning, or rows with `&` between the cells and two strokes behind them."""
    if b"\0" in head:
        return False
    if re.search(rb"\\begin\{(?:" + KINDS + rb")\*?\}", head):
        return True
    return len(ROW.findall(head)) > 1 and not re.match(rb"\s*[<{]", head)


def _tables(source: Source) -> dict[str, _sheets.Rows]:
    """The rows of every table, each at the number of its line."""
    check_lengths(source)
    found: dict[str, _sheets.Rows] = {}
    captions: _sheets.Rows = []
    rows: _sheets.Rows | None = None if BEGINS.search(source.text) else found.setdefault("1", [])
    begun, count = "", 0
    for number, line in enumerate(source.lines):
        line = _uncommented(line)
        if caption := CAPTION.search(line):
            captions.append([f"# {_plain(caption[1])}"])
        if begin := BEGINS.search(line):
            count += number
            rows, begun = found.setdefault(str(len(found) + 1), [[]] * number), ""
            line = _without_columns(line[begin.end() :])
        end = ENDS.search(line)
        if rows is None:
            continue
        before = len(rows)
        *whole, left = (begun + " " + (line[: end.start()] if end else line)).split("\\\\")
        rows += [_cells(each) for each in whole[:1]] or [[]]
        rows += [_cells(each) for each in whole[1:]]
        begun = left
        if len(begun) > LONGEST_ROW:
            raise source.error(f"found a row of more than {LONGEST_ROW} letters; wanted '\\\\' behind it", number + 1)
        count += sum(map(len, rows[before:]))
        _sheets.check_cells(source, count)
        if end:
            rows.append(_cells(begun))
            rows, begun = None, ""
    return {name: [*rows, *captions] for name, rows in found.items()}


def _uncommented(line: str) -> str:
    """The line with escaped signs out of the way, and without what follows a percent sign."""
    line = line.replace("\\\\", "\x00")
    for sign, stand_in in PLAIN.items():
        line = line.replace(sign, stand_in)
    return line.partition("%")[0].replace("\x00", "\\\\")


def _without_columns(text: str) -> str:
    """What follows the columns' description: `{|c|c|}`, `{\\textwidth}{lll}`, `[t]{S[table-format=1.2]}`."""
    text = text.lstrip()
    while text[:1] in ("{", "["):
        depth = 0
        for place, letter in enumerate(text):
            depth += (letter in "{[") - (letter in "}]")
            if not depth:
                text = text[place + 1 :].lstrip()
                break
        else:
            return ""
    return text


def _cells(row: str) -> list[str]:
    row = RULE.sub("", re.sub(r"^ ?\[[^\]]{0,20}\]", "", row.strip()))
    cells: list[str] = []
    for cell in row.split("&") if row.strip() else []:
        spanned = SPANNING.search(cell)
        cells += [_plain(cell), *[""] * (int(spanned[1]) - 1 if spanned else 0)]
    return cells


def _plain(text: str) -> str:
    """A cell's words and numbers without the commands that set them."""
    text = ROWS_SPANNED.sub("", SPANNING.sub("", LABEL.sub("", text)))
    text = ANGLE.sub(r"\1°", QUANTITY.sub(r"\1 \2", text))
    text = COMMAND.sub(lambda found: MEANT.get(found[1], ""), text)
    text = text.replace("$", "").replace("{", "").replace("}", "").replace("^°", "°").replace("~", " ")
    return " ".join(text.translate(ESCAPED).replace("\\", "").split())


FORMAT = _sheets.format_of_sheets(
    "latex", (".tex",), recognises, _tables, word="table", kind="LaTeX table", limit=_sheets.PASTED
)
