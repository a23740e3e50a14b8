"""What is printed fits the terminal that it is printed on."""

import re
import sys
from types import SimpleNamespace

import pytest

from brdfguide import models
from brdfguide.fitting.compare import compare
from brdfguide.report import elements, sheet
from brdfguide.report.documents.fit import fit_document
from brdfguide.report.figures import spheres
from brdfguide.report.text import catalogue, folding, ranking, table, terminal
from brdfguide.report.text.ranking import shows_text

from .. import synthetic

LONG = "even the best error is many times the noise of a single value: no candidate describes this surface fully, " * 2
NAMES = ("lambertian+ggx", "oren-nayar+ggx", "lambertian+ward")


@pytest.fixture
def screen(monkeypatch):
    """Makes standard output a terminal of so many columns; of none a pipe."""

    def of(columns: int | None):
        monkeypatch.setattr(sys, "stdout", SimpleNamespace(isatty=lambda: columns is not None, fileno=lambda: 99))
        monkeypatch.setenv("COLUMNS", str(columns or 60))

    return of


@pytest.fixture(scope="module", params=[True, False], ids=["timed", "untimed"])
def document(request):
    data = synthetic.surface(models.get("lambertian+ggx"), synthetic.scan(), {"ggx.alpha": 0.2}, noise=0.02, seed=1)
    return fit_document(compare(data, [models.get(name) for name in NAMES]), data, timing=request.param)


def widest(text: str) -> int:
    return max(map(len, re.sub(r"\x1b\[[0-9;]*m", "", text).split("\n")))


@pytest.mark.parametrize("columns, most", [(60, 60), (100, 100), (300, 100)])
def test_paragraphs_are_as_wide_as_a_terminal_but_no_wider_than_a_page(screen, columns, most):
    screen(columns)
    lines = folding.wrapped_text(LONG).splitlines()
    assert most - 15 < max(map(len, lines)) <= most and all(line.startswith("    ") for line in lines[1:])
    assert " ".join(folding.wrapped_text(LONG).split()) == " ".join(LONG.split())


def test_a_pipe_gets_a_page_of_100_columns_whatever_the_terminal_is(screen):
    screen(None)
    assert 85 < max(map(len, folding.wrapped_text(LONG).splitlines())) <= 100
    assert folding.page(LONG) == LONG


def test_a_word_longer_than_the_line_is_broken_after_a_sign_and_nothing_of_it_is_lost():
    name = "coated:lambertian+flakes-beckmann+he-torrance"
    lines = folding.broken(f"{name} is long", 20)
    assert (
        lines[:2] == ["coated:lambertian+", "flakes-beckmann+"] and "".join(lines).replace(" ", "") == f"{name}islong"
    )
    assert folding.broken("\u4e2d" * 30, 20) == ["\u4e2d" * 10] * 3


def test_a_number_and_its_percent_stay_on_one_line():
    assert folding.broken("slope shows from 66 % on", 19) == ["slope shows from", "66 % on"]


@pytest.mark.parametrize("columns", [40, 60, 80, None])
def test_a_table_folds_words_and_never_numbers(screen, columns):
    screen(columns)
    rows = [("lambertian+cook-torrance", "0.0718", "a doubt that is said in many words " * 2), ("ggx", "1", "-")]
    lines = table.columns(("model", "error", "doubts"), rows, right=(1,)).split("\n")
    assert columns is None or max(map(len, lines)) <= columns
    assert any("0.0718" in line for line in lines) and (columns is not None or len(lines) == 3)
    words = " ".join(lines).split()
    assert sum(word in ("a", "doubt", "many", "words") for word in words) == 8


def test_a_name_that_is_typed_again_is_not_broken_while_another_column_can_be(screen):
    screen(80)
    rows = [("anodised-aluminium", "aluminium", "metal", "satin", "aluminium with a clear oxide layer, bead blasted")]
    lines = table.columns(("material", "kind or substance", "appearance", "finish", "about"), rows).split("\n")
    assert any(line.startswith("anodised-aluminium ") for line in lines) and max(map(len, lines)) <= 80


