"""A subset stands for the whole: unbiased, reproducible, present in every corner."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import formats, subsample
from brdfguide.data.measurement import Measurement, row_median, rows_of_each
from brdfguide.fitting import fit
from brdfguide.physics.geometry import Geometry, rows

from .. import synthetic


def scatter(size: int, seed: int = 3) -> Measurement:
    draw = np.random.default_rng(seed)
    geom = rows(
        Geometry.from_degrees(draw.uniform(0, 89, size), 0.0, draw.uniform(0, 89, size), draw.uniform(-180, 180, size))
    )
    return Measurement(geom, np.exp(-geom.tan2_h) + 0.01)


def test_small_measurement_is_returned_as_it_is():
    measurement = scatter(100)
    assert subsample.subset(measurement, 100) is measurement


def test_same_seed_gives_the_same_directions():
    first, again = (subsample.subset(scatter(20000), 500) for _ in range(2))
    np.testing.assert_array_equal(first.brdf, again.brdf)
    assert len(first.geom) == 500
    assert first.findings[-1].code == "subset"


@pytest.mark.parametrize("seed", range(4))
def test_mean_over_a_subset_is_nearer_to_the_whole_than_a_blind_draw_would_be(seed):
    measurement = scatter(40000)
    values = np.log(measurement.brdf[:, 0])
    picked = subsample.subset(measurement, 1000, seed)
    blind = values.std() / np.sqrt(1000)
    assert abs(np.log(picked.brdf).mean() - values.mean()) < 0.8 * blind


@pytest.mark.parametrize("model", ["lambertian+ggx", "lambertian+ward"])
def test_a_finer_subset_of_a_whole_table_changes_no_answer_by_more_than_its_uncertainty(data, model):
    table = formats.read(data / "merl_format" / "alum-bronze.binary.xz", theta_max=80)
    coarse, fine = (fit.fit(models.get(model), subsample.subset(table, count)) for count in (2000, 16000))
    for name, value in coarse.values.items():
        if name in coarse.stderr:
            assert np.all(np.abs(value - fine.values[name]) <= coarse.stderr[name]), name


@pytest.mark.parametrize("name", ["paper_white", "vch_golden_yellow", "cc_ibiza_sunset", "cg_sunflower"])
def test_an_rgl_table_is_settled_on_as_a_whole(data, name):
    table = formats.read(data / "rgl" / f"{name}_rgb.bsdf")
    assert len(fit.prepare(table).used) == np.count_nonzero(np.any(table.usable, axis=1))


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("model", ["lambertian+ggx", "lambertian+ward", "lambertian+blinn"])
def test_of_a_narrow_lobe_the_whole_changes_no_answer_of_a_subset_by_more_than_its_uncertainty(data, model, seed):
    """A lobe half a degree wide, and models that are wrong about its flank: a few directions carry its width."""
    table = formats.read(data / "rgl" / "cg_sunflower_rgb.bsdf")
    coarse, fine = (fit.fit(models.get(model), each) for each in (subsample.subset(table, 16_000, seed), table))
    for name, stderr in coarse.stderr.items():
        assert np.all(np.abs(coarse.values[name] - fine.values[name]) <= stderr), name


def test_models_far_behind_settle_on_fewer_directions_and_stay_within_their_errors_with_seed_6():
    """Sizes on both sides of what settles all together: 12,000 directions of three channels, and 26,000."""
    truth = {"lambertian.albedo": np.array([0.3, 0.2, 0.1]), "ggx.alpha": 0.2, "ggx.n": 1.5}
    names = ["lambertian+ggx", "lambertian+phong", "lambertian+cook-torrance"]
    for directions in (12_000, 26_000):
        data = synthetic.surface(
            models.get("lambertian+ggx"),
            synthetic.hemisphere(directions, seed=6),
            truth,
            noise=0.03,
            seed=6,
            channels=3,
        )
        right, *wrong = fit.fit_all([models.get(name) for name in names], data)
        assert not right.has("discrepancy") and all(found.has("discrepancy") for found in wrong)
        assert all(np.all(np.isfinite(found.residuals)) for found in (right, *wrong))
        for found in wrong:
            assert found.rms_ln > fit.OUTRUN * right.rms_ln
            alone = fit.fit(found.model, data)  # by itself it is not behind
            for name, stderr in found.stderr.items():
                assert np.all(np.abs(found.values[name] - alone.values[name]) <= 2 * stderr), (
                    directions,
                    found.name,
                    name,
                )


def test_bands_of_many_values_hold_the_same_rows_however_they_are_found(monkeypatch):
    """Edges in place of the order, with many equal values, seed 3."""
    whole = scatter(60_000)
    angles = (whole.geom.theta_i_deg, 0.0 * whole.geom.phi_i_deg, whole.geom.theta_r_deg, whole.geom.phi_deg)
    rounded = Geometry.from_degrees(*(np.round(0.9 * each, -1) for each in angles))
    for geom in (whole.geom, rounded):
        measurement = Measurement(geom, whole.brdf)
        found = subsample.representative_rows(measurement, 3000)
        monkeypatch.setattr(subsample, "FEW", 10**9)
        assert np.array_equal(subsample.representative_rows(Measurement(geom.afresh(), whole.brdf), 3000), found)
        monkeypatch.undo()


def test_rows_of_each_tenth_and_medians_of_three_channels_are_numpys():
    angles = np.round(np.random.default_rng(5).uniform(0, 90, 30_000), 1)
    found = rows_of_each(angles)
    assert list(found) == np.unique(angles).tolist()
    assert all(np.array_equal(rows, np.flatnonzero(angles == angle)) for angle, rows in found.items())
    values = np.random.default_rng(6).standard_normal((1000, 3))
    assert np.array_equal(row_median(values), np.median(values, axis=1))
    values[::7, 1] = np.nan
    np.testing.assert_array_equal(row_median(values), np.nanmedian(values, axis=1))


@pytest.mark.parametrize("picked", ["mask", "rows", "slice"])
def test_some_rows_keep_the_angles_that_were_formed(picked):
    whole = scatter(1000)
    rows = {"mask": np.arange(1000) % 3 == 0, "rows": np.arange(0, 1000, 3), "slice": slice(None, None, 3)}[picked]
    before, angles = whole[rows], whole.geom.theta_r_deg
    after = whole[rows]
    assert "theta_r_deg" not in vars(before.geom.directions) and "theta_r_deg" in vars(after.geom.directions)
    for some in (before, after):
        assert np.array_equal(some.geom.theta_r_deg, angles[::3]) and np.array_equal(some.brdf, whole.brdf[::3])
        assert np.array_equal(some.geom.phi_deg, whole.geom.phi_deg[::3])
