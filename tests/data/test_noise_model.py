"""How sure single values are: relative and absolute parts, on noise that is known."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats, noise
from brdfguide.data.measurement import Measurement
from brdfguide.data.noise_model import SIGMA_PER_MEDIAN, NoiseModel, two_parts
from brdfguide.fitting.residuals import ln_residuals
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import Geometry, in_plane, rows

from .. import synthetic
from ..conftest import ROOT


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


def test_a_colour_outside_srgb_doubts_its_channel_alone():
    run = dim_run(0.01, 0.0, 3, channels=3)
    shift = np.array([0.0, 0.0, 2 * np.median(run.brdf[:, 2])])
    colours = Measurement(run.geom, run.brdf - shift, ("R", "G", "B"))
    blue = colours.brdf[:, 2]
    assert noise.estimated_noise(colours).absolute == (0.0, 0.0, SIGMA_PER_MEDIAN * np.median(-blue[blue < 0]))
    told = {each.code: each for each in examine.examine(colours)}
    assert "negative, most of channel B: a colour outside sRGB; upper limits" in told["negative-values"].text
    assert "missing-values" not in told


def test_a_law_that_gives_nothing_is_no_farther_off_than_what_nothing_tells_from_zero():
    run = dim_run(0.01, 0.0, 3, channels=3)
    shift = np.array([0.0, 0.0, 2 * np.median(run.brdf[:, 2])])
    colours = examine.prepared(Measurement(run.geom, run.brdf - shift, ("R", "G", "B")))
    dark = Surface(models.get("lambertian"), {"lambertian.albedo": np.array([0.5, 0.5, 0.0])}, colours.channels)
    left = ln_residuals(dark, colours)[:, 2]
    told = np.isfinite(left)
    expected = np.log(colours.noise.absolute[2]) - colours.ln[told, 2]
    assert told.any() and np.allclose(left[told], expected, rtol=1e-12)


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


def on_a_floor(floor: float, scatter: float = 0.1, alpha: float = 0.08) -> Measurement:
    """A polished metal whose far flanks no detector sees, and what one adds to them."""
    random, theta_r = np.random.default_rng(1), np.arange(-80.0, 81.0, 2.0)
    geom = rows(in_plane(np.array([10.0, 40.0, 70.0])[:, None], theta_r))
    brdf = np.asarray(models.term("beckmann")(geom, alpha=alpha, n=0.96, k=6.7, scale=1.0))
    added = floor * np.exp(scatter * random.standard_normal(brdf.shape))
    return Measurement(geom, brdf * (1 + 0.01 * random.standard_normal(brdf.shape)) + added)


def test_dimmest_values_at_one_level_that_is_darker_than_any_body_are_the_detectors():
    measurement = on_a_floor(1e-5)
    assert noise.detector_floor(measurement) == pytest.approx(1e-5, rel=0.2)
    assert noise.estimated_noise(measurement).absolute[0] >= noise.detector_floor(measurement)
    assert "below-dark-level" in {each.code for each in noise.noise_findings(measurement)}


@pytest.mark.parametrize(
    "measurement",
    [
        on_a_floor(2e-3),  # a body of albedo 0.006
        on_a_floor(1e-5, scatter=1.0),  # no level
        on_a_floor(1e-5, alpha=0.8),  # hardly a value that dim
    ],
    ids=["a black body", "scattered", "bright flanks"],
)
def test_no_other_dim_values_are(measurement):
    assert noise.detector_floor(measurement) == 0.0


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.csv")), ids=lambda path: path.stem)
def test_no_example_stands_on_a_detectors_floor(path):
    assert noise.detector_floor(formats.read(path)) == 0.0


def test_values_of_nothing_are_left_out_of_what_is_expected_of_the_others():
    """Found by the fuzz: 0.01 over 1e-320 has no number."""
    values = np.array([[1e-320], [0.5], [1.0]])
    found = NoiseModel(0.1, (0.01,), (0.0,), (0.0,)).expected(values, values > 0.1)
    assert found == pytest.approx(np.sqrt(0.1**2 + (0.02**2 + 0.01**2) / 2), rel=1e-12)


def test_a_doubt_that_is_next_to_nothing_is_none():
    """Found by the fuzz: values below zero by 1e-308 are no dark level, whose square would be 0."""
    clean = dim_run(0.03, 0.0, seed=1)
    brdf = clean.brdf.copy()
    brdf[:9] = -1e-308
    assert noise.estimated_noise(Measurement(clean.geom, brdf, clean.channels)).absolute == (0.0,)


def test_scans_of_a_turned_sample_hold_one_turn_each():
    theta_i, theta_r = (each.ravel() for each in np.meshgrid(np.arange(10.0, 75.0, 10.0), np.arange(-60.0, 61.0, 10.0)))
    phi_r = np.where(theta_r < 0, 0.0, 180.0)
    parts = [(theta_i, turn + 0 * theta_i, np.abs(theta_r), turn + phi_r) for turn in (0.0, 30.0, 90.0)]
    geom = rows(Geometry.from_degrees(*np.concatenate(parts, axis=1)))
    scans = noise._scans(geom)
    assert len(scans) == 3 * (7 + 13)
    assert all(len(np.unique(geom.phi_i_deg[found, 0])) == 1 for found, _ in scans)
