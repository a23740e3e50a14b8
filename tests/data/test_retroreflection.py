"""A lobe toward the source stands above its surroundings on both sides; the flank of the surface's own does not."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import retroreflection
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows

COPPER = {"beckmann.alpha": 0.25, "beckmann.n": 0.95, "beckmann.k": 2.6}


def scans(name: str, values, step: float) -> Measurement:
    angles = np.meshgrid([10.0, 30.0, 45.0, 60.0, 75.0], np.arange(-81.0, 82.0, step))
    geom = rows(in_plane(*(each.T.ravel() for each in angles)))
    model = models.get(name)
    return Measurement(geom, Surface(model, {**model.defaults(), **values}, ("550 nm",)).brdf(geom), ("550 nm",))


@pytest.mark.parametrize("step", [3.0, 10.0])
def test_a_flank_that_falls_by_decades_is_no_lobe(step):
    found = retroreflection.lobe(scans("beckmann", COPPER, step))
    assert found.lobe < 1.5


@pytest.mark.parametrize("step", [3.0, 10.0])
def test_light_sent_back_over_such_a_flank_is_one(step):
    found = retroreflection.lobe(scans("beckmann+retro", COPPER, step))
    assert found.lobe > 3


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("ggx", {"ggx.alpha": 0.2, "ggx.n": 1.0, "ggx.k": 6.6}),
        ("lommel-seeliger", {"lommel-seeliger.w": 0.3}),
        ("oren-nayar", {"oren-nayar.albedo": 0.2, "oren-nayar.spread": 0.5}),
    ],
)
def test_what_grows_toward_grazing_is_no_lobe_where_nothing_was_measured_beyond_the_source(name, values):
    whole = scans(name, values, 3.0)
    steep = whole[whole.geom.theta_i_deg[:, 0] > 70]
    assert retroreflection.lobe(steep).lobe < 1.5
    sent_back = scans(f"{name}+retro", values | {"retro.rho": 0.1, "retro.alpha": 0.05}, 3.0)
    assert retroreflection.lobe(sent_back[sent_back.geom.theta_i_deg[:, 0] > 70]).lobe > 3
