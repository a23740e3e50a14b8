"""Two surfaces side by side: models, tables and measured directions, and where the difference comes from."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting.side_by_side import greatest, middle, of_function, of_measurement, of_surface, pair, parts
from brdfguide.models import looks
from brdfguide.models.surface import Surface
from brdfguide.physics.aperture import solid_angle_of

from .. import synthetic

GGX = models.get("lambertian+ggx")
NARROW = {"lambertian.albedo": 0.3, "ggx.alpha": 0.1, "ggx.n": 1.5}
WIDE = {**NARROW, "ggx.alpha": 0.2}


def side(values, name="it"):
    return of_surface(Surface(GGX, values), name)


def test_two_models_are_compared_on_the_sphere():
    found = pair(side(NARROW), side(WIDE))
    assert found.kind == "quadrature"
    assert found.seen == pytest.approx(looks.seen_difference(Surface(GGX, NARROW), Surface(GGX, WIDE)), rel=1e-12)


def test_a_table_of_a_model_is_the_model():
    colours = Surface.of_colours(GGX, {**WIDE, "lambertian.albedo": [0.3, 0.2, 0.1]})
    table = of_function(colours.brdf, ("R", "G", "B"), "table")
    assert pair(of_surface(colours, "model"), table).seen == 0.0
    assert pair(side(NARROW), table).seen > 4


def test_directions_without_a_value_in_a_table_do_not_count():
    def holes(geom):
        value = Surface(GGX, WIDE).brdf(geom).copy()
        value[geom.theta_i_deg[:, 0] > 50] = np.nan
        return value

    found = pair(side(WIDE), of_function(holes, ("550nm",), "table"))
    assert found.seen == 0.0 and np.isnan(found.brighter).any() and found.rms_ln == 0.0


def test_a_measurement_and_a_model_meet_at_its_directions():
    data = synthetic.surface(GGX, synthetic.scan(), NARROW)
    found = pair(of_measurement(data, "scan"), side(WIDE))
    assert found.kind == "ring" and len(found.weights) == len(data.geom)
    assert pair(of_measurement(data, "scan"), side(NARROW)).seen == pytest.approx(0, abs=1e-9)


def test_a_fit_is_read_through_the_aperture_of_the_measurement():
    model, geom = Surface(GGX, {**NARROW, "ggx.alpha": 0.02}), synthetic.scan()
    through = solid_angle_of(4.0)
    data = replace(synthetic.surface(GGX, geom, model.values), solid_angle=through)
    read = looks.instrument_reading(model, replace(data.instrument, geom=geom))
    measured = of_measurement(replace(data, brdf=read), "scan")
    assert pair(measured, of_surface(model, "fit")).seen == pytest.approx(0, abs=1e-9)
    assert pair(of_measurement(replace(data, brdf=read, solid_angle=None), "scan"), of_surface(model, "fit")).seen > 1


def test_two_measurements_of_the_same_directions():
    scans = [of_measurement(synthetic.surface(GGX, synthetic.scan(), values), "scan") for values in (NARROW, WIDE)]
    assert pair(*scans).seen > 2
    other = of_measurement(synthetic.surface(GGX, synthetic.scan(step=5.0), WIDE), "other")
    with pytest.raises(InputError, match="measured at different directions"):
        pair(scans[0], other)


# --- where -----------------------------------------------------------------------------------------------


def test_parts_add_up_and_agree_with_the_whole():
    found = pair(side(NARROW), side(WIDE))
    for name, each in parts(found).items():
        assert sum(part.share for part in each) == pytest.approx(1.0, rel=1e-9), name


def test_a_wider_lobe_is_darker_in_the_middle_and_lighter_around():
    near, beside, *_, far = parts(pair(side(NARROW), side(WIDE)))["from_mirror_direction"]
    assert near.brighter < -10 and near.seen > beside.seen > far.seen and far.brighter > 0
    assert middle(pair(side(NARROW), side(WIDE))).within_deg < 10


def test_a_lighter_body_is_lighter_everywhere():
    found = pair(side(NARROW), side({**NARROW, "lambertian.albedo": 0.4}))
    assert all(part.brighter > 0 for each in parts(found).values() for part in each)
    assert middle(found).within_deg > 40 and found.mean_brighter > 3


def test_the_greatest_difference_lies_at_the_mirror_direction():
    most = greatest(pair(side(NARROW), side(WIDE)))
    assert abs(most.theta_i_deg - most.theta_r_deg) < 3 and abs(most.phi_deg - 180) < 3 and most.brighter < -50


def test_equal_surfaces_differ_nowhere():
    found = pair(side(NARROW), side(NARROW))
    assert found.seen == 0 and greatest(found) is None and middle(found) is None and found.mean_brighter == 0
