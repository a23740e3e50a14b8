"""Text tables laid out otherwise: each gives back the surface that made it, or one sentence."""

import pytest

from brdfguide.errors import InputError

from .plane_tables import PLANE, THETA_I, THETA_R, agrees, lines, read

ROWS = [line.split(",") for line in lines(THETA_I, THETA_R, PLANE).splitlines()]
HEAD = "theta_i,theta_r,brdf\n"
PLAIN = "".join(",".join(row) + "\n" for row in ROWS)
COLUMNS = [
    "\t".join((name, *cells)) for name, cells in zip(HEAD.strip().split(","), zip(*ROWS, strict=True), strict=True)
]


def each_row(form: str) -> str:
    return "".join(form.format(*row, place=place) + "\n" for place, row in enumerate(ROWS, 1))


LAYOUTS = {
    "Python's lists": HEAD + each_row("[{0}, {1}, {2}],"),
    "a list of lists": HEAD + "rows = [\n" + each_row("[{0}, {1}, {2}],") + "]\n",
    "tuples": HEAD + each_row("({0}, {1}, {2})"),
    "braces of C": HEAD + "{\n" + each_row("{{{0}, {1}, {2}}},") + "};\n",
    "names in the cells": each_row("theta_i={0} theta_r={1} brdf={2}"),
    "names in the cells, with colons": each_row("theta_i: {0}, theta_r: {1}, brdf: {2}"),
    "a name before each row": "\n".join(COLUMNS) + "\n",
    "a name before each row, with commas": "\n".join(COLUMNS).replace("\t", ",") + "\n",
    "a name before each row, with blanks": "\n".join(COLUMNS).replace("\t", "  ") + "\n",
    "quoted names before each row": "\n".join(f'"{row}'.replace("\t", '"\t', 1) for row in COLUMNS) + "\n",
    "a count above": f"{len(ROWS)}\n{HEAD}{PLAIN}",
    "row numbers without a name": HEAD + each_row("{place},{0},{1},{2}"),
    "R's table": '"theta_i" "theta_r" "brdf"\n' + each_row('"{place}" {0} {1} {2}'),
    "row names": HEAD + each_row("run{place},{0},{1},{2}"),
    "a mean below": HEAD + PLAIN + "\nMean,,0.2\nstd,,0.1\n",
    "words below": HEAD + PLAIN + "\nOperator: J. Smith\nDate: 2021-03-04\n",
    "blocks that begin below the names": "theta_r,brdf\n"
    + "".join(f"theta_i = {i}\n" + "".join(f"{b},{c}\n" for a, b, c in ROWS if a == i) for i in ("10", "30", "50")),
}


@pytest.mark.parametrize("content", LAYOUTS.values(), ids=LAYOUTS)
def test_a_table_laid_out_otherwise(tmp_path, content):
    agrees(read(tmp_path, content))


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (HEAD + PLAIN + "10,20\n30,40,1\n", "line 95: found 2 cells, wanted 3"),
        ("name,theta_i,theta_r,brdf\n" + each_row("w,{0},{1},{2}") + "w,10\nw,10,20,1\n", "line 95: found 2 cells"),
        (HEAD + each_row("{2},{0},{1},{2}"), "the header names 3 columns .*; this row has 4"),
        (each_row("theta_i={0} theta_r={1} brdf={2}") + "theta_i=10 brdf=1\n", "no row of numbers found"),
    ],
)
def test_what_is_not_laid_out_so_is_refused(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, content)
