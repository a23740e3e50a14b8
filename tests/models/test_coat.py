"""A clear coat over every law: against 50 digits, at its limits, and what it does to bodies and flakes."""

from functools import partial

import numpy as np
import pytest
from mpmath import mpf, workdps

from brdfguide import models
from brdfguide.audit import textbook_more as textbook
from brdfguide.audit.trials import parameter_sets, trial_directions, within
from brdfguide.errors import InputError
from brdfguide.models import coat
from brdfguide.models.model import spelt
from brdfguide.physics import coat as optics
from brdfguide.physics import fresnel, hemisphere
from brdfguide.physics.geometry import Geometry, in_plane, rows

BASES = [law for law in models.every() if law.name != "coupled"]
every_base = pytest.mark.parametrize("base", BASES, ids=lambda base: base.name)
ANGLES = (0.0, 20.0, 40.0, 55.0, 65.0, 75.0, 82.0, 87.0, 89.9)


def under(base, values, n=1.5, depth=0.0):
    """The coated law's values: the base's, and the coat's."""
    return {**base.defaults(), **values, "coat_n": n, "coat_depth": depth}


@pytest.mark.parametrize("name", ["lambertian", "flakes", "ggx", "beckmann", "student-t", "ward-gmd"])
def test_agrees_with_the_formula_at_50_digits_with_seed_91(name):
    rng, base = np.random.default_rng(91), models.term(name)
    for _ in range(8):
        n, depth = mpf(rng.uniform(1.0001, 2.5)), mpf(rng.uniform(0, 2))
        angles = (rng.choice([rng.uniform(0, 89), 90 - 10 ** rng.uniform(-7, 0)]), 0.0, rng.uniform(0, 89), 170.0)
        values = {p.name: within(p, rng.uniform(0.2, 0.8)) for p in base.parameters}
        with workdps(50):
            exact = {key: mpf(float(value)) for key, value in values.items()}
            right = textbook.coated(textbook.ExactDirections(*angles), name, exact, n, depth)
        got = coat.over(base)(Geometry.from_degrees(*angles), **values, coat_n=float(n), coat_depth=float(depth))
        assert float(got) == pytest.approx(float(right), rel=2e-11, abs=1e-290), (angles, values)


@every_base
def test_light_and_detector_may_change_places_under_a_coat_with_seed_92(base):
    if "reciprocity" in base.breaks:
        return
    law, geom = coat.over(base), trial_directions(92)
    for values in parameter_sets(base, 92, 3):
        values = under(base, values, 1.62, 0.3)
        np.testing.assert_allclose(law(geom.swapped(), **values), law(geom, **values), rtol=1e-11)


@every_base
def test_a_coat_of_index_1_is_no_coat_with_seed_93(base):
    geom, law = trial_directions(93, highest=89.0), coat.over(base)
    for values in parameter_sets(base, 93, 2):
        bare = base(geom, **values)
        np.testing.assert_allclose(law(geom, **under(base, values, 1.0)), bare, rtol=1e-9, atol=1e-250)
        thin = law(geom, **under(base, values, 1.0001))
        flat = np.asarray(bare > 1e-3 * np.max(bare)) & (geom.cos_i > 0.4) & (geom.cos_r > 0.4)
        if base.is_body:
            np.testing.assert_allclose(thin[flat], bare[flat], rtol=1e-3, atol=1e-4)


@every_base
def test_no_more_comes_out_of_a_coat_than_went_in_with_seed_94(base):
    if {"energy", "rotation"} & base.breaks.keys():
        return
    for values in parameter_sets(base, 94, 1):
        values |= {p.name: min(p.high, 1.0) for p in base.parameters if p.linear or p.name == "albedo"}
        if any(p.linear and p.unit == "1/sr" for p in base.parameters):
            continue  # nothing bounds a lobe's height
        sent = hemisphere.dhr(partial(coat.over(base), **under(base, values)), (0.0, 60.0, 85.0, 89.9))[:, 0]
        entered = 1 - fresnel.fresnel(np.cos(np.radians([0.0, 60.0, 85.0, 89.9])), 1.5)
        # K is that of Lambert's law: a rough body sends less of its light back down
        assert np.all(sent <= entered * (1.03 if base.name == "eon" else 1.0) + 1e-3), values


