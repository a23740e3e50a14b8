"""Tables out of papers, pages, office programs, scripts and archives: each gives back the surface that made it, or one
sentence."""

import gzip
import io
import json
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.errors import InputError

from .plane_tables import PLANE, THETA_I, THETA_R, agrees, lines

ROWS = list(zip(map("{:g}".format, THETA_I), map("{:g}".format, THETA_R), map("{:.9g}".format, PLANE), strict=True))
PLAIN = "theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, PLANE)


def read(tmp_path, name: str, content, **options):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return formats.read(path, **options)


# --- LaTeX ------------------------------------------------------------------------------------------------

HEAD = "\\toprule\n$\\theta_i$ & $\\theta_r$ & BRDF \\\\\n\\midrule\n"


def latex(rows, head: str = HEAD, columns: str = "{rrr}", kind: str = "tabular", before: str = "") -> str:
    body = "".join(" & ".join(row) + " \\\\\n" for row in rows)
    return f"{before}\\begin{{{kind}}}{columns}\n{head}{body}\\bottomrule\n\\end{{{kind}}}\n"


def with_error(row) -> tuple[str, str, str]:
    return f"${row[0]}^\\circ$", f"${row[1]}^{{\\circ}}$", f"${row[2]} \\pm {0.05 * float(row[2]):.9g}$"


LATEX = {
    "plain": latex(ROWS),
    "ruled": latex(ROWS, columns="{|c|c|c|}").replace("toprule", "hline").replace("midrule", "hline\\hline"),
    "a document": "\\documentclass{a}\n\\begin{document}\n\\begin{table}[t]\n"
    + latex(ROWS)
    + "\\end{table}\n\\end{document}",
    "a long table": latex(ROWS, kind="longtable", columns="[c]{lll}", head="\\caption{x}\\\\\n" + HEAD + "\\endhead\n"),
    "tabularx": latex(ROWS, kind="tabularx", columns="{\\textwidth}{@{}X>{\\bfseries}rS[table-format=1.4]@{}}"),
    "siunitx": latex([[f"\\num{{{cell}}}" for cell in row] for row in ROWS], columns="{SSS}"),
    "angles of siunitx": latex([(f"\\ang{{{a}}}", f"\\SI{{{b}}}{{\\degree}}", c) for a, b, c in ROWS]),
    "powers": latex([(a, f"${b}$", f"${1e3 * float(c):.9g}\\times 10^{{-3}}$") for a, b, c in ROWS]),
    "an array": "$$\n" + latex(ROWS, kind="array") + "$$\n",
    "rows alone": "$\\theta_{\\mathrm{i}}$ & $\\theta_{\\mathrm{r}}$ & $f_r$ \\\\\n"
    + latex(ROWS, "").split("\n", 1)[1],
    "comments": latex([(a, b, f"{c} % {b} & nothing") for a, b, c in ROWS]).replace("nothing \\\\", "\n\\\\"),
    "several rows": latex([(f"\\multirow{{31}}{{*}}{{{a}}}" if b == "-75" else "", b, c) for a, b, c in ROWS]),
    "words over columns": latex(ROWS, "\\multicolumn{2}{c}{angles} & \\\\\n\\cmidrule(lr){1-2}\n" + HEAD[9:]),
    "thousands": latex([(a, b, f"{float(c):.9f}".replace(".", "{.}")) for a, b, c in ROWS]),
    "two rows a line": latex(ROWS).replace("\\\\\n30 & -75", "\\\\ 30 & -75"),
    "a row on two lines": latex(ROWS).replace("30 & -75 &", "30 &\n -75 &"),
}


@pytest.mark.parametrize("content", LATEX.values(), ids=LATEX)
def test_a_table_of_latex(tmp_path, content):
    agrees(read(tmp_path, "table.tex", content))


def test_errors_units_and_the_caption_of_latex(tmp_path):
    head = "$\\theta_i$ (deg) & $\\theta_r$ (deg) & BRDF (sr$^{-1}$) \\\\ \\hline\n"
    content = latex(map(with_error, ROWS), head, before="\\caption{BRDF of a paint at 633 nm}\n")
    found = read(tmp_path, "table.tex", content)
    agrees(found)
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-6)
    assert 1000 * found.geom.wavelength == pytest.approx(633)


