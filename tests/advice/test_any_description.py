"""Any valid description, however odd, is answered: drawn from the schema itself."""

import json
import random

import numpy as np
import pytest

from brdfguide.advice import material, recommend
from brdfguide.errors import InputError
from brdfguide.report.documents.recommendation import document
from brdfguide.report.text.recommendation import text

from .coherence import faults

NAMES = ("brass", "paint", "silicon", "water", "unobtainium", "gold", "wood", "steel paint", "germanium")


def number(field, rng) -> float:
    low = field.above if field.above is not None else field.low
    if rng.random() < 0.3:
        return rng.choice([field.high, low if field.above is None else low + (field.high - low) * 1e-6])
    start = max(low, field.high * 1e-6)
    return float(f"{np.exp(rng.uniform(np.log(start), np.log(field.high))):.6g}")


def value(field, rng):
    if field.choices and (field.kind == "word" or rng.random() < 0.2):
        return rng.choice(field.choices)
    if field.kind == "number":
        return number(field, rng)
    if field.kind == "numbers":
        return [number(field, rng) for _ in range(rng.choice(field.counts or (2,)))]
    if field.kind == "colour":
        return rng.choice([f"#{rng.randrange(256**3):06x}", [rng.random() for _ in range(3)], rng.random()])
    if field.kind == "flag":
        return rng.random() < 0.5
    if field.kind == "text":
        return rng.choice(NAMES)
    if field.name == "colorchecker":
        return {"between": rng.sample(material.PATCHES, 2), "position": rng.random()}
    return {each.name: value(each, rng) for each in field.fields if each.required or rng.random() < 0.6}


def drawn(seed: int) -> dict:
    rng = random.Random(seed)
    share = rng.choice((0.1, 0.25, 0.5))
    given = {field.name: value(field, rng) for field in material.OBSERVATIONS if rng.random() < share}
    return _as_a_shader_has_it({key: each for key, each in given.items() if each != {}}, rng)


def _as_a_shader_has_it(given: dict, rng) -> dict:
    """A shader's words in a form that may be accepted: mostly they would contradict each other."""
    given |= {"metallic": rng.randrange(2)} if "metallic" in given else {}
    given |= {"roughness": rng.random()} if "roughness" in given else {}
    dropped = {"in"} if "roughness" not in given else set()
    dropped |= {"ior"} if "index" in given else set()
    return {key: each for key, each in given.items() if key not in dropped}


def test_an_observation_that_answers_what_a_rule_needs_is_not_without_effect_seed_10052():
    """A streak's width: without it the rule says what it needs, and nothing else changes."""
    made = material.parse_material(json.dumps(drawn(10_052)))
    assert recommend.recommend(made, anyway=True).effects["highlight_width_deg"] == "confirms"
    assert not list(faults(made))


def test_an_observation_that_a_candidate_cannot_show_is_not_without_effect_seed_10729():
    """A mirror image seen above flakes under a satin coat: only what the candidates cannot show tells of it."""
    made = material.parse_material(json.dumps(drawn(10_729)))
    assert recommend.recommend(made, anyway=True).effects["emergence_angle_deg"] == "confirms"
    assert not list(faults(made))


@pytest.mark.parametrize("seed", range(30))
def test_it_is_answered_or_refused_in_words_seed(seed):
    try:
        made = material.parse_material(json.dumps(drawn(seed)))
    except InputError as error:
        assert str(error).startswith("<text>:1:")
        return
    found = recommend.recommend(made, anyway=True)
    assert found.candidates and found.verdict
    said = document(found)
    json.dumps(said, allow_nan=False)
    assert text(said, explain=True)
    if made.kind == "metal":
        assert not any(term.model.is_body for each in found.candidates for term in each.model.terms)


@pytest.mark.parametrize("seed", [10_008, 10_011, 10_024, 10_043])
def test_an_answer_hangs_together_seed(seed):
    """A sample of `benchmarks/descriptions.py`."""
    assert list(faults(material.parse_material(json.dumps(drawn(seed))))) == []
