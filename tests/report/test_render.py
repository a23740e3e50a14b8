"""The preview's light: against independent sums, the report's Figures 6 and 10 by numbers, and the command."""

import os
import subprocess
import sys

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import formats
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.fitting import fit
from brdfguide.physics.colour import luminance
from brdfguide.physics.geometry import Geometry
from brdfguide.report import render

from ..conftest import ROOT
from ..patience import takes_less_than

STEEL = {"he-torrance.sigma": 0.08, "he-torrance.slope": 0.05, "he-torrance.n": 2.9, "he-torrance.k": 3.1}


def surface(name, **values):
    return ColouredSurface(models.get(name), {**models.get(name).defaults(), **values})


def world_sum(each: ColouredSurface, normal, points=400_000):
    """Sky and ground reflected toward the camera, by an even sum over the sphere of directions around the object."""
    k = np.arange(points)
    y = 1 - (2 * k + 1) / points
    turn = 2.399963229728653 * k
    i = np.stack((np.sqrt(1 - y * y) * np.cos(turn), y, np.sqrt(1 - y * y) * np.sin(turn)), axis=-1)
    cos = i @ normal
    up = cos > 0
    x = np.cross(normal, [0.3, 0.9, 0.1])
    x /= np.linalg.norm(x)
    frame = np.stack((x, np.cross(normal, x), normal))
    f = each.rgb(Geometry.from_vectors(i[up] @ frame.T, np.broadcast_to(frame @ [0.0, 0.0, 1.0], (up.sum(), 3))))
    return 4 * np.pi / points * np.sum(f * cos[up, None] * render.sky(i[up, 1]), axis=0)


@pytest.mark.parametrize(
    "name, values",
    [
        ("lambertian", {}),
        ("lambertian+ggx", {"ggx.alpha": 0.15}),
        ("ward", {"ward.alpha": 0.3}),
        ("oren-nayar", {}),
        ("lambertian+retro", {"retro.rho": 0.5, "retro.alpha": 0.05}),
    ],
)
def test_reflected_sky_agrees_with_a_plain_sum_over_all_directions(name, values):
    each = surface(name, **values)
    normals = np.array([[0.05, 0.1, 1.0], [0.6, -0.2, 1.0], [-0.9, 0.9, 0.5], [1.0, 0.02, 0.35]])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    expected = np.array([world_sum(each, normal) for normal in normals])
    np.testing.assert_allclose(render.around_of(each, normals), expected, rtol=0.015)


def test_a_lobe_about_the_light_sends_back_its_share_of_an_even_light_at_every_angle(monkeypatch):
    for name in ("ZENITH", "HORIZON", "GROUND"):
        monkeypatch.setattr(render, name, np.ones(3))
    each = surface("retro", **{"retro.rho": 0.5, "retro.alpha": 0.005})
    angles = np.radians([1.0, 20.0, 45.0, 70.0])
    normals = np.stack((np.sin(angles), 0 * angles, np.cos(angles)), axis=-1)
    np.testing.assert_allclose(render.around_of(each, normals), 0.5, rtol=0.01)


def test_a_mirror_shows_the_world_and_the_whole_sun():
    each, sun = surface("mirror", **{"mirror.n": 1.5}), render.sun_direction("side")
    half = sun + [0, 0, 1]
    half /= np.linalg.norm(half)
    normals = np.array([[0.0, 0.05, 1.0], half])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    view = render.mirror_of(each, normals, sun)
    plain = normals[0] * 2 * normals[0, 2] - [0, 0, 1]
    np.testing.assert_allclose(view[0], 0.04 * render.sky(plain[1]), rtol=1e-3)
    assert view[1].max() > 100


def test_sun_on_a_white_diffuser_is_its_irradiance_over_pi():
    sun = render.sun_direction("front")
    view = render.sun_of(surface("lambertian", **{"lambertian.albedo": 1.0}), np.array([sun, -sun]) * [1, 1, 1], sun)
    np.testing.assert_allclose(view[0], render.SUN / np.pi, rtol=1e-3)
    assert np.all(view[1] == 0)


