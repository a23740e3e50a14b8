"""Every document follows its JSON Schema, which is printed by name and complete."""

import subprocess
import sys

import pytest

from brdfguide import models

from .. import schemas
from ..conftest import ROOT

jsonschema = pytest.importorskip("jsonschema")
KEPT = schemas.KEPT
AGAIN = "python -m tests.schemas writes them anew"


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    return schemas.documents(tmp_path_factory.mktemp("schemas"))


@pytest.mark.parametrize("name", KEPT)
def test_a_schema_is_one(name):
    jsonschema.Draft202012Validator.check_schema(KEPT[name])
    assert KEPT[name]["title"] == f"brdfguide/{name}/1"


def test_every_document_that_the_source_makes_has_a_schema():
    said = set()
    for path in (ROOT / "brdfguide").rglob("*.py"):
        said |= {word.split("/")[0] for word in path.read_text().split('"brdfguide/')[1:] if "/1" in word[:30]}
    own = {"explain", "factors", "collected", "answers", "failure", "explorer"}  # words only; contents of files
    assert said - own == set(KEPT), AGAIN


def test_every_document_follows_its_schema(printed):
    assert {line: schemas.wrong(document) for line, document in printed if schemas.wrong(document)} == {}, AGAIN


def test_no_key_is_without_an_entry(printed):
    now = schemas.schemas(printed)
    assert {name: sorted(keys(schema) - keys(KEPT[name])) for name, schema in now.items()} == {
        name: [] for name in now
    }, AGAIN


def keys(schema: dict, place: str = "") -> set[str]:
    """Every place in a schema that has a name."""
    found = set()
    for name, inside in schema.get("properties", {}).items():
        found |= {f"{place}.{name}"} | keys(inside, f"{place}.{name}")
    for word in ("items", "additionalProperties"):
        if isinstance(schema.get(word), dict):
            found |= keys(schema[word], f"{place}.*")
    for name, inside in schema.get("$defs", {}).items():
        found |= keys(inside, f"${name}")
    return found


def test_a_number_is_never_a_list_of_one_nor_a_list_a_number(printed):
    """What belongs to channels is an array in every row, also where it was held or there is one channel."""
    rankings = [document["ranking"] for _, document in printed if "ranking" in document]
    rows = [(row["model"], row["parameters"]) for ranking in rankings for row in ranking if "parameters" in row]
    assert len(rows) > 20
    for name, parameters in rows:
        for key, parameter in models.get(name).parameters.items():
            assert isinstance(parameters[key]["value"], list) == parameter.per_channel, f"{name} {key}"


def test_the_recommended_fit_is_its_row(printed):
    fits = [document for line, document in printed if document["schema"] == "brdfguide/fit/1"]
    assert fits
    for document in fits:
        row = next(row for row in document["ranking"] if row["candidate"] == document["recommended"])
        assert document["recommended_fit"] == row and document["trustworthy"] == (document["no_answer"] is None)


def schema(*words: str):
    return subprocess.run(
        [sys.executable, "-m", "brdfguide", "schema", *words], cwd=ROOT, capture_output=True, text=True
    )


def test_a_schema_is_printed_by_name_as_it_is_kept():
    assert schema("fit").stdout == schema("brdfguide/fit/1").stdout == (schemas.FOLDER / "fit.json").read_text()
    assert schema().stdout.split() == sorted(KEPT)
    missing = schema("fitt")
    assert missing.returncode == 2 and "no document called 'fitt'; did you mean fit?" in missing.stderr
