"""What holds for every target: a file or a sentence, the same bytes twice, no number outside its range."""

import json
import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import exporters
from brdfguide.data.formats import merl
from brdfguide.errors import BrdfguideError, InputError, NoAnswer
from brdfguide.exporters import _directions
from brdfguide.exporters.exporter import ColouredSurface, Refused, number
from brdfguide.exporters.tables import tensor
from brdfguide.exporters.tables.placement import Warp
from brdfguide.physics.geometry import Geometry, rows

from .conftest import EVERY_LAW, random_surface, surface

FEW = rows(
    Geometry.from_degrees(
        *np.array(
            np.meshgrid([5.0, 45.0, 75.0], [0.0], [10.0, 44.0, 46.0, 74.0, 80.0], [0.0, 120.0, 178.0, 180.0])
        ).reshape(4, -1)
    )
)


@pytest.mark.parametrize("target", exporters.names())
def test_every_law_becomes_a_file_or_a_sentence(target, each):
    try:
        made = exporters.export(target, each)
    except Refused as refusal:
        assert refusal.nearest in exporters.names() and refusal.nearest in str(refusal) and len(str(refusal)) > 60
        exporters.export(refusal.nearest, each)  # the advice holds
        return
    assert made.statement.status in ("exact", "refit", "lossy")
    assert made.statement.rms_ln < (1e-4 if made.statement.status == "exact" else np.inf)
    assert made.content and made.statement.target == target
    assert_seen(made.statement)


def assert_seen(statement):
    """S of what the file shows; a mirror alone has none, an exact file differs nowhere."""
    assert (statement.seen is None) == (statement.shown is None)
    if statement.seen is None:
        assert "mirror" in statement.over
        return
    assert 0 <= statement.seen < (0.05 if statement.status == "exact" else 200)
    assert f"seen {statement.seen:.1f} L*" in statement.sentence()
    geom = rows(Geometry.from_degrees(30.0, 0.0, np.array([10.0, 25.0, 50.0]), 170.0))
    assert statement.shown(geom).shape == (3, 3)


@pytest.mark.parametrize("target", exporters.names())
def test_bytes_repeat(target):
    made = [exporters.export(target, EVERY_LAW["ward"]) for _ in range(2)]
    assert made[0].content == made[1].content and dict(made[0].beside) == dict(made[1].beside)


@pytest.fixture(autouse=True)
def small_tables(monkeypatch):
    """Tables of a few nodes: here it is the road that is tested, not the resolution."""
    even = Warp(np.ones(2))
    monkeypatch.setattr(
        tensor,
        "grids",
        lambda brdf: [tensor.Grid(np.radians([0.0, 40.0, 70.0, 89.0]), even, even, 8, tensor._ndf(brdf))],
    )
    monkeypatch.setattr(_directions, "JUDGED", 40)
    for name, size in (("THETA_H", 6), ("THETA_D", 6), ("PHI_D", 8)):
        monkeypatch.setattr(merl, name, size)


@pytest.mark.parametrize("target", exporters.names())
def test_a_surface_with_a_grain_is_refused_in_one_sentence(target):
    grained = surface("stam", stam__ratio=3.0)
    if exporters.get(target).grained or exporters.get(target).averages:  # see test_grained
        return
    sentence = f"{target} cannot express this surface: stam changes as the sample turns: .* unless ratio is 1"
    with pytest.raises(Refused, match=sentence) as refusal:
        exporters.export(target, grained)
    assert exporters.get(refusal.value.nearest).grained


def test_own_law_is_exact_where_the_target_has_it():
    for name, target in (
        ("lambertian", "mitsuba"),
        ("lambertian", "pbrt"),
        ("lambertian", "gltf"),
        ("lambertian", "materialx"),
        ("lambertian", "radiance"),
        ("ggx", "pbrt"),
        ("ward-gmd", "radiance"),
        ("mirror", "mitsuba"),
        ("mirror", "pbrt"),
        ("mirror", "materialx"),
    ):
        assert exporters.export(target, EVERY_LAW[name]).statement.status == "exact", (name, target)


def test_unlike_laws_are_not_called_exact():
    for name, target in (
        ("ward", "radiance"),
        ("phong", "mitsuba"),
        ("ggx", "mitsuba"),
        ("ggx", "gltf"),
        ("he-torrance", "mitsuba"),
        ("paint", "pbrt"),
    ):
        statement = exporters.export(target, EVERY_LAW[name]).statement
        assert statement.status != "exact" and statement.rms_ln > 1e-3, (name, target)


# ranges that the readers document, by the name in the file
UNIT = (
    "albedo",
    "baseColorFactor",
    "roughnessFactor",
    "metallicFactor",
    "specularFactor",
    "specularColorFactor",
    "diffuseColor",
    "specularColor",
    "inputs:roughness",
    "base_color",
    "specular_roughness",
    "base_metalness",
    "metalness",
    "reflectance",
    "amount",
    "weight",
)
NUMBER = r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?"


