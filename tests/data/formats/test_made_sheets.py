"""Sheets of random conventions whose truth is known: benchmarks/sheets.py prints the same for hundreds."""

import pytest

from benchmarks.made_sheets import made
from benchmarks.sheets import judged


@pytest.mark.parametrize("seed", [*range(60), 272, 1225, 1268, 1895, 2786, 3553])
def test_a_sheet_comes_back_as_its_surface_or_is_refused_in_a_sentence_seed(tmp_path, seed):
    sheet = made(seed)
    verdict, why = judged(sheet, tmp_path / "sheet.csv")
    assert verdict in ("right", "refused", "doubted"), why
    assert verdict != "refused" or "strange" in sheet.said, why  # only for a name that says nothing