@every_base
def test_gradient_under_a_coat_agrees_with_differences_with_seed_95(base):
    law, geom = coat.over(base), trial_directions(95, 100, highest=80.0)
    names = [p.name for p in law.parameters if p.name != "coat_n"]
    for values in parameter_sets(base, 95, 2):
        values = {p.name: within(p, 0.3 + 0.4 * np.mod(values[p.name] * 7, 1)) for p in base.parameters}
        values = under(base, values, 1.4, 0.2)
        slopes = law.gradient(geom, names, **values)
        for name, slope in slopes.items():
            step = 1e-4 * values[name]
            ends = [law(geom, **values | {name: values[name] + shift * step}) for shift in (-2, -1, 1, 2)]
            expected = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * step)
            size = np.abs(expected).max() + np.abs(law(geom, **values)).max() / (step * 1e9)
            whole = (ends[0] > 0) == (ends[3] > 0)
            np.testing.assert_allclose(
                np.where(whole, np.broadcast_to(slope, expected.shape), 0),
                np.where(whole, expected, 0),
                atol=1e-5 * size,
            )


@pytest.mark.parametrize(("n", "k"), [(1.33, 0.471949), (1.5, 0.596346), (1.7, 0.695612)])
def test_share_of_diffuse_light_that_the_coat_sends_down_again(n, k):
    assert float(optics.returned(n)) == pytest.approx(k, abs=5e-7)
    assert float(optics.returned(1.0)) == 0.0


@pytest.mark.parametrize("n", [1.0001, 1.33, 1.5, 2.4])
def test_a_white_body_and_the_mirror_return_everything(n):
    surface = models.get("coated:lambertian")
    values = surface.defaults() | {"coat.n": n, "lambertian.albedo": 1.0}
    sent = hemisphere.dhr(lambda geom: surface(geom, values), ANGLES, step=1 / 24)[:, 0]
    mirrored = surface.mirror(in_plane(np.array(ANGLES), 0.0), values)
    np.testing.assert_allclose(sent + mirrored, 1.0, atol=2e-9)


def test_a_coat_darkens_a_grey_body():
    law = models.term("coated:lambertian")
    sent = hemisphere.dhr(partial(law, albedo=0.5, coat_n=1.5), (0.0,))[0, 0]
    seen = next(each for each in law.derived if each.name == "seen_albedo")
    assert sent == pytest.approx(0.276, abs=5e-4)
    assert seen.of(albedo=0.5, coat_n=1.5, coat_depth=0.0) == pytest.approx(sent, rel=1e-9)


@pytest.mark.parametrize(
    ("tilt", "n", "growth"),
    [(0.05, 1.0, 14.2), (0.35, 1.0, 8.8), (0.05, 1.33, 1.35), (0.35, 1.33, 1.26), (0.05, 1.5, 1.02), (0.35, 1.5, 0.98)],
)
def test_growth_toward_grazing_disappears_under_a_coat(tilt, n, growth):
    law = models.term("coated:flakes")
    low, high = law(in_plane(np.array([10.0, 75.0]), np.array([10.0, 75.0])), tilt=tilt, coat_n=n)
    assert high / low == pytest.approx(growth, rel=0.01)


def test_flakes_look_wider_than_they_lie():
    law, theta = models.term("coated:flakes"), np.linspace(10, 40, 3001)
    lobe = law(in_plane(np.full(3001, 10.0), theta), tilt=0.05)
    half = theta[np.argmin(np.abs(lobe - lobe.max() / 2))] - 10
    bare = models.term("flakes")(in_plane(np.full(3001, 10.0), theta), tilt=0.05)
    assert half / (theta[np.argmin(np.abs(bare - bare.max() / 2))] - 10) == pytest.approx(1.5, abs=0.02)


