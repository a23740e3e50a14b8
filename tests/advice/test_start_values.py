"""Start values: the lobes of different laws made from one material are one surface near the normal."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.advice import guidelines, start_values
from brdfguide.advice.material import observed, parse_material
from brdfguide.advice.recommend import recommend
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane

LOBES = ("phong", "blinn", "ward-gmd", "cook-torrance", "beckmann", "he-torrance")


def started(name: str, text: str):
    filled = guidelines.consult(parse_material(text)).material
    model = models.get(name)
    return model, start_values.start_values(model, filled), filled


@pytest.mark.parametrize("name", LOBES)
def test_every_law_starts_from_the_same_peak(name):
    model, values, filled = started(name, "composition: aluminium\nhighlight_width_deg: 19.03")
    assert filled.alpha == pytest.approx(0.1, rel=1e-3)
    peak = 0.92114 / (4 * np.pi * 0.1**2)
    assert float(np.squeeze(model(in_plane(5, 5), values))) == pytest.approx(peak, rel=0.04)


@pytest.mark.parametrize("name", ("phong", "blinn", "ward-gmd", "beckmann", "ggx"))
def test_every_gaussian_law_starts_with_the_width_that_was_seen(name):
    model, values, _ = started(name, "composition: aluminium\nhighlight_width_deg: 19.03")
    peak, half = (float(np.squeeze(model(in_plane(2, 2 + off), values))) for off in (0, 19.03 / 2))
    assert half / peak == pytest.approx(0.5, abs=0.04)


def test_ward_keeps_its_factor_of_the_root_of_the_cosines():
    model, values, _ = started("ward", "composition: aluminium\nhighlight_width_deg: 19.03")
    assert values["ward.rho_s"] == pytest.approx(0.92114, abs=1e-4)
    assert float(np.squeeze(model(in_plane(0, 0), values))) == pytest.approx(0.92114 / (4 * np.pi * 0.01), rel=1e-3)


def test_a_lafortune_lobe_follows_the_facets_it_stands_for_within_a_factor_of_four():
    text = "kind: dielectric\nappearance: black\nhighlight_width_deg: 37"
    (one, a, _), (other, b, _) = started("lafortune", text), started("beckmann", text)
    for theta in (5, 20, 40, 60, 75):
        ratio = float(np.squeeze(one(in_plane(theta, theta), a))) / float(np.squeeze(other(in_plane(theta, theta), b)))
        assert 1 / 4 < ratio < 4


def test_a_lafortune_lobe_that_cannot_be_as_narrow_has_no_more_light():
    light = []
    for width in (1.6, 0.4):
        _, values, _ = started("lafortune", f"kind: dielectric\nappearance: black\nhighlight_width_deg: {width}")
        light.append(values["lafortune.ks"] / (values["lafortune.exponent"] + 1))
    assert values["lafortune.exponent"] == 1e4
    assert light[1] == pytest.approx(light[0], rel=0.01)


def test_start_values_lie_inside_the_bounds_of_their_laws():
    for text in (
        "composition: silver\nfinish: mirror",
        "kind: metal\nf0: 0.9999\nfinish: matt",
        "appearance: metallic flake",
        "kind: dielectric\nf0: 0",
        "finish: satin",
    ):
        for name in (
            "lambertian+ggx",
            "phong+mirror",
            "lafortune",
            "blinn",
            "phong-lewis",
            "ward",
            "he-torrance",
            "oren-nayar+ggx",
            "cook-torrance",
            "mirror",
        ):
            model, values, _ = started(name, text)
            for key, value in values.items():
                bound = model.parameters[key]
                assert np.all((np.atleast_1d(value) >= bound.least) & (np.atleast_1d(value) <= bound.high)), (text, key)
            start_values.grazing_growth(Surface.of_colours(model, values))


def test_an_index_below_1_survives_as_a_start_value():
    _, values, _ = started("ggx", "composition: silver\nfinish: satin")
    assert (values["ggx.n"], values["ggx.k"]) == (0.12, 3.45)


def test_exponents_follow_from_the_width():
    text = "composition: aluminium\nhighlight_width_deg: 19.0287"
    assert started("blinn", text)[1]["blinn.exponent"] == pytest.approx(198, rel=1e-3)
    assert started("phong", text)[1]["phong.exponent"] == pytest.approx(49.5, rel=1e-3)
    assert started("phong-lewis", text)[1]["phong-lewis.exponent"] == pytest.approx(49.5, rel=1e-3)


def test_flakes_lie_narrower_than_their_highlight_by_the_index_of_the_coat():
    """30 degrees at half height are alpha 0.2045, by GGX's tan δ = alpha √(√2 - 1)."""
    text = "appearance: metallic flake\nflake_highlight_width_deg: 30"
    values = started("coated:flakes", text)[1]
    assert values["coat.n"] == 1.5 and values["flakes.tilt"] == pytest.approx(0.2045 / 1.5, rel=1e-3)
    unknown = started("coated:flakes", "appearance: metallic flake")[1]
    assert unknown["flakes.tilt"] == pytest.approx(start_values.FLAKE_ALPHA / 1.5)


def test_metallic_flake_is_flakes_under_a_coat_and_the_reports_choice_is_listed_as_such():
    found = recommend(observed({"appearance": "metallic flake"}))
    names = [each.model.name for each in found.candidates]
    assert names[:2] == ["coated:flakes", "phong+mirror"]
    assert found.candidates[1].why.startswith("the report's own choice")
    assert found.candidates[0].rise.at_mirror < 1.5  # bare facets: 8 to 14


def test_a_body_that_looks_so_bright_under_a_coat_is_brighter():
    """0.276 through n = 1.5 is an albedo of 0.5."""
    values = started("coated:lambertian", "kind: dielectric\ncoat: clear\ndiffuse_reflectance: 0.2757")[1]
    assert values["lambertian.albedo"] == pytest.approx(0.5, rel=2e-3)
    bright = recommend(observed({"kind": "dielectric", "coat": "clear", "diffuse_reflectance": [0.7]}))
    assert "coated:lambertian" in [each.model.name for each in bright.candidates[:3]]


def test_a_coats_index_is_never_a_metals():
    text = "appearance: metallic flake\nmetallic: 1\nindex: {n: 0.04, k: 20}\nroughness: 0.6"
    _, values, _ = started("ggx+coated:flakes", text)
    assert values["coat.n"] == 1.5
    _, values, _ = started("ggx+coated:flakes", "appearance: metallic flake\nindex: {n: 1.48}")
    assert values["coat.n"] == 1.48
