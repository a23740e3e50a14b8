"""What a sum may be given: one thing more each time, and where that begins."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting.layout import Layout
from brdfguide.models import candidates
from brdfguide.models.extensions import edges, extensions, revived
from brdfguide.physics.fresnel import f0
from brdfguide.physics.geometry import in_plane, rows

from .. import synthetic

SUMS = (
    "lambertian+ggx",
    "lambertian+beckmann (height free)",
    "lambertian+ggx:2",
    "lambertian+ggx+ggx",
    "ggx (metal)",
    "ggx:2 (metal)",
    "coated:lambertian+flakes",
    "ggx+coated:lambertian",
    "lambertian+lafortune:2",
)
GEOM = rows(in_plane(np.repeat([10.0, 60.0], 9), np.tile(np.linspace(-70, 70, 9), 2)))


def grown_from(label: str, kind=None):
    model = candidates.named(label)
    values = synthetic.random_values(Layout(model, 1), np.random.default_rng(8))
    return model, values, list(extensions(model, values, kind))


@pytest.mark.parametrize("label", SUMS)
def test_each_is_another_candidate_that_can_be_typed_with_seed_8(label):
    model, _, found = grown_from(label)
    names = [candidates.candidate_label(each.model) for each in found]
    assert found and len({*names, label}) == len(names) + 1
    for name, each in zip(names, found, strict=True):
        typed = candidates.named(name)
        assert set(typed.free) == set(each.model.free) and typed.fixed == each.model.fixed
        assert each.adds


@pytest.mark.parametrize("label", SUMS)
def test_every_start_is_a_surface_of_the_longer_sum_with_seed_8(label):
    for each in grown_from(label)[2]:
        layout = Layout(each.model, 1)
        for start in each.starts:
            values = layout.decode(*layout.encode(start))
            f = each.model(GEOM, values)
            assert np.all(np.isfinite(f)) and np.all(f >= 0)


@pytest.mark.parametrize("label", ["lambertian+ggx:2", "lambertian+ggx (height free)", "lambertian+ggx"])
def test_a_law_that_contains_another_begins_at_its_surface_with_seed_8(label):
    model, values, found = grown_from(label)
    (wider,) = [each for each in found if "student-t" in each.model.name]
    np.testing.assert_allclose(wider.model(GEOM, wider.starts[0]), model(GEOM, values), rtol=1e-12)


def test_heights_and_indices_begin_where_they_change_nothing_with_seed_8():
    for label, adds in (("lambertian+ggx", "a height"), ("lambertian+ggx:2", "an index")):
        model, values, found = grown_from(label)
        (freed,) = [each for each in found if each.adds.startswith(adds)]
        np.testing.assert_allclose(freed.model(GEOM, freed.starts[0]), model(GEOM, values), rtol=1e-12)
        assert Layout(freed.model, 3).count > Layout(model, 3).count


def test_a_second_lobe_is_narrower_or_wider_than_the_first():
    model, values, found = grown_from("lambertian+ggx")
    (two,) = [each for each in found if each.adds == "a second lobe"]
    ratios = [start["ggx.2.alpha"] / start["ggx.1.alpha"] for start in two.starts]
    assert min(ratios) < 1 / 1.5 and max(ratios) > 1.5


def test_a_metal_gets_no_body_and_keeps_its_k():
    _, _, found = grown_from("ggx (metal)", "metal")
    for each in found:
        assert not any(term.model.is_body for term in each.model.terms)
        assert any(key.endswith(".k") for key in each.model.free)
    assert "coated:ggx (metal)" in [candidates.candidate_label(each.model) for each in found]


def test_no_more_than_three_lobes_of_one_law():
    names = [candidates.candidate_label(each.model) for each in grown_from("lambertian+ggx:3")[2]]
    assert not any("ggx:4" in name for name in names)


def test_lobes_with_indices_of_their_own_are_written_apart():
    apart, together = models.get("lambertian+ggx+ggx"), models.get("lambertian+ggx:2")
    assert apart.name == "lambertian+ggx+ggx" and together.name == "lambertian+ggx:2"
    assert {"ggx.1.n", "ggx.2.n"} < set(apart.parameters) and "ggx.2.n" not in together.parameters
    assert set(apart.free) == set(together.free) == {"ggx.1.scale", "ggx.2.scale"}
    assert models.get("lambertian+lafortune+lafortune").name == "lambertian+lafortune:2"


def test_lobes_in_order_keep_their_own_index():
    layout = Layout(models.get("ggx+ggx"), 1)
    start = {"ggx.1.alpha": 0.3, "ggx.2.alpha": 0.1, "ggx.1.n": np.array([1.4]), "ggx.2.n": np.array([2.0])}
    values = layout.decode(*layout.in_order(*layout.encode(start)))
    assert values["ggx.1.alpha"] == pytest.approx(0.1) and values["ggx.1.n"] == pytest.approx(2.0)
    uneven = Layout(models.get("ggx:2+ggx"), 1)
    assert uneven.alike == [["ggx.1", "ggx.2"]]  # the third has an index of its own and stays


def test_the_lobe_of_a_metal_that_is_as_high_as_f0_keeps_its_place():
    layout = Layout(candidates.named("ggx:3 (metal)"), 1)
    assert layout.alike == [["ggx.2", "ggx.3"]]
    start = {"ggx.1.alpha": 0.3, "ggx.2.alpha": 0.2, "ggx.3.alpha": 0.1, "ggx.1.k": np.array([3.0])}
    start |= {"ggx.2.scale": np.array([0.5]), "ggx.3.scale": np.array([0.2])}
    given = layout.encode(start)
    sorted_ = layout.decode(*layout.in_order(*given))
    np.testing.assert_allclose(layout.model(GEOM, sorted_), layout.model(GEOM, layout.decode(*given)), rtol=1e-12)
    assert sorted_["ggx.1.alpha"] == pytest.approx(0.3) and sorted_["ggx.2.alpha"] == pytest.approx(0.1)


@pytest.mark.parametrize(
    "label, freed",
    [
        ("lambertian+ggx (height free)", {"ggx.scale"}),
        ("ggx (metal)", {"ggx.k"}),
        ("ggx (metal, height free)", {"ggx.k", "ggx.scale"}),
        ("ggx (metal, edge free)", {"ggx.k"}),
        ("  lambertian+ggx ", set()),
    ],
)
def test_a_candidate_is_read_by_the_name_it_is_shown_under(label, freed):
    model = candidates.named(label)
    assert set(model.free) == freed and candidates.candidate_label(model) == label.strip()


def test_other_words_in_brackets_are_refused():
    with pytest.raises(InputError, match=r"found \(wide\); wanted \(metal\), \(edge free\) or \(height free\)"):
        candidates.named("ggx (wide)")
    with pytest.raises(InputError, match=r"found \(edge free\); wanted \(metal, edge free\)"):
        candidates.named("lambertian+ggx (edge free)")


def test_a_metal_is_given_an_edge_of_its_own_at_the_same_reflectance_and_never_beside_a_height():
    metal = candidates.named("ggx (metal)")
    values = {**metal.defaults(), "ggx.k": np.array([4.0, 1.0])}
    (found,) = edges(metal, values)
    assert candidates.candidate_label(found.model) == "ggx (metal, edge free)"
    for start in found.starts[1:]:
        assert f0(start["ggx.n"], start["ggx.k"])[0] == pytest.approx(0.8)
    assert not list(edges(found.model, values))
    assert not list(edges(candidates.named("ggx (metal, height free)"), values))
    assert not list(edges(candidates.named("lambertian+ggx"), values))


def test_a_lobe_that_ended_at_nothing_stands_anew_beside_the_other():
    model = candidates.named("lambertian+ggx:2")
    values = model.defaults() | {"ggx.1.alpha": 0.0001, "ggx.2.alpha": 0.05}
    ended = values | {"ggx.1.scale": np.zeros(1), "ggx.2.scale": np.full(1, 0.3)}
    starts = revived(model, ended)
    assert np.allclose([start["ggx.1.alpha"] for start in starts], [0.005, 0.05 / 3, 0.15, 0.5])
    assert all(start["ggx.2.alpha"] == 0.05 for start in starts)
    assert not revived(model, ended | {"ggx.1.scale": np.full(1, 1e-3)})
    assert not revived(candidates.named("lambertian+ggx"), candidates.named("lambertian+ggx").defaults())
