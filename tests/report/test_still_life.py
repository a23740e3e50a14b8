"""The preview's objects among lights: against sums over all directions, shade in closed form, and the command."""

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.face.functions import preview
from brdfguide.face.staging import row_of
from brdfguide.face.surfaces import named_surface
from brdfguide.physics.geometry import Geometry
from brdfguide.report.figures import spheres
from brdfguide.report.still_life import chequer, light_map, lit_by, standing
from brdfguide.report.still_life.composition import HALF_WIDTH, Stage

from ..patience import takes_less_than
from .test_render import run

SIZE = 96


def even(radiance: float = 1.0) -> light_map.Lighting:
    return light_map.Lighting(np.full((light_map.ROWS, 2 * light_map.ROWS, 3), radiance, np.float32))


def all_directions(points: int = 100_000) -> np.ndarray:
    k = np.arange(points)
    y = 1 - (2 * k + 1) / points
    turn = 2.399963229728653 * k
    return np.stack((np.sqrt(1 - y * y) * np.cos(turn), y, np.sqrt(1 - y * y) * np.sin(turn)), axis=-1)


def plain_sum(surface, stage: Stage, layer, place: int) -> np.ndarray:
    """Light that one pixel reflects, by an even sum over the sphere, each direction followed to floor or lights."""
    normal, view, point = layer.normal[place], -layer.ray[place], layer.points[place]
    i = all_directions()
    i = i[i @ normal > 0]
    x = np.cross(normal, [0.3, 0.9, 0.1])
    x /= np.linalg.norm(x)
    frame = np.stack((x, np.cross(normal, x), normal))
    f = surface.rgb(Geometry.from_vectors(i @ frame.T, np.broadcast_to(frame @ view, i.shape)))
    light = stage.toward(np.broadcast_to(point, i.shape), i, 0.005)
    return 4 * np.pi / 100_000 * np.sum(f * (i @ normal)[:, None] * light, axis=0)


@pytest.mark.parametrize(
    "words",
    ["lambertian", "lambertian+ggx alpha=0.15", "ward alpha=0.3", "ggx alpha=0.08 k=3", "retro alpha=0.1 rho=0.5"],
)
def test_what_a_pixel_reflects_agrees_with_a_plain_sum_over_all_directions(words):
    surface = named_surface(words)
    stage = lit_by.staged([surface], "studio", "side", "sphere", SIZE)
    picture = stage.picture(surface).reshape(-1, 3)
    (layer,) = stage.layers
    inside = np.flatnonzero(layer.covered == 1)
    for place in inside[np.linspace(0, len(inside) - 1, 7).astype(int)[1:-1]]:
        expected = plain_sum(surface, stage, layer, place)
        np.testing.assert_allclose(picture[layer.rows[place]], expected, rtol=0.05, atol=0.012)


def test_a_picture_among_surroundings_takes_less_than_three_seconds_of_work():
    assert takes_less_than(3, lambda: preview("porcelain", size=512).png)


def test_a_mirror_shows_what_stands_in_the_mirror_direction():
    surface = named_surface("mirror n=1.5")
    stage = lit_by.staged([surface], "room", "front", "sphere", SIZE)
    (layer,) = stage.layers
    place = np.argmin(np.sum((layer.normal + layer.ray) ** 2, axis=1))  # it faces the camera
    ray, normal = layer.ray[[place]], layer.normal[[place]]
    to = ray - 2 * np.sum(ray * normal) * normal
    expected = 0.04 * stage.toward(layer.points[[place]], to, 4 * HALF_WIDTH / SIZE)[0]
    np.testing.assert_allclose(stage.picture(surface).reshape(-1, 3)[layer.rows[place]], expected, rtol=0.01)


def test_a_ball_under_an_even_sky_shades_the_floor_as_the_closed_form_says():
    """A sphere that touches a plane takes r³/(d² + r²)^{3/2} of an even sky from a point at distance d."""
    floor = chequer.floor_under([standing.Thing("sphere")], even())
    d = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    np.testing.assert_allclose(floor.open_to(d, 0 * d), 1 - (d**2 + 1) ** -1.5, atol=0.03)
    np.testing.assert_allclose(floor.white, 1, rtol=2e-3)
    np.testing.assert_allclose(floor.open_to(9.0, 9.0), 1, atol=1e-3)


