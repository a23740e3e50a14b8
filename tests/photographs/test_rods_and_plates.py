"""A rod, whose strip scans one azimuth, and a plate under a moved lamp: both give the surface that was rendered."""

import re

import numpy as np
import pytest

from brdfguide import fit
from brdfguide.data import formats
from brdfguide.errors import InputError
from brdfguide.photographs.readers import read_picture
from brdfguide.photographs.rod_outline import find_rod
from brdfguide.photographs.solids import Pinhole, plate_points, points

from .pictures import Matt, Paint, describe, lamp_at, write_float_tiff

ROD = Pinhole((60.0, 40.0), 50.0, 24.0)
ROD_HEAD = "camera: {distance: 24}\nreference_albedo: 0.9\noutline: {centre_px: [60, 40], radius_px: 50}"
SIZE = (60, 40)
PLATE = {"distance": 500.0, "angle_deg": 45.0, "width": 60.0}
PLATE_HEAD = "camera: {distance_mm: 500, angle_deg: 45, width_mm: 60}\nreference_albedo: 0.9\npatch_px: [26, 16, 8, 8]"
pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(autouse=True)
def needs_floats():
    pytest.importorskip("cv2", reason="float TIFFs need the extra photo")


def shaded(surface, seen, lamp):
    """Light (..., 3) of points; 0 where they are not lit or missed."""
    at = seen.directions(lamp)
    with np.errstate(all="ignore"):
        cos_h = 1 / np.sqrt(1 + at.tan2_h)
        lit = (at.cos_i > 0) & (at.cos_r > 0)
        light = surface.brdf(at.cos_i, at.cos_r, cos_h, at.cos_d) * (np.pi * seen.irradiance(lamp))[..., None]
    return np.where(lit[..., None], light, 0.0)


def rod_shots(folder, lamps, **more):
    y, x = np.mgrid[0:80, 0:120] + 0.5
    with np.errstate(invalid="ignore"):
        seen = points("cylinder", ROD, x, y)
    rows = []
    for number, lamp in enumerate(lamps):
        for name, surface in (("paint", Paint()), ("white", Matt())):
            write_float_tiff(folder / f"{name}{number}.tif", shaded(surface, seen, lamp))
        rows.append((f"paint{number}.tif", f"white{number}.tif", lamp))
    return describe(folder, rows, head=ROD_HEAD, solid="cylinder", **more)


def plate_shots(folder, lamps):
    y, x = np.mgrid[0 : SIZE[1], 0 : SIZE[0]] + 0.5
    seen = plate_points(size=SIZE, x_px=x, y_px=y, **PLATE)
    rows = []
    for number, lamp in enumerate(lamps):
        for name, surface in (("paint", Paint(0.1)), ("white", Matt())):
            write_float_tiff(folder / f"{name}{number}.tif", shaded(surface, seen, lamp))
        rows.append((f"paint{number}.tif", f"white{number}.tif", lamp))
    return describe(folder, rows, head=PLATE_HEAD, solid="flat")


def test_a_rod_gives_the_paint_that_is_wrapped_round_it(tmp_path):
    path = rod_shots(tmp_path, [lamp_at(40), lamp_at(100)])
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["ggx.alpha"]["value"] == pytest.approx(0.15, rel=0.02)
    assert row["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.02)
    assert row["lambertian.albedo"]["value"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)


def test_a_plate_under_eighteen_lamps_gives_its_paint(tmp_path):
    angles = np.radians(np.linspace(-70, 78, 18))  # off the normal; the camera is at -45, the mirror direction at 45
    lamps = [600 * np.array([0.0, np.sin(angle), np.cos(angle)]) for angle in angles]
    path = plate_shots(tmp_path, lamps)
    measurement = formats.read(path)
    assert len(measurement.brdf) >= 18 * 16  # one frame is a scan already
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["ggx.alpha"]["value"] == pytest.approx(0.1, rel=0.02)
    assert row["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.02)
    assert row["lambertian.albedo"]["value"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)


def test_a_plate_is_seen_where_the_camera_looks():
    seen = plate_points(500.0, 45.0, 60.0, (61, 41), np.array([30.5, 30.5]), np.array([20.5, 10.5]))
    assert seen.at[0] == pytest.approx([0, 0, 0], abs=1e-9)
    assert seen.at[1, 1] > 0 and seen.at[1, 2] == pytest.approx(0, abs=1e-9)  # higher in the picture is farther away
    assert np.degrees(np.arccos(seen.cos_r[0])) == pytest.approx(45)


def test_a_plate_needs_its_patch_and_its_lamps(tmp_path):
    path = plate_shots(tmp_path, [np.array([0.0, 300.0, 500.0])])
    text = path.read_text()
    for old, new, sentence in (
        ("patch_px: [26, 16, 8, 8]\n", "", "needs patch_px"),
        ("[26, 16, 8, 8]", "[56, 16, 8, 8]", "lies outside"),
        ("lamp: [0.0, 300.0, 500.0]", "lamp: reference", "no shading to find the lamp from"),
        ("width_mm: 60", "radius_mm: 3", "needs distance_mm"),
    ):
        path.write_text(text.replace(old, new))
        with pytest.raises(InputError, match=sentence):
            formats.read(path)


@pytest.mark.parametrize("lamp", ["stated", "reference"])
def test_the_outline_of_a_rod_is_found(tmp_path, lamp):
    path = rod_shots(tmp_path, [lamp_at(40), lamp_at(100)])
    text = path.read_text().replace("outline: {centre_px: [60, 40], radius_px: 50}\n", "")
    if lamp == "reference":
        text = re.sub(r"lamp: \[[^]]*\]", "lamp: reference", text)
    path.write_text(text)
    measurement = formats.read(path)
    numbers = next(dict(each.numbers) for each in measurement.findings if each.code == "outline-found")
    assert numbers["x_px"] == pytest.approx(60, abs=0.1) and numbers["radius_px"] == pytest.approx(50, abs=0.1)
    if lamp == "stated":
        row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
        assert row["ggx.alpha"]["value"] == pytest.approx(0.15, rel=0.02)
        assert row["lambertian.albedo"]["value"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)


@pytest.mark.parametrize("phases", [(40,), (20,), (100,), (-30, 70), (60, 120)])
def test_the_width_of_a_rod_is_told_by_one_lit_edge_and_the_shadows_edge(tmp_path, phases):
    lamps = [lamp_at(abs(phase), 0 if phase > 0 else 180) for phase in phases]
    rod_shots(tmp_path, lamps)
    pictures = [read_picture(tmp_path / f"white{number}.tif", None) for number in range(len(lamps))]
    found, _, leans = find_rod(pictures, lamps, ROD.distance)
    assert found.x == pytest.approx(60, abs=0.1) and found.radius == pytest.approx(50, abs=0.1) and leans < 0.1


def test_a_rod_of_which_a_crescent_is_lit_from_who_knows_where_is_not_found(tmp_path):
    rod_shots(tmp_path, [lamp_at(140)])
    with pytest.raises(InputError, match="no upright matt rod whose width the light tells"):
        find_rod([read_picture(tmp_path / "white0.tif", None)], [None], ROD.distance)


def test_a_stated_outline_that_the_shading_contradicts_is_said(tmp_path):
    path = rod_shots(tmp_path, [lamp_at(40), lamp_at(100)])
    assert "outline-differs" not in {each.code for each in formats.read(path).findings}
    path.write_text(path.read_text().replace("radius_px: 50", "radius_px: 53"))
    assert "outline-differs" in {each.code for each in formats.read(path).findings}
