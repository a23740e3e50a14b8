"""What a description says and a fit denies."""

import pytest

from brdfguide.advice import eye_against_fit, material, recommend
from brdfguide.data import metal_or_dielectric
from brdfguide.fitting import compare
from brdfguide.models import candidates

from .. import synthetic

STEEL = {"he-torrance.sigma": 0.1, "he-torrance.slope": 0.03, "he-torrance.k": 4.0, "he-torrance.n": 1.0}


@pytest.fixture(scope="module")
def fitted():
    """Wave optics of rms height 0.1 um, and the fit to it."""
    law = candidates.named("he-torrance (metal)")
    data = synthetic.surface(law, synthetic.scan((10, 40, 65), step=1.0), STEEL, noise=0.02, seed=3)
    return data, compare.compare(data, [law, candidates.named("ggx (metal)")])


def heights(fitted, sigma_um, **more):
    data, ranked = fitted
    described = recommend.recommend(material.observed({"kind": "metal", "stylus": {"sigma_um": sigma_um}, **more}))
    found = eye_against_fit.disagreements(described, metal_or_dielectric.verdict(data), ranked, data)
    return [each for each in found if each.code == "height-disagrees"]


def test_a_stylus_height_seven_times_the_fitted_one_is_said_with_seed_3(fitted):
    (said,) = heights(fitted, 0.7)
    numbers = dict(said.numbers)
    assert numbers["stylus_um"] == 0.7 and numbers["fitted_um"] == pytest.approx(0.1, rel=0.1)
    assert said.severity == "warning" and "a factor 7" in said.text and "0.7 µm by the stylus" in said.text


def test_a_stylus_height_that_light_agrees_with_is_not_said_with_seed_3(fitted):
    assert heights(fitted, 0.13) == []


def test_a_height_that_was_inferred_is_no_stylus_with_seed_3(fitted):
    data, ranked = fitted
    described = recommend.recommend(material.observed({"kind": "metal", "finish": "matt"}))
    found = eye_against_fit.disagreements(described, metal_or_dielectric.verdict(data), ranked, data)
    assert "height-disagrees" not in {each.code for each in found}