def test_horizon_in_slightly_rough_metal_is_blurred_in_front_and_sharp_at_the_rim():
    """Figure 10: the step across the horizon within half a degree, as a share of the whole, grows toward grazing."""
    each = surface("he-torrance", **STEEL)
    shares = []
    for theta in np.radians([5.0, 40.0, 70.0, 82.0]):
        y = np.array([0.9, 0.004, -0.004, -0.9]) * np.cos(theta)
        normals = np.stack((np.full(4, np.sin(theta)), y, np.sqrt(np.cos(theta) ** 2 - y**2)), axis=-1)
        light = render.around_of(each, normals) + render.mirror_of(each, normals, render.sun_direction("side"))
        near = luminance(light[1] - light[2])
        shares.append(near / luminance(render.HORIZON - render.GROUND))
    assert shares == sorted(shares) and shares[0] < 0.15 and shares[-1] > 0.5


def test_highlight_of_a_slightly_rough_metal_is_larger_than_the_sun_in_a_mirror():
    rough = luminance(render.render(surface("he-torrance", **STEEL), 128))
    mirror = luminance(render.render(surface("mirror", **{"mirror.n": 2.9, "mirror.k": 3.1}), 128))
    assert np.count_nonzero(rough > 2) > 20 * max(1, np.count_nonzero(mirror > 2))


def test_phong_is_a_little_brighter_than_lafortune_near_normal_and_much_darker_toward_grazing():
    """Figure 6, from rendered pixels: both fitted to the rough plastic."""
    measurement = formats.read(ROOT / "examples" / "rough_plastic.csv")
    light = {}
    for name in ("lambertian+phong", "lambertian+lafortune"):
        found = fit.fit(models.get(name), measurement)
        light[name] = luminance(render.render(ColouredSurface(found.model, found.values), 128, "back"))
    view = render.view(128)
    sphere = (view.covered == 1) & (np.arange(128)[:, None] < 0.66 * 128)
    theta = np.degrees(np.arccos(view.normal[..., 2]))

    def ratio(low, high):
        return np.divide(*(each[sphere & (theta >= low) & (theta < high)].mean() for each in light.values()))

    assert 1.02 < ratio(0, 20) < 1.3
    assert ratio(75, 85) < 0.6


def test_a_preview_takes_less_than_five_seconds_of_work():
    assert takes_less_than(5, lambda: render.render(surface("lambertian+he-torrance", **STEEL), 512))


def run(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "brdfguide", "preview", *words],
        cwd=cwd,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


def test_two_surfaces_stand_side_by_side_with_their_difference(tmp_path):
    words = ("ward ward.alpha=0.1", "--compare", "lambertian", "--size", "64", "-o")
    first, second = run(*words, "a.png", cwd=tmp_path), run(*words, "b.png", cwd=tmp_path)
    assert first.returncode == second.returncode == 0, first.stderr
    picture = (tmp_path / "a.png").read_bytes()
    assert picture == (tmp_path / "b.png").read_bytes()
    width = int.from_bytes(picture[16:20], "big")
    assert width == 3 * 64 + 4 * 12
    assert first.stdout == "" and first.stderr == "a.png: ward | lambertian\n"


@pytest.mark.parametrize(
    "words, sentence",
    [
        (("wrad",), "no model or material called 'wrad'; did you mean ward?"),
        (("ward ward.alhpa=1",), "no parameter of ward called 'ward.alhpa'"),
        (("ward", "--light", "below"), "no place for the light called 'below'"),
        (("ward", "--size", "9"), "--size 9: a picture has 64 to 2048 pixels"),
        (("ward", "-o", "a.jpg"), "a.jpg: a preview is a .png or .exr"),
        (("nowhere.json",), "nowhere.json: there is no such file"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_a_sentence(words, sentence, tmp_path):
    done = run(*words, cwd=tmp_path)
    assert done.returncode == 2 and sentence in done.stderr and "Traceback" not in done.stderr