def test_a_rough_metal_under_a_coat_keeps_its_mirror_where_it_has_one():
    surface = models.get("coated:he-torrance")
    values = surface.defaults() | {"he-torrance.sigma": 0.02, "he-torrance.slope": 0.05}
    values |= {"he-torrance.n": 1.5, "he-torrance.k": 3.0, "coat.depth": 0.3}
    geom = Geometry.from_degrees(40.0, 0.0, 40.0, 180.0)
    inside = np.degrees(np.arcsin(np.sin(np.radians(40)) / 1.5))
    below = models.term("he-torrance").mirror(
        Geometry.from_degrees(inside, 0.0, inside, 180.0, 0.55 / 1.5), sigma=0.02, slope=0.05, n=1.0, k=2.0, scale=1.0
    )
    own = fresnel.fresnel(geom.cos_i, 1.5)
    through = (1 - own) ** 2 * np.exp(-0.6 / np.cos(np.radians(inside)))
    assert float(surface.mirror(geom, values)) == pytest.approx(float(own + through * below), rel=1e-12)


def test_terms_under_one_coat_share_its_index_and_depth():
    surface = models.get("coated:lambertian+flakes:2")
    assert list(surface.parameters) == [
        "coat.n",
        "coat.depth",
        "coat.sigma",
        "lambertian.albedo",
        "flakes.1.flake",
        "flakes.1.tilt",
        "flakes.2.flake",
        "flakes.2.tilt",
    ]
    geom = rows(in_plane(np.array([30.0]), np.array([40.0])))
    parts = [models.term("coated:lambertian")(geom, coat_n=1.7), *2 * [models.term("coated:flakes")(geom, coat_n=1.7)]]
    np.testing.assert_allclose(surface(geom, {"coat.n": 1.7}), sum(parts), rtol=1e-14)


def test_a_lobe_on_top_is_the_coats_own_surface():
    surface = models.get("ggx+coated:lambertian")
    assert "ggx.n" not in surface.parameters and "coat.sigma" not in surface.parameters and not surface.has_mirror
    assert surface.free == ("coat.n",)
    geom = rows(in_plane(np.array([30.0]), np.array([40.0])))
    expected = models.term("ggx")(geom, n=1.7) + models.term("coated:lambertian")(geom, coat_n=1.7)
    np.testing.assert_allclose(surface(geom, {"coat.n": 1.7}), expected, rtol=1e-14)


@pytest.mark.parametrize(
    "expression",
    ["coated:ggx", "coated:lambertian+flakes:2", "ggx+coated:lambertian", "coated:flakes-beckmann", "lambertian+ggx:2"],
)
def test_an_expression_spells_what_it_was_read_from(expression):
    surface = models.get(expression)
    assert surface.name == expression == spelt(surface.terms) and models.get(surface.name).parameters.keys()


@pytest.mark.parametrize(
    ("expression", "sentence"),
    [
        ("coated:", "a coat over nothing; a law follows, as in coated:lambertian"),
        ("coated:coated:ggx", "coated: stands once, and all that follows lies under the coat"),
        ("ggx coated:lambertian", "coated: stands once"),
        ("coated:coupled", "coupled is a body under a coat already; coated:lambertian is the physical one"),
        ("coated:wrad", "did you mean ward"),
        ("coat", "no model called 'coat'"),
        ("coated:flakes:4", "lobes are counted from 1 to 3"),
    ],
)
def test_what_is_no_coat_is_refused_in_a_sentence(expression, sentence):
    with pytest.raises(InputError, match=sentence):
        models.get(expression)


def test_indices_in_turn_are_each_answered_as_on_fresh_directions():
    """What lies under the last few is kept; one for each channel is not that of another channel's."""
    geom, indices = rows(in_plane(30.0, np.array([-20.0, 30.0, 60.0]))), (1.5, 1.4, np.array([1.4, 1.5]), 1.6, 1.7)
    for n in (*indices, *reversed(indices), np.array([1.5, 1.4])):
        np.testing.assert_array_equal(optics.under(geom, n)[0].gate, optics.under(geom.afresh(), n)[0].gate)
        assert optics.under(geom, n)[0] is optics.under(geom, n)[0]


def test_what_enters_a_coat_is_one_minus_fresnel_to_the_last_digit():
    geom = rows(Geometry.from_degrees(ANGLES, 0.0, 30.0, 180.0))
    for n in (1.0, 1.0 + 1e-9, 1.33, 1.5, 4.0):
        inside, _ = optics.under(geom, n)
        through = fresnel.one_minus_fresnel(geom.cos_i, n) * fresnel.one_minus_fresnel(geom.cos_r, n)
        assert np.array_equal(inside.gate, through / (n * n))
