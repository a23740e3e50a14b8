"""`verify`: what decides between metal and dielectric, and what a shader or a step tells twice."""

import json
from copy import deepcopy

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import workdps

from brdfguide import models
from brdfguide.audit import verification
from brdfguide.audit.exact_kind import compare_kind
from brdfguide.audit.rederived import Comparisons
from brdfguide.data import examine
from brdfguide.data.measurement import Measurement
from brdfguide.data.metal_or_dielectric import LOBE_DEG, _Observed, verdict
from brdfguide.face.beyond import fitted_as
from brdfguide.face.functions import fit
from brdfguide.physics.geometry import Geometry, rows

from .. import synthetic

READ = {"noise": {}, "data": {"findings": [], "solid_angle_sr": None}}


def compared(data: Measurement, numbers: dict) -> list:
    document = READ | {"kind": {"numbers": numbers}, "data": READ["data"] | {"channels": list(data.channels)}}
    found = Comparisons()
    with workdps(30):
        compare_kind(document, verification.readings_of(data, document), found)
    return found.derived


@pytest.mark.parametrize("seed", range(12))
def test_what_decides_between_metal_and_dielectric_is_derived(seed):
    """Of bodies and lobes of one to twelve channels, with gaps."""
    draw, channels = np.random.default_rng(seed), (1, 3, 12)[seed % 3]
    model = models.get("lambertian+ggx")
    values = {"lambertian.albedo": draw.uniform(0.05, 0.6, channels), "ggx.alpha": draw.uniform(0.1, 0.5)}
    geom = rows(synthetic.scan(theta_i=(5, 15, 30, 55, 75), step=5.0))
    f = np.broadcast_to(model(geom, {**model.defaults(), **values}), (len(geom), channels))
    f = f * np.exp(0.03 * draw.standard_normal(f.shape))
    names = ("R", "G", "B") if channels == 3 else tuple(f"{each}" for each in range(channels))
    geom = geom.at(np.linspace(0.45, 0.65, channels))
    data = examine.prepared(Measurement(geom, np.where(draw.random(f.shape) < 0.05, np.nan, f), names))
    told = dict(verdict(data).numbers)
    found = compared(data, told)
    assert all(each.agrees for each in found) and len(found) >= len(told) - ("lobe_colour" in told)
    for key in told:
        changed = compared(data, told | {key: told[key] * (1 + 1e-8)})
        wrong = {each.place for each in changed if not each.agrees}
        assert wrong == {f"kind.numbers.{key}"} & {each.place for each in found}
    assert {"lobe_reflectance", "whole_reflectance", "body_colour", "rise"} <= {each.place[13:] for each in found}


def test_no_rounding_says_whether_a_direction_lies_in_the_lobe():
    """At 25 degrees from the mirror direction, where it ends."""
    theta = np.arange(0.0, 60.0, 0.5)
    geom = rows(Geometry.from_degrees(theta, 0.0, theta + LOBE_DEG, 180.0))
    observed = _Observed(Measurement(geom, np.ones((len(theta), 1)), ("brdf",)))
    assert np.array_equal(observed.from_mirror, np.full(len(theta), LOBE_DEG))


@pytest.fixture(scope="module")
def shaded():
    data = synthetic.surface(
        models.get("lambertian+ggx"), synthetic.scan(theta_i=(15, 45, 70), step=10.0), {}, noise=0.03, seed=4
    )
    found = fit(data, ["lambertian+ggx", "lambertian+ward"], timing=False)
    told, _ = fitted_as("gltf", found.ranking, found.measurement, None)
    document = json.loads(json.dumps(found.document | {"as": told}))
    return verification.readings_of(found.measurement, document), document


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("rms_ln",), "as.rms_ln"),
        (("off_percent",), "as.off_percent"),
        (("best_law", "rms_ln"), "as.best_law.rms_ln"),
        (("settings", 0, "rms_ln"), "as.settings[0].rms_ln"),
        (("parameters", "gltf.roughness", "value"), "as.rms_ln"),
    ],
)
def test_what_a_shader_can_do_is_derived(shaded, path, place):
    readings, document = shaded[0], deepcopy(shaded[1])
    assert not verification.verify(document, readings).wrong
    entry = document["as"]
    for step in path[:-1]:
        entry = entry[step]
    entry[path[-1]] *= 1.01
    assert place in {each.place for each in verification.verify(document, readings).wrong}


def test_a_step_begins_where_the_one_before_ended(shaded):
    readings, document = shaded[0], deepcopy(shaded[1])
    taken = {"candidate": "ggx:2", "adds": "", "rms_ln": 0.25, "held_out_rms_ln": 0.3}
    first = {"of": "ggx", "rms_ln": 0.5, "held_out_rms_ln": 0.6, "tried": [taken], "taken": "ggx:2"}
    document["grown"] = [first, {**taken, "of": "ggx:2", "tried": [], "taken": None}]
    assert not verification.verify(document, readings).wrong
    document["grown"][1]["rms_ln"] = 0.26
    assert {each.place for each in verification.verify(document, readings).wrong} == {"grown[1].rms_ln"}
