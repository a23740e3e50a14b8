"""From pictures to values: exact where nothing is wrong, and the parameters of the surface that was rendered."""

import numpy as np
import pytest

from brdfguide import fit
from brdfguide.data import formats
from brdfguide.photographs import extract, plan
from brdfguide.photographs.lamp import find_lamp, phase_deg
from brdfguide.photographs.solids import FAR, Pinhole, points

from .pictures import DISTANCE, Paint, describe, lamp_at, srgb, write_codes


def values(path, surface):
    """Extracted values over those of the surface's own formula."""
    found = extract.extract(plan.planned(path.read_text(), str(path)))
    at = found.directions
    cos_h = 1 / np.sqrt(1 + at.tan2_h)
    return found, found.f / surface.brdf(at.cos_i, at.cos_r, cos_h, at.cos_d)


def test_every_cell_has_the_brdf_that_was_rendered_there(shots):
    found, ratio = values(shots(), Paint())
    assert len(ratio) > 800
    assert np.abs(np.log(ratio)).max() < 0.05 and np.sqrt(np.mean(np.log(ratio) ** 2)) < 0.005
    assert found.directions.tan2_h.min() < np.tan(np.radians(1)) ** 2


def test_a_fit_finds_the_paint_with_the_lamp_from_the_shading(shots):
    answer = fit(shots(), models=["lambertian+ggx", "lambertian+beckmann"])
    first = answer.document["ranking"][0]
    assert first["model"] == "lambertian+ggx"
    got = {key: np.asarray(entry["value"]) for key, entry in first["parameters"].items()}
    assert got["ggx.alpha"] == pytest.approx(0.15, rel=0.02)
    assert got["ggx.n"] == pytest.approx(1.5, abs=0.02)
    assert got["lambertian.albedo"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)


@pytest.mark.parametrize("name, law", [("paint_a", "lambertian+ggx"), ("metal_a", "beckmann (metal)")])
def test_pictures_of_another_renderer_give_the_law_that_they_were_made_with(data, tmp_path, name, law):
    pytest.importorskip("OpenEXR", reason="half floats need the extra photo")
    folder = data / "photographs"
    path = describe(
        tmp_path, [(folder / f"{name}_{p}.exr", folder / f"reference_{p}.exr", "reference") for p in ("040", "110")]
    )
    document = fit(path).document
    assert document["recommended"].replace(", edge free", "") == law, document["because"]
    rows = sorted(document["ranking"], key=lambda row: (float(f"{row['rms_ln']:.4g}"), row["free_parameters"]))
    others = [row for row in rows if "free" not in row["candidate"] and "student" not in row["model"]]
    assert others[0]["model"] == law.removesuffix(" (metal)")
    assert ("metal" in others[0]["candidate"]) == ("metal" in law)
    got = {key: np.asarray(entry["value"]) for key, entry in others[0]["parameters"].items()}
    if name == "paint_a":
        assert rows[0]["tied"] or rows[0] is others[0]
        assert got["ggx.alpha"] == pytest.approx(0.12, rel=0.02) and got["ggx.n"] == pytest.approx(1.5, abs=0.02)
        assert got["lambertian.albedo"] == pytest.approx([0.35, 0.20, 0.08], rel=0.015)
    else:
        assert got["beckmann.alpha"] == pytest.approx(0.3, rel=0.02)


def test_the_exposure_of_both_pictures_changes_no_value(shots):
    plain, _ = values(shots(), Paint())
    brighter, _ = values(shots(lambda light, phase: 3.7 * light), Paint())
    assert brighter.f == pytest.approx(plain.f, rel=1e-4)


def test_a_mirrored_picture_with_a_mirrored_lamp_gives_the_same_values(shots):
    plain, _ = values(shots(lamp=lamp_at), Paint())
    mirrored, _ = values(shots(lambda light, phase: light[:, ::-1], lamp=lambda p: lamp_at(p, 180.0)), Paint())
    assert len(mirrored.f) == pytest.approx(len(plain.f), rel=0.02)
    for each in (plain, mirrored):
        each.f.sort(axis=0)
    quantiles = np.linspace(0.02, 0.98, 25)
    assert np.quantile(mirrored.f, quantiles, axis=0) == pytest.approx(
        np.quantile(plain.f, quantiles, axis=0), rel=0.02
    )


