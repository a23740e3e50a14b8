"""The one list of flags: nothing outside it can be made, nothing in it is dead, and the page says what it says."""

import ast

import pytest

from brdfguide import flags
from brdfguide.advice.guidelines import rules
from brdfguide.errors import InputError
from brdfguide.finding import Finding
from brdfguide.report.documents.explained import explained
from brdfguide.report.text.explained import explained_text

from .conftest import ROOT

SOURCES = [path for path in sorted((ROOT / "brdfguide").rglob("*.py")) if path.name != "flags.py"]
TREES = {path: ast.parse(path.read_text()) for path in SOURCES}


def constants(node) -> set[str]:
    return {each.value for each in ast.walk(node) if isinstance(each, ast.Constant) and isinstance(each.value, str)}


def codes_said():
    """(place, code) of every code that stands in the source where one is made: in a Finding, or in a document."""
    for path, tree in TREES.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("Finding", "_flag", "remark_on"):
                if isinstance(node.args[0], ast.Constant):
                    yield f"{path.name}:{node.lineno}", node.args[0].value
            elif isinstance(node, ast.Dict):
                for key, value in zip(node.keys, node.values, strict=True):
                    if isinstance(key, ast.Constant) and key.value == "code" and isinstance(value, ast.Constant):
                        yield f"{path.name}:{node.lineno}", value.value


def test_every_code_in_the_source_is_listed():
    found = list(codes_said())
    assert len(found) > 100
    assert not [(place, code) for place, code in found if code not in flags.FLAGS | {"guess": None}]


def test_every_listed_flag_is_raised_somewhere():
    said = set().union(*map(constants, TREES.values()))
    assert not flags.FLAGS.keys() - said


def test_the_page_is_written_from_the_list():
    assert (ROOT / "docs" / "flags.md").read_text() == flags.flags_page(), "python -m brdfguide.flags > docs/flags.md"


@pytest.mark.parametrize(
    "args, more, sentence",
    [
        (("no-such-code", "text"), {}, "no flag called no-such-code"),
        (("ridge", "text", "error"), {}, "ridge is listed as warning, found error"),
        (("spikes", "text", "warning"), {"option": "--quantity"}, "listed with the option '--anyway'"),
        (("at-bound", "text"), {}, "listed with a subject"),
        (("ridge", "text", "warning"), {"subject": "ggx.n"}, "listed without a subject"),
    ],
)
def test_what_the_list_does_not_say_cannot_be_made(args, more, sentence):
    with pytest.raises(ValueError, match=sentence):
        Finding(*args, **more)


def test_a_finding_about_a_parameter_prints_both_parts():
    assert Finding("at-bound", "text", "warning", subject="ggx.alpha").printed == "at-bound:ggx.alpha"
    assert Finding("ridge", "text", "warning").printed == "ridge"


def test_no_code_is_listed_twice():
    assert sum(map(len, flags.SECTIONS.values())) == len(flags.FLAGS)


def test_no_code_steers_since_the_list_says_what_each_does():
    """What the program does for a flag is its Effect; its code is asked for only by people, through `Fit.has`."""
    for path, tree in TREES.items():
        asked = {id(each) for node in ast.walk(tree) if getattr(node, "name", "") == "has" for each in ast.walk(node)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Compare) and id(node) not in asked:
                names = {each.attr for each in ast.walk(node) if isinstance(each, ast.Attribute)}
                assert "code" not in names, f"{path.name}:{node.lineno}"


def test_every_effect_is_some_flags():
    assert {flag.effect for flag in flags.FLAGS.values()} == set(flags.Effect)


def test_every_flag_and_every_rule_is_explained():
    for code in [*flags.FLAGS, *(rule.__name__ for rule in rules())]:
        entry = explained(code)
        text = " ".join(explained_text(entry).split())
        assert text.startswith(f"{code}: ") and " ".join(entry["meaning"].split()) in text
        if entry["is"] == "flag":
            assert entry["meaning"] == flags.FLAGS[code].meaning
            assert not flags.FLAGS[code].option or f"overridden by {flags.FLAGS[code].option}" in text


def test_a_code_is_explained_as_it_is_printed_and_one_misspelt_gets_the_nearest():
    assert explained("at-bound:ggx.alpha")["code"] == "at-bound" and explained("discrepancy 7.1 %")["is"] == "flag"
    with pytest.raises(InputError, match="no flag or rule called 'discrepanc'; did you mean discrepancy?"):
        explained("discrepanc")