def test_materials_on_a_narrow_screen_are_a_line_or_two_each(screen):
    rows = [("anodised-aluminium", "aluminium", "metal", "satin", "aluminium with a clear oxide layer, bead blasted")]
    rows.append(
        ("retro-tape", "dielectric", "", "satin", "retro-reflective tape; outside what the guide's models can do")
    )
    screen(80)
    lines = catalogue.materials_text(rows).split("\n")
    assert len(lines) == 5 and max(map(len, lines)) <= 80
    assert "bead blasted" in lines[1] and " ".join(lines[1:3]).split()[-3:] == ["(aluminium,", "metal,", "satin)"]
    screen(None)
    assert len(catalogue.materials_text(rows).split("\n")) == 3


@pytest.mark.parametrize("columns", [80, 100, 120, 200])
@pytest.mark.parametrize("full", [True, False], ids=["full", "short"])
def test_an_answer_fits_the_screen_in_colour_and_says_what_the_plain_one_says(screen, document, columns, full):
    screen(columns)
    plain = ranking.ranking_text(document, full=full)
    coloured = terminal.coloured_text(document, full=full)
    assert widest(coloured) <= columns
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured) == plain
    head = next(line for line in plain.split("\n") if line.startswith("rank"))
    assert re.split(r"  +", head) == ["rank", "model", "off", "seen L*", "held-out", "doubts"]


def test_the_answer_comes_first_then_what_to_type_then_how_far_to_trust_it(screen, document):
    screen(80)
    lines = ranking.ranking_text(document).split("\n")
    row = ranking.recommended_row(document)
    assert lines[0].startswith(f"recommended: {document['recommended']}, typically ")
    assert lines[1].startswith("  to type: ") and f"ggx.alpha={row['typed']['ggx.alpha']:.4g}" in " ".join(lines[1:3])
    assert any(line.startswith("  trust: ") for line in lines[:12])
    assert "ns/sample" not in "\n".join(lines)


def test_in_full_every_row_has_its_error_and_its_parameters(screen, document):
    screen(None)
    text = ranking.ranking_text(document, full=True)
    for row in document["ranking"]:
        assert f"{row['candidate']}  " in text and f"{row['rms_ln']:.4f}" in text
    assert ("ns/sample" in text) == ("time_per_sample_ns" in document["ranking"][0])


def test_a_doubt_of_every_model_is_said_once(screen, document):
    screen(None)
    shared = [{**row, "flags": [*row["flags"], {"code": "discrepancy", "text": "t"}]} for row in document["ranking"]]
    text = ranking.ranking_text({**document, "ranking": shared})
    assert "doubts of every model: discrepancy" in text
    assert not any("discrepancy" in line for line in text.split("\n") if line.startswith(("1 ", "2 ", "1=", "3 ")))


def test_the_recommended_row_is_green_and_doubts_are_yellow(screen, document):
    screen(200)
    lines = terminal.coloured_text(document).split("\n")
    chosen = next(line for line in lines if f"  {document['recommended']} " in line)
    assert chosen.startswith("\x1b[1;32m") and lines[0].startswith("\x1b[1;32mrecommended")
    doubts = [line for line in lines if "doubts:" in line and "every model" not in line]
    assert all(line.startswith("\x1b[33m") for line in doubts)


def test_parameters_of_one_name_are_told_apart_for_the_eye():
    entry = {"known_to": 0.1, "shows_from": 0.2}
    said = shows_text({"ggx.1.alpha": entry, "ggx.2.alpha": entry, "ggx.1.n": entry, "lambertian.albedo": {}})
    assert "ggx.1.alpha is known" in said and "ggx.2.alpha is known" in said
    assert "; n is known" in said and "albedo" not in said


def test_captions_and_pages_do_not_break_the_names_of_models():
    words = "he-torrance.sigma 0.03 um, he-torrance.slope 0.006, he-torrance.n 1.5"
    assert all(line.count("he-torrance") == line.count("torrance") for line in spheres.caption(words, 30))
    assert elements.typed({"he-torrance.n": 1.5}).startswith('<code class="whole">he-torrance.n=')
    assert "code.whole{display:inline-block" in sheet.html_page("", "", "")
