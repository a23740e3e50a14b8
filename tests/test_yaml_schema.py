"""Files of declared shape: YAML 1.2 scalars, all errors at once with their places, and nothing dangerous."""

import pytest

from brdfguide.errors import InputError
from brdfguide.yaml_schema import MOST_BYTES, Field, parse, read

from .patience import takes_less_than

FIELDS = (
    Field("kind", "word", choices=("metal", "dielectric", "metallic flake")),
    Field("f0", "number", low=0, high=1),
    Field("angle_deg", "number", unit="°", low=0, high=90, choices=("never",)),
    Field("rgb", "numbers", counts=(1, 3), low=0, high=1),
    Field("gloss", "group", fields=(Field("60", "number", low=0, unit="GU"),)),
    Field("turned", "flag"),
    Field(
        "lights", "groups", fields=(Field("size_deg", "number", above=0, required=True, meaning="angular diameter"),)
    ),
    Field("files", "texts"),
)


def wrong(text: str, rules=()) -> list[str]:
    with pytest.raises(InputError) as caught:
        parse(text, FIELDS, rules, "x.yaml")
    return str(caught.value).split("\n")


def test_numbers_words_and_flags_are_those_of_yaml_1_2():
    document = parse(
        "f0: 1e-3\nangle_deg: Never\nkind: metallic_FLAKE\nturned: false\nrgb: 01\nfiles: no\ngloss: {60: +1.5E1}",
        FIELDS,
    )
    assert document.values == {
        "f0": 0.001,
        "angle_deg": "never",
        "kind": "metallic flake",
        "turned": False,
        "rgb": [1.0],
        "files": ["no"],
        "gloss": {"60": 15.0},
    }


def test_every_value_knows_its_place():
    document = parse("kind: metal\nlights:\n  - {size_deg: 3}\n  - size_deg: 4\n", FIELDS)
    assert document.place("kind") == (1, 7)
    assert document.place("lights.1.size_deg") == (4, 15)
    assert document.at("lights.1.colour", "grey") == "<text>:4:5: grey"