def test_an_error_in_latex_names_its_line(tmp_path):
    content = latex(ROWS, before="\\begin{document}\n").replace("30 & -75 &", "30 & what &")
    line = 1 + content[: content.index("what")].count("\n")
    with pytest.raises(InputError, match=f"line {line}: column 'theta_r': found 'what'"):
        read(tmp_path, "table.tex", content)


@pytest.mark.parametrize("name, table", [("two.tex", latex), ("two.html", lambda rows: page(rows))])
def test_one_of_several_tables_is_chosen(tmp_path, name, table):
    half = [(a, b, f"{float(c) / 2:.9g}") for a, b, c in ROWS]
    with pytest.raises(InputError, match="2 tables hold tables .1, 2.: choose one with --select table=1"):
        read(tmp_path, name, table(ROWS) + table(half))
    agrees(read(tmp_path, name, table(ROWS) + table(half), select=["table=2"]), factor=0.5)
    with pytest.raises(InputError, match="no table called '3'; there are: 1, 2"):
        read(tmp_path, name, table(ROWS) + table(half), select=["table=3"])
    assert formats.groups(tmp_path / name, "theta_i", select=["table=2"]) == ("10", "30", "50")


# --- pages ------------------------------------------------------------------------------------------------


def page(rows, names=("theta_i", "theta_r", "brdf"), before: str = "<table>", after: str = "</table>") -> str:
    head = "".join(f"<th>{name}</th>" for name in names)
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>\n" for row in rows)
    return f"{before}<tr>{head}</tr>\n{body}{after}\n"


def entities(row) -> tuple[str, str, str]:
    return row[0], row[1].replace("-", "&minus;"), f"{row[2]}&nbsp;&plusmn;&nbsp;{0.05 * float(row[2]):.9g}"


PAGES = {
    "a table": page(ROWS),
    "a page": "<!DOCTYPE html>\n<html><body><script>a<b</script>" + page(ROWS, before='<TABLE border="1"><thead>'),
    "Excel's page": '<html xmlns:o="urn:o"><head><meta charset=utf-8></head>' + page(ROWS) + "</html>",
    "no end tags": "<table><tr><th>theta_i<th>theta_r<th>brdf" + "".join(f"<tr><td>{'<td>'.join(r)}" for r in ROWS),
    "a menu beside it": "<html>" + page([], ("home", "next")) + page(ROWS),
    "a menu around it": "<table><tr><td>home</td><td>" + page(ROWS) + "</td></tr></table>",
    "rows spanned": page(
        [(f'<b rowspan="1">{a}</b>' if b != "-75" else a, b, c) for a, b, c in ROWS],
        ("&theta;<sub>i</sub> (&deg;)", "&theta;<sub>r</sub> (&deg;)", "BRDF [sr<sup>&minus;1</sup>]"),
    ),
    "powers": page([(a, b, f"{1e3 * float(c):.9g}&times;10<sup>&minus;3</sup>") for a, b, c in ROWS]),
    "a comment": "<div><!-- <table> -->" + page(ROWS),
}


@pytest.mark.parametrize("content", PAGES.values(), ids=PAGES)
def test_a_table_of_a_page(tmp_path, content):
    agrees(read(tmp_path, "table.html", content))


def test_a_cell_over_several_rows_and_the_caption(tmp_path):
    head, *body = page(ROWS, before="<table><caption>BRDF at 633 nm</caption>").splitlines()
    for place, row in enumerate(body[: len(ROWS)]):
        first, rest = row.split("</td>", 1)
        span = "<tr><td rowspan=31>" + first.rpartition(">")[2] + "</td>"
        body[place] = (span if place % 31 == 0 else "<tr>") + rest
    found = read(tmp_path, "table.html", "\n".join([head, *body]))
    agrees(found)
    assert 1000 * found.geom.wavelength == pytest.approx(633)


def test_errors_in_a_page(tmp_path):
    found = read(tmp_path, "table.html", page(map(entities, ROWS)))
    agrees(found)
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-6)


# --- OpenDocument -----------------------------------------------------------------------------------------


