"""Power laws of |β - β0|: noticed in the data, fitted by their own laws, and what such a fit says of the surface."""

import json

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.data.power_law import power_law
from brdfguide.fitting.compare import compare
from brdfguide.fitting.diagnostics.derived_error import ln_stderr
from brdfguide.fitting.fit import FitOptions, fit
from brdfguide.fitting.job import Job, case_of, read_for_fit
from brdfguide.fitting.stray_light import stray_light
from brdfguide.models import abc
from brdfguide.physics.aperture import solid_angle_of
from brdfguide.physics.fresnel import fresnel
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.physics.height_spectrum import KCorrelation, surface_height

from .. import synthetic
from ..cli.test_advice import run
from ..conftest import ROOT

RED = 0.633
ABG = {"abg.a": 1e-4, "abg.b": 1e-5, "abg.g": 1.8}
ABC = {"abc.a": 2e-5, "abc.b": 30.0, "abc.c": 1.9}


def polished(expression: str, values, *, noise: float, seed: int, wavelengths=(RED,), aperture=None) -> Measurement:
    """Scans at 5 to 60 degrees of a surface of `models`, five of them within a degree of the mirror direction."""
    fine = np.array([0.15, 0.3, 0.6])
    theta_i, theta_r = [], []
    for each in (5.0, 30.0, 60.0):
        angles = np.unique(np.concatenate((np.arange(-80.0, 81.0, 5.0), each - fine, each + fine)))
        angles = angles if aperture else angles[np.abs(angles - each) > 0.1]
        theta_i, theta_r = np.append(theta_i, np.full(len(angles), each)), np.append(theta_r, angles)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))
    geom = geom.at(np.array(wavelengths))
    names = tuple(f"{1000 * each:g} nm" for each in wavelengths)
    brdf = np.broadcast_to(models.get(expression)(geom, values), (len(geom), len(wavelengths)))
    noisy = brdf * np.exp(noise * np.random.default_rng(seed).standard_normal(brdf.shape))
    return Measurement(geom, noisy, names, solid_angle=aperture and solid_angle_of(aperture))


def test_case_13_is_its_own_law_exactly(tmp_path):
    """The file's four digits leave 0.01 %; without them nothing is left."""
    data = polished("abg", ABG, noise=0.0, seed=0)
    found = case_of(data, Job())
    assert {"abg", "harvey-shack", "abc", "lambertian+abg"} <= {each.name for each in found.candidates}
    exact = fit(models.get("abg"), data)
    assert exact.rms_ln < 1e-6
    for key, value in ABG.items():
        assert float(np.ravel(exact.values[key])[0]) == pytest.approx(value, rel=1e-6)


def test_the_default_ranking_recommends_the_law_and_says_what_it_means(tmp_path):
    data = polished("abg", ABG, noise=0.01, seed=3)
    lines = ["# 633 nm", "AOI,theta_s,BSDF (1/sr)"]
    for theta_i, theta_r, value in zip(
        data.geom.theta_i_deg[:, 0], data.geom.signed_theta_r_deg[:, 0], data.brdf[:, 0], strict=True
    ):
        lines.append(f"{theta_i:.6g},{theta_r:.8g},{value:.8g}")
    file = tmp_path / "mirror.csv"
    file.write_text("\n".join(lines))
    plain = run("fit", str(file), "--no-timing", "--plot", str(tmp_path / "it.svg"), "--x", "beta").stdout
    assert "recommended: abg" in plain
    assert "stray light by abg (a fit: its numbers hold at 633 nm" in plain
    assert "physics beside it: " in plain
    document = json.loads(run("fit", str(file), "--no-timing", "--json").stdout)
    said = document["stray_light"][0]
    assert document["close"] == "none"
    for name, value in (("a", 1e-4), ("b", 1e-5), ("g", 1.8)):
        each = said["intervals_95"][name]
        assert each["low"] < value < each["high"] and each["high"] < 1.2 * each["low"]
    assert said["scattered"][0]["measured"] <= said["scattered"][0]["extrapolated"] < 0.01


