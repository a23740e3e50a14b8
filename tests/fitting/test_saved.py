"""What comes back in is checked once: a tampered or foreign JSON is a sentence with the place of the error."""

import copy
import json
import random

import pytest

from brdfguide import exporters
from brdfguide.errors import BrdfguideError, InputError, NoAnswer
from brdfguide.fitting import saved

ROW = {
    "model": "lambertian+ggx",
    "candidate": "lambertian+ggx",
    "freed": [],
    "parameters": {
        "lambertian.albedo": {"value": [0.5, 0.4]},
        "ggx.alpha": {"value": 0.3},
        "ggx.n": {"value": [1.5, 1.5]},
        "ggx.k": {"value": 0.0},
        "ggx.scale": {"value": 1.0, "stderr": None},
    },
}
FIT = {
    "schema": "brdfguide/fit/1",
    "data": {"channels": ["450 nm", "650 nm"], "wavelength_nm": [450.0, 650.0], "solid_angle_sr": None},
    "recommended": "lambertian+ggx",
    "ranking": [ROW, {**ROW, "model": "lambertian+ward", "candidate": "lambertian+ward", "parameters": {}}],
}
START = {"lambertian.albedo": [0.1, 0.2, 0.3], "ggx.alpha": 0.2}
SAID = {"schema": "brdfguide/recommend/1", "candidates": [{"model": "lambertian+ggx", "start": START}]}


def read(document, tmp_path, name=None):
    path = tmp_path / "x.json"
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return saved.read_surface(path, name)


def changed(document, place: str, value):
    """A copy with another value at a place such as `ranking.0.model`."""
    made = copy.deepcopy(document)
    *way, last = [int(word) if word.isdigit() else word for word in place.split(".")]
    at = made
    for word in way:
        at = at[word]
    if value is KeyError:
        del at[last]
    else:
        at[last] = value
    return made


def test_good_ones_are_surfaces(tmp_path):
    surface = read(FIT, tmp_path)
    assert surface.values["ggx.alpha"] == 0.3 and surface.channels == ("450 nm", "650 nm")
    assert read(FIT, tmp_path, "lambertian+ward").model.name == "lambertian+ward"
    assert read(SAID, tmp_path).channels == ("R", "G", "B")


@pytest.mark.parametrize(
    "place, value, sentence",
    [
        ("data", "x", r'x.json: data: found "x"; wanted an object'),
        ("data.channels", [0, 1], r"data.channels\[0\]: found 0; wanted a text"),
        ("data.channels", [], r"data.channels: found none; wanted at least one"),
        ("data.wavelength_nm", [1.0, 2.0, 3.0], r"found 3 wavelengths; wanted one, or 2 for the channels"),
        ("data.wavelength_nm", [0.0, 550.0], r"data.wavelength_nm: found 0; wanted 100 to 100000 nm"),
        ("recommended", [], r"recommended: found a list of 0; wanted a text"),
        ("recommended", "ward", r"recommended: found 'ward'; wanted a row of the ranking"),
        ("ranking", "x", r'ranking: found "x"; wanted a list'),
        ("ranking", [], r"ranking: found none"),
        ("ranking.0", None, r"ranking\[0\]: found null; wanted an object"),
        ("ranking.0.candidate", KeyError, r"ranking\[0\]: there is no 'candidate'; wanted a text"),
        ("ranking.0.model", "../x", r"ranking\[0\].model: no model called '../x'"),
        ("ranking.0.freed", ["ggx.x"], r"ranking\[0\].freed: found ggx.x, which is no parameter"),
        ("ranking.0.parameters", None, r"ranking\[0\].parameters: found null; wanted an object"),
        ("ranking.0.parameters.ggx_alpha", 3, r"parameters.ggx_alpha: found 3; wanted an object or null"),
        ("schema", "brdfguide/fit/7", r"its schema is brdfguide/fit/7, of another version of brdfguide, and this one"),
        ("schema", "brdfguide/export/1", r"its schema is 'brdfguide/export/1'; this reads brdfguide/fit/1 or"),
        ("schema", KeyError, r"it has no 'schema'"),
        ("schema", 3, r"its schema is '3'"),
    ],
)
def test_an_error_says_its_place(place, value, sentence, tmp_path):
    with pytest.raises(InputError, match=sentence):
        read(changed(FIT, place, value), tmp_path)


