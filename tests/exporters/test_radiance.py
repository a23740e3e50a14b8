"""Radiance compiles every material and `rtrace` sees our values."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from brdfguide import exporters
from brdfguide.exporters import _target_models
from brdfguide.exporters.exporter import Refused
from brdfguide.printable import identifier

from .conftest import EVERY_LAW, NAMES, directions, vectors

pyradiance = pytest.importorskip("pyradiance", reason="pip install pyradiance: the reader of these exports")
pytestmark = [pytest.mark.validate, pytest.mark.filterwarnings("ignore")]
SOURCE_DEG = 0.001  # so small that Radiance does not widen the lobe by it
SCENE = """
void light lamp 0 0 3 {power} {power} {power}
lamp source sun 0 0 4 {x:.12g} {y:.12g} {z:.12g} {size}
{name} polygon sample 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
"""


def traced(made, name: str, light, view, folder: Path) -> np.ndarray:
    """BRDF (3,) that `rtrace` sees in one pair of directions."""
    home = Path(pyradiance.__file__).parent
    environment = dict(os.environ, PATH=f"{home / 'bin'}:{os.environ['PATH']}", RAYPATH=f".:{home / 'lib'}")
    for file, content in made.beside.items():
        (folder / file).write_text(content)
    scene = made.content + SCENE.format(power=1e8, x=light[0], y=light[1], z=light[2], size=SOURCE_DEG, name=name)
    (folder / "scene.rad").write_text(scene)
    octree = subprocess.run(["oconv", "scene.rad"], cwd=folder, env=environment, capture_output=True)
    assert octree.returncode == 0, octree.stderr.decode()
    (folder / "scene.oct").write_bytes(octree.stdout)
    ray = " ".join(f"{each:.12g}" for each in (*view, *-view))
    run = subprocess.run(
        ["rtrace", "-h", "-ab", "0", "-lr", "0", "-ov", "scene.oct"],
        cwd=folder,
        env=environment,
        input=ray.encode(),
        capture_output=True,
    )
    assert run.returncode == 0 and not run.stderr, run.stderr.decode()
    solid_angle = 2 * np.pi * 2 * np.sin(np.radians(SOURCE_DEG / 4)) ** 2
    return np.array([float(each) for each in run.stdout.split()]) / (1e8 * solid_angle * light[2])


@pytest.mark.parametrize("target", ["radiance", "radiance-cal"])
@pytest.mark.parametrize("name", NAMES)
def test_rtrace_sees_the_stated_law(target, name, of, tmp_path):
    few = 12 if len(of(name)) == 1 else 3
    geom = directions(few, seed=5)
    for surface in of(name):
        try:
            made = exporters.export(target, surface, stem="m")
        except Refused:
            continue
        if target == "radiance":
            written = {"specular": 0.0, "roughness": 0.1, **made.statement.written}
            wanted = np.broadcast_to(
                _target_models.radiance("void metal" in made.content).brdf(geom, **written), (few, 3)
            )
        else:
            wanted = surface.rgb(geom)
        got = np.array(
            [
                traced(made, identifier(surface.name), light, view, tmp_path)
                for light, view in zip(*vectors(geom), strict=True)
            ]
        )
        np.testing.assert_allclose(got, wanted, rtol=2e-5, atol=1e-6, err_msg=surface.name)


def test_mirror_of_a_function_material_reflects_by_the_law(tmp_path):
    """A ray toward the mirror image of the lamp sees rho times its radiance."""
    surface = EVERY_LAW["polish"]
    made = exporters.export("radiance-cal", surface, stem="m")
    for theta in (20.0, 70.0):
        angle = np.radians(theta)
        light, view = np.array([-np.sin(angle), 0, np.cos(angle)]), np.array([np.sin(angle), 0, np.cos(angle)])
        from brdfguide.physics.geometry import Geometry

        rho = surface.mirror_rgb(Geometry.from_degrees(theta, 0.0, theta, 180.0))[0]
        global SOURCE_DEG
        SOURCE_DEG = 0.5
        try:
            seen = traced(made, identifier(surface.name), light, view, tmp_path)
            solid_angle = 2 * np.pi * 2 * np.sin(np.radians(SOURCE_DEG / 4)) ** 2
        finally:
            SOURCE_DEG = 0.001
        np.testing.assert_allclose(seen * solid_angle * light[2], rho, rtol=0.01)
