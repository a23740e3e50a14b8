"""A grain in a file: its numbers give the widths back, and its streak lies where the surface has it, in all readers."""

import json
import re

import numpy as np
import pytest

from brdfguide import exporters, models
from brdfguide.data import formats
from brdfguide.errors import NoAnswer
from brdfguide.exporters import _grained, cards, conversions
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.exporters.tables import turned_goniometric
from brdfguide.physics.geometry import Geometry, rows

GONIOMETRIC = ("zemax", "csv", "fred", "astm", "tracepro", "speos-anisotropic")
TABLES = ("rgl", "rgl-spectral", *GONIOMETRIC)  # hold the axis by themselves
TARGETS = [name for name in exporters.names() if exporters.get(name).grained and name not in TABLES]
OFF = {"gltf-pbr": 0.12}  # rms ln of a shader that masks both directions with one width
WIDE, NARROW, AXIS = 0.3, 0.075, 30.0


def brushed(axis=AXIS, law="ggx-aniso", **values):
    values = {"alpha_x": WIDE, "alpha_y": NARROW, "axis": np.radians(axis), **values}
    if law == "ggx-aniso":
        values |= {"n": 1.0, "k": 4.0}
    return ColouredSurface(models.get(law), {f"{law}.{name}": value for name, value in values.items()})


def streak(brdf, axis=AXIS):
    """Values 20° off the mirror direction of light at the normal: along the axis and across it."""
    geom = rows(Geometry.from_degrees(0.0, 0.0, 20.0, np.array([axis, axis + 180, axis + 90, axis + 270])))
    return brdf(geom)[:, 0]


@pytest.mark.parametrize("target", TARGETS)
def test_what_the_file_shows_has_its_streak_along_the_axis(target):
    law = "ward-gmd-aniso" if target == "radiance" else "ggx-aniso"
    surface = brushed(law=law, **({"rho_s": 0.8} if target == "radiance" else {}))
    statement = exporters.export(target, surface).statement
    along, back, across, other = streak(statement.shown)
    assert along == pytest.approx(back, rel=1e-9) and across == pytest.approx(other, rel=1e-9)
    assert along > 10 * across
    np.testing.assert_allclose(streak(statement.shown), streak(surface.rgb), rtol=0.12)
    assert statement.rms_ln < OFF.get(target, 0.03) and not any("grain" in each for each in statement.lost)
    turned = [each for each in statement.notes if f"{AXIS:g} degrees" in each]
    assert turned or target == "radiance"


def test_gltf_gives_both_widths_and_the_axis_back():
    material = json.loads(exporters.export("gltf", brushed()).content)["materials"][0]
    alpha = material["pbrMetallicRoughness"]["roughnessFactor"] ** 2
    grain = material["extensions"]["KHR_materials_anisotropy"]
    assert alpha == pytest.approx(NARROW, rel=0.02)
    assert alpha + (1 - alpha) * grain["anisotropyStrength"] ** 2 == pytest.approx(WIDE, rel=0.02)
    assert np.degrees(grain["anisotropyRotation"]) == pytest.approx(AXIS)


@pytest.mark.parametrize("target", ["openpbr", "standard-surface"])
def test_materialx_gives_both_widths_back(target):
    text = exporters.export(target, brushed()).content
    values = {name: float(value) for name, value in re.findall(r'name="(\w+)" type="float" value="([^"]+)"', text)}
    r = values["specular_roughness"]
    if target == "openpbr":
        ratio = 1 - values["specular_roughness_anisotropy"]
        wide = r**2 * np.sqrt(2 / (1 + ratio**2))
    else:
        ratio = 1 - values["specular_anisotropy"]
        wide = r**2 / np.sqrt(ratio)
        assert 360 * values["specular_rotation"] == pytest.approx(180 - AXIS)  # clockwise
    assert wide == pytest.approx(WIDE, rel=0.02) and ratio * wide == pytest.approx(NARROW, rel=0.02)


def test_pbrt_has_the_law_itself():
    made = exporters.export("pbrt", brushed())
    assert made.statement.status == "exact"
    assert re.search(rf'"float uroughness" {WIDE}  "float vroughness" {NARROW}', made.content)


def test_radiance_has_wards_bounded_law_and_the_direction_across_the_grain():
    made = exporters.export("radiance", brushed(law="ward-gmd-aniso", rho_s=0.8))
    assert made.statement.status == "exact"
    lines = made.content.splitlines()
    assert re.match(r"void (metal|plastic)2 ", lines[-4])
    numbers = [float(word) for word in lines[-3].split()[1:4]]
    np.testing.assert_allclose(numbers, [np.cos(np.radians(AXIS)), np.sin(np.radians(AXIS)), 0.0], atol=1e-9)
    np.testing.assert_allclose([float(word) for word in lines[-1].split()[-2:]], [WIDE, NARROW], rtol=1e-4)


