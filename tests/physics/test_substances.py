"""Substances by name: each with a source, no name twice, and a wavelength that is used or refused."""

import pytest

from brdfguide.errors import InputError
from brdfguide.physics import fresnel, substances


def f0_of(name, wavelength_um=0.55):
    n, k, _ = substances.at_wavelength(substances.find(name), wavelength_um)
    return float(fresnel.f0(n, k))


def test_no_two_substances_share_a_name():
    names = [name for each in substances.SUBSTANCES for name in (each.name, *each.aliases)]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("each", substances.SUBSTANCES, ids=lambda each: each.name)
def test_every_number_has_a_source_and_a_plausible_size(each):
    assert len(each.source) > 10
    assert len(each.n) == len(each.k)
    assert each.wavelength is None or len(each.wavelength) in (1, len(each.n))
    for n, k in zip(each.n, each.k, strict=True):
        reflected = float(fresnel.f0(n, k))
        low, high = {"metal": (0.3, 0.99), "dielectric": (0.015, 0.25), "semiconductor": (0.2, 0.6)}[each.kind]
        assert low < reflected < high


@pytest.mark.parametrize(
    "name",
    [
        "leather",
        "wood",
        "snow",
        "soil",
        "glaze",
        "porcelain",
        "polypropylene",
        "abs",
        "pvc",
        "nylon",
        "silicone",
        "epoxy",
        "emulsion paint",
        "varnish",
        "emerald",
        "ruby",
        "topaz",
        "garnet",
        "opal",
        "304",
        "316",
        "cartridge brass",
        "red brass",
        "gilding metal",
        "bronze",
        "anodised layer",
    ],
)
def test_what_people_have_is_known(name):
    assert substances.find(name) is not None


@pytest.mark.parametrize("name", ["bronze", "304", "steel", "soil", "porcelain", "leather", "abs", "granite"])
def test_a_stand_in_says_how_far_off_it_may_be(name):
    assert "%" in substances.find(name).note


def test_platinum_reflects_as_its_mirror_measurements_say():
    """0.64 to 0.73 by all but the energy loss spectra, which give every metal 20 to 50 % too much."""
    assert f0_of("platinum") == pytest.approx(0.642, abs=0.002)


def test_a_wavelength_between_two_is_between_their_values():
    brass = substances.find("brass")
    n, k, at = substances.at_wavelength(brass, 0.6)
    assert (n, k, at) == pytest.approx(((0.444 + 0.527) / 2, (3.695 + 2.765) / 2, 0.6))
    assert substances.at_wavelength(brass, 0.65) == pytest.approx((0.444, 3.695, 0.65))
    assert substances.at_wavelength(brass, 0.45) == pytest.approx((1.094, 1.829, 0.45))


def test_a_handbook_value_serves_near_its_wavelength_and_says_which_that_is():
    assert substances.at_wavelength(substances.find("nylon"), 0.55) == (1.53, 0.0, 0.5893)


@pytest.mark.parametrize(
    ("name", "wavelength_um", "sentence"),
    [
        ("brass", 1.064, "brass is known at 450 and 550 and 650 nm only, and between them; 1064 nm was asked for"),
        ("leather", 0.55, "leather is known at 850 nm only; 550 nm was asked for"),
        ("salt", 0.55, "salt comes from a source that names no wavelength; 550 nm was asked for"),
    ],
)
def test_another_wavelength_is_refused_in_words(name, wavelength_um, sentence):
    with pytest.raises(InputError) as caught:
        substances.at_wavelength(substances.find(name), wavelength_um)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    "words, kind",
    [
        ("oak table", "dielectric"),
        ("walnut veneer", "dielectric"),
        ("plywood", "dielectric"),
        ("denim", "dielectric"),
        ("satin steel", "metal"),
        ("brushed stainless", "metal"),
        ("silver birch", None),
    ],
)
def test_what_things_about_the_house_are_made_of_is_known_by_name(words, kind):
    assert substances.kind_of_words(words)[0] == kind