def test_the_grey_card_sends_18_percent_of_what_a_white_one_would():
    floor = chequer.floor_under([], even(2.0))
    x, z = chequer.CARD_MIDDLE
    np.testing.assert_allclose(floor.radiance(np.array([x]), np.array([z]), 0.01, 0.01), 0.18 * 2.0, rtol=2e-3)


@pytest.mark.parametrize("width", [0, 3, 7])
def test_a_blurred_lamp_keeps_its_light_and_is_as_wide_as_the_map_says(width):
    lamp = np.array([0.6, 0.48, 0.64])
    there = np.clip((light_map.map_directions() @ lamp - np.cos(0.02)) * 1e5, 0, 1)
    found = light_map.Lighting(np.repeat(there[..., None], 3, axis=-1).astype(np.float32))
    to = all_directions(200_000)
    light = found.seen(to, np.full(len(to), light_map.WIDTHS[width] ** 2, np.float32))[:, 0].astype(float)
    sent = np.sum(found.seen(to, np.zeros(len(to), np.float32))[:, 0])
    np.testing.assert_allclose(light.sum(), sent, rtol=0.05)
    texel = np.pi / light_map.ROWS_OF_WIDTHS[width]
    expected = np.linalg.norm([light_map.WIDTHS[width], 0.02 / 2, texel / 2])  # a disc's, and a tent's over a texel
    apart = np.arccos(np.clip(to @ lamp, -1, 1))
    light[apart > 6 * expected] = 0
    own = np.sum(light * apart**2) / light.sum() / 2  # along each of two axes
    np.testing.assert_allclose(np.sqrt(own), expected, rtol=0.06)


@pytest.mark.parametrize("name", standing.HITS)
def test_rays_meet_every_object_on_its_surface_and_normals_face_them(name):
    thing = standing.Thing(name)
    layer = Stage([thing], even(), SIZE).layers[0]
    assert layer.covered.max() == 1 and len(layer.rows) > 0.1 * SIZE**2
    np.testing.assert_allclose(np.linalg.norm(layer.normal, axis=1), 1, rtol=1e-9)
    assert np.all(np.sum(layer.normal * layer.ray, axis=1) <= 1e-12)
    np.testing.assert_allclose(np.sum(layer.normal * layer.across, axis=1), 0, atol=1e-9)
    if name == "knob":
        on = layer.covered == 1
        rho = np.hypot(layer.points[on, 0], layer.points[on, 2])
        assert np.quantile(np.abs(standing._distance_knob(rho, layer.points[on, 1])), 0.9) < 1e-3


def test_a_white_surface_in_an_even_light_vanishes():
    """The furnace: all weights of a lobe's cells sum to its albedo."""
    stage = Stage([standing.Thing("sphere")], even(), 64, has_floor=False)
    picture = stage.picture(named_surface("lambertian albedo=1"))
    np.testing.assert_allclose(picture, 1, rtol=0.02)


def test_an_equirectangular_picture_lights_as_what_it_was_made_of(tmp_path):
    openexr = pytest.importorskip("OpenEXR")

    def written(name, pixels):
        channels = {"RGB": openexr.Channel(np.ascontiguousarray(pixels.astype(np.float32)))}
        openexr.File({"type": openexr.scanlineimage}, channels).write(str(tmp_path / name))
        return str(tmp_path / name)

    surface = named_surface("lambertian+ggx alpha=0.1")
    own = lit_by.staged([surface], "studio", "side", "sphere", 64)
    path = written("studio.exr", own.around.sharp)
    other = lit_by.staged([surface], path, "side", "sphere", 64)
    np.testing.assert_allclose(other.around.sharp, own.around.sharp, rtol=1e-3)
    assert other.floor is None and preview(surface, size=64, around=path).pixels.std() > 10
    with pytest.raises(InputError, match="100 x 80 pixels; wanted twice as wide as high"):
        lit_by.staged([surface], written("odd.exr", np.ones((80, 100, 3))), "side", "sphere", 64)
    with pytest.raises(InputError, match="no light comes from above"):
        lit_by.staged([surface], written("black.exr", np.zeros((64, 128, 3))), "side", "sphere", 64)
    with pytest.raises(InputError, match="holds its own light"):
        preview(surface, size=64, around=path, light="back")


