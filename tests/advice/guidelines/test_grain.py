"""What is said of a grain becomes two widths and an axis; what contradicts itself is flagged."""

import numpy as np
import pytest

from brdfguide.advice import recommend
from brdfguide.advice.material import observed, said_to_be_grained
from brdfguide.advice.recommend import predicted_gloss
from brdfguide.models.surface import Surface

BRUSHED = {"composition": "stainless steel", "appearance": "metal", "texture": "brushed"}


def start(**seen):
    found = recommend.recommend(observed(BRUSHED | seen))
    first = found.candidates[0]
    assert first.model.name == "ggx-aniso"
    return {name.rpartition(".")[2]: value for name, value in first.start.items()}


def says(**seen):
    return " ".join(each.says for each in recommend.recommend(observed(BRUSHED | seen)).advice)


def test_the_ratio_is_what_was_seen_of_the_streak_else_what_is_usual():
    usual, seen = start(finish="satin"), start(finish="satin", highlight_aspect=6)
    assert usual["alpha_x"] / usual["alpha_y"] == pytest.approx(4.0)
    assert seen["alpha_x"] / seen["alpha_y"] == pytest.approx(6.0)
    assert np.sqrt(usual["alpha_x"] * usual["alpha_y"]) == pytest.approx(np.sqrt(seen["alpha_x"] * seen["alpha_y"]))
    assert "usual for brushed metal" in says(finish="satin") and "6 times as wide" in says(highlight_aspect=6)


def test_the_width_that_was_seen_of_a_streak_is_its_short_one():
    narrow, wide = start(highlight_width_deg=8, highlight_aspect=1), start(highlight_width_deg=8, highlight_aspect=5)
    assert wide["alpha_y"] == pytest.approx(narrow["alpha_y"]) and wide["alpha_x"] == pytest.approx(5 * wide["alpha_y"])


def test_a_grain_goes_before_the_law_that_alone_gives_the_readings():
    seen = observed(BRUSHED | {"finish": "satin", "highlight_width_deg": 5, "highlight_aspect": 6})
    found = recommend.recommend(seen)
    assert "law_that_gives_the_readings" in {each.rule for each in found.advice}
    assert found.candidates[0].model.turns and not found.candidates[0].cannot[1:]


def test_the_axis_lies_across_the_grooves():
    assert np.degrees(start(grain_deg=30)["axis"]) == pytest.approx(120.0)
    assert np.degrees(start(grain_deg=120)["axis"]) == pytest.approx(30.0)


@pytest.mark.parametrize(
    "seen", [{"turned_90_brighter": True}, {"streak": "across the grain"}, {"highlight_aspect": 3}]
)
def test_what_is_seen_of_a_streak_is_a_grain_too(seen):
    assert said_to_be_grained(observed({"composition": "aluminium", "appearance": "metal"} | seen))
    assert not said_to_be_grained(observed({"composition": "aluminium", "appearance": "metal"}))


@pytest.mark.parametrize("streak", ["along the grain", "none"])
def test_a_streak_that_brushing_cannot_make_is_flagged(streak):
    found = recommend.recommend(observed(BRUSHED | {"streak": streak}))
    assert any(each.conflict and "brushing draws a highlight out across" in each.says for each in found.advice)


def test_brushed_yet_unchanged_when_turned_still_conflicts():
    found = recommend.recommend(observed(BRUSHED | {"changes_when_turned": False}))
    assert any(each.conflict and "unchanged as it turns" in each.says for each in found.advice)


def test_gloss_of_a_grain_is_the_mean_over_four_turns():
    surface = Surface.named("ggx-aniso", {"alpha_x": 0.2, "alpha_y": 0.05, "axis": 0.0, "n": 1.5})
    turned = [
        predicted_gloss(Surface.named("ggx-aniso", {"alpha_x": 0.2, "alpha_y": 0.05, "axis": axis, "n": 1.5}))[60]
        for axis in (0.0, 45.0, 90.0)
    ]
    assert turned == pytest.approx([turned[0]] * 3, rel=1e-9)
    assert predicted_gloss(surface)[60] < predicted_gloss(Surface.named("ggx", {"alpha": 0.05, "n": 1.5}))[60]
