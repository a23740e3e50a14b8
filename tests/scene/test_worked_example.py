"""T-P7: the worked example of pruning comes back from its own definitions, number by number, and the program's differ
for stated reasons.
"""

import sys

import numpy as np
import pytest

from brdfguide import models
from brdfguide.physics.geometry import in_plane
from brdfguide.scene.features import NOTHING

from ..conftest import ROOT

sys.path.insert(0, str(ROOT / "examples" / "scenes"))
import worked_example as example

WHICH = ("mean", "p95", "worst")
WIDER = (
    "of a 2° lamp's image, 5 % of the samples and more lie within when they scatter by 0.7 alpha; p95 0 says that "
    "its own scattered wider"
)
UNKNOWN = "the one or two numbers of its row beside it come back; no definition that we tried gives this mean as well"
LOST = {
    (
        "lapped lacquer",
        "A",
        "Fresnel",
        "worst",
    ): "its constant factor took the spike too; a mirror here keeps Fresnel's",
    ("lapped lacquer", "C", "spike", "mean"): WIDER,
    ("lapped lacquer", "C", "spike", "p95"): WIDER,
    ("lapped lacquer", "C", "spike", "worst"): WIDER,
    ("lapped lacquer", "C", "series", "mean"): UNKNOWN,
    ("lapped lacquer", "B", "series", "mean"): UNKNOWN,
    ("lapped lacquer", "B", "coupling", "mean"): UNKNOWN,
    ("rough plastic", "B", "series", "mean"): UNKNOWN,
    ("satin black", "C", "masking", "mean"): UNKNOWN,
}


def numbers():
    for material, scene in example.STATED:
        for part in example.FEATURES:
            for which in WHICH:
                case = material, scene, part, which
                marks = [pytest.mark.xfail(strict=True, reason=LOST[case])] if case in LOST else []
                yield pytest.param(*case, marks=marks, id="-".join(case).replace(" ", "-"))


@pytest.mark.parametrize(("material", "scene", "part", "which"), list(numbers()))
def test_stated_number_comes_back_within_20_percent(material, scene, part, which):
    place = WHICH.index(which)
    sampled = [example.demonstration(material, scene, seed)[part][place] for seed in example.SEEDS]
    assert example.comes_back(example.stated(material, scene)[part][place], sampled), sampled


@pytest.mark.parametrize(
    ("material", "scene", "kept", "worst", "albedo"),
    [
        ("rough plastic", "A", (), 0.9, 0.5225),
        ("satin black", "A", ("Fresnel",), 1.6, None),
        ("lapped lacquer", "A", ("spike", "series", "Fresnel"), None, 0.315),
        ("rough plastic", "C", ("Fresnel", "masking", "coupling"), 41, None),
    ],
)
def test_stated_choice_comes_back_and_the_lobe_is_always_in_it(material, scene, kept, worst, albedo):
    """What is called "diffuse alone" keeps a lobe, Beckmann's with a constant Fresnel factor: with it kd is refitted to
    0.5225.
    """
    ablation = NOTHING
    for name in example.FEATURES.keys() - set(kept):
        ablation = ablation.without(example.FEATURES[name])
    sampled = []
    for seed in example.SEEDS:
        picture = example.sampled(material, scene, seed, example.demonstrated("Fresnel" not in kept), False)
        factors = picture.refitted(ablation)
        sampled.append(picture.ablation_errors(ablation, factors).worst)
        if albedo is not None:
            assert picture.surface(ablation, factors).values["coupled.albedo"] == pytest.approx(albedo, rel=0.005)
    assert worst is None or example.comes_back(worst, sampled)


@pytest.mark.parametrize("material", example.MATERIALS)
def test_worst_without_fresnel_or_coupling_at_sunset_is_the_stated_one_in_the_program_too(material):
    """Neither depends on weights, shadows or the light's size: the worst direction is in every draw."""
    ours, theirs = example.program(material, "B"), example.stated(material, "B")
    assert ours["coupling"][2] == pytest.approx(theirs["coupling"][2], rel=0.2)
    if (
        material != "lapped lacquer"
    ):  # whose lobe the sun's disc and the shadows change: 43 by its definitions, 38 with the shadows
        assert ours["Fresnel"][2] == pytest.approx(theirs["Fresnel"][2], rel=0.2)


def test_frontal_worst_without_fresnel_is_the_stated_one_while_the_mixture_made_its_mean_larger():
    for material, mean in (("rough plastic", 0.13), ("satin black", 0.56)):
        ours, theirs = example.program(material, "A")["Fresnel"], example.stated(material, "A")["Fresnel"]
        assert ours[2] == pytest.approx(theirs[2], rel=0.2)
        assert ours[0] < 0.7 * theirs[0] and theirs[0] == mean


def test_he_torrances_shadows_and_nothing_else_make_masking_matter_more():
    """Under Smith's masking the stated 42 JND comes back; He and Torrance's, on the same samples, is worth three times
    that.
    """
    smith, he = example.steps("rough plastic", "B")[2:4]
    assert smith["masking"][2] < 42 < he["masking"][2] / 3
    assert he["coupling"][2] == pytest.approx(smith["coupling"][2], rel=0.2)


def test_smiths_masking_is_that_of_beckmanns_law():
    geom, law = in_plane(70, np.array([[-80.0], [10.0], [85.0]])), models.term("beckmann")
    values = law.defaults() | {"alpha": 0.3}
    assert example.smith(geom, 0.15) == pytest.approx(
        law.brdf(geom, **values) / law.without["masking"](geom, **values), rel=1e-12
    )
