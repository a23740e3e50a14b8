"""What `benchmarks/scenes.py` found in scenes drawn at random, kept."""

from dataclasses import replace

from brdfguide import models
from brdfguide.models import cost
from brdfguide.models.surface import Surface
from brdfguide.scene import prune, scene

from .random_scenes import drawn_scene

ROUGH_PLASTIC = {"coupled.albedo": 0.5, "he-torrance.sigma": 1.2, "he-torrance.slope": 0.15, "he-torrance.n": 1.5}


def pruned(seed: int, expression: str, values: dict, jnd: float) -> prune.Pruned:
    where = replace(drawn_scene(seed), tolerance=scene.Tolerance(jnd, jnd))
    return prune.prune(Surface(models.get(expression), values), where, timing=False)


def test_what_is_cheapest_on_the_drawn_pixels_and_does_not_stand_hides_nothing_that_would_seed_503():
    """At 1 JND Cook-Torrance's law of 90 operations stands in; at 3 a plainer cut seemed to do, was refused, and laws
    dearer than it had not been tried: what was left took 294."""
    found = pruned(503, "coupled+he-torrance", ROUGH_PLASTIC, 3.0)
    assert cost.work(found.operations[1]) <= 90 and found.fresh.within(scene.Tolerance(3.0, 3.0))
    refused = [each.text for each in found.findings if each.code == "pruned-refused"]
    assert refused and not any(text.startswith(f"without {found.ablation} would") for text in refused)


def test_a_scene_without_a_lamp_has_a_box_of_views_seed_502():
    found = pruned(502, "coupled+ggx", {"coupled.albedo": 0.8, "ggx.alpha": 0.4}, 1.0)
    assert not found.scene.lights and set(found.box_deg) == {"theta_r_deg"}
    low, high = found.box_deg["theta_r_deg"]
    assert 0 <= low < high <= 90
