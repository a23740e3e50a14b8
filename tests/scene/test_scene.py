"""Scenes: what the YAML says, which pixels are drawn from it, what they weigh, and what a display makes of them."""

from dataclasses import replace
from math import cos, log, pi, radians

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.numerics import sphere
from brdfguide.physics import colour, display
from brdfguide.scene import radiance, scene

from ..conftest import ROOT

SCENES = sorted((ROOT / "examples" / "scenes").glob("*.yaml"))
GLOSSY = 0.05  # width of a narrow lobe [rad]


def white(geom):
    return np.full(geom.shape, 1 / pi)


def mean(q, values):
    return float(q.weights @ values[:, 0])


# --- the file ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_every_worked_scene_is_read_and_drawn(path):
    q = radiance.sample(scene.read_scene(path), 1000, 0, GLOSSY)
    assert len(q) > 250
    assert q.weights.sum() == pytest.approx(1)


def test_five_scenes_are_worked():
    assert len(SCENES) == 5


def test_the_page_of_the_scenes_tells_every_key():
    page = (ROOT / "examples" / "scenes" / "README.md").read_text()
    assert not [field.name for field in scene.FIELDS if f"| `{field.name}` |" not in page]


def test_default_scene_leaves_no_angle_out():
    box = radiance.sample(scene.DEFAULT, 20000, 0, GLOSSY).box()
    for name in ("theta_i_deg", "theta_r_deg"):
        assert box[name][0] < 1 and box[name][1] > 89
    assert box["phi_deg"][0] < 1 and box["phi_deg"][1] > 179
    assert (scene.DEFAULT.tolerance.worst, scene.DEFAULT.tolerance.p95) == (1, 1)


@pytest.mark.parametrize("colour, worst, p95", [("grey", 20, 9), ("rgb", 30, 15), ("spectral", 30, 15)])
def test_a_picture_may_keep_its_look_alone(colour, worst, p95):
    found = scene.parse_scene(f"colour: {colour}\ntolerance: look")
    assert (found.tolerance.worst, found.tolerance.p95) == (worst, p95)
    assert "keeps its look side by side but not in a cut or a flicker test" in found.describe()
    assert "look" not in scene.parse_scene(f"colour: {colour}").describe()


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("shape: plain", "'shape' is 'plain'; did you mean 'plane'?"),
        ("shap: plane", "no key called 'shap'; did you mean 'shape'"),
        ("camera: {theta_deg: [40, 10]}", "'camera.theta_deg' runs from 40 down to 10"),
        ("camera: {theta_deg: [10, 100]}\nshape: plane", "a surface of shape plane is seen and lit from above"),
        ("camera: {theta_deg: [0, 20, 30]}", "has 3 numbers; wanted 1 or 2"),
        ("camera: {theta_deg: 200}", "'camera.theta_deg' is 200"),
        ("shape: sphere\nin_plane: true", "a sphere shows normals in every plane"),
        ("lights: []", "'lights' is empty"),
        ("lights: [{irradiance: 0}]", "'lights.0.irradiance' is 0"),
        ("directions: [{theta_i_deg: 10}]", "needs 'theta_r_deg'"),
        ("directions: [{theta_i_deg: 10, theta_r_deg: 20}]\nshape: plane", "exclude each other"),
        ("display: {white: -1}", "'display.white' is -1"),
        ("tolerance: {worst: 1}", "did you mean 'worst_jnd'"),
        ("tolerance: loook", "'tolerance' is 'loook'; did you mean 'look'?"),
        ("tolerance: 3", "it is one of: look, or lines of `key: value` with worst_jnd, p95_jnd"),
        ("tolerance: [1, 2]", "'tolerance' is a list; wanted lines"),
        ("in_plane: yes", "wanted true or false"),
        ("colour: gray", "'colour' is 'gray'; did you mean 'grey'?"),
    ],
)
def test_a_wrong_scene_gets_a_sentence_with_its_place(text, sentence):
    with pytest.raises(InputError, match=r"<text>:\d+:\d+: ") as caught:
        scene.parse_scene(text)
    assert sentence in str(caught.value)


def test_every_mistake_is_told_at_once():
    with pytest.raises(InputError) as caught:
        scene.parse_scene("shape: plain\npixels: many\ncamera: {theta_deg: [9, 1]}")
    assert len(str(caught.value).splitlines()) == 3


# --- the pixels -------------------------------------------------------------------------------------


def test_white_plane_under_a_cap_of_light_has_the_mean_cosine_seed_1():
    s = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [0, 35]}, lights: [{theta_deg: [0, 40], radius_deg: 10}]}"
    )
    q = radiance.sample(s, 20000, 1, GLOSSY)
    # even in solid angle; a disc of 10° sees a mean cosine of its own
    exact = (1 + cos(radians(40))) / 2 * (1 + cos(radians(10))) / 2
    assert mean(q, q.radiance(white)) == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize("phase", [20, 60, 120])
