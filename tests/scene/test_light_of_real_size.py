"""Lamps are integrated over their discs, surroundings over all directions, each against a plain sum of many points."""

from math import cos, pi

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.models.surface import Surface
from brdfguide.numerics import sphere
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.scene import lamps, prune, radiance, scene
from brdfguide.scene.difference import lobe_width

PIXELS = 24


def ggx(alpha):
    return Surface(models.get("ggx"), {"ggx.alpha": alpha})


def through_the_disc(surface, to_light, to_camera, radius, points=20_000):
    """Mean of f cos θi over a disc, by points that share it evenly."""
    found = []
    for light, camera in zip(to_light, to_camera, strict=True):
        each = sphere.cap(light[None], radius, points)[0]
        geom = rows(Geometry.from_vectors(each, np.broadcast_to(camera, each.shape)))
        found.append(np.mean(surface.brdf(geom)[:, 0] * np.maximum(each[:, 2], 0.0)))
    return np.array(found)


@pytest.mark.parametrize("ratio", [0.04, 0.3, 0.69, 1.0, 2.0, 4.0])
def test_a_disc_as_wide_as_part_of_a_lobe_is_integrated_seed_3(ratio):
    """A point in place of a disc of 0.69 widths is 20 % too bright in the middle of a GGX lobe: 1 + 0.69² (√2 - 1)."""
    rng = np.random.default_rng(3)
    surface = ggx(0.05)
    width = lobe_width(surface)
    radius = ratio * width
    camera = sphere.from_angles(np.cos(rng.uniform(0.1, 0.9, PIXELS)), rng.uniform(0, 6, PIXELS))
    light = sphere.near(camera * lamps.FLIP, np.full(PIXELS, radius + width), rng.random(PIXELS), rng.random(PIXELS))
    directions, shares, pixel = lamps.lit_points(light, camera, radius, width)
    values = surface.brdf(rows(Geometry.from_vectors(directions, camera[pixel])))[:, 0] * directions[:, 2] * shares
    found = np.bincount(pixel, values, PIXELS)
    assert found == pytest.approx(through_the_disc(surface, light, camera, radius), rel=0.03)
    assert np.mean(found) == pytest.approx(np.mean(through_the_disc(surface, light, camera, radius)), rel=0.004)


def test_a_soft_box_much_wider_than_a_lobe_has_no_holes_seed_4():
    """A mirror-like lobe well within a disc sees all of it or nothing, whatever the points."""
    surface = ggx(0.01)
    width = lobe_width(surface)
    camera = sphere.from_angles(np.cos(np.linspace(0.1, 0.9, PIXELS)), np.linspace(0, 6, PIXELS))
    light = sphere.near(camera * lamps.FLIP, np.full(PIXELS, 0.03), *np.random.default_rng(4).random((2, PIXELS)))
    directions, shares, pixel = lamps.lit_points(light, camera, 0.35, width)
    values = surface.brdf(rows(Geometry.from_vectors(directions, camera[pixel])))[:, 0] * directions[:, 2] * shares
    expected = through_the_disc(surface, light, camera, 0.35, 40_000)
    assert np.bincount(pixel, values, PIXELS) == pytest.approx(expected, rel=0.05)
    assert np.bincount(pixel, values, PIXELS).mean() == pytest.approx(expected.mean(), rel=0.02)  # its points are few


def test_shares_of_a_disc_add_up_to_one_and_hold_the_mean_cosine():
    camera = sphere.from_angles(np.array([cos(0.4)]), np.array([0.3]))
    for radius in (1e-4, 0.01, 0.05, 0.1):
        for away in (0.0, 0.2, 0.8):
            light = sphere.from_angles(np.array([cos(0.4 - away / 2)]), np.array([pi + 0.3 + away]))
            directions, shares, _ = lamps.lit_points(light, camera, radius, 0.3)
            assert shares.sum() == pytest.approx(1, rel=1e-6)
            # a cap of radius a has a mean cosine of (1 + cos a)/2 times that of its axis
            mean = light[0, 2] * (1 + cos(radius)) / 2
            assert directions[:, 2] @ shares == pytest.approx(mean, rel=2e-3)


# --- light from all around ----------------------------------------------------------------------------


def by_many_half_vectors(surface, q, pixel, points=60_000):
    """∫ f L cos θi dω of one pixel, by half vectors on a spiral in even steps of ln tan of their tilt."""
    camera = q.to_camera[pixel]
    place = (np.arange(points) + 0.5) / points
    low, high = np.log(1e-3 * q.width), np.log(60.0)
    t = np.exp(low + (high - low) * place)
    phi = sphere.GOLDEN_ANGLE * np.arange(points)
    cosine = 1 / np.sqrt(1 + t * t)
    half = np.stack([t * cosine * np.cos(phi), t * cosine * np.sin(phi), cosine], axis=1)
    along = half @ camera
    light = 2 * along[:, None] * half - camera
    good = (along > 0) & (light[:, 2] > 0)
    light = light[good]
    geom = rows(Geometry.from_vectors(light, np.broadcast_to(camera, light.shape)))
    incident = q.scene.around.radiance(light @ q.to_world[pixel].T)
    area = 4 * along * t * t * cosine**3 * (high - low) * 2 * pi / points
    return np.sum(surface.brdf(geom)[:, 0] * light[:, 2] * incident * area[good]) * q.unit


