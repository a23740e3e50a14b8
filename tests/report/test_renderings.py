"""The guide's renderings: meshes that close, and what the guide says of each, on the pixels of small renderings."""

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.errors import InputError
from brdfguide.report.figures import rendered
from brdfguide.report.path_traced import meshes, renderings, tracer

from ..conftest import ROOT


@pytest.mark.parametrize("mesh", [*meshes.teapot(), meshes.car_body()], ids=["belly", "spout", "handle", "car"])
def test_bodies_are_finite_and_their_normals_are_those_of_the_surface(mesh):
    assert np.isfinite(mesh.corners).all()
    lengths = np.linalg.norm(mesh.normals, axis=1)
    assert np.mean(np.abs(lengths - 1) < 1e-6) > 0.97
    a, b, c = (mesh.corners[mesh.triangles[:, place]] for place in range(3))
    flat = np.cross(b - a, c - a)
    size = np.linalg.norm(flat, axis=1)
    kept = (size > 1e-5) & (lengths[mesh.triangles].min(axis=1) > 0.99)
    agree = np.abs(np.sum(flat * mesh.normals[mesh.triangles[:, 0]], axis=1)[kept] / size[kept])
    assert np.quantile(agree, 0.05) > 0.9


def test_a_mesh_is_written_as_a_ply_that_says_its_size(tmp_path):
    mesh = meshes.lathe(lambda t: 1 - t, lambda t: t, turns=8, rows=5)
    mesh.write(tmp_path / "cone.ply")
    head, _, body = (tmp_path / "cone.ply").read_bytes().partition(b"end_header\n")
    assert b"element vertex 40\n" in head and b"element face 56\n" in head
    assert len(body) == 40 * 24 + 56 * 13


def test_without_mitsuba_a_rendering_is_refused_in_a_sentence(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mitsuba", None)
    with pytest.raises(InputError, match=r"needs Mitsuba.*brdfguide\[render\]"):
        renderings.rendering(10, None, 16, 1)


def claims(number: int, size: int, samples: int) -> dict[str, float]:
    pytest.importorskip("mitsuba")
    needed = renderings.NEEDS.get(number)
    measurement = formats.read(ROOT / "examples" / needed) if needed else None
    made = renderings.rendering(number, measurement, size, samples)
    assert all(np.isfinite(panel).all() and panel.min() >= 0 for _, panel in made.panels)
    assert rendered.rendered_figure(number, made, "here").axes
    return dict(made.claims)


def test_a_cameras_rays_meet_what_mitsuba_sees():
    """The middle of a picture of even size lies between its four middle pixels; half its width is half the angle."""
    rays = tracer.Camera((0.0, 3.0, 4.0), (0.0, 0.0, 0.0), 40).rays((4, 6))
    np.testing.assert_allclose(rays[1:3, 2:4].mean(axis=(0, 1)), (0.0, -0.6, -0.8), atol=1e-12)
    np.testing.assert_allclose(
        rays[..., 0], np.tan(np.radians(20)) * np.array([-5, -3, -1, 1, 3, 5]) / 6 + 0 * rays[..., 0]
    )
    assert np.all(np.diff(rays[..., 1], axis=0) < 0)


@pytest.mark.validate
def test_rough_aluminium_mirrors_the_posts_toward_grazing_alone():
    """Figure 3: "some mirror reflection is suggested in the right-hand rendering at the larger viewing angle"."""
    found = claims(3, 64, 16)
    at_50, at_80 = (value for words, value in found.items() if "mirror image" in words)
    assert abs(at_50) < 0.1 and 0.3 < at_80 < 1


@pytest.mark.validate
def test_paper_differs_near_grazing_where_from_above_nothing_is_seen():
    """Figure 8: "near-normal viewing shows virtually no difference, near grazing a dramatic difference"."""
    found = claims(8, 64, 16)
    above, grazing = (value for words, value in found.items() if "Lafortune over Phong" in words)
    assert abs(above) < 2 and grazing > 6


@pytest.mark.validate
def test_nearly_smooth_metal_blurs_the_horizon_in_front_and_not_at_the_edge():
    """Figure 10, and its highlight, where a mirror shows a few clipped pixels."""
    found = claims(10, 110, 16)
    assert found["pixels brighter than 1.5 times white, He-Torrance"] > 20 * max(
        1.0, found["pixels brighter than 1.5 times white, ideal mirror"]
    )
    front, edge = (f"sharpness of the horizon {where}, " for where in ("on the front", "at the edge"))
    assert found[front + "He-Torrance"] < 0.7 * found[front + "ideal mirror"]
    assert found[edge + "He-Torrance"] > 0.8 * found[edge + "ideal mirror"]


@pytest.mark.validate
def test_phong_is_brighter_near_the_normal_and_much_darker_toward_grazing():
    """Figure 6."""
    near, grazing = claims(6, 64, 16).values()
    assert 1.05 < near < 1.4 and grazing < 0.75


@pytest.mark.validate
def test_a_clear_coat_shines_at_the_edges_of_a_body():
    """Figure 12, paint and coat both from our exports."""
    facing, edge = claims(12, 64, 16).values()
    assert 0.01 < facing < 0.04 and edge > 5 * facing
