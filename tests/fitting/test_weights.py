"""No scan outvotes the others for being dense, and the intervals know of it."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.data.noise_model import NoiseModel
from brdfguide.fitting import compare, weights
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.fit import FitOptions
from brdfguide.physics.geometry import Geometry, in_plane, rows

from .. import synthetic

PLASTIC, WARD = models.get("lambertian+ggx"), models.get("lambertian+ward")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}


def scans(*steps, noise=0.0, seed=0, channels=1) -> Measurement:
    """Of incidences 10, 35 and 60 degrees, each with its own step."""
    parts = [synthetic.scan((theta,), step=step) for theta, step in zip((10, 35, 60), steps, strict=True)]
    return synthetic.surface(PLASTIC, synthetic.joined(parts), TRUTH, noise=noise, seed=seed, channels=channels)


def at(measurement, theta):
    return np.abs(measurement.geom.theta_i_deg[:, 0] - theta) < 0.1


def moved(measurement, theta_i) -> Measurement:
    """The same values as if seen at other incidences."""
    geom = measurement.geom
    return replace(
        measurement, geom=rows(Geometry.from_degrees(theta_i, 0.0, geom.theta_r_deg[:, 0], geom.phi_deg[:, 0]))
    )


def test_scans_of_like_density_are_left_alone():
    even, nearly = scans(2, 2, 2), scans(2, 3, 3.5)
    assert (
        weights.sample_weights(even) is None
        and weights.sample_weights(nearly) is None
        and weights.sample_weights(even, "sampling") is None
    )
    np.testing.assert_array_equal(weights.of_values(nearly), 1.0)
    assert weights.sample_weights(nearly, "sampling") is not None and weights.sample_weights(nearly, "none") is None


def test_every_incidence_counts_alike_and_no_direction_more_than_ten_times_another():
    uneven, extreme = scans(0.5, 1, 4), scans(0.25, 1, 20)
    sample_weights = weights.sample_weights(uneven)
    assert sample_weights[:, 0].mean() == pytest.approx(1)
    shares = [sample_weights[at(uneven, theta)].sum() for theta in (10, 35, 60)]
    np.testing.assert_allclose(shares, len(sample_weights) / 3, rtol=1e-12)
    assert weights.sample_weights(extreme).max() == pytest.approx(10 * weights.sample_weights(extreme).min())


def test_what_is_missing_makes_a_scan_sparse():
    data = scans(1, 1, 1)
    brdf = data.brdf.copy()
    brdf[np.flatnonzero(at(data, 60))[::5]] = np.nan
    assert weights.sample_weights(replace(data, brdf=brdf)) is None
    brdf[np.flatnonzero(at(data, 60))[30:]] = np.nan
    sample_weights = weights.sample_weights(replace(data, brdf=brdf))
    assert sample_weights[at(data, 60)][0] > 4 * sample_weights[at(data, 10)][0]


def test_incidences_that_were_not_held_make_no_scans():
    assert weights.sample_weights(synthetic.surface(PLASTIC, synthetic.hemisphere(3000), TRUTH)) is None
    data = scans(2, 2, 2)
    jitter = np.where(np.arange(len(data.brdf)) % 9 == 0, 0.1, 0.0)  # a few samples each, a tenth of a degree beside
    assert weights.sample_weights(moved(data, data.geom.theta_i_deg[:, 0] + jitter)) is None


def test_a_stray_direction_gains_nothing_by_being_alone():
    data = scans(2, 2, 2)
    theta_i = data.geom.theta_i_deg[:, 0].copy()
    theta_i[7] = 22.0
    assert weights.sample_weights(moved(data, theta_i)) is None


def test_a_dense_scan_outvotes_the_others_only_if_asked_to():
    data = scans(0.5, 8, 8)
    errors = {kind: fitting.fit(WARD, data, FitOptions(weights=kind)) for kind in ("none", "auto")}
    far = {kind: np.sqrt(np.mean(found.residuals[at(data, 60)] ** 2)) for kind, found in errors.items()}
    assert far["auto"] < 0.9 * far["none"]


def test_the_error_that_ranks_counts_every_incidence_alike():
    data = scans(0.5, 4, 4, noise=0.01, seed=3)
    ranked = compare.compare(data, [PLASTIC, WARD])
    row = ranked.rows[-1]
    by_incidence = np.array(list(row.rms_ln_by_theta_i.values()))
    assert row.fit.name == WARD.name and row.rms_ln == pytest.approx(np.sqrt(np.mean(by_incidence**2)), rel=0.02)
    plain = np.sqrt(np.mean(row.fit.residuals**2))
    assert abs(row.rms_ln / plain - 1) > 0.1


def test_what_weighs_the_values_is_stated():
    uneven, even = scans(0.5, 8, 8), scans(2, 2, 2)

    def codes(data, kind="auto"):
        return [finding.code for finding in weights.weighing(data, kind)]

    counts = [np.count_nonzero(at(uneven, theta)) for theta in (60, 10)]
    assert (
        codes(uneven) == ["weighed-by-scan"]
        and f"{counts[0]} to {counts[1]} directions" in weights.weighing(uneven)[0].text
    )
    assert codes(even) == [] and codes(uneven, "none") == []
    with_errors = replace(even, stderr=0.02 * even.brdf)
    assert codes(with_errors) == ["weighed-by-stderr"] and codes(with_errors, "none") == []
    assert [finding.code for finding in compare.compare(uneven, [WARD]).weighing] == ["weighed-by-scan"]


@pytest.mark.parametrize("channels", [1, 3])
def test_intervals_know_what_the_sample_weights_are_worth_with_seeds_0_to_39(channels):
    """Printed standard errors against the scatter of the answers over 40 draws of the noise."""
    found = [fitting.fit(PLASTIC, scans(0.5, 8, 8, noise=0.03, seed=seed, channels=channels)) for seed in range(40)]
    for name in ("ggx.alpha", "lambertian.albedo", "ggx.n"):
        scatter = np.std([fit.values[name] for fit in found], axis=0, ddof=1)
        printed = np.sqrt(np.mean([fit.stderr[name] ** 2 for fit in found], axis=0))
        assert 0.75 < np.mean(printed / scatter) < 1.35, name


def test_a_sandwich_of_equal_spreads_is_the_plain_covariance():
    data = scans(2, 4, 4, noise=0.02, seed=1, channels=3)
    layout = fitting.Layout(PLASTIC, 3)
    best = fitting.prepare(data).settle.misfit(layout, fitting.metric("ln")).descend(layout.encode(TRUTH), 1e-9)
    plain = best.normal.variances(0.02**2)
    sandwich = best.normal.scatter(np.full(data.brdf.shape, 0.02), *best.at_minimum[1:])
    for one, other in zip(plain, sandwich, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-8)


def test_no_value_is_so_sure_that_it_leaves_the_others_without_weight():
    """Found by the fuzz: beside a doubt whose square is 0 a variance over the mean had no inverse."""
    geom = rows(in_plane([30.0], [0.0, 10.0, 20.0]))
    nothing = NoiseModel(0.1, (1e-200,), (0.0,), (0.0,), matters=True)
    measurement = Measurement(geom, np.array([[1e-99], [0.5], [1.0]]), ("1",), noise=nothing)
    found = weights.unlike(measurement, None, None, None, 0.01)
    assert found.min() == weights.SUREST and np.isfinite(1 / found).all()
