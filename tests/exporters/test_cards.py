"""The numbers to type: each is of the program's own formula, and the programs that are here evaluate that formula."""

import numpy as np
import pytest

from brdfguide.exporters import _principled, _substance, _unreal, coloured
from brdfguide.exporters._programs import PROGRAMS
from brdfguide.exporters.cards import _card, _Chosen, cards
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


def by_program(expression, values, *names):
    """Cards by program; of all programs without names."""
    surface = coloured(Surface.named(expression, values))
    if not names:
        return {each.program: each for each in cards([surface], FEW)}
    chosen = _Chosen(FEW)
    return {each.name: _card(each, chosen, surface) for each in PROGRAMS if each.name in names}


def test_a_shaders_own_numbers_come_back_as_they_are():
    given = {"base_color": [0.8, 0.1, 0.05], "roughness": 0.4}
    card = by_program("gltf", given, "glTF, three.js")["glTF, three.js"]
    assert card.rms_ln < 1e-6
    assert card.numbers["baseColor"] == (0.8, 0.1, 0.05) and card.numbers["roughness"] == 0.4


def test_the_same_dielectric_needs_other_numbers_elsewhere():
    given = {"base_color": [0.3, 0.2, 0.1], "specular_roughness": 0.5}
    found = by_program("standard-surface", given, "Arnold, Maya, Houdini", "Blender", "Unreal")
    assert found["Arnold, Maya, Houdini"].rms_ln < 1e-6
    assert found["Blender"].numbers["Roughness"] == 0.5 and found["Blender"].numbers["IOR"] == 1.5
    unreal = found["Unreal"]
    assert 0.001 < unreal.rms_ln < 0.2 and unreal.numbers["Specular"] == pytest.approx(0.5, abs=0.2)
    assert unreal.numbers["Base Color"][0] < 0.3, "its lobe takes nothing from the body, so the body is darker"


def test_the_error_is_that_of_the_programs_formula_with_the_numbers_of_the_card():
    surface = coloured(Surface.named("ggx", {"alpha": 0.2, "n": 1.2, "k": 6.0}))
    [unreal] = [each for each in PROGRAMS if each.name == "Unreal"]
    card = _card(unreal, _Chosen(FEW), surface)
    typed = card.numbers
    law = _unreal.LAW(
        FEW,
        **_unreal.LAW.defaults()
        | {
            "base_color": np.array(typed["Base Color"]),
            "metallic": typed["Metallic"],
            "roughness": typed["Roughness"],
            "specular": typed["Specular"],
        },
    )
    error = np.sqrt(np.mean(np.log(law / surface.rgb(FEW)) ** 2))
    assert error == pytest.approx(card.rms_ln, rel=0.3), "over the directions that count"
    assert typed["Metallic"] == 1.0


def test_a_mirror_over_a_lobe_is_a_coat_in_every_program():
    given = {"ggx.alpha": 0.2, "ggx.n": 0.5, "ggx.k": 3.0, "mirror.n": 1.5}
    found = by_program("ggx+mirror", given, "Unreal", "Substance", "Mitsuba")
    assert found["Unreal"].shader == "Clear Coat" and found["Unreal"].numbers["Clear Coat"] > 0.5
    assert found["Substance"].numbers["Coat opacity"] > 0.5 and found["Substance"].rms_ln < 0.2
    assert found["Mitsuba"].numbers["clearcoat"] > 0.5 and "glows" in found["Mitsuba"].cannot[0]


def test_a_matt_body_is_matt_in_blender():
    """IOR Level 0: without it Blender lays a lobe of index 1.5 over every body."""
    found = by_program("lambertian", {"albedo": [0.5, 0.3, 0.1]}, "Blender", "Unreal")
    assert found["Blender"].numbers["IOR Level"] == 0.0 and found["Blender"].rms_ln < 1e-6
    assert found["Unreal"].numbers["Specular"] == 0.0
    coated = by_program("coated:lambertian", {}, "Blender", "Arnold, Maya, Houdini")
    assert coated["Blender"].numbers["IOR Level"] == 0.0 == coated["Arnold, Maya, Houdini"].numbers["specular"]


def test_a_coat_is_typed_in_full():
    """Defaults of its roughness differ: 0.03 in Blender, 0.1 in Arnold, 0 here."""
    found = by_program("ggx+mirror", {"ggx.n": 0.5, "ggx.k": 3.0}, "Blender", "Arnold, Maya, Houdini", "OpenPBR")
    assert found["Blender"].numbers["Coat Roughness"] == 0.0
    assert found["Arnold, Maya, Houdini"].numbers["coat_roughness"] == 0.0
    assert {"coat_weight", "coat_roughness", "coat_ior"} <= found["OpenPBR"].numbers.keys()