def test_a_value_out_of_bounds_or_of_another_number_says_its_place(tmp_path):
    document = copy.deepcopy(FIT)
    document["ranking"][0]["parameters"]["ggx.alpha"] = {"value": 7}
    with pytest.raises(InputError, match=r"ranking\[0\].parameters.ggx.alpha: .*7 is outside"):
        read(document, tmp_path)
    document["ranking"][0]["parameters"]["ggx.alpha"] = {"value": [0.1, 0.2, 0.3]}
    with pytest.raises(InputError, match=r"ggx.alpha: found 3 values; wanted one, or 2 for the channels"):
        read(document, tmp_path)
    document["ranking"][0]["parameters"]["ggx.alpha"] = {"value": 10**400}
    with pytest.raises(InputError, match=r"ggx.alpha.value: found a huge number; wanted a number or a list"):
        read(document, tmp_path)


def test_recommendations_say_their_places(tmp_path):
    for place, value, sentence in (
        ("candidates.0.start", KeyError, r"candidates\[0\]: there is no 'start'"),
        ("candidates.0.start", {"ggx.alpha": "a"}, r"candidates\[0\].start.ggx.alpha: found \"a\"; wanted a number"),
        ("candidates.0.start", {"ward.alpha": 0.1}, r"candidates\[0\].start: ward.alpha is no parameter"),
        ("candidates.0.model", "ggx+nosuch", r"candidates\[0\].model: no model called 'nosuch'"),
    ):
        with pytest.raises(InputError, match=sentence):
            read(changed(SAID, place, value), tmp_path)
    with pytest.raises(NoAnswer, match="recommends no model"):
        read(changed(SAID, "candidates", []), tmp_path)


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("", "not JSON"),
        ("[]", "found a list of 0; wanted the output"),
        ("3", "found 3; wanted the output"),
        ("[" * 100_000, "nested too deeply"),
        ('{"schema": NaN}', "NaN is no number"),
        ("9" * 5000, "not JSON"),
        ("\ufeff{}", "not JSON|no 'schema'"),
    ],
)
def test_what_is_no_such_json_is_a_sentence(text, sentence, tmp_path):
    with pytest.raises(InputError, match=sentence) as error:
        read(text, tmp_path)
    assert len(str(error.value)) < 600


ODD = (None, True, 0, -1, 1e300, 10**400, "", "x", "\ud800", [], {}, [0], [[]], {"value": 1}, ["a"], [0.5, 0.4, 0.3])


def mutated(document, draw: random.Random):
    """A copy with one to three places changed, left out, doubled or renamed."""
    made = copy.deepcopy(document)
    for _ in range(draw.randint(1, 3)):
        at = made
        while True:
            keys = list(at) if isinstance(at, dict) else list(range(len(at)))
            if not keys:
                break
            key = draw.choice(keys)
            if isinstance(at[key], (dict, list)) and draw.random() < 0.75:
                at = at[key]
                continue
            change = draw.randrange(4)
            if change == 0:
                del at[key]
            elif change == 1 and isinstance(at, dict):
                at[draw.choice(("x", "value", "model", "candidate"))] = at.pop(key)
            else:
                at[key] = copy.deepcopy(draw.choice(ODD))
            break
    return made


@pytest.mark.parametrize("seed", [16, 17, 18])
@pytest.mark.parametrize("document", [FIT, SAID], ids=["fit", "recommend"])
def test_a_thousand_tampered_documents_are_surfaces_or_sentences(document, seed, tmp_path):
    draw, said = random.Random(seed), set()
    for _ in range(300):
        made = mutated(document, draw)
        try:
            surface = read(made, tmp_path)
            exporters.coloured(surface, "x")
            assert surface.channel(0).values is not None
        except BrdfguideError as error:
            assert "\n" not in str(error) and len(str(error)) < 1300
            said.add(str(error))
        except Exception as error:
            raise AssertionError(f"{json.dumps(made)[:2000]}") from error
    assert len(said) > 25  # the test is not about the first sentence alone
