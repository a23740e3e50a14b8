"""What Radiance's `rtrace` sees of a Klems matrix is what we read of it: sides, azimuths and values."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from brdfguide.data import formats

from .test_programs import klems_xml

pyradiance = pytest.importorskip("pyradiance", reason="pip install pyradiance: it reads Klems' matrices")
pytestmark = [pytest.mark.validate, pytest.mark.filterwarnings("ignore")]
SOURCE_DEG, POWER = 1.0, 1000.0
SCENE = """void light lamp 0 0 3 {power} {power} {power}
lamp source sun 0 0 4 {x:.9g} {y:.9g} {z:.9g} {size}
void BSDF it 6 0 it.xml 0 1 0 . 0 0
it polygon sample 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0
"""


def vector(theta: float, phi: float) -> np.ndarray:
    theta, phi = np.radians(theta), np.radians(phi)
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


def traced(folder: Path, light: np.ndarray, view: np.ndarray) -> float:
    """BRDF [1/sr] that `rtrace` sees on the side of the surface that is the back in WINDOW's words."""
    home = Path(pyradiance.__file__).parent
    environment = dict(os.environ, PATH=f"{home / 'bin'}:{os.environ['PATH']}", RAYPATH=f".:{home / 'lib'}")
    where = dict(zip("xyz", light, strict=True))
    (folder / "it.rad").write_text(SCENE.format(power=POWER, size=SOURCE_DEG, **where))
    octree = subprocess.run(["oconv", "it.rad"], cwd=folder, env=environment, capture_output=True, check=True)
    (folder / "it.oct").write_bytes(octree.stdout)
    ray = " ".join(f"{each:.12g}" for each in (*(5 * view), *-view)).encode()
    said = subprocess.run(["rtrace", "-h", "-ab", "0", "-dj", "0", "-ss", "0", "it.oct"],
                          cwd=folder, env=environment, input=ray, capture_output=True, check=True)  # fmt: skip
    solid_angle = 2 * np.pi * (1 - np.cos(np.radians(SOURCE_DEG / 2)))
    return float(said.stdout.split()[0]) / (POWER * solid_angle * light[2])


def test_rtrace_sees_what_we_read(tmp_path):
    path = tmp_path / "it.xml"
    path.write_text(klems_xml("Full", "Reflection Back"))
    measurement = formats.read(path)
    geom = measurement.geom
    phi_i, phi_r = np.radians(geom.phi_i_deg), np.radians(geom.phi_i_deg + geom.phi_deg)
    for theta_i, light, theta_r, view in ((40, 0, 40, 180), (40, 0, 40, 0), (40, 90, 60, 315), (20, 45, 60, 225)):
        to_light, to_view = vector(theta_i, light), vector(theta_r, view)
        apart = (geom.sin_i * np.cos(phi_i) - to_light[0]) ** 2 + (geom.sin_i * np.sin(phi_i) - to_light[1]) ** 2
        apart += (geom.sin_r * np.cos(phi_r) - to_view[0]) ** 2 + (geom.sin_r * np.sin(phi_r) - to_view[1]) ** 2
        ours = measurement.brdf[int(np.argmin(apart)), 0]
        assert traced(tmp_path, to_light, to_view) == pytest.approx(ours, rel=0.01)