def test_something_clear_is_no_metal():
    """A black metal with a dark edge looks the same from outside."""
    clear = by_program("ggx", {"n": 1.5, "k": 0.0, "alpha": 0.15}, "Arnold, Maya, Houdini", "glTF, three.js")
    metal = by_program("ggx", {"n": 0.3, "k": 3.0, "alpha": 0.15}, "Arnold, Maya, Houdini", "glTF, three.js")
    assert [each.numbers[label] for each, label in zip(clear.values(), ("metalness", "metallic"), strict=True)] == [
        0.0,
        0.0,
    ]
    assert [each.numbers[label] for each, label in zip(metal.values(), ("metalness", "metallic"), strict=True)] == [
        1.0,
        1.0,
    ]


def test_a_body_under_more_than_any_dielectric_reflects_is_typed_as_a_metal():
    """Without a kind a metal is fitted as a body under a lobe of high index; no program has such an index."""
    law = {"lambertian.albedo": 0.03, "ggx.n": 40.0, "ggx.alpha": 0.2}
    found = by_program("lambertian+ggx", law, "Blender", "glTF, three.js", "Mitsuba")
    assert all(each.rms_ln < 0.25 and each.numbers.get("Metallic", 1.0) > 0.9 for each in found.values())
    assert found["glTF, three.js"].numbers["metallic"] > 0.8


def test_every_number_has_its_role_in_every_program():
    """Only what no other program has stands without one."""
    grained = by_program("ggx-aniso", {"n": 1.2, "k": 6.0, "alpha_x": 0.3, "alpha_y": 0.1, "axis": 30.0})
    for card in (*grained.values(), *by_program("ggx+mirror", {"ggx.n": 0.5, "ggx.k": 3.0}).values()):
        assert card.numbers.keys() == card.roles.keys(), card.program
        assert card.rms_ln is None or {"colour", "roughness"} <= set(card.roles.values())


def test_what_cannot_be_typed_is_said():
    found = by_program("lambertian+ggx+mirror", {"ggx.alpha": 0.2})
    assert found["Radiance"].rms_ln is None and "mirror" in found["Radiance"].cannot[0]
    assert found["OpenPBR"].numbers["coat_weight"] > 0


def test_a_grain_is_typed_in_every_programs_own_numbers():
    """The widths that its own formula makes of them are the surface's, and so is the direction."""
    found = by_program("ggx-aniso", {"alpha_x": 0.3, "alpha_y": 0.1, "n": 1.2, "k": 6.0, "axis": 30.0})
    widths = {}
    for program, (roughness, amount) in {
        "Blender": ("Roughness", "Anisotropic"),
        "Arnold, Maya, Houdini": ("specular_roughness", "specular_anisotropy"),
        "OpenPBR": ("specular_roughness", "specular_roughness_anisotropy"),
        "Unreal": ("Roughness", "Anisotropy"),
        "Substance": ("Roughness", "Anisotropy level"),
        "glTF, three.js": ("roughness", "anisotropyStrength"),
        "Mitsuba": ("roughness", "anisotropic"),
    }.items():
        assert found[program].rms_ln < 0.06
        widths[program] = WIDTHS[program](found[program].numbers[roughness] ** 2, found[program].numbers[amount])
        assert widths[program] == pytest.approx((0.3, 0.1), rel=0.05), program
    for program, label, turn in (
        ("Blender", "Anisotropic Rotation", 30 / 360),
        ("Arnold, Maya, Houdini", "specular_rotation", 150 / 360),  # clockwise
        ("Substance", "Anisotropy angle", 30 / 360),
        ("glTF, three.js", "anisotropyRotation", np.radians(30)),
    ):
        assert found[program].numbers[label] == pytest.approx(turn)
    for program in ("OpenPBR", "Unreal", "Mitsuba"):
        assert "azimuth 30 degrees" in found[program].notes[0]


def _burleys(alpha, amount):
    aspect = np.sqrt(1 - 0.9 * amount)
    return alpha / aspect, alpha * aspect


WIDTHS = {  # as each program's documentation has them
    "Blender": _burleys,
    "Mitsuba": _burleys,
    "Arnold, Maya, Houdini": lambda alpha, amount: (alpha / np.sqrt(1 - amount), alpha * np.sqrt(1 - amount)),
    "OpenPBR": lambda alpha, amount: (
        alpha * np.sqrt(2 / (1 + (1 - amount) ** 2)),
        (1 - amount) * alpha * np.sqrt(2 / (1 + (1 - amount) ** 2)),
    ),
    "Unreal": lambda alpha, amount: (alpha * (1 + amount), alpha * (1 - amount)),
    "Substance": lambda alpha, amount: (min(1.0, alpha + amount**4), alpha),
    "glTF, three.js": lambda alpha, amount: (alpha + (1 - alpha) * amount**2, alpha),
}