def test_the_middle_of_an_equirectangular_picture_stands_behind_the_object():
    pixels = np.zeros((96, 192, 3))
    pixels[40:56, 90:102] = 1
    found = light_map.Lighting(light_map.resampled(pixels).astype(np.float32))
    np.testing.assert_allclose(found.seen(np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]), np.zeros(2))[:, 0], [1, 0])
    pixels = np.zeros((96, 192, 3))
    pixels[40:56, 140:148] = 1  # three quarters along: to the right of a viewer who faces the middle
    found = light_map.Lighting(light_map.resampled(pixels).astype(np.float32))
    np.testing.assert_allclose(found.seen(np.array([[1.0, 0.0, 0.0]]), np.zeros(1))[:, 0], [1])


def test_a_row_changes_one_number_in_even_steps():
    made = row_of(named_surface("ggx"), "alpha=0.1..0.9")
    assert [each.values["ggx.alpha"] for each in made] == pytest.approx([0.1, 0.3, 0.5, 0.7, 0.9])
    assert [each.name for each in row_of(named_surface("ggx"), "alpha=0.2..0.4/3")] == [
        "alpha 0.2",
        "alpha 0.3",
        "alpha 0.4",
    ]


@pytest.mark.parametrize(
    "asked, sentence",
    [
        ("alpha", "wanted NAME=LOW..HIGH"),
        ("alpha=1..2..3", "wanted NAME=LOW..HIGH"),
        ("alpha=0.1..0.2/99", "2 to 12 steps"),
        ("alfa=0.1..0.2", "no parameter"),
        ("alpha=0.1..7", "alpha"),
    ],
)
def test_a_row_that_cannot_be_is_refused(asked, sentence):
    with pytest.raises(InputError, match=sentence.replace("..", r"\.\.")):
        row_of(named_surface("ggx"), asked)


def test_a_difference_counts_steps_that_are_just_noticeable():
    one = np.full((2, 2, 3), 0.5)
    steps = spheres.noticeable_steps(one, one * 1.02**3)
    np.testing.assert_allclose(steps, 3, rtol=0.02)
    assert np.all(spheres.difference_picture(np.zeros((2, 2))) == 1)
    np.testing.assert_allclose(spheres.difference_picture(np.full((1, 1), 99.0))[0, 0], spheres.MORE)
    steps = np.linspace(-30, 30, 13)[None]
    clear = spheres.clear_difference(steps)
    over_white = clear[..., :3] * clear[..., 3:] + 1 - clear[..., 3:]
    np.testing.assert_allclose(over_white, spheres.difference_picture(steps))


def test_several_surfaces_make_a_sheet_without_differences_and_the_same_bytes_twice(tmp_path):
    words = ("ward", "lambertian", "chrome", "--size", "64", "--object", "knob", "-o")
    first, second = run(*words, "a.png", cwd=tmp_path), run(*words, "b.png", cwd=tmp_path)
    assert first.returncode == second.returncode == 0, first.stderr
    picture = (tmp_path / "a.png").read_bytes()
    assert picture == (tmp_path / "b.png").read_bytes()
    assert int.from_bytes(picture[16:20], "big") == 3 * 64 + 4 * 12
    assert first.stderr == "a.png: ward | lambertian | chrome\n"


@pytest.mark.parametrize(
    "words, sentence",
    [
        (("ward", "--env", "beach"), "no surroundings called 'beach'"),
        (("ward", "--object", "teapot"), "no object called 'teapot'"),
        (("ward", "--env", "sky", "--object", "knob"), "under the sky stand a sphere and a bent sheet"),
        (("ward", "phong", "-c", "ggx"), "--compare: wanted one surface before it, found 2"),
        (("ward", "phong", "--row", "alpha=.1...2"), "--row: wanted one surface before it, found 2"),
        (("ward", "--env", "none.exr"), "none.exr: there is no such file"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_a_sentence(words, sentence, tmp_path):
    done = run(*words, cwd=tmp_path)
    assert done.returncode == 2 and sentence in done.stderr and "Traceback" not in done.stderr
