"""Which sums are tried on a surface of each kind."""

import numpy as np
import pytest

from brdfguide import catalog, models
from brdfguide.errors import InputError
from brdfguide.models import candidates
from brdfguide.physics.geometry import in_plane


def test_a_metal_has_no_subsurface_term():
    for candidate in candidates.of_kind("metal"):
        assert "lambertian" not in candidate.name and "oren-nayar" not in candidate.name


def test_a_dielectric_always_has_one():
    for candidate in candidates.of_kind("dielectric"):
        assert candidate.terms[0].label in ("lambertian", "oren-nayar", "lommel-seeliger")


def test_an_unknown_kind_gets_both_sorts():
    names = {candidate.name for candidate in candidates.of_kind()}
    assert {candidate.name for candidate in candidates.of_kind("dielectric")} < names
    bare = {law.name for law, asks in candidates.tried() if law.is_lobe and asks.bare}
    bodies = {law.name for law, asks in candidates.tried() if law.is_body and asks.bare}
    assert {"lambertian", "oren-nayar"} <= bodies <= {each.name for each in candidates.of_kind("dielectric")}
    assert names - {candidate.name for candidate in candidates.of_kind("dielectric")} == bare
    assert bare >= {"cook-torrance", "beckmann", "ggx", "he-torrance"}


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


def test_lobes_of_one_law_share_its_index_and_have_heights_of_their_own():
    surface = models.get("lambertian+ggx:2")
    assert "ggx.2.n" not in surface.parameters and surface.free == ("ggx.1.scale", "ggx.2.scale")
    geom = in_plane(np.array([40.0]), np.array([50.0]))
    one, other = (models.term("ggx")(geom, alpha=alpha, n=1.7) for alpha in (0.1, 0.3))
    values = {"ggx.1.alpha": 0.1, "ggx.2.alpha": 0.3, "ggx.1.n": 1.7, "ggx.1.scale": 0.2, "ggx.2.scale": 0.5}
    body = models.term("lambertian")(geom)
    np.testing.assert_allclose(surface(geom, values), body + 0.2 * one + 0.5 * other, rtol=1e-14)


def test_of_two_lobes_of_a_metal_the_first_is_as_high_as_its_reflectance():
    metal = candidates.as_metal(models.get("ggx:2"))
    assert metal.fixed == {"ggx.1.n": 1.0} and set(metal.free) == {"ggx.1.k", "ggx.2.scale"}


def test_polished_data_bring_the_laws_of_stray_light_and_the_wave_law_beside_them():
    plain = {each.name for each in candidates.of_kind("metal")}
    added = {each.name for each in candidates.of_kind("metal", polished=True, beam=True)} - plain
    laws = {"abg", "harvey-shack", "abc"}
    assert added == laws | {"stam", "lambertian+stam"} | {f"lambertian+{law}" for law in laws} | {
        f"{law}+mirror" for law in laws
    }, "stam has a mirror beam of its own"


def test_a_law_that_asks_to_be_tried_says_so_in_its_own_file():
    asking = [law.name for law in models.every() if law.candidacy is not None]
    assert set(asking) <= set(catalog.saying("models", "Candidacy"))


def test_a_lobe_that_is_a_coats_own_surface_stays_dielectric_on_a_metal():
    (over_body,) = candidates.of_kind("metal", ["ggx+coated:lambertian"])
    assert not over_body.fixed and not candidates.has_edge(over_body)
    (over_metal,) = candidates.of_kind("metal", ["ggx+coated:ggx"])
    assert over_metal.fixed == {"ggx.2.n": 1.0} and over_metal.free == ("coat.n", "ggx.2.k")