def test_unreals_coat_lets_the_body_through_as_snell_would():
    """Published: ⅔ c - b with b = (0.63 - 0.22 d) d - 0.745; at 60 degrees 0.818, where Snell has 0.816."""
    law = _unreal.LAW
    geom = rows(Geometry.from_degrees([0.0, 60.0], 0.0, [0.0, 60.0], 180.0))
    given = {"base_color": 0.4, "specular": 0.0, "clear_coat": 1.0, "clear_coat_roughness": 0.0}
    through = law(geom, **law.defaults() | given)[:, 0] / (0.4 / np.pi)
    assert through == pytest.approx([0.96**2, 0.93**2 * (0.5 / 1.5 + 0.485) / 0.5], rel=1e-6)
    assert pytest.approx(np.sqrt(1 - 0.75 / 1.5**2), rel=3e-3) == 0.5 / 1.5 + 0.485
    metal = law(geom, **law.defaults() | {"base_color": 0.4, "metallic": 1.0, "clear_coat": 1.0})[:, 0]
    bare = law(geom, **law.defaults() | {"base_color": 0.4, "metallic": 1.0})[:, 0]
    assert metal[0] / bare[0] == pytest.approx(0.96**2, rel=0.01), "no longer way at the normal, so nothing is absorbed"
    assert law.mirror(geom, **law.defaults() | given)[:, 0] == pytest.approx([0.04, 0.07])


def test_substances_coat_takes_from_a_metal_nothing_and_from_a_body_its_index():
    law = _substance.LAW

    def at(**given):
        return law(FEW, **law.defaults() | {"coat_roughness": 0.3, **given})

    coat = at(base_color=0.0, specular_level=0.0, coat_opacity=1.0) - at(base_color=0.0, specular_level=0.0)
    metal = {"metallic": 1.0, "base_color": 0.8}
    assert at(**metal, coat_opacity=1.0) == pytest.approx(at(**metal) + coat, rel=1e-9)
    under = (0.1 / 3.1) ** 2 / 0.04  # F0 of 1.5 against 1.6 over F0 of 1.5 against air
    weaker = at(coat_opacity=1.0, specular_level=0.5) - coat
    assert weaker == pytest.approx(at(specular_level=0.5 * under), rel=1e-9)


def test_substances_edge_colour_is_openpbrs():
    """Both bend Schlick's curve at 82 degrees (Kutz, Hasan and Edmondson 2021)."""
    geom = rows(Geometry.from_degrees(np.degrees(np.arccos(1 / 7)), 0.0, np.degrees(np.arccos(1 / 7)), 180.0))
    found = {
        edge: _substance.LAW.mirror(
            geom,
            **_substance.LAW.defaults()
            | {"metallic": 1.0, "base_color": 0.8, "roughness": 0.0, "specular_edge_color": edge},
        )
        for edge in (1.0, 0.5)
    }
    assert found[0.5] == pytest.approx(0.5 * found[1.0], rel=1e-6)


def test_a_colour_picker_gets_srgb():
    assert hex_of(np.array([1.0, 0.5, 0.0])) == "#ffbc00"  # IEC 61966-2-1: 0.5 is 0.7354
    assert hex_of(of_hex("#c83205")) == "#c83205"
    assert of_hex("#ffbc00")[1] == pytest.approx(0.5, abs=0.003)


@pytest.mark.validate
def test_mitsuba_evaluates_principled_as_we_do():
    mitsuba = pytest.importorskip("mitsuba", reason="pip install mitsuba")
    mitsuba.set_variant("scalar_rgb")
    given = {"roughness": 0.45, "eta": 1.6}
    for more in (
        {"metallic": 0.0},
        {"metallic": 1.0},
        {"anisotropic": 0.7},
        {"clearcoat": 1.0, "clearcoat_gloss": 0.3},
        {"metallic": 1.0, "clearcoat": 0.6, "clearcoat_gloss": 0.8},
    ):
        plugin = mitsuba.load_dict(
            {"type": "principled", "base_color": {"type": "rgb", "value": [0.4, 0.4, 0.4]}, **given, **more}
        )
        law = _principled.LAW
        ours = law(FEW, **law.defaults() | {"base_color": 0.4} | given | more)[:, 0]
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
            assert theirs == pytest.approx(float(ours[place]), rel=2e-4), (more, place)


def _vector(theta_deg, phi_deg):
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    return [float(np.sin(theta) * np.cos(phi)), float(np.sin(theta) * np.sin(phi)), float(np.cos(theta))]