@pytest.mark.parametrize("kind", ["studio", "overcast", "room"])
@pytest.mark.parametrize("alpha", [0.3, 0.03])
def test_surroundings_are_integrated_seed_1(kind, alpha):
    surface = ggx(alpha)
    where = scene.parse_scene(f"{{shape: sphere, camera: {{theta_deg: 90, phi_deg: 0}}, surroundings: {kind}}}")
    q = radiance.sample(where, 120, 1, lobe_width(surface))
    found = q.radiance(surface.brdf)[:, 0]
    some = np.argsort(q.to_camera[:, 2])[5::20]
    expected = np.array([by_many_half_vectors(surface, q, pixel) for pixel in some])
    assert found[some] == pytest.approx(expected, rel=0.08)
    assert np.sqrt(np.mean((found[some] / expected - 1) ** 2)) < 0.04


def test_even_surroundings_are_the_environment():
    number = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [0, 80]}, lights: [{theta_deg: 30}], environment: 3}"
    )
    word = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [0, 80]}, lights: [{theta_deg: 30}], "
        "surroundings: {kind: uniform, irradiance: 3}}"
    )
    one, other = (radiance.sample(each, 300, 2, 0.1).radiance(ggx(0.2).brdf) for each in (number, word))
    assert one == pytest.approx(other)


def test_a_table_under_an_overcast_sky_gets_all_of_its_light():
    where = scene.parse_scene("{shape: plane, camera: {theta_deg: [0, 60]}, surroundings: overcast}")
    q = radiance.sample(where, 200, 5, 0.3)
    assert not where.lights and q.unit == pytest.approx(pi)
    assert q.radiance(lambda geom: np.full(geom.shape, 1 / pi)) == pytest.approx(1, rel=0.03)


def test_a_mirror_shows_the_surroundings():
    where = scene.parse_scene("{shape: sphere, camera: {theta_deg: 90, phi_deg: 0}, surroundings: studio}")
    q = radiance.sample(where, 4000, 6, 0.01)
    shown = q.mirror_radiance(lambda geom: np.ones(geom.shape))[:, 0]
    assert shown.max() == pytest.approx(where.around.brightest * q.unit, rel=0.1)
    # of a sphere's image each direction fills as much as of all directions: their mean is the mean radiance
    everywhere = sphere.from_angles(np.linspace(-1, 1, 201)[:-1, None] + 0.005, np.linspace(0, 2 * pi, 401)[None, :-1])
    assert q.weights @ shown == pytest.approx(where.around.radiance(everywhere).mean() * q.unit, rel=0.05)


def test_a_glazed_plate_keeps_its_mirror_where_there_is_something_to_reflect():
    glazed = Surface(models.get("lambertian+mirror"), {"lambertian.albedo": 0.7})
    plate = "{{shape: plane, camera: {{theta_deg: [20, 60]}}, colour: grey, {}}}"
    spot = "lights: [{theta_deg: [0, 5], radius_deg: 1}]"
    dark, room = (scene.parse_scene(plate.format(each)) for each in (spot, spot + ", surroundings: room"))
    assert "mirror" in {str(each) for each in prune.prune(glazed, dark, timing=False).ablation.out}
    assert not prune.prune(glazed, room, timing=False).ablation.out


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("surroundings: studoi", "'surroundings' is 'studoi'; did you mean 'studio'?"),
        ("surroundings: {irradiance: 2}", "'surroundings' needs 'kind'"),
        ("surroundings: room\nenvironment: 1", "'environment' and 'surroundings' exclude each other"),
        (
            "surroundings: {kind: room, up: {theta_deg: [0, 90]}}",
            "'surroundings.up.theta_deg' is a range; upward is one direction",
        ),
    ],
)
def test_wrong_surroundings_get_a_sentence_with_their_place(text, sentence):
    with pytest.raises(InputError, match=r"<text>:\d+:\d+: ") as caught:
        scene.parse_scene(text)
    assert sentence in str(caught.value)


def test_surroundings_are_told():
    found = scene.parse_scene("{shape: plane, surroundings: {kind: room, irradiance: 2, up: {theta_deg: 90}}}")
    assert "; around it a room with a window, 2; " in found.describe()
    assert "light" not in found.describe().partition("around it")[0]
