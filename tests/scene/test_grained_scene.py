"""A grain in a scene: seen from where the camera stands, left out only where no turn shows it, under light from all
around as a sum by force has it."""

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.models.surface import Surface
from brdfguide.numerics import sphere
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.scene import radiance, scene
from brdfguide.scene.difference import Picture, lobe_width
from brdfguide.scene.features import Ablation, Feature, Features
from brdfguide.scene.prune import prune

ROUND_VIEW = "camera: {theta_deg: [20, 70], phi_deg: [0, 360]}"


def brushed(axis_deg=0.0, wide=0.3, narrow=0.1):
    return Surface.named("ggx-aniso", {"alpha_x": wide, "alpha_y": narrow, "axis": axis_deg, "n": 1.0, "k": 4.0})


def quadrature(text, surface, size=300, seed=1, turns=True):
    return radiance.sample(scene.parse_scene(text), size, seed, lobe_width(surface), turns)


def without_grain(text, surface, size=1500):
    """The difference that it makes to leave the grain out."""
    picture = Picture(Features(surface), quadrature(text, surface, size))
    ablation = Ablation(frozenset({Feature("ggx-aniso", "anisotropy")}))
    return picture.ablation_errors(ablation, picture.refitted(ablation))


def by_force(surface, q, pixel, count=60_000):
    """∫ f L cos θi dω of one pixel by a sum over directions even in projected solid angle."""
    place = np.arange(count) + 0.5
    light = sphere.from_angles(np.sqrt(1 - place / count), sphere.GOLDEN_ANGLE * place)
    f = surface.brdf(rows(Geometry.from_vectors(light, np.broadcast_to(q.to_camera[pixel], light.shape))))
    world = light if q.to_world is None else light @ q.to_world[pixel].T
    return np.pi * np.mean(f[:, 0] * q.around.surroundings.radiance(world))


@pytest.mark.parametrize("axis", [0.0, 35.0])
@pytest.mark.parametrize(
    ("text", "within"),
    [
        (f"shape: plane\nsurroundings: studio\n{ROUND_VIEW}", 0.05),
        ("shape: sphere\nsurroundings: overcast\ncamera: {theta_deg: 60, phi_deg: 0}", 0.03),
        (f"shape: plane\nsurroundings: uniform\n{ROUND_VIEW}", 0.02),
    ],
)
def test_light_from_all_around_is_that_of_a_sum_by_force(text, within, axis):
    surface = brushed(axis)
    q = quadrature(text, surface, size=60)
    got = q.around.reflected(surface.brdf)[:, 0]
    picked = np.arange(0, len(q), len(q) // 10)
    wanted = np.array([by_force(surface, q, pixel) for pixel in picked])
    assert np.sqrt(np.mean((got[picked] / wanted - 1) ** 2)) < within


def test_a_law_without_a_grain_sees_the_same_light_either_way():
    text, surface = f"shape: plane\nsurroundings: overcast\n{ROUND_VIEW}", Surface.named("ggx", {"alpha": 0.2})
    even, turned = (quadrature(text, surface, turns=turns).radiance(surface.brdf)[:, 0] for turns in (False, True))
    np.testing.assert_allclose(turned, even, rtol=0.03)


def test_a_sphere_has_its_grain_round_its_axis():
    """Azimuth 0 lies along the meridians, toward the axis, so that a streak does where `axis` is 0."""
    q = quadrature("shape: sphere\nsurroundings: overcast\ncamera: {theta_deg: 60, phi_deg: 0}", brushed())
    np.testing.assert_allclose(q.to_world[:, 2, 1], 0.0, atol=1e-12)  # grooves are level
    assert np.all(q.to_world[:, 2, 0] >= 0)
    turned = quadrature("shape: sphere\nsurroundings: overcast\nturn_deg: 90", brushed())
    np.testing.assert_allclose(turned.to_world[:, 2, 0], 0.0, atol=1e-12)


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0])
def test_turn_deg_turns_the_sample_as_its_axis_would(turn):
    text = "shape: plane\ncamera: {theta_deg: 40, phi_deg: 0}\nlights: [{theta_deg: [20, 60], phi_deg: [150, 210]}]"
    turned = quadrature(f"{text}\nturn_deg: {turn}", brushed(20.0)).radiance(brushed(20.0).brdf)
    plain = quadrature(text, brushed(20.0)).radiance(brushed(20.0 + turn).brdf)
    np.testing.assert_allclose(turned, plain, rtol=1e-9)


def test_listed_directions_are_looked_at_under_every_turn_unless_one_is_said():
    text = "directions: [{theta_i_deg: 30, theta_r_deg: 45}, {theta_i_deg: 50, theta_r_deg: 50, weight: 3}]"
    q = quadrature(text, brushed())
    azimuths = np.degrees(np.arctan2(q.to_camera[:, 1], q.to_camera[:, 0])) % 360
    assert len(q) == 2 * 24 and len(np.unique(azimuths.round(6))) == 24
    assert q.weights[:24].sum() == pytest.approx(0.25)
    assert len(quadrature(f"{text}\nturn_deg: 10", brushed())) == 2
    assert len(quadrature(text, Surface.named("ggx", {}), turns=False)) == 2


def test_the_grain_may_go_where_neither_camera_nor_light_turns():
    """Held, a round lobe shows the same but for its height, which is refitted."""
    held = "shape: plane\ncamera: {theta_deg: 30, phi_deg: 0}\nlights: [{theta_deg: 45, phi_deg: 180}]"
    dim = "display: {exposure: 0.05}"
    assert without_grain(f"{held}\n{dim}", brushed()).visible < 0.5
    assert without_grain(f"{held}\nturn_deg: [0, 360]\n{dim}", brushed()).visible > 20
    assert without_grain(f"{held.replace('180', '[0, 360]')}\n{dim}", brushed()).visible > 20


def test_the_narrowest_width_is_that_along_the_grain():
    along = lobe_width(brushed(0.0)), lobe_width(brushed(90.0)), lobe_width(brushed(45.0))
    np.testing.assert_allclose(along, lobe_width(Surface.named("ggx", {"alpha": 0.1, "n": 1.0, "k": 4.0})), rtol=0.2)


def test_bounds_of_a_turn_ascend():
    with pytest.raises(InputError, match="'turn_deg' runs from 90 to 10; the smaller comes first"):
        scene.parse_scene("turn_deg: [90, 10]")
    assert "turned 0..180° in its plane" in scene.parse_scene("turn_deg: [0, 180]").describe()


def test_surroundings_alone_are_light_enough_to_leave_parts_out():
    alone = scene.parse_scene("shape: sphere\nsurroundings: uniform")
    found = prune(Surface.named("lambertian+ggx", {}), alone, timing=False)
    assert set(found.box_deg) == {"theta_r_deg"} and found.fresh.within(found.scene.tolerance)