def out_of_range(text: str) -> list[str]:
    """Numbers after a name of UNIT that are not within 0..1, and any number that is none."""
    body = "\n".join(
        line
        for line in re.sub(r"<!--.*?-->", "", text, flags=re.S).splitlines()
        if not line.lstrip().startswith(("#", "//", '"command', '"parameters'))
    )
    found = re.findall(r"(?<![\w.])(?:nan|inf)(?![\w.])", body, flags=re.I)
    for name in UNIT:
        for match in re.finditer(
            rf'(?<!\w){name}"?(?:\s*(?:type="\w+"|"))?\s*(?:value=|:|=|\[)?\s*["(\[]*((?:{NUMBER}[,\s]*)+)', body
        ):
            values = [float(each) for each in re.findall(NUMBER, match[1])]
            values = values[1::2] if "spectrum" in body[max(0, match.start() - 12) : match.start()] else values
            found += [f"{name}={value}" for value in values if not 0 <= value <= 1]
    return found


def test_the_range_check_sees_what_it_should():
    assert (
        out_of_range('<float name="weight" value="1.2"/>')
        and out_of_range('"roughnessFactor": -0.1')
        and out_of_range("x = nan;")
    )
    assert not out_of_range('<float name="weight" value="0.2"/>') and not out_of_range(
        '"spectrum reflectance" [ 360 0.5 830 0.5 ]'
    )


@pytest.mark.parametrize("seed", range(32))  # benchmarks/random_exports.py tries as many as you like
def test_random_material_through_every_exporter(seed):
    exported_everywhere(random_surface(seed))


def exported_everywhere(surface) -> Counter[str]:
    """How many targets write `surface` and how many refuse it, each file or sentence looked at."""
    ended: Counter[str] = Counter()
    for target in exporters.names():
        try:
            made = exporters.export(target, surface, FEW)
        except BrdfguideError as refusal:
            assert isinstance(refusal, NoAnswer) and len(str(refusal)) > 40 and str(refusal).count("\n") == 0, refusal
            ended["refused"] += 1
            continue
        assert made.statement.status in ("exact", "refit", "lossy") and made.statement.rms_ln >= 0
        if isinstance(made.content, str):
            assert not out_of_range(made.content), (target, surface.model.name)
        if target in ("gltf",):
            json.loads(made.content)
        ended[made.statement.status] += 1
    return ended


def test_number_outside_its_range_never_reaches_a_file():
    for bad in (1.0001, -1e-9, float("nan"), float("inf")):
        with pytest.raises(NoAnswer, match="outside 0..1"):
            number(bad, 0.0, 1.0, "roughness")


def test_too_large_an_error_writes_nothing():
    with pytest.raises(NoAnswer, match="more than --max-export-error 0.01; nothing was written"):
        exporters.export("gltf", EVERY_LAW["ward"], most=0.01)
    assert exporters.export("gltf", EVERY_LAW["ward"], most=0.5)


def test_unknown_target_names_the_nearest():
    with pytest.raises(InputError, match="did you mean mitsuba"):
        exporters.get("mitsubu")


def test_spec_without_a_file_is_refused(tmp_path):
    law = EVERY_LAW["ggx"]
    with pytest.raises(InputError, match="is not TARGET:FILE"):
        exporters.export_to("mitsuba", law)
    statement, document = exporters.export_to(f"mitsuba:{tmp_path}/a.xml", law)
    assert document["files"] == [f"{tmp_path}/a.xml"] and document["rms_ln"] == statement.rms_ln
    assert statement.target == "mitsuba" and (tmp_path / "a.xml").read_text().startswith("<!--")


def test_value_out_of_bounds_is_refused():
    law = EVERY_LAW["ggx"]
    with pytest.raises(InputError, match="ggx.alpha = -1 is outside"):
        exporters.export_to("mitsuba:x.xml", law.with_value("ggx.alpha", -1.0))
    with pytest.raises(InputError, match="2 values for 3 channels"):
        three = replace(law, channels=("R", "G", "B"))
        exporters.export_to("mitsuba:x.xml", three.with_value("ggx.n", np.array([1.5, 1.6])))


def test_comment_holds_command_version_colour_and_cost():
    from brdfguide import __version__

    law = EVERY_LAW["paint"]
    made = exporters.export(
        "usd",
        ColouredSurface(
            law.model, law.values, law.channels, law.wavelength, "paint", "brdfguide export paint.json --to usd"
        ),
    )
    for words in (
        f"brdfguide {__version__}",
        "command: brdfguide export paint.json --to usd",
        "colour: channels red, green and blue",
        "usd: refit, ",
    ):
        assert words in made.content
