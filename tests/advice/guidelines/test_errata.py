"""The report's inconsistencies (X1 to X24 of its reading), as the advisor meets them."""

from math import exp, pi, sqrt

import numpy as np
import pytest

from brdfguide import models
from brdfguide.advice import guidelines, recommend, start_values
from brdfguide.advice.material import parse_material
from brdfguide.models.surface import Surface
from brdfguide.physics import colorchecker, emergence, fresnel, fresnel_simplifications, substances


def says(text: str, rule: str) -> str:
    return next(each.says for each in guidelines.consult(parse_material(text)).advice if each.rule == rule)


def recommended(text: str) -> recommend.Recommendation:
    return recommend.recommend(parse_material(text))


def test_x1_the_worked_example_lies_on_the_75_degree_contour():
    assert emergence.crossing(75, 0.1) == pytest.approx((0.499, 4.99), rel=2e-3)
    assert emergence.formula_crossing(80, 0.1) == pytest.approx((0.857, 8.57), rel=1e-3)
    filled = guidelines.consult(parse_material("emergence_angle_deg: 75")).material
    assert (filled.sigma, filled.tau) == pytest.approx((0.5, 5.0), rel=0.01)
    assert "sigma 0.583 µm, tau 5.83 µm" in says("emergence_angle_deg: 75", "formula_beside_criterion")


def test_x2_table_2_is_low_at_85_degrees_and_the_advice_says_how_much():
    assert "-23%" in says("emergence_angle_deg: 85", "formula_beside_criterion")


def test_x3_the_chart_has_six_neutrals_in_two_data_sets():
    assert len(colorchecker.PATCHES) == 6
    assert [colorchecker.patch(name) for name in colorchecker.PATCHES] == [
        0.9124,
        0.5886,
        0.3596,
        0.1913,
        0.0895,
        0.0320,
    ]
    assert [colorchecker.patch(name, "iso17321") for name in colorchecker.PATCHES] == [
        0.8872,
        0.5839,
        0.3582,
        0.2031,
        0.0926,
        0.0335,
    ]


def test_x4_the_reports_smooth_limit_scatters_19_percent():
    assert 1 - exp(-((4 * pi * 0.02 / 0.55) ** 2)) == pytest.approx(0.1885, abs=1e-4)
    text = says("stylus: {sigma_um: 0.02}", "smooth_limit")
    assert "takes 18.8% of the light from the mirror image" in text and "0.0044 µm would take 1 %" in text


def test_x5_both_phongs_are_named_and_grow_differently():
    phong, lewis = (start_values.grazing_growth(Surface(models.get(name), {})) for name in ("phong", "phong-lewis"))
    assert phong.at_mirror == pytest.approx(
        np.cos(np.radians(10)) / np.cos(np.radians(75)), rel=1e-9
    )  # 3.81, the same as Ward's
    assert lewis.at_mirror == pytest.approx(1.0, rel=1e-9)
    ward = start_values.grazing_growth(Surface(models.get("ward"), {"ward.alpha": 0.2}))
    assert ward.at_mirror == pytest.approx(3.805, abs=1e-3) and ward.greatest == pytest.approx(10.05, abs=0.01)


def test_x10_no_mirror_image_bounds_sigma_and_the_bound_is_called_soft():
    assert "this bound is soft" in says("kind: dielectric\nemergence_angle_deg: never", "never_a_mirror_image")


def test_x12_the_coupling_is_not_neglected_for_a_bright_body():
    assert "take `coupled` in place of `lambertian`" in says(
        "kind: dielectric\ndiffuse_reflectance: 0.75", "energy_of_body_and_surface"
    )


def test_x13_eq_2_of_a_metal_falls_where_the_metal_rises():
    n, up_to = fresnel_simplifications.equivalent_cost(0.958, 6.69)
    assert n == pytest.approx(48.7, abs=0.05) and 75 < up_to < 80
    at_85 = np.cos(np.radians(85.0))
    assert fresnel.fresnel(at_85, n) < 0.8 * fresnel.fresnel(at_85, 0.958, 6.69)
    filled = guidelines.consult(parse_material("kind: metal\nf0: 0.9211")).material
    assert filled.n == (1.0,)
    assert fresnel.f0(filled.n[0], filled.k[0]) == pytest.approx(0.9211, rel=1e-12)
    assert fresnel.fresnel(at_85, filled.n[0], filled.k[0]) == pytest.approx(0.8846, rel=0.03)


