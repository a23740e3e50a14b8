"""Documents are the only source of text, JSON and page: words are made of what JSON holds, and of nothing else."""

import json
import subprocess
import sys

import pytest

from brdfguide.report.text import (
    audit,
    catalogue,
    emergence,
    glossmeter,
    indices,
    inspection,
    neutrals,
    numbers,
    pruned,
    ranking,
    recommendation,
    values,
)

from ..conftest import ROOT
from ..test_house import FILES, imports


def fitted(document: dict) -> str:
    found = f"\n\n{ranking.next_text(document['next'])}" if "next" in document else ""
    return f"{ranking.ranking_text(document)}{found}\n\n{numbers.card_text(document['numbers'])}"


def recommended(document: dict, explain: bool = False) -> str:
    scene = f"\n\n{pruned.text(document['scene'])}" if "scene" in document else ""
    return f"{recommendation.text(document, explain=explain)}{scene}\n\n{numbers.card_text(document['numbers'])}"


RUN = [sys.executable, "-m", "brdfguide"]
# command line -> what makes its words of its JSON
SAID = {
    "roughness --angle 80": emergence.text,
    "roughness --sigma-um 0.5 --tau-um 5": emergence.text,
    "inspect examples/rough_plastic.csv": inspection.text,
    "fit examples/rough_aluminium.csv --no-timing --numbers": fitted,
    "fit examples/rough_aluminium.csv --no-timing --numbers --next -m lambertian+ggx,lambertian+ward": fitted,
    "recommend porcelain --no-timing --numbers --scene default": recommended,
    "recommend porcelain --no-timing --numbers --explain": lambda document: recommended(document, explain=True),
    "recommend satin-chrome --no-timing --numbers": recommended,
    "recommend satin-chrome --no-timing --no-numbers": recommendation.text,
    "index brass": indices.text,
    "gloss --at-60 80": glossmeter.readings_text,
    "gloss --alpha 0.2": glossmeter.lobes_text,
    "albedo": neutrals.chart_text,
    "albedo --patch white": neutrals.text,
    "check lambertian ward": audit.text,
    "evaluate ggx alpha=0.2 n=1.5": values.csv,
    "models ward": lambda document: catalogue.model_text(document["models"][0]),
}


def said(*words: str) -> str:
    return subprocess.run([*RUN, *words], cwd=ROOT, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("line", SAID)
def test_the_words_of_a_command_can_be_made_of_its_json(line):
    document = json.loads(said(*line.split(), "--json"))
    assert SAID[line](document).rstrip("\n") == said(*line.split()).rstrip("\n")


@pytest.mark.parametrize(
    "module", [name for name in FILES if name.startswith(("report.text.", "report.page", "report.elements"))]
)
def test_words_and_pages_know_no_results(module):
    """They import each other, documents and the ground: no model, no data, no fit."""
    for line, target, _ in imports(module):
        ground = "." not in target
        assert ground or target.startswith(
            ("report.text", "report.documents", "report.sheet", "report.elements", "report.page")
        ), f"{module}:{line}"


@pytest.mark.parametrize("module", [name for name in FILES if name.startswith("report.documents.")])
def test_documents_know_no_words_and_no_pictures(module):
    for line, target, _ in imports(module):
        assert not target.startswith(("report.text", "report.figures", "report.page")), f"{module}:{line}: {target}"