def test_white_sphere_has_lamberts_phase_function_seed_2(phase):
    s = scene.parse_scene(
        f"{{shape: sphere, camera: {{theta_deg: 0}}, lights: [{{theta_deg: {phase}, radius_deg: 0.1}}]}}"
    )
    q = radiance.sample(s, 20000, 2, GLOSSY)
    a = radians(phase)
    lambert = (2 / 3) * (np.sin(a) + (pi - a) * np.cos(a)) / pi  # mean over the disc, of which (1 + cos a)/2 is lit
    assert mean(q, q.radiance(white)) == pytest.approx(lambert / ((1 + cos(a)) / 2), rel=0.02)


def test_mirror_sphere_sends_light_evenly_all_round_seed_3():
    """A perfect mirror sphere has a mean radiance E/4π over its disc at any phase angle."""
    for phase in (30, 90, 140):
        s = scene.parse_scene(
            f"{{shape: sphere, camera: {{theta_deg: 0}}, lights: [{{theta_deg: {phase}, radius_deg: 0.27}}]}}"
        )
        q = radiance.sample(s, 40000, 3, GLOSSY)
        shine = mean(q, q.mirror_radiance(lambda geom: np.ones(geom.shape)))
        assert shine * (1 + cos(radians(phase))) / 2 == pytest.approx(0.25, rel=0.05)


def test_cylinder_seen_from_the_side_shows_a_cosine_seed_4():
    s = scene.parse_scene(
        "{shape: cylinder, camera: {theta_deg: 90, phi_deg: 0}, lights: [{theta_deg: 90, phi_deg: 0}]}"
    )
    q = radiance.sample(s, 20000, 4, GLOSSY)
    assert mean(q, q.radiance(white)) == pytest.approx(pi / 4, rel=0.01)  # mean of √(1 - x²) over the width


def test_box_shows_each_face_by_its_projected_area_seed_5():
    s = scene.parse_scene("{shape: box, camera: {theta_deg: 60, phi_deg: 0}, lights: [{theta_deg: 0}]}")
    q = radiance.sample(s, 4000, 5, GLOSSY)
    assert np.unique(np.round(q.to_camera[:, 2], 9)) == pytest.approx([0.5])  # the top alone is lit
    s = scene.parse_scene("{shape: box, camera: {theta_deg: 60, phi_deg: 0}, lights: [{theta_deg: 45, phi_deg: 0}]}")
    q = radiance.sample(s, 4000, 5, GLOSSY)
    top = q.weights[np.isclose(q.to_camera[:, 2], 0.5)].sum()
    assert top == pytest.approx(0.5 / (0.5 + np.sin(radians(60))), abs=0.02)


def test_uniform_surroundings_are_as_bright_as_a_white_surface_seed_6():
    s = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [0, 80]}, lights: [{theta_deg: 30, irradiance: 1}], environment: 3}"
    )
    q = radiance.sample(s, 500, 6, GLOSSY)
    around = q.radiance(white) - 0.25 * cos(radians(30))
    assert around == pytest.approx(0.75, rel=0.03)
    assert np.mean(around) == pytest.approx(0.75, rel=0.01)


def test_weights_are_those_of_the_picture_not_of_the_draw_seed_7():
    """The share of directions within 5° of the mirror, drawn with and without the defensive half."""
    s = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [20, 60]}, lights: [{theta_deg: [20, 60], phi_deg: [0, 90]}]}"
    )
    shares = []
    for width in (0.03, 0.3):
        q = radiance.sample(s, 100_000, 7, width)
        near = np.sum((q.to_lights[:, 0] - q.to_camera * [-1, -1, 1]) ** 2, axis=1) < radians(5) ** 2
        shares.append(q.weights[near].sum())
        assert near.mean() > 5 * shares[-1] or width == 0.3
    assert shares[0] == pytest.approx(shares[1], rel=0.06)


def test_spike_of_a_hundredth_of_a_degree_is_found_seed_8():
    """T-P6: of a light of 0.01° radius, which 1500 even draws would meet once in thousands of times."""
    s = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [10, 60]}, lights: [{theta_deg: [10, 60], radius_deg: 0.01}]}"
    )
    q = radiance.sample(s, 1500, 8, GLOSSY)
    image = q.mirrored[1] > 0
    assert image.sum() > 50
    assert q.weights[image].sum() < 1e-6


def test_list_of_directions_is_taken_as_it_stands():
    s = scene.parse_scene(
        "directions: [{theta_i_deg: 10, theta_r_deg: 50, phi_deg: 170, weight: 3}, {theta_i_deg: 20, theta_r_deg: 20}]"
    )
    q = radiance.sample(s, 1500, 0, GLOSSY)
    assert q.weights == pytest.approx([0.75, 0.25])
    assert q.angles_deg(0) == pytest.approx((10, 50, 170))


def test_in_plane_scene_stays_in_the_plane():
    s = scene.parse_scene(
        "{shape: plane, camera: {theta_deg: [10, 60]}, lights: [{theta_deg: [10, 60]}], in_plane: true}"
    )
    q = radiance.sample(s, 2000, 0, GLOSSY)
    assert q.centres.off_plane_deg.max() < 1e-6
    assert {0.0, 180.0} == set(np.round(np.abs(q.centres.phi_deg), 6))