def ods(sheets: dict[str, str], kind: str = "spreadsheet", doctype: str = "") -> bytes:
    tables = "".join(f'<table:table table:name="{name}">{rows}</table:table>' for name, rows in sheets.items())
    spaces = "".join(f' xmlns:{each}="urn:{each}"' for each in ("office", "table", "text"))
    stream = io.BytesIO()
    with ZipFile(stream, "w") as archive:
        archive.writestr("mimetype", f"application/vnd.oasis.opendocument.{kind}")
        archive.writestr(
            "content.xml", f"<?xml version='1.0'?>{doctype}<office:d{spaces}>{tables}</office:d>", ZIP_DEFLATED
        )
    return stream.getvalue()


def spoilt(packed: bytes) -> bytes:
    """The same with some of what is compressed lost."""
    return packed[:200] + 40 * b"\xff" + packed[240:]


def ods_rows(rows) -> str:
    def cell(value) -> str:
        number = f' office:value-type="float" office:value="{value}"' if isinstance(value, float) else ""
        return f"<table:table-cell{number}><text:p>{value}</text:p></table:table-cell>"

    rest = '<table:table-cell table:number-columns-repeated="16000"/>'
    made = "".join(f"<table:table-row>{''.join(map(cell, row))}{rest}</table:table-row>" for row in rows)
    return made + f'<table:table-row table:number-rows-repeated="1048000">{rest}</table:table-row>'


SHEET = ods_rows(
    [("theta_i", "theta_r", "brdf"), *zip(THETA_I.tolist(), THETA_R.tolist(), PLANE.tolist(), strict=True)]
)


def test_an_opendocument_sheet(tmp_path):
    agrees(read(tmp_path, "table.ods", ods({"notes": ods_rows([("hello",)]), "scan": SHEET})))
    with pytest.raises(InputError, match="2 sheets hold tables .a, b.: choose one with --select sheet=a"):
        read(tmp_path, "table.ods", ods({"a": SHEET, "b": SHEET}))
    agrees(read(tmp_path, "table.ods", ods({"a": SHEET, "b": SHEET}), select=["sheet=b"]))


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (ods({"a": SHEET})[:-200], "a damaged OpenDocument sheet: "),
        (spoilt(ods({"a": SHEET})), "a damaged OpenDocument sheet: Error -3 while decompressing"),
        (ods({"a": SHEET + "<table:x>"}), "a damaged OpenDocument sheet: mismatched tag"),
        (ods({"a": SHEET}, doctype='<!DOCTYPE a [<!ENTITY b "c">]>'), "XML with a document type of its own"),
        (ods({"a": "<table:table-row/>" * 400_000}), "unpacks to 7 MB, more than such a sheet"),
        (ods({"a": SHEET}).replace(b"content.xml", b"context.xml"), "without a content.xml that can be read"),
        (ods({"a": ods_rows([("hello",)])}), "none of its sheets .a. holds a table of numbers"),
    ],
)
def test_opendocument_sheets_that_cannot_be_read(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, "table.ods", content)


# --- JSON -------------------------------------------------------------------------------------------------

NUMBERS = {"theta_i": THETA_I.tolist(), "theta_r": THETA_R.tolist(), "brdf": PLANE.tolist()}
NAMED = [dict(zip(NUMBERS, row, strict=True)) for row in zip(*NUMBERS.values(), strict=True)]
BARE = [list(row.values()) for row in NAMED]
DOCUMENTS = {
    "rows": json.dumps(NAMED),
    "rows one a line": "\n".join(map(json.dumps, NAMED)),
    "columns": json.dumps(NUMBERS),
    "columns by row": json.dumps({name: dict(enumerate(column)) for name, column in NUMBERS.items()}),
    "pandas": json.dumps({"columns": list(NUMBERS), "index": list(range(len(BARE))), "data": BARE}),
    "words beside them": json.dumps({"sample": "paint", "wavelength_nm": 550, "measurements": NAMED}),
    "rows in a list of lists": json.dumps({"data": [list(NUMBERS), *BARE]}),
    "indented": json.dumps(NAMED, indent=2),
}


@pytest.mark.parametrize("content", DOCUMENTS.values(), ids=DOCUMENTS)
def test_a_table_in_json(tmp_path, content):
    agrees(read(tmp_path, "table.json", content))