def test_x14_each_row_of_table_1_has_its_own_wavelength_or_says_that_it_has_none():
    at = {each.name: each.wavelength for each in substances.SUBSTANCES if each.table1}
    assert (
        at["nickel"] == (0.5636,)
        and at["chromium"] == (0.5585,)
        and at["fused silica"] == (0.546074,)
        and at["polyethylene"] == (0.5511,)
    )
    assert at["aluminium"] is None and at["silver"] is None


@pytest.mark.parametrize("name", ["gold", "copper", "brass"])
def test_x14b_coloured_metals_break_the_rule_of_one_index(name):
    found = recommended(f"composition: {name}\nfinish: mirror")
    red, _, blue = fresnel.f0(np.array(found.material.n), np.array(found.material.k))
    assert red > 1.3 * blue
    assert len(found.candidates[0].start["mirror.n"]) == 3


@pytest.mark.parametrize("each", [each for each in substances.SUBSTANCES if each.table1], ids=lambda each: each.name)
def test_table_1_is_right_to_its_rounding(each):
    assert float(fresnel.f0(each.n[0], each.k[0])) == pytest.approx(each.table1, abs=5e-5)


def test_x15_water_and_acrylic_offer_what_other_tables_have():
    assert "1.333 to 1.335" in substances.find("water").note and "1.49 is usual" in substances.find("lucite").note


def test_x16_not_every_metal_reflects_half():
    iron = substances.find("iron")
    f = fresnel.fresnel(np.cos(np.radians(np.arange(0, 90.0))), iron.n[1], iron.k[1])
    assert f.min() < 0.5


def test_x17_sigma_over_tau_is_four_different_slopes():
    text = says("stylus: {sigma_um: 0.5, tau_um: 5}", "slopes_of_stylus")
    assert all(each in text for each in ("sigma/tau = 0.1", f"{sqrt(2) * 0.1:.3g} (Rdq)", "0.2 (Sdq)", "alpha = 0.2"))
    assert recommended("kind: metal\nstylus: {sigma_um: 2, tau_um: 5}").status == "flagged"
    assert recommended("kind: metal\nstylus: {sigma_um: 6, tau_um: 5}").status == "outside"


def test_x18_emergence_depends_on_the_wavelength():
    sigma, tau = emergence.crossing(75, 0.1)
    assert emergence.emergence_angle(sigma, tau, 0.45) == pytest.approx(77.7, abs=0.1)
    assert emergence.emergence_angle(sigma, tau, 0.65) == pytest.approx(72.1, abs=0.1)


def test_x24_only_the_slope_can_be_told_far_above_the_wavelength():
    text = "kind: dielectric\nstylus: {sigma_um: 4.9, tau_um: 32}"
    assert "only its slope, sigma/tau, shows" in says(text, "only_slope_matters")
    assert recommended(text).candidates[0].model.name == "lambertian+ggx"


def test_g4_the_cost_of_n_1_5_is_what_the_tables_say():
    costs = {n: fresnel_simplifications.index_cost(n) for n in (1.34, 1.46, 1.48, 1.49, 1.51, 1.54, 2.4203)}
    assert [round(100 * cost) for cost in costs.values()] == [89, 14, 7, 3, -3, -12, -77]


@pytest.mark.parametrize(
    "name, to_75, to_85", [("nickel", 1.7, 12), ("chromium", 5.6, 6.7), ("aluminium", 2.4, 3.1), ("silver", 0.3, 1.1)]
)
def test_g5_the_cost_of_a_constant_for_metals_is_what_the_spec_says(name, to_75, to_85):
    metal = substances.find(name)
    assert 100 * fresnel_simplifications.constant_cost(metal.n[0], metal.k[0], 75)[0] == pytest.approx(to_75, abs=0.3)
    assert 100 * fresnel_simplifications.constant_cost(metal.n[0], metal.k[0], 85)[0] == pytest.approx(to_85, abs=0.7)