def test_all_errors_come_at_once_in_the_order_of_the_file():
    assert wrong("falg: 1\nkind: mettal\nf0: 2\nrgb: [1, 0]\nf0: 1\n") == [
        "x.yaml:1:1: no key called 'falg'; there are: kind, f0, angle_deg, rgb, gloss, turned, lights, files",
        "x.yaml:2:7: 'kind' is 'mettal'; did you mean 'metal'? it is one of: metal, dielectric, metallic flake",
        "x.yaml:3:5: 'f0' is 2; wanted a number from 0 to 1",
        "x.yaml:4:6: 'rgb' has 2 numbers; wanted 1 or 3",
        "x.yaml:5:1: 'f0' is given twice; first in line 3, column 1",
    ]


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("f0: 4%", "x.yaml:1:5: 'f0' is '4%'; wanted a number from 0 to 1; write 0.04"),
        ("f0: 0,04", "x.yaml:1:5: 'f0' is '0,04'; wanted a number from 0 to 1; write 0.04"),
        ("f0: '0.04'", "x.yaml:1:5: 'f0' is '0.04'; wanted a number from 0 to 1; write it without quotes"),
        ("f0: 0x10", "x.yaml:1:5: 'f0' is '0x10'; wanted a number from 0 to 1"),
        ("f0: .nan", "x.yaml:1:5: 'f0' is '.nan'; wanted a number from 0 to 1"),
        ("f0: 1e999", "x.yaml:1:5: 'f0' is 1e999; wanted a number from 0 to 1"),
        ("f0: {a: 1}", "x.yaml:1:5: 'f0' is a mapping; wanted a number from 0 to 1"),
        ("f0:", "x.yaml:1:4: 'f0' has no value; give one, or remove the line"),
        (
            "angle_deg: 80 deg",
            (
                "x.yaml:1:12: 'angle_deg' is '80 deg'; wanted a number from 0 to 90 [°] or 'never'; write the number "
                "alone, 80"
            ),
        ),
        ("turned: no", "x.yaml:1:9: 'turned' is 'no'; wanted true or false"),
        ("trned: true", "x.yaml:1:1: no key called 'trned'; did you mean 'turned'?"),
        ("gloss: {61: 3}", "x.yaml:1:9: no key called '61' in 'gloss'; there are: 60"),
        ("lights: [{}]", "x.yaml:1:10: 'lights.0' needs 'size_deg': angular diameter"),
        ("lights: 3", "x.yaml:1:9: 'lights' is '3'; wanted a list"),
        ("lights: [{size_deg: 0}]", "x.yaml:1:21: 'lights.0.size_deg' is 0; wanted a number above 0"),
        (
            "- metal",
            (
                "x.yaml:1:1: the file is a list; wanted lines of `key: value` with kind, f0, angle_deg, rgb, gloss, "
                "turned, lights, files"
            ),
        ),
        (
            "? [a]\n: b",
            "x.yaml:1:3: no key called 'a list'; there are: kind, f0, angle_deg, rgb, gloss, turned, lights, files",
        ),
        (
            "",
            (
                "x.yaml:1:1: empty; a description needs at least one of: kind, f0, angle_deg, rgb, gloss, turned, "
                "lights, files"
            ),
        ),
        ("kind: [metal", "x.yaml:1:13: not valid YAML: expected ',' or ']', but got '<stream end>'"),
        ("\tkind: metal", "x.yaml:1:1: not valid YAML: found character '\\t' that cannot start any token"),
        ("kind: metal\n---\nkind: metal", "x.yaml:2:1: not valid YAML: but found another document"),
        (
            "f0: !!python/object/apply:os.getcwd []",
            "x.yaml:1:5: not valid YAML: tags (tag:yaml.org,2002:python/object/apply:os.getcwd) are not used here",
        ),
        ("f0: !mine 3", "x.yaml:1:5: not valid YAML: tags (!mine) are not used here"),
        ("kind: &a metal", "x.yaml:1:7: not valid YAML: anchors (&a) are not used here"),
        ("kind: *a", "x.yaml:1:7: not valid YAML: aliases (*a) are not used here"),
        ("kind: met\0al", "x.yaml:1:1: not text: contains the character 0x0"),
        ("[" * 30000, "x.yaml:1:13: not valid YAML: nested more than 12 deep"),
    ],
)
def test_each_error_is_one_clear_sentence(text, sentence):
    assert wrong(text) == [sentence]


def test_a_bomb_of_aliases_is_refused_before_it_grows():
    bomb = "a: &a [x, x]\n" + "".join(
        f"{b}: &{b} [*{a}, *{a}, *{a}, *{a}]\n" for a, b in zip("abcdefghijk", "bcdefghijkl", strict=True)
    )
    assert takes_less_than(0.5, lambda: wrong(bomb))
    assert wrong(bomb) == ["x.yaml:1:4: not valid YAML: anchors (&a) are not used here"]


def test_rules_speak_with_the_place_of_what_they_found():
    def rule(document):
        if document.values.get("kind") == "metal" and "f0" in document.values:
            yield "f0", "too dark for a metal"

    assert wrong("kind: metal\nf0: 0.04\n", [rule]) == ["x.yaml:2:5: too dark for a metal"]


def test_huge_unreadable_and_binary_files_do_no_harm(tmp_path):
    huge = tmp_path / "huge.yaml"
    huge.write_bytes(b"#" * (MOST_BYTES + 1))
    with pytest.raises(InputError, match="larger than 64 kB"):
        read(huge, FIELDS)
    with pytest.raises(InputError, match="is a directory; wanted a file"):
        read(tmp_path, FIELDS)
    with pytest.raises(InputError, match="there is no such file"):
        read(tmp_path / "none.yaml", FIELDS)
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"kind: metal\nf0: \xff\xfe")
    with pytest.raises(InputError, match="binary.yaml:2:5: not UTF-8 text"):
        read(binary, FIELDS)
