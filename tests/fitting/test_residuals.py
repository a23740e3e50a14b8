import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting import fit, prepared
from brdfguide.fitting.residuals import BLOCK, ln_residuals, rms, rms_over_all

from .. import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.25, "ggx.n": 1.5}


def table(directions, channels=1):
    return synthetic.surface(
        GGX, synthetic.hemisphere(directions, seed=2), TRUTH, noise=0.03, seed=2, channels=channels
    )


@pytest.mark.parametrize("weighed", [False, True])
def test_the_rms_over_blocks_is_the_rms_over_all_with_seed_2(weighed):
    data = table(BLOCK + 700, channels=2)
    data.brdf[5:900, 1] = np.nan
    counted = np.linspace(0.5, 1.5, len(data.brdf))[:, None] if weighed else None
    surfaces = [
        synthetic.fitted(GGX, {**GGX.defaults(), **TRUTH, "ggx.alpha": alpha}, data) for alpha in (0.2, 0.25, 0.3)
    ]
    known = [
        np.sqrt(np.nanmean(ln_residuals(each, data) ** 2 * (1 if counted is None else counted))) for each in surfaces
    ]
    np.testing.assert_allclose(rms_over_all(surfaces, data, counted), known, rtol=1e-12)
    np.testing.assert_allclose([rms(ln_residuals(each, data), counted) for each in surfaces], known, rtol=1e-12)


def test_of_a_large_table_residuals_are_kept_where_models_are_compared_and_the_error_is_over_all_with_seed_2():
    data = table(prepared.COMPARED_SAMPLES + 3000)
    near, far = fit.fit_all([GGX, models.get("lambertian")], data)
    assert far.rms_ln > fit.TWINS * near.rms_ln
    rows = prepared.compared_rows(data)
    assert len(rows) <= prepared.COMPARED_SAMPLES
    for one in (near, far):
        np.testing.assert_array_equal(one.residuals, ln_residuals(one.surface, data)[rows])
    assert near.rms_ln == pytest.approx(rms(ln_residuals(near.surface, data)), rel=1e-12)
    assert near.rms_ln == pytest.approx(rms(near.residuals_on(data)), rel=1e-12)
    assert far.rms_ln == pytest.approx(rms(ln_residuals(far.surface, data)), rel=0.01)
