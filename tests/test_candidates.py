"""Which sums are tried on a surface of each kind."""

import pytest

from brdfguide import candidates, models
from brdfguide.errors import InputError


def test_a_metal_has_no_subsurface_term():
    for candidate in candidates.of_kind("metal"):
        assert "lambertian" not in candidate.name and "oren-nayar" not in candidate.name


def test_a_dielectric_always_has_one():
    for candidate in candidates.of_kind("dielectric"):
        assert candidate.terms[0].label in ("lambertian", "oren-nayar")


def test_an_unknown_kind_gets_both_sorts():
    names = {candidate.name for candidate in candidates.of_kind()}
    assert {candidate.name for candidate in candidates.of_kind("dielectric")} < names
    assert names - {candidate.name for candidate in candidates.of_kind("dielectric")} == set(candidates.FRESNEL)


def test_fresnels_factor_of_a_metal_frees_k_and_holds_n():
    for candidate in candidates.of_kind("metal"):
        for term in candidate.terms:
            if "k" in term.model.defaults():
                assert candidate.fixed[f"{term.label}.n"] == 1.0
                assert f"{term.label}.k" in candidate.free
                assert candidate.defaults()[f"{term.label}.k"] == candidates.METAL_K


def test_names_are_taken_as_they_are():
    (only,) = candidates.of_kind(names=["lambertian+ward"])
    assert only.name == "lambertian+ward" and only.fixed == {} and only.free == ()


def test_an_unknown_kind_of_surface_is_an_error():
    with pytest.raises(InputError, match="no kind of surface called 'metallic'; did you mean metal"):
        candidates.of_kind("metallic")


def test_start_values_stand_in_for_defaults():
    plain = models.get("ward")
    from dataclasses import replace

    started = replace(plain, start={"ward.alpha": 0.05})
    assert started.defaults() == {**plain.defaults(), "ward.alpha": 0.05}
