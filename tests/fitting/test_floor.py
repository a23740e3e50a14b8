"""The floor under a fit: what it says of the shipped examples and of made data, and when it says nothing."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.fitting import baselines, describable
from brdfguide.fitting.compare import compare
from brdfguide.fitting.fit import FitOptions
from brdfguide.fitting.floor import Floor
from brdfguide.models import candidates

from .. import synthetic
from ..conftest import ROOT

GGX, BECKMANN = models.get("lambertian+ggx"), models.get("lambertian+beckmann")
VALUES = {"lambertian.albedo": 0.2, "ggx.alpha": 0.3, "ggx.n": 1.5}


def example(name: str):
    return examine.prepared(formats.read(ROOT / "examples" / f"{name}.csv"))


@pytest.mark.parametrize(
    "name, best, reducible",
    [
        ("rough_plastic", "lambertian+beckmann", (0.88, 0.95)),
        ("rough_aluminium", "lambertian+lafortune:2", (0.92, 0.97)),
        ("white_paper", "oren-nayar+ggx", (0.50, 0.65)),
    ],
)
def test_share_that_some_smooth_law_would_remove(name, best, reducible):
    floor = compare(example(name), candidates.of_kind(names=[best])).floor
    assert floor.candidate == best and reducible[0] < floor.reducible < reducible[1]
    assert floor.noise < floor.smooth < floor.model
    assert floor.by_form == pytest.approx(1 - (floor.factored / floor.model) ** 2)


def test_of_data_that_a_model_made_nothing_is_left_to_remove():
    data = synthetic.surface(GGX, synthetic.scan((10, 30, 50, 65, 75), 1.7), VALUES, noise=0.015)
    ranked = compare(data, [GGX])
    floor = ranked.floor
    assert floor.reducible < 0.2 and 0.9 * 0.015 < floor.smooth < 1.2 * 0.015
    assert "at-the-floor" in [warning.code for warning in ranked.warnings]


def test_a_wrong_model_has_a_floor_at_the_noise():
    data = synthetic.surface(GGX, synthetic.hemisphere(2000), VALUES, noise=0.015)
    floor = compare(data, [BECKMANN]).floor
    assert floor.smooth < 0.02 < floor.model and floor.reducible > 0.8 and floor.by_form > 0.8


def test_the_factor_that_differs_is_named():
    """A metal's flat Fresnel factor in place of a dielectric's: the free one rises faster."""
    data = synthetic.surface(GGX, synthetic.hemisphere(2000), VALUES, noise=0.015)
    flat = candidates.named("lambertian+ggx (height free)")
    unlike = compare(data, [flat], FitOptions(fixed={"ggx.n": 20.0})).floor.unlike
    assert unlike.factor == "Fresnel factor" and unlike.ratio[2] > 2 * unlike.ratio[0]


@pytest.mark.parametrize("case", ["one incidence", "eight values", "all alike"])
def test_where_nothing_can_be_told_there_is_none(case):
    geom = synthetic.scan((30,), 1.0) if case == "one incidence" else synthetic.scan((10, 50), 40.0)
    data = synthetic.surface(GGX, geom, VALUES, noise=0.02)
    if case == "all alike":
        data = synthetic.surface(models.get("lambertian"), geom, {"lambertian.albedo": 0.3})
    assert compare(data, [models.get("lambertian")]).floor is None


def test_thirty_one_channels_are_looked_at_as_luminance_and_both_ends():
    data = synthetic.surface(GGX, synthetic.scan(step=2.0), VALUES, noise=0.02, channels=31)
    ranked = compare(data, [BECKMANN])
    assert ranked.floor.of == ("luminance", data.channels[0], data.channels[-1])


def test_missing_values_and_zeros_are_no_part_of_it():
    data = synthetic.with_gaps(synthetic.surface(GGX, synthetic.hemisphere(900), VALUES, noise=0.02, channels=3), 3)
    data.brdf[::17] = 0.0
    floor = compare(data, [BECKMANN]).floor
    assert floor is not None and 0.015 < floor.smooth < 0.05


def test_shares_are_those_of_squares():
    floor = Floor("a", 0.1, 0.05, 0.08, 0.01, 50.0, 1e-3, 0.05, ("brdf",), 400)
    assert floor.reducible == pytest.approx(0.75) and floor.by_form == pytest.approx(0.36)
    assert floor.beyond_form == pytest.approx(0.39)
    assert [each.code for each in floor.findings()] == ["not-of-this-form"]


def test_a_floor_far_above_the_noise_says_nothing_of_a_limit():
    coarse = Floor("a", 0.24, 0.23, None, 0.001, 50.0, 1e-3, 0.05, ("brdf",), 400)
    assert not coarse.resolves and coarse.findings() == ()


def test_width_of_a_lobe_is_what_its_alpha_is():
    surface = synthetic.fitted(models.get("ggx"), {"ggx.alpha": 0.05}, synthetic.surface(GGX, synthetic.scan(), VALUES))
    assert describable.lobe_alpha(surface) == pytest.approx(0.05, rel=0.15)


def test_baselines_of_a_scan():
    rows = {row.name: row for row in baselines.baselines(example("white_paper"))}
    assert rows["sh:12"].rms_ln is None and rows["sh:12"].note == "too few data" and rows["sh:4"].coefficients == 14
    assert rows["factors"].left_out_rms_ln < 0.03 > rows["smooth"].left_out_rms_ln
    assert rows["sh:8"].left_out_rms_ln < rows["sh:4"].left_out_rms_ln
    assert rows["wavelets"].note == "needs a dense table" and rows["net"].ns_per_sample > 0


def test_components_of_surfaces_like_it_come_close():
    geom = synthetic.hemisphere(500)
    others = [synthetic.surface(GGX, geom, VALUES | {"ggx.alpha": alpha}) for alpha in (0.2, 0.25, 0.35, 0.4)]
    data = synthetic.surface(GGX, geom, VALUES)
    rows = {row.name: row for row in baselines.baselines(data, others=others)}
    assert rows["components:2"].left_out_rms_ln < 0.1 and np.isfinite(rows["components:1"].rms_ln)