def test_the_reference_as_sample_is_its_albedo_over_pi(shots, tmp_path):
    shots()
    path = describe(tmp_path, [(f"white_{p}.tif", f"white_{p}.tif", "reference") for p in (40, 110)])
    found, _ = values(path, Paint())
    assert found.f == pytest.approx(0.9 / np.pi, rel=0.005)


def test_a_stated_exposure_is_allowed_for(shots):
    path = shots(lambda light, phase: light)
    text = path.read_text().replace("lamp: reference", "lamp: reference, seconds: 0.02, reference_seconds: 0.01")
    plain, _ = values(path, Paint())
    path.write_text(text)
    twice, _ = values(path, Paint())
    assert twice.f == pytest.approx(plain.f / 2, rel=1e-6)
    assert any(each.code == "exposure" for each in twice.findings)


def test_an_8_bit_png_with_a_clipped_highlight_is_enough(rendered, tmp_path):
    rows = []
    for phase in (40, 110):
        for name in ("paint", "white"):
            write_codes(tmp_path / f"{name}_{phase}.png", srgb(rendered[name, phase] / 1.05))
        rows.append((f"paint_{phase}.png", f"white_{phase}.png", "reference"))
    path = describe(tmp_path, rows)
    answer = fit(path, models=["lambertian+ggx"])
    got = {key: np.asarray(entry["value"]) for key, entry in answer.document["ranking"][0]["parameters"].items()}
    assert got["ggx.alpha"] == pytest.approx(0.15, rel=0.02) and got["ggx.n"] == pytest.approx(1.5, abs=0.02)
    assert got["lambertian.albedo"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)
    assert "clipped" in {each.code for each in formats.read(path).findings}


@pytest.mark.parametrize("phase, roll, distance", [(20, 0, 40), (75, 140, 12), (130, -60, 200)])
def test_the_shading_of_a_matt_ball_shows_the_lamp(phase, roll, distance):
    y, x = np.mgrid[0:200, 0:200] + 0.5
    seen = points("sphere", Pinhole((100, 100), 96, DISTANCE), x, y)
    seen = seen[np.nan_to_num(seen.cos_r) > 0.25]
    lamp = lamp_at(phase, roll, distance)
    found = find_lamp(seen, seen.irradiance(lamp))
    cosine = found.position @ lamp / found.distance / distance
    assert np.degrees(np.arccos(min(cosine, 1.0))) < 0.01 and found.distance == pytest.approx(distance, rel=1e-3)
    assert found.gamma == pytest.approx(1.0, abs=1e-3) and phase_deg(found.position) == pytest.approx(phase, abs=0.01)


@pytest.mark.parametrize("solid", ["sphere", "cylinder"])
@pytest.mark.parametrize("distance", [24.0, 3.0, FAR])
def test_what_a_pixel_sees_lies_on_the_solid_and_toward_the_camera(solid, distance):
    x = np.linspace(60, 140, 9)
    seen = points(solid, Pinhole((100, 100), 50, distance), x[None, :], x[:, None])
    kept = seen.at[..., [0, 2]] if solid == "cylinder" else seen.at
    hit = np.isfinite(seen.cos_r)
    assert hit[4].all() and np.linalg.norm(kept, axis=-1)[hit] == pytest.approx(1.0)
    assert np.all(seen.cos_r[hit] >= 0)
    if np.isfinite(distance):
        camera = seen.at + seen.toward * ((distance - seen.at[..., 2]) / seen.toward[..., 2])[..., None]
        assert camera[hit] == pytest.approx(np.broadcast_to([0, 0, distance], camera[hit].shape), abs=1e-9)
