"""Surfaces on a sphere: mirrors, grain, colours, and what twelve of them cost."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models import looks
from brdfguide.models.surface import Surface
from brdfguide.physics import seen
from brdfguide.physics.aperture import Instrument, solid_angle_of

from ..patience import takes_less_than


def surface(name: str, **values) -> Surface:
    return Surface.of_colours(models.get(name), {key.replace("__", "."): value for key, value in values.items()})


GREY, LIGHTER = surface("lambertian", lambertian__albedo=0.5), surface("lambertian", lambertian__albedo=0.6)


def test_two_matt_surfaces_by_hand():
    assert looks.seen_difference(GREY, LIGHTER) == pytest.approx(5.05, rel=1e-3)


def test_grey_and_coloured_surfaces_compare():
    coloured = surface("lambertian", lambertian__albedo=[0.45, 0.40, 0.35])
    assert looks.seen_difference(surface("lambertian", lambertian__albedo=0.4), coloured) == pytest.approx(
        2.555, rel=1e-3
    )


def test_a_mirror_shows_a_lamp():
    glass, rough = surface("lambertian+mirror"), surface("lambertian")
    assert 5 < looks.seen_difference(glass, rough) < 15
    assert looks.seen_difference(glass, glass) == 0
    wide, narrow = (looks.seen_difference(glass, rough, solid_angle_of(angle)) for angle in (4.0, 0.5))
    assert narrow < wide, "the image of a small lamp covers less of the sphere"


def test_a_narrow_lobe_is_the_nearer_to_a_mirror_the_narrower_it_is():
    found = [
        looks.seen_difference(surface("mirror"), surface("ggx", ggx__alpha=alpha)) for alpha in (0.003, 0.01, 0.03, 0.1)
    ]
    assert np.all(np.diff(found) > 0)


def test_the_cells_follow_the_rim_of_the_lamp():
    """Against eight times as many half vectors and four times as many differences."""
    glass, matt, lit = surface("lambertian+mirror"), surface("lambertian"), []
    for cells in (seen.CELLS, (360, 48, 48)):
        sphere = seen.sphere(cells)
        lightness = [looks.lightness_shown(each, Instrument(sphere.geom)) for each in (glass, matt)]
        lit.append(seen.apart(*lightness, sphere.weights))
    assert lit[0] == pytest.approx(lit[1], rel=0.01)


def brushed(**values) -> Surface:
    return surface("stam", **{"stam__ratio": 4.0, "stam__sigma": 0.5, **values})


def test_turning_both_brushed_surfaces_changes_nothing_and_turning_one_shows():
    one, other = brushed(), brushed(stam__slope=0.15)
    turned = [brushed(stam__axis=30.0 * np.pi / 180), brushed(stam__slope=0.15, stam__axis=30.0 * np.pi / 180)]
    assert looks.seen_difference(*turned) == pytest.approx(looks.seen_difference(one, other), rel=1e-6)
    assert looks.seen_difference(one, turned[0]) > looks.seen_difference(one, brushed(stam__axis=0.05)) > 0.5


def test_without_grain_the_sphere_is_not_turned():
    assert looks.turns(brushed()) and not looks.turns(brushed(stam__ratio=1.0)) and not looks.turns(GREY)


def test_twelve_candidates_take_less_than_30_ms():
    names = [
        "ward",
        "ggx",
        "beckmann",
        "he-torrance",
        "cook-torrance",
        "blinn",
        "phong",
        "lafortune",
        "ward-gmd",
        "gtr",
    ]
    surfaces = [surface(f"lambertian+{name}", lambertian__albedo=[0.3, 0.2, 0.1]) for name in names]
    surfaces += [surface("oren-nayar+ggx"), GREY]
    found = looks.looks(surfaces).from_first()
    assert len(found) == 12 and found[0] == 0
    assert takes_less_than(0.030, lambda: looks.looks(surfaces).from_first())
