"""S of fits against measurements: from residuals, with readings that are black, missing or coloured."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.seen_weights import seen_weights
from brdfguide.fitting import appearance, fit, ranking
from brdfguide.fitting.appearance import lobe_width_deg, of_fits, too_coarse
from brdfguide.fitting.reading import reading
from brdfguide.models.surface import Surface
from brdfguide.physics import seen
from brdfguide.physics.aperture import solid_angle_of

from .. import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.2, "ggx.n": 1.5}


def plastic(**more):
    return synthetic.surface(GGX, synthetic.scan(), TRUTH, **more)


def fitted(data, **values):
    return fit.fit(GGX, data, fit.FitOptions(fixed={**TRUTH, **values}))


def by_hand(surface, data, colours=None) -> float:
    """S of a surface read by the instrument, nothing taken from residuals."""
    mixed = [f if colours is None else f @ colours for f in (reading(surface, data.instrument), data.brdf)]
    return seen.apart(*(seen.lightness(f, data.geom.cos_i) for f in mixed), seen_weights(data).of_rows)


def s_of(found, data) -> float:
    return of_fits([found], [found.residuals], data).seen(0)


def test_s_from_residuals_is_that_of_readings():
    data = plastic(noise=0.05, seed=1)
    found = fitted(data, **{"ggx.alpha": 0.25})
    assert s_of(found, data) == pytest.approx(by_hand(found.surface, data), rel=1e-9)


def test_through_an_aperture_too():
    data = replace(plastic(noise=0.05, seed=1), solid_angle=solid_angle_of(3.0))
    found = fitted(data, **{"ggx.alpha": 0.25})
    assert s_of(found, data) == pytest.approx(by_hand(found.surface, data), rel=1e-9)


def test_values_below_zero_count_as_black():
    data = plastic()
    data.brdf[5:9] = -0.01
    found = fitted(data, **{"ggx.alpha": 0.25})
    assert np.isnan(found.residuals[5:9]).all()
    assert s_of(found, data) == pytest.approx(by_hand(found.surface, data), rel=1e-9)
    assert s_of(found, data) > s_of(fitted(plastic(), **{"ggx.alpha": 0.25}), plastic())


def test_missing_values_do_not_count():
    data = plastic(channels=3)
    data.brdf[5:9, 1] = np.nan
    found = fitted(data, **{"ggx.alpha": 0.25})
    colours = seen.colours(data.channels, data.geom.wavelength)
    assert s_of(found, data) == pytest.approx(by_hand(found.surface, data, colours), rel=1e-9)


def test_a_spectrum_is_looked_at_in_colour():
    data = plastic(channels=31)
    found = fitted(data, **{"lambertian.albedo": 0.35})
    colours = seen.colours(data.channels, data.geom.wavelength)
    assert colours.shape == (31, 3)
    assert s_of(found, data) == pytest.approx(by_hand(found.surface, data, colours), rel=1e-9)


def test_noise_adds_little_and_changes_no_clear_order():
    names = ("lambertian+ggx", "lambertian+ward", "lambertian+phong")
    clean, noisy = plastic(), plastic(noise=0.05, seed=4)
    orders, least = [], []
    for data in (clean, noisy):
        rows = ranking.rank(fit.fit_all(map(models.get, names), data), data).rows
        orders.append([row.fit.name for row in sorted(rows, key=lambda row: row.seen)])
        least.append(min(row.seen for row in rows))
    assert orders[0] == orders[1] and least[0] < 0.01 < least[1] < 2.5


def test_a_gain_of_the_data_scales_s_by_its_cube_root():
    data = plastic(noise=0.05, seed=1)
    brighter = replace(data, brdf=2 * data.brdf)
    one, other = (fit.fit(models.get("lambertian+ward"), each) for each in (data, brighter))
    assert s_of(other, brighter) == pytest.approx(np.cbrt(2) * s_of(one, data), rel=1e-3)


def test_between_two_fits():
    data = plastic()
    fits = [fitted(data, **{"ggx.alpha": alpha}) for alpha in (0.2, 0.25)]
    look = of_fits(fits, [each.residuals for each in fits], data)
    assert look.kind == "ring" and look.between(0, 0) == 0
    assert look.between(0, 1) == pytest.approx(look.seen(1), rel=1e-6), "the first is the data's own surface"


# --- too coarse a scan -----------------------------------------------------------------------------------


@pytest.mark.parametrize("alpha, step, coarse", [(0.02, 5.0, True), (0.2, 5.0, False), (0.02, 1.0, False)])
def test_a_lobe_narrower_than_two_steps_is_said(alpha, step, coarse):
    values = {**TRUTH, "ggx.alpha": alpha}
    data = synthetic.surface(GGX, synthetic.scan(step=step), values)
    found = too_coarse(Surface(GGX, values), data)
    assert (found is not None) == coarse
    assert not coarse or "degrees wide" in found.text


def test_the_width_of_a_lobe():
    def gaussian(alpha):
        return Surface(models.get("ward"), {"ward.alpha": alpha, "ward.rho_s": 0.1})

    # in the plane of incidence a Gaussian of tan δ falls to half at alpha √ln 2, and r turns by twice δ
    assert lobe_width_deg(gaussian(0.05)) == pytest.approx(4 * np.degrees(0.05 * np.sqrt(np.log(2))), rel=0.15)
    assert lobe_width_deg(Surface(models.get("lambertian"), {"lambertian.albedo": 0.5})) is None


def test_hemispheres_are_not_scans():
    data = synthetic.surface(GGX, synthetic.hemisphere(100), TRUTH)
    assert appearance.too_coarse(Surface(GGX, {**TRUTH, "ggx.alpha": 0.01}), data) is None
