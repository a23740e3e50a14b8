"""From which change of a parameter on a surface looks different."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models import looks
from brdfguide.models.surface import Surface
from brdfguide.models.visible_change import begins_to_show
from brdfguide.report.documents.emergence import SHOWS_FROM

GGX, BECKMANN = models.get("lambertian+ggx"), models.get("lambertian+beckmann")
BODIES = {  # albedo below, n and k of the surface
    "bare metal": (0.0, 0.17, 3.1),  # F0 0.93
    "dark plastic (albedo 0.02)": (0.02, 1.5, 0.0),
    "light plastic (albedo 0.3)": (0.3, 1.5, 0.0),
}


def surface(model, body, alpha=0.1, **more) -> Surface:
    albedo, n, k = BODIES[body]
    lobe = model.terms[1].label
    values = {"lambertian.albedo": albedo, f"{lobe}.alpha": alpha, f"{lobe}.n": n, f"{lobe}.k": k}
    return Surface(model, {**values, **more})


# another program's, for Schlick's Fresnel and uncorrelated masking: about
@pytest.mark.parametrize("body, shows", list(zip(BODIES, (0.08, 0.34, 0.55), strict=True)))
@pytest.mark.parametrize("alpha", [0.05, 0.1, 0.3])
def test_a_width_shows_on_metal_before_it_does_on_plastic(body, shows, alpha):
    found = begins_to_show(surface(GGX, body, alpha), ["ggx.alpha"])["ggx.alpha"]
    assert found == pytest.approx(shows, rel=0.2)


@pytest.mark.parametrize("body", BODIES)
def test_the_change_that_shows_is_two_and_a_half_l(body):
    whole = surface(GGX, body)
    for key, share in begins_to_show(whole, ["lambertian.albedo", "ggx.alpha", "ggx.n"]).items():
        changed = whole.with_value(key, whole.values[key] * (1 + share))
        assert looks.seen_difference(whole, changed) == pytest.approx(2.5, rel=0.05), key


@pytest.mark.parametrize("body", BODIES)
def test_what_roughness_prints_is_what_a_gaussian_lobe_gives(body):
    surfaces = [surface(BECKMANN, body, alpha) for alpha in (0.1, 0.2, 0.3)]
    found = [begins_to_show(each, ["beckmann.alpha"])["beckmann.alpha"] for each in surfaces]
    assert SHOWS_FROM[body] == pytest.approx(np.mean(found), rel=0.1)


def test_what_no_growth_shows_has_none():
    """A rough surface of He and Torrance: only sigma/tau is seen; and an albedo that cannot grow enough."""
    rough = Surface(
        models.get("lambertian+he-torrance"),
        {"lambertian.albedo": 0.95, "he-torrance.sigma": 8.0, "he-torrance.slope": 0.15},
    )
    found = begins_to_show(rough, ["he-torrance.sigma", "lambertian.albedo", "he-torrance.slope"])
    assert found["he-torrance.sigma"] is None and found["lambertian.albedo"] is None
    assert found["he-torrance.slope"] > 0.1


def test_zeros_and_angles_are_left_out():
    oren = Surface(models.get("oren-nayar"), {"oren-nayar.albedo": 0.3, "oren-nayar.spread": 0.4})
    assert list(begins_to_show(oren, ["oren-nayar.albedo", "oren-nayar.spread"])) == ["oren-nayar.albedo"]
    assert begins_to_show(surface(GGX, "bare metal"), ["lambertian.albedo"]) == {}


def test_a_spectrum_is_judged_by_three_of_its_channels():
    um = np.linspace(0.4, 0.7, 31)
    albedo = np.interp(um, [0.4, 0.7], [0.05, 0.5])
    values = {"lambertian.albedo": albedo, "ggx.alpha": 0.2, "ggx.n": 1.5}
    spectrum = Surface(GGX, values, tuple(f"{1e3 * each:.0f}nm" for each in um), um)
    colours = [float(np.interp(each, um, albedo)) for each in (0.61, 0.55, 0.465)]
    few = Surface.of_colours(GGX, {**values, "lambertian.albedo": colours})
    one, other = (begins_to_show(each, ["ggx.alpha"])["ggx.alpha"] for each in (spectrum, few))
    assert one == pytest.approx(other, rel=0.03)


def test_outside_the_visible_the_middle_channel_stands_for_all():
    um = np.linspace(2.0, 4.0, 5)
    infrared = Surface(GGX, {"ggx.alpha": 0.2}, tuple(f"{1e3 * each:.0f}nm" for each in um), um)
    assert begins_to_show(infrared, ["ggx.alpha"])["ggx.alpha"] > 0