def test_the_wider_of_both_widths_says_where_the_streak_lies():
    assert np.degrees(_grained.axis_of(brushed(axis=30.0))) == pytest.approx(30.0)
    swapped = brushed(axis=30.0, alpha_x=NARROW, alpha_y=WIDE)
    assert np.degrees(_grained.axis_of(swapped)) == pytest.approx(120.0)
    assert _grained.axis_of(brushed(alpha_x=0.1, alpha_y=0.1)) is None


def test_grains_that_cross_are_refused():
    law = models.get("ggx-aniso+ward-gmd-aniso")
    values = {"ggx-aniso.alpha_y": 0.05, "ward-gmd-aniso.alpha_y": 0.05, "ward-gmd-aniso.axis": 1.0}
    with pytest.raises(NoAnswer, match="it has more than one grain"):
        exporters.export("mitsuba", ColouredSurface(law, law.defaults() | values))


@pytest.fixture(scope="module")
def turned_table():
    return exporters.export("rgl", brushed())


def test_rgl_has_an_axis_of_azimuths_that_holds_the_streak(turned_table):
    statement = turned_table.statement
    assert statement.rms_ln < 0.02 and statement.status == "refit" and statement.written["phi_i"] > 16
    np.testing.assert_allclose(streak(statement.shown), streak(brushed().rgb), rtol=0.01)


def test_rgl_is_read_back_with_its_rotations_and_the_same_grain(turned_table, tmp_path):
    path = tmp_path / "grain.bsdf"
    path.write_bytes(turned_table.content)
    found = formats.read(path)
    assert len(np.unique(np.round(found.geom.phi_i_deg, 3))) == turned_table.statement.written["phi_i"] - 1
    some = found[np.arange(0, len(found.geom), 499)]
    some = some[(np.maximum(some.geom.theta_i_deg, some.geom.theta_r_deg)[:, 0] < 75) & (some.brdf[:, 0] > 1e-3)]
    assert len(some.geom) > 50
    off = np.abs(some.brdf[:, 0] / brushed().rgb(some.geom)[:, 0] - 1)
    assert np.quantile(off, 0.95) < 0.02


@pytest.mark.validate
def test_mitsuba_reads_the_turned_table_as_we_do(turned_table, tmp_path):
    mitsuba = pytest.importorskip("mitsuba", reason="pip install mitsuba: the reader of these exports")
    mitsuba.set_variant("scalar_rgb")
    path = tmp_path / "grain.bsdf"
    path.write_bytes(turned_table.content)
    bsdf, si = mitsuba.load_dict({"type": "measured", "filename": str(path)}), mitsuba.SurfaceInteraction3f()
    rng = np.random.default_rng(3)
    theta_i, phi_i = rng.uniform(0, 75, 60), rng.uniform(0, 360, 60)
    theta_r = np.clip(np.abs(theta_i + rng.normal(0, 12, 60)), 0, 75)
    phi_r = phi_i + 180 + rng.normal(0, 25, 60)
    got = []
    for light, azimuth, view, seen in zip(theta_i, phi_i, theta_r, phi_r, strict=True):
        si.wi, out = upward(light, azimuth), upward(view, seen)
        got.append(bsdf.eval(mitsuba.BSDFContext(), si, out)[0] / out[2])
    geom = rows(Geometry.from_degrees(theta_i, phi_i, theta_r, phi_r))
    np.testing.assert_allclose(got, turned_table.statement.shown(geom)[:, 0], rtol=1e-4)


@pytest.mark.parametrize("target", GONIOMETRIC)
def test_a_table_under_rotations_is_read_back_with_the_same_grain(target, tmp_path, monkeypatch):
    surface, polar = brushed(alpha_x=0.35, alpha_y=0.15), 10.0 if target.startswith("speos") else None
    coarse = turned_goniometric.Steps(45.0, 20.0, 30.0, polar)
    monkeypatch.setattr(turned_goniometric, "WIDEST_DEG", 20.0)
    monkeypatch.setattr(turned_goniometric, "FIRST", 0.5)
    made = turned_goniometric.with_rotations(exporters.get(target), levels=(coarse,)).export(surface)
    assert "could not be held" in made.statement.notes[0] and made.statement.written["rotations"] == 8
    path = tmp_path / "grain.txt"
    path.write_text(made.content)
    found = formats.read(path)
    assert len(np.unique(np.round(np.remainder(found.geom.phi_i_deg, 360), 2))) == 8
    some = found[(found.geom.theta_r_deg[:, 0] < 85) & (found.brdf[:, 0] > 0)]
    assert len(some.geom) > 1000
    np.testing.assert_allclose(some.brdf[:, 0], surface.rgb(some.geom)[:, 0], rtol=1e-5)
    np.testing.assert_allclose(streak(made.statement.shown)[:2], streak(surface.rgb)[:2], rtol=0.3)