def test_facets_and_bodies_are_no_power_law():
    for expression, values in (
        ("lambertian+ggx", {"lambertian.albedo": 0.2, "ggx.alpha": 0.1, "ggx.n": 1.5}),
        ("lambertian+ggx", {"lambertian.albedo": 0.001, "ggx.alpha": 0.03, "ggx.n": 1.5}),
        ("lambertian+beckmann", {"lambertian.albedo": 0.05, "beckmann.alpha": 0.2, "beckmann.n": 1.5}),
        ("he-torrance", {"he-torrance.sigma": 0.2, "he-torrance.slope": 0.1, "he-torrance.n": 1.5}),
    ):
        assert power_law(polished(expression, values, noise=0.02, seed=1)) is None, expression
    assert power_law(synthetic.surface(models.get("lambertian"), synthetic.scan(), {})) is None


@pytest.mark.parametrize(
    "sample", ["rough_plastic", "rough_aluminium", "smooth_steel", "white_paper", "metallic_paint"]
)
def test_the_samples_of_the_guide_are_no_power_laws(sample):
    assert power_law(read_for_fit(ROOT / "examples" / f"{sample}.csv")) is None


@pytest.mark.parametrize("body", [0.0, 1e-3])
def test_a_power_law_is_noticed_with_noise_a_body_and_a_beam(body):
    data = polished("lambertian+abg", {"lambertian.albedo": body, **ABG}, noise=0.05, seed=2, aperture=0.1)
    beam = data.instrument.beam
    assert np.any(beam > 0)
    spiked = Measurement(data.geom, data.brdf + 0.9 * beam, data.channels, solid_angle=data.solid_angle)
    found = power_law(spiked)
    assert found is not None and found.slope == pytest.approx(-1.8, abs=0.25)
    assert any(each.name == "abg+mirror" for each in case_of(spiked, Job()).candidates)


def test_heights_of_a_k_correlation_surface_are_those_of_its_spectrum():
    data = polished("abc", ABC, noise=0.01, seed=5, wavelengths=(0.4, 0.633, 1.06))
    ranked = compare(data, [models.get(name) for name in ("abc", "harvey-shack", "he-torrance")])
    said = stray_light(ranked, data)[0]
    truth = KCorrelation(2e-5, 30.0, 1.9)
    assert said.law == "abc" and said.physics
    assert said.sigma_total == pytest.approx(truth.height, rel=0.05)
    assert said.sigma == pytest.approx(surface_height(truth, *said.band), rel=0.02)
    low, high = said.sigma_total_ends
    assert low < truth.height < high < 1.3 * low
    assert said.phase < 0.1 and said.shortest < 0.4
    assert [each.law for each in said.beside] == ["he-torrance"]


def test_the_wave_law_and_k_correlation_agree_on_one_surface():
    """Heights of 4 nm whose correlation is Gaussian: the steepest K-correlation is nearly that."""
    n, k, sigma = 0.96, 6.69, 0.004
    values = {"he-torrance.sigma": sigma, "he-torrance.slope": 4e-4, "he-torrance.n": n, "he-torrance.k": k}
    data = polished("he-torrance", values, noise=0.0, seed=0, wavelengths=(0.633, 0.8))
    near = data[np.sqrt(data.geom.vxy2[:, 0]) < 0.06]
    found = fit(models.get("abc"), near, FitOptions(fixed={"abc.f0": float(fresnel(1.0, n, k))}))
    total = float(np.ravel(abc.height(**{name: found.values[f"abc.{name}"] for name in "abc"}))[0])
    assert total == pytest.approx(sigma, rel=0.1)


def test_intervals_of_a_height_hold_the_truth_nineteen_times_in_twenty_seeds_0_to_23():
    """A height follows from a, b and c, which err together."""
    truth, held, width = KCorrelation(2e-5, 30.0, 1.9).height, 0, []
    for seed in range(24):
        data = polished("abc", ABC, noise=0.03, seed=seed, wavelengths=(0.5, 0.633, 1.06))
        found = fit(models.get("abc"), data)

        def height(values):
            return float(abc.height(*(values[f"abc.{name}"] for name in "abc")))

        error = ln_stderr(found, data, height)
        held += abs(np.log(height(found.values) / truth)) < 1.96 * error
        width.append(error)
    assert 20 <= held <= 24
    assert 0.001 < np.mean(width) < 0.05
