"""The numbers to type: each is of the program's own formula, and the programs that are here evaluate that formula."""

import numpy as np
import pytest

from brdfguide.exporters import _engine_laws, coloured
from brdfguide.exporters.cards import cards
from brdfguide.models.surface import Surface
from brdfguide.physics.colour import hex_of
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.physics.picked_colour import of_hex

FEW = rows(
    Geometry.from_degrees(
        *np.array(np.meshgrid([5.0, 45.0, 75.0], [0.0], [10.0, 40.0, 50.0, 70.0], [20.0, 120.0, 175.0, 180.0])).reshape(
            4, -1
        )
    )
)


def by_program(expression, values):
    return {each.program: each for each in cards([coloured(Surface.named(expression, values))], FEW)}


def test_a_shaders_own_numbers_come_back_as_they_are():
    given = {"base_color": [0.8, 0.1, 0.05], "roughness": 0.4}
    card = by_program("gltf", given)["glTF, three.js"]
    assert card.rms_ln < 1e-6
    assert card.numbers["baseColor"] == (0.8, 0.1, 0.05) and card.numbers["roughness"] == 0.4


def test_the_same_dielectric_needs_other_numbers_elsewhere():
    found = by_program("standard-surface", {"base_color": [0.3, 0.2, 0.1], "specular_roughness": 0.5})
    assert found["Arnold, Maya, Houdini"].rms_ln < 1e-6
    assert found["Blender"].numbers["Roughness"] == 0.5 and found["Blender"].numbers["IOR"] == 1.5
    unreal = found["Unreal"]
    assert 0.001 < unreal.rms_ln < 0.2 and unreal.numbers["Specular"] == pytest.approx(0.5, abs=0.2)
    assert unreal.numbers["Base Color"][0] < 0.3, "its lobe takes nothing from the body, so the body is darker"


def test_the_error_is_that_of_the_programs_formula_with_the_numbers_of_the_card():
    surface = coloured(Surface.named("ggx", {"alpha": 0.2, "n": 1.2, "k": 6.0}))
    [card] = [each for each in cards([surface], FEW) if each.program == "Unreal"]
    typed = card.numbers
    law = _engine_laws.UNREAL(
        FEW,
        base_color=np.array(typed["Base Color"]),
        metallic=typed["Metallic"],
        roughness=typed["Roughness"],
        specular=typed["Specular"],
    )
    error = np.sqrt(np.mean(np.log(law / surface.rgb(FEW)) ** 2))
    assert error == pytest.approx(card.rms_ln, rel=0.3), "over the directions that count"
    assert typed["Metallic"] == 1.0


def test_what_cannot_be_typed_is_said():
    found = by_program("lambertian+ggx+mirror", {"ggx.alpha": 0.2})
    assert found["Unreal"].rms_ln is None and "mirror" in found["Unreal"].cannot[0]
    assert found["OpenPBR"].numbers["coat_weight"] > 0


def test_a_colour_picker_gets_srgb():
    assert hex_of(np.array([1.0, 0.5, 0.0])) == "#ffbc00"  # IEC 61966-2-1: 0.5 is 0.7354
    assert hex_of(of_hex("#c83205")) == "#c83205"
    assert of_hex("#ffbc00")[1] == pytest.approx(0.5, abs=0.003)


@pytest.mark.validate
def test_mitsuba_evaluates_principled_as_we_do():
    mitsuba = pytest.importorskip("mitsuba", reason="pip install mitsuba")
    mitsuba.set_variant("scalar_rgb")
    values = {"base_color": 0.4, "roughness": 0.45, "metallic": 0.0, "eta": 1.6}
    for metallic in (0.0, 1.0):
        values["metallic"] = metallic
        plugin = mitsuba.load_dict(
            {
                "type": "principled",
                "base_color": {"type": "rgb", "value": [0.4, 0.4, 0.4]},
                "roughness": 0.45,
                "metallic": metallic,
                "eta": 1.6,
            }
        )
        ours = _engine_laws.PRINCIPLED(FEW, **values)[:, 0]
        for place in range(0, len(FEW), 5):
            i, r = (
                _vector(theta[place, 0], phi)
                for theta, phi in zip(
                    (FEW.theta_i_deg, FEW.theta_r_deg), (FEW.phi_i_deg[place, 0], FEW.phi_r_deg[place, 0]), strict=True
                )
            )
            interaction = mitsuba.SurfaceInteraction3f()
            interaction.wi = r
            theirs = plugin.eval(mitsuba.BSDFContext(), interaction, i)[0] / i[2]
            assert theirs == pytest.approx(float(ours[place]), rel=2e-4), (metallic, place)


def _vector(theta_deg, phi_deg):
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    return [float(np.sin(theta) * np.cos(phi)), float(np.sin(theta) * np.sin(phi)), float(np.cos(theta))]