def test_azimuths_that_are_closer_near_the_mirror_direction_are_read_alike(tmp_path):
    """About the normal a lobe moves with the incidence: where it stands, close azimuths count."""
    surface, near = brushed(alpha_x=0.5, alpha_y=0.25), ((40.0, 10.0), (180.0, 35.0))
    levels = [turned_goniometric.Steps(45.0, 20.0, azimuth, 10.0) for azimuth in (35.0, near)]
    assert levels[1].azimuths().tolist() == [0, 35, 70, 105, *range(140, 221, 10), 255, 290, 325]
    nodes = [
        turned_goniometric.turned_table_of("speos-anisotropic", surface, None, [each], several=False) for each in levels
    ]
    off = [float(re.search(r"within ([\d.e+]+) %", each.statement.notes[0])[1]) for each in nodes]
    assert off[1] < 0.8 * off[0]
    (tmp_path / "grain.anisotropicbsdf").write_text(formats.write("speos-anisotropic", nodes[1].measurement)[0])
    found = formats.read(tmp_path / "grain.anisotropicbsdf")
    some = found[found.geom.theta_r_deg[:, 0] < 85]
    assert len(np.unique(np.round(some.geom.phi_deg))) == 16
    np.testing.assert_allclose(some.brdf[:, 0], surface.rgb(some.geom)[:, 0], rtol=1e-5)
    np.testing.assert_allclose(nodes[1].statement.shown(some.geom), surface.rgb(some.geom), rtol=1e-5)


def test_rotations_are_added_until_a_linear_reader_is_close():
    surface = brushed(alpha_x=0.5, alpha_y=0.35)
    steps = [turned_goniometric.Steps(rotation, 10.0, 15.0) for rotation in (60.0, 15.0, 7.5)]
    made = turned_goniometric.turned_table_of("zemax", surface, None, steps, several=False)
    assert made.statement.written["rotations"] == 24 and "could not be held" not in made.statement.notes[0]
    np.testing.assert_allclose(streak(made.statement.shown), streak(surface.rgb), rtol=0.02)


@pytest.mark.parametrize("target, nearest", [("speos", "speos-anisotropic"), ("lighttools", "zemax"), ("merl", "rgl")])
def test_what_cannot_hold_a_grain_names_the_nearest_that_can(target, nearest):
    with pytest.raises(exporters.Refused, match=f"changes as the sample turns.*nearest target that can is {nearest}$"):
        exporters.export(target, brushed())
    assert exporters.get(nearest).grained


def upward(theta_deg, phi_deg):
    """A unit vector as a list."""
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    return [float(np.sin(theta) * np.cos(phi)), float(np.sin(theta) * np.sin(phi)), float(np.cos(theta))]


@pytest.mark.validate
def test_mitsuba_shows_the_streak_that_the_statement_has():
    mitsuba = pytest.importorskip("mitsuba", reason="pip install mitsuba: the reader of these exports")
    mitsuba.set_variant("scalar_rgb")
    surface = brushed(axis=0.0)  # its u lies along x
    made = exporters.export("mitsuba", surface)
    bsdf, si = mitsuba.load_string(made.content), mitsuba.SurfaceInteraction3f()
    geom = rows(Geometry.from_degrees(30.0, np.arange(0, 180, 15.0), 35.0, np.arange(0, 180, 15.0) + 170.0))

    def vector(theta, phi):
        theta, phi = np.radians(theta), np.radians(phi)
        return [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)]

    got = []
    for turn in np.arange(0, 180, 15.0):
        si.wi = vector(30.0, turn)
        out = vector(35.0, turn + 170.0)
        got.append(np.array(bsdf.eval(mitsuba.BSDFContext(), si, out))[0] / out[2])
    np.testing.assert_allclose(got, made.statement.shown(geom)[:, 0], rtol=1e-4)


