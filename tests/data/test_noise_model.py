"""How sure single values are: relative and absolute parts, on noise that is known."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats, noise
from brdfguide.data.measurement import Measurement
from brdfguide.data.noise_model import two_parts

from .. import synthetic


def dim_run(relative: float, absolute: float, seed: int, channels: int = 1, albedo: float = 0.005) -> Measurement:
    """A black gloss in scans of one degree, down to some hundredths: relative noise, and noise of the dark level."""
    model = models.get("lambertian+ggx")
    values = {"lambertian.albedo": albedo, "ggx.alpha": 0.12, "ggx.n": 1.5}
    truth = synthetic.surface(model, synthetic.scan(step=1.0), {**model.defaults(), **values}, channels=channels)
    random = np.random.default_rng(seed)
    noisy = truth.brdf * (1 + relative * random.standard_normal(truth.brdf.shape))
    return Measurement(truth.geom, noisy + absolute * random.standard_normal(truth.brdf.shape), truth.channels)


@pytest.mark.parametrize("relative", [0.01, 0.05])
@pytest.mark.parametrize("absolute", [0.0005, 0.002])
@pytest.mark.parametrize("seed", range(4))
def test_both_parts_are_found_to_a_half(relative, absolute, seed):
    found = noise.estimated_noise(dim_run(relative, absolute, seed))
    assert found.relative == pytest.approx(relative, rel=0.5)
    assert found.absolute[0] == pytest.approx(absolute, rel=0.35)


@pytest.mark.parametrize("seed", range(8))
def test_relative_noise_alone_shows_no_dark_level(seed):
    found = noise.estimated_noise(dim_run(0.03, 0.0, seed))
    assert found.absolute == (0.0,) and found.relative == pytest.approx(0.03, rel=0.25)


def test_two_parts_of_few_departures_are_not_told():
    assert two_parts(np.linspace(1, 2, 59), np.ones(59)) is None


def test_two_parts_of_values_near_the_least_number_are_numbers():
    levels = np.geomspace(1e-320, 1e-300, 400)
    assert np.isfinite(two_parts(levels, np.zeros(400))).all()
    assert np.isfinite(two_parts(levels, levels)).all()
    assert np.isfinite(two_parts(np.geomspace(1e-320, 1e3, 400), np.ones(400))).all()


def test_values_below_zero_are_noise_that_a_fit_looks_at():
    measurement = examine.prepared(dim_run(0.01, 0.002, 3))
    below = measurement.brdf < 0
    assert np.any(below) and np.all(measurement.weighed[below]) and not np.any(measurement.clear[below])
    assert not np.any(measurement.clear & (measurement.brdf < 10 * measurement.noise.absolute[0]))
    assert measurement.censored == 0


def test_colours_outside_srgb_are_no_noise():
    run = dim_run(0.01, 0.0, 3, channels=3)
    colours = Measurement(run.geom, np.where(run.brdf < 0.003, -run.brdf, run.brdf), ("R", "G", "B"))
    assert noise.estimated_noise(colours).absolute == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", ["cornell/garnet_red.brdf", "cornell/cayman.brdf", "mwir/lacquer_smooth.csv"])
def test_a_fit_is_told_the_noise_that_inspect_prints(data, name):
    measurement = formats.read(data / name)
    found = {each.code: dict(each.numbers) for each in examine.examine(measurement)}
    worth = examine.prepared(measurement).noise
    assert found["noise"]["relative"] == worth.relative
    assert found["noise"]["absolute_per_sr"] == np.median(worth.absolute)


def test_parts_of_a_measurement_keep_the_noise_of_the_whole(data):
    measurement = examine.prepared(formats.read(data / "cornell" / "garnet_red.brdf"))
    part = measurement[::7].of_channels(np.array([3, 9]))
    assert part.noise.absolute == (measurement.noise.absolute[3], measurement.noise.absolute[9])
    assert part.noise.relative == measurement.noise.relative