def test_same_seed_same_pixels():
    first, again, other = (radiance.sample(scene.DEFAULT, 500, seed, GLOSSY) for seed in (4, 4, 5))
    assert np.array_equal(first.to_camera, again.to_camera)
    assert not np.array_equal(first.to_camera, other.to_camera)


def test_scaled_scene_stays_above_the_horizon():
    s = scene.parse_scene("{shape: plane, camera: {theta_deg: [70, 86]}, lights: [{theta_deg: [60, 85]}]}").scaled(1.1)
    assert s.camera.theta_deg == pytest.approx((77, 89.9))


def test_draws_integrate_to_their_density_seed_9():
    rng = np.random.default_rng(9)
    for width in (0.01, 0.3, 3.0):
        axis = np.array([0.6, 0.0, 0.8])
        v = sphere.near(axis[None], width, *rng.random((2, 20000)))
        inside = sphere.dot(v, axis) > 1 - width**2 if width < 1 else sphere.dot(v, axis) > 0
        # probability of the cap by the density, in closed form
        k = 1 / width**2
        edge = width**2 if width < 1 else 1.0
        assert inside.mean() == pytest.approx(np.expm1(-k * edge) / np.expm1(-2 * k), abs=0.012)
    assert np.linalg.norm(v, axis=1) == pytest.approx(1)


# --- the display ------------------------------------------------------------------------------------


def test_one_weber_fraction_is_one_jnd():
    d = display.Display(floor=1e-9)
    assert d.difference(np.array([[0.5]]), np.array([[0.51]])) == pytest.approx([1.0], rel=1e-6)


def test_what_both_clip_does_not_differ_and_black_is_not_infinite():
    d = display.Display()
    assert d.difference(np.array([[2.0]]), np.array([[900.0]])) == pytest.approx([0])
    assert d.difference(np.array([[0.0]]), np.array([[0.002]])) == pytest.approx([log(2) / log(1.02)])


def test_delta_e_itp_of_known_greys_and_colours():
    """ΔE_ITP of 100 against 101 cd/m² by ITU-R BT.2100 and BT.2124, and that a change of hue counts where luminance
    stays.
    """
    d = display.Display(floor=1e-12)

    def pq(y):
        return (
            (0.8359375 + 18.8515625 * (y / 1e4) ** 0.1593017578125) / (1 + 18.6875 * (y / 1e4) ** 0.1593017578125)
        ) ** 78.84375

    grey = d.difference(np.array([[1.0, 1.0, 1.0]]), np.array([[1.01, 1.01, 1.01]]))
    assert grey == pytest.approx([720 * (pq(101) - pq(100))], rel=1e-3)
    redder = np.array([[0.5 + 0.05 / 0.2126, 0.5 - 0.05 / 0.7152, 0.5]])
    assert redder @ colour.LUMINANCE == pytest.approx([0.5], abs=1e-12)
    assert d.difference(np.array([[0.5, 0.5, 0.5]]), redder)[0] > 5


def test_white_is_white_whatever_the_channels():
    for wavelengths in (np.linspace(0.4, 0.7, 31), np.array([0.63, 0.53, 0.46]), np.array([0.55])):
        for kind in ("grey", "spectral"):
            weights = display.colour_weights(wavelengths, len(wavelengths), kind)
            assert np.ones(len(wavelengths)) @ weights == pytest.approx(1, abs=2e-3)


def test_codes_count_the_steps_of_the_display():
    d = display.Display(white=1.0)
    assert d.codes(np.array([[1.0]]), np.array([[0.0]])) == pytest.approx([255])


def test_pixel_of_a_sphere_turns_with_the_number_of_pixels():
    few, many = replace(scene.DEFAULT, shape="sphere", pixels=1e4), replace(scene.DEFAULT, shape="sphere", pixels=1e6)
    assert few.pixel_normal == pytest.approx(10 * many.pixel_normal)
    assert replace(few, pixel_normal_deg=0.5).pixel_normal == pytest.approx(radians(0.5))
    assert scene.DEFAULT.pixel_normal == 0


def test_every_key_is_in_the_readme():
    text = (ROOT / "examples" / "scenes" / "README.md").read_text()

    def names(fields):
        for each in fields:
            yield each.name
            yield from names(each.fields)

    missing = {name for name in names(scene.FIELDS) if f"`{name}`" not in text}
    assert not missing


def test_defaults_are_those_of_the_readme():
    d = scene.DEFAULT.display
    assert (d.exposure, d.white, d.floor, d.weber, d.bits, d.gamma, d.peak_cd_m2) == (1, 1.5, 0.002, 0.02, 8, 2.2, 100)
    assert (scene.DEFAULT.shape, scene.DEFAULT.pixels, scene.DEFAULT.colour, scene.DEFAULT.environment) == (
        "arbitrary",
        1e6,
        "spectral",
        0,
    )