def test_gltf_pbr_gives_both_widths_and_the_axis_back():
    text = exporters.export("gltf-pbr", brushed()).content
    values = {name: float(value) for name, value in re.findall(r'name="(\w+)" type="float" value="([^"]+)"', text)}
    alpha = values["roughness"] ** 2
    assert alpha == pytest.approx(NARROW, rel=0.03)
    assert alpha + (1 - alpha) * values["anisotropy_strength"] ** 2 == pytest.approx(WIDE, rel=0.03)
    assert np.degrees(values["anisotropy_rotation"]) == pytest.approx(AXIS)
    assert "roughness_anisotropy" not in text


def test_openpbrs_file_turns_its_tangent_by_a_node():
    text = exporters.export("openpbr", brushed()).content
    [joined] = re.findall(r'name="geometry_tangent" type="vector3" nodename="(\w+)"', text)
    node = re.search(rf'<rotate3d name="{joined}" type="vector3">(.*?)</rotate3d>', text, re.S)[1]
    assert float(re.search(r'name="amount" type="float" value="([^"]+)"', node)[1]) == pytest.approx(-AXIS)
    assert "geometry_tangent" not in exporters.export("openpbr", brushed(axis=0.0)).content


@pytest.mark.parametrize("axis", [0.0, 30.0, 90.0, 150.0])
def test_standard_surface_turns_clockwise(axis):
    text = exporters.export("standard-surface", brushed(axis=axis)).content
    found = re.search(r'name="specular_rotation" type="float" value="([^"]+)"', text)
    assert (0.0 if found is None else 360 * float(found[1])) == pytest.approx((180 - axis) % 180)


def test_disney_has_its_aspect_and_gives_the_widths_back():
    found = conversions.convert(brushed(alpha_x=0.3, alpha_y=0.1), "disney")
    assert found.rms_ln < 0.03
    aspect = np.sqrt(1 - 0.9 * found.numbers["anisotropic"])
    alpha = found.numbers["roughness"] ** 2
    assert (alpha / aspect, alpha * aspect) == pytest.approx((0.3, 0.1), rel=0.03)
    assert found.numbers["axis"] == pytest.approx(AXIS)
    given = {name: [value] for name, value in found.numbers.items()}
    back = conversions.convert(conversions.read("disney", given), "ggx-aniso")
    assert back.rms_ln < 0.1 and back.numbers["axis"] == pytest.approx(AXIS)
    assert (back.numbers["alpha_x"], back.numbers["alpha_y"]) == pytest.approx((0.3, 0.1), rel=0.1)


def test_usd_gets_a_round_lobe_and_says_so():
    statement = exporters.export("usd", brushed()).statement
    assert statement.status == "lossy" and any(each.startswith("the grain") for each in statement.lost)
    assert streak(statement.shown)[0] == pytest.approx(streak(statement.shown)[2], rel=1e-9)


TYPED = {
    "Blender": lambda n: (n["Roughness"], np.sqrt(1 - 0.9 * n["Anisotropic"])),
    "Mitsuba": lambda n: (n["roughness"], np.sqrt(1 - 0.9 * n["anisotropic"])),
    "Arnold, Maya, Houdini": lambda n: (n["specular_roughness"], np.sqrt(1 - n["specular_anisotropy"])),
}


def test_what_is_typed_into_programs_holds_both_widths():
    found = {card.program: card for card in cards.cards([brushed(alpha_x=0.3, alpha_y=0.1)])}
    for program, widths in TYPED.items():
        roughness, aspect = widths(found[program].numbers)
        assert (roughness**2 / aspect, roughness**2 * aspect) == pytest.approx((0.3, 0.1), rel=0.05), program
    assert 360 * found["Blender"].numbers["Anisotropic Rotation"] == pytest.approx(AXIS)
    assert np.degrees(found["glTF, three.js"].numbers["anisotropyRotation"]) == pytest.approx(AXIS)
    assert any("u lies at azimuth 30 degrees" in note for note in found["Mitsuba"].notes)
    assert found["Radiance"].numbers.keys() >= {"roughness along u", "roughness across u"}
    assert any("Tangent lies at azimuth 30 degrees" in note for note in found["Unreal"].notes)


@pytest.mark.parametrize("wide, narrow", [(0.2, 0.034), (0.15, 0.015), (0.5, 0.05)])
def test_a_long_streak_keeps_its_widths(wide, narrow):
    for target in ("standard-surface", "openpbr"):
        assert exporters.export(target, brushed(alpha_x=wide, alpha_y=narrow)).statement.rms_ln < 0.05


def test_what_masking_with_one_width_costs_is_said():
    for target in ("openpbr", "standard-surface"):
        notes = exporters.export(target, brushed()).statement.notes
        assert any("MaterialX masks light and view with one width" in each for each in notes)
