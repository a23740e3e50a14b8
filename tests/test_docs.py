"""The documentation is true: what it shows is what an installed program prints, its commands and links exist, and the
pages that are made of tables are those of today.
"""

import io
import json
import re
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from typer.main import get_command

from brdfguide import catalog, models
from brdfguide.advice import library
from brdfguide.cli import _pages, _reference_pictures
from brdfguide.cli._app import build

from . import commands, transcripts
from .conftest import ROOT

COMMAND = re.compile(r"\bbrdfguide ((?:[a-z]+|--[a-z]+)\b[^`|>;&\n]*)")
ALIKE = 4.0  # of 255; the pictures of two laws are 8 to 10 apart
TIMED = {"fit_rough_plastic.png": 0.6}  # the part above a panel of measured times
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


@pytest.mark.parametrize("page", commands.PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_command_of_a_page_runs_and_prints_what_the_page_shows(page, package, tmp_path):
    """By an installed program, in a folder with what its reader has; numbers to the last printed digits, and pictures
    that a page shows as they would be drawn today."""
    bin_ = str(package.bin)
    commands.furnished(page, tmp_path, bin_)
    for command, shown in commands.commands(page):
        done = transcripts.run(command, tmp_path, bin_)
        assert done.returncode == 0 and "Traceback" not in done.stderr, f"{command}\n{done.stderr}"
        if shown is None:
            assert done.stdout or done.stderr or re.search(r" -o | -q\b| > ", command), command
        elif not shown:
            assert not done.stdout, f"{command}: the page shows nothing; the program says\n{done.stdout}"
        else:
            line = transcripts.missing(done.stdout, shown)
            assert line is None, f"{command}: the page shows {line!r}; the program says\n{done.stdout}"
    for drawn in sorted(tmp_path.rglob("*.png")):
        kept = ROOT / "docs" / "pictures" / drawn.name
        assert not kept.exists() or apart(kept, drawn, TIMED.get(drawn.name, 1.0)) < ALIKE, drawn.name


@pytest.fixture(scope="module")
def options():
    """Command -> the names of its options."""
    group = get_command(build(catalog.names("cli")))
    found = {name: {n for each in command.params for n in each.opts} for name, command in group.commands.items()}
    return {name: names | {"-h", "--help", "-"} for name, names in found.items()}


@pytest.mark.parametrize("page", transcripts.PAGES, ids=lambda page: page.name)
def test_every_command_that_is_written_anywhere_exists_with_its_options(page, options):
    for typed in COMMAND.findall(page.read_text()):
        words = typed.split()
        if words[0].startswith("-"):
            assert words[0] in ("--explain", "--version", "--help", "--install-completion"), typed
        elif words[0] in options or len(words) > 1 and words[1].startswith("-"):
            assert words[0] in options, typed
            wrong = [w for w in words[1:] if w.startswith("-") and w[1:2].isalpha() | w.startswith("--")]
            names = [w.partition("=")[0].rstrip(".,:)'\"") for w in wrong]
            assert [name for name in names if name not in options[words[0]]] == [], typed


@pytest.mark.parametrize("page", transcripts.PAGES, ids=lambda page: page.name)
def test_every_link_leads_somewhere(page):
    for target in LINK.findall(page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), target


@pytest.mark.parametrize("name", sorted(_pages.NAMES))
def test_a_page_of_tables_is_that_of_today(name):
    kept = (ROOT / "docs" / name).read_text(encoding="utf-8")
    assert kept == _pages.reference_page(name), "python -m brdfguide.cli._pages docs"


def test_the_reference_pages_are_complete():
    """Each command, law, rule and format has its entry: they are made of the catalogues, which know them all."""
    commands, laws = ((ROOT / "docs" / "reference" / f"{name}.md").read_text() for name in ("commands", "models"))
    assert all(f"\n## {name}\n" in commands for name in catalog.names("cli"))
    assert all(f"\n## {name}\n" in laws for name in catalog.names("models"))


def test_every_law_and_every_material_has_its_picture():
    laws, materials = (
        {path.stem for path in (ROOT / "docs" / "pictures" / kind).glob("*.png")} for kind in ("laws", "materials")
    )
    assert (
        laws == set(models.names()) - _reference_pictures.UNDRAWN
        and materials == set(library.library_names()) - _reference_pictures.UNDRAWN
    )


@pytest.mark.parametrize("folder, name", [("laws", "ward"), ("laws", "lafortune"), ("materials", "banana")])
def test_a_picture_of_the_reference_is_what_would_be_drawn_today(folder, name):
    draw = _reference_pictures.law_picture if folder == "laws" else _reference_pictures.material_picture
    assert apart(ROOT / "docs" / "pictures" / folder / f"{name}.png", io.BytesIO(draw(name))) < ALIKE


def apart(kept, today, upper: float = 1.0) -> float:
    """Mean difference of the pixels of the upper part, of 255: another matplotlib sets letters otherwise."""
    kept, today = (np.asarray(Image.open(each).convert("RGB"), float) for each in (kept, today))
    assert kept.shape == today.shape
    rows = round(upper * len(kept))
    return float(np.mean(np.abs(kept - today)[:rows]))


def test_the_site_is_built(tmp_path):
    pytest.importorskip("mkdocs")
    command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--site-dir", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "for_artists" / "index.html").exists() and (tmp_path / "reference" / "models").is_dir()


def test_the_notebook_does_what_it_says(tmp_path, monkeypatch):
    """Its cells one after another, in an empty folder."""
    notebook = json.loads((ROOT / "docs" / "notebook.ipynb").read_text())
    source = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(source) > 6 and notebook["nbformat"] == 4
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))  # of the program that the first cell starts
    names: dict = {}
    for cell in source:
        exec(compile(cell, "notebook.ipynb", "exec"), names)
    assert names["answer"].document["trustworthy"] and (tmp_path / "mug.mtlx").stat().st_size > 100