def test_what_stands_beside_a_table_in_json_counts(tmp_path):
    found = read(tmp_path, "table.json", json.dumps({"wavelength": "633 nm", "data": NAMED}))
    assert 1000 * found.geom.wavelength == pytest.approx(633)
    stated = [row | {"brdf": f"{row['brdf']:.9g} ± {0.05 * row['brdf']:.9g}"} for row in NAMED]
    found = read(tmp_path, "table.json", json.dumps(stated))
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-6)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ('[{"theta_i": 10, "theta_r": ', "not valid JSON"),
        ('{"theta_i": 1}\n{"theta_i": 2\n', "line 2: not valid JSON"),
        ('{"theta_i": [1, 2], "brdf": [1]}', "found 2 values of 'theta_i' and 1 of 'brdf'"),
        ('{"columns": ["a", "b"], "data": [[1, 2], [3]]}', "row 2: found 1 values, wanted 2"),
        ('[{"theta_i": {"deg": 1}, "theta_r": 2, "brdf": 3}]', "'theta_i' holds no plain numbers or words"),
        ('[{"theta_i": 10}, 5]', "row 2: found 0 values, wanted 1"),
        ('{"a": []' + ', "data": [[]]}', "JSON of another kind|without a table|no rows under"),
        ("[" * 100_000, "JSON of another kind"),
        ('[{"a":' * 100_000, "not valid JSON"),
    ],
)
def test_json_that_is_no_table(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, "table.json", content)


# --- archives and encodings -------------------------------------------------------------------------------


def zipped(files: dict[str, bytes | str]) -> bytes:
    stream = io.BytesIO()
    with ZipFile(stream, "w", ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return stream.getvalue()


@pytest.mark.parametrize(
    "files",
    [
        {"scan.csv": PLAIN},
        {"folder/": "", "folder/scan.csv": PLAIN, "__MACOSX/folder/._scan.csv": b"\0\1", "folder/.DS_Store": b"\0"},
        {"README.txt": "hello", "scan.csv": PLAIN},
        {"scan.csv.gz": gzip.compress(PLAIN.encode())},
        {"scan.tex": LATEX["plain"]},
    ],
)
def test_a_zip_of_one_file(tmp_path, files):
    agrees(read(tmp_path, "scan.zip", zipped(files)))


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (zipped({"a.csv": PLAIN, "b.csv": PLAIN}), "a ZIP archive of 2 files .a.csv, b.csv.; wanted one"),
        (zipped({"README": "x"}), "a ZIP archive of no file; wanted one"),
        (zipped({"a.csv": PLAIN})[:-60], "a ZIP archive, which is not read"),
        (zipped({"a.csv": PLAIN + " " * 30_000_000}), "unpacks to more than 200 times its size"),
        (zipped({"a.zip": zipped({"b.csv": PLAIN})}), "a ZIP archive, which is not read; unpack it"),
    ],
)
def test_zips_that_are_not_read(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, "scan.zip", content)


def test_a_zip_that_is_damaged_or_locked(tmp_path):
    whole = bytearray(zipped({"scan.csv": PLAIN}))
    whole[60] ^= 255
    with pytest.raises(InputError, match="its ZIP compression is damaged|cannot be unpacked"):
        read(tmp_path, "scan.zip", bytes(whole))
    unlike = zipped({"scan.csv": PLAIN}).replace(b"scan.csv", b"scaN.csv", 1)  # the list at its end has another name
    with pytest.raises(InputError, match="'scan.csv' in it cannot be unpacked: File name in directory"):
        read(tmp_path, "scan.zip", unlike)
    locked = bytearray(zipped({"scan.csv": PLAIN}))
    place = locked.rfind(b"PK\x01\x02")
    locked[place + 8] |= 1
    with pytest.raises(InputError, match="'scan.csv' in it is locked by a password"):
        read(tmp_path, "scan.zip", bytes(locked))


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-8-sig"])
def test_encodings_with_and_without_a_mark(tmp_path, encoding):
    text = "# Probe aus Körnung µ\n" + PLAIN
    agrees(read(tmp_path, "scan.csv", text.encode(encoding)))
    agrees(read(tmp_path, "scan.tex", LATEX["plain"].encode(encoding)))
