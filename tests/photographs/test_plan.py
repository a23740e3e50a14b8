"""The description: every error with its place, and no key without effect."""

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.photographs.plan import planned

SPHERE = "photographs: sphere\ncamera: {distance: 24}\nreference_albedo: 0.9\n"
BARE = "photographs: sphere\ncamera: {distance: 24}\n"


def test_millimetres_and_radii_say_the_same():
    shots = "shots: [{file: a.png, reference: b.png, lamp: reference}]\n"
    one = planned(SPHERE + shots, "s.yaml")
    other = planned(SPHERE.replace("{distance: 24}", "{distance_mm: 600, radius_mm: 25}") + shots, "s.yaml")
    assert one.distance == other.distance == 24


def test_a_phase_is_a_lamp_and_a_patch_is_an_albedo():
    text = SPHERE.replace("0.9", "neutral 5") + "shots: [{file: a.png, reference: b.png, phase_deg: 90, roll_deg: 90, "
    plan = planned(text + "lamp_distance: 40}]\n", "folder/s.yaml")
    assert plan.shots[0].lamp == pytest.approx(np.array([0, 40, 0]), abs=1e-9)
    assert plan.reference_albedo == pytest.approx([0.1913] * 3)
    assert str(plan.shots[0].file).replace("\\", "/") == "folder/a.png"


@pytest.mark.parametrize(
    "text, sentence",
    [
        (SPHERE + "shots: []\n", "at least one picture"),
        (SPHERE + "shots: [{file: a.png, lamp: reference}]\n", "needs a reference"),
        (SPHERE + "shots: [{file: a.png, reference: b.png}]\n", "lamp: reference, lamp:"),
        (SPHERE + "shots: [{file: a.png, reference: b.png, lamp: refrence}]\n", "did you mean 'reference'"),
        (SPHERE + "shots: [{file: a.png, reference: b.png, lamp: [1, 2]}]\n", "has 2 numbers; wanted 3"),
        (SPHERE + "patch_px: [1, 1, 4, 4]\nshots: [{file: a.png, reference: b.png, phase_deg: 4}]\n", "no effect"),
        (SPHERE + "shots: [{file: a, reference: b, lamp: [1e300, 0, 0]}]\n", "from -1e+07 to 1e+07"),
        (SPHERE.replace("24", "1e300") + "shots: [{file: a, reference: b, phase_deg: 4}]\n", "at most 1e+07"),
        (SPHERE.replace("sphere", "cube") + "shots: [{file: a, reference: b, phase_deg: 4}]\n", "it is one of: sphere"),
        (SPHERE.replace("sphere", "cylinder") + "shots: [{file: a, phase_deg: 4}]\n", "rod is not found"),
        (SPHERE.replace("reference_albedo: 0.9\n", "") + "shots: [{file: a, reference: b, phase_deg: 4}]\n", "needs"),
        (SPHERE + "shots: [{file: a, phase_deg: 4}]\n", "'reference_albedo' has no effect"),
        (BARE + "shots: [{file: a, phase_deg: 4, chart_px: [1, 1, 4, 4]}]\n", "needs 'chart_albedo'"),
        (BARE + "chart_albedo: white\nshots: [{file: a, phase_deg: 4}]\n", "no shot has a chart_px"),
        (SPHERE + "shots: [{file: a, reference: b, phase_deg: 4, chart_px: [1, 1, 4, 4]}]\n", "'chart_px' has no"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(text, sentence):
    with pytest.raises(InputError, match=r"s\.yaml:\d+:\d+: ") as caught:
        planned(text, "s.yaml")
    assert sentence in str(caught.value)
