"""What `import brdfguide` gives, used as a notebook uses it, and read as a type checker reads it."""

import subprocess
import sys
from functools import cache

import numpy as np
import pytest

import brdfguide
from brdfguide import errors

from .conftest import ROOT

SAMPLE = ROOT / "examples" / "rough_plastic.csv"
TWO = ("lambertian+ggx", "lambertian+ward")


@cache
def answer():
    return brdfguide.fit(brdfguide.read(SAMPLE), TWO)


def test_everything_promised_is_there_and_nothing_is_loaded_before_it_is_asked_for():
    code = (
        "import sys, brdfguide; print(sorted(set(brdfguide.__all__) - set(dir(brdfguide))), 'numpy' in sys.modules);"
        "print([hasattr(brdfguide, each) for each in brdfguide.__all__], hasattr(brdfguide, 'no_such_name'))"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert run.stdout.split("\n")[0] == "[] False"
    assert run.stdout.split("\n")[1] == f"{[True] * len(brdfguide.__all__)} False"


def test_a_measurement_shows_what_it_is_and_what_was_noticed():
    measurement = brdfguide.read(SAMPLE, theta_max=80)
    assert isinstance(measurement, brdfguide.Measurement)
    head, *notes = repr(measurement).splitlines()
    assert "directions in the plane of incidence" in head and "theta_i 10..75" in head
    assert len(notes) == len(measurement.findings) and any(note.strip().startswith("theta-max:") for note in notes)
    assert brdfguide.read(SAMPLE, aperture_deg=1).solid_angle == pytest.approx(2 * np.pi * (1 - np.cos(np.radians(1))))


def test_a_ranking_shows_itself_as_the_command_does():
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "fit", SAMPLE, "--models", ",".join(TWO), "--json", "--no-timing"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    untimed = brdfguide.fit(SAMPLE, TWO, timing=False)
    printed = subprocess.run(
        [sys.executable, "-m", "brdfguide", "fit", SAMPLE, "--models", ",".join(TWO), "--no-timing", "--no-numbers"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert repr(untimed) + "\n" == printed
    assert untimed.document == __import__("json").loads(run.stdout)
    html = untimed._repr_html_()
    assert html.count("<tr") >= 3 and "recommended" not in html and "<strong>lambertian+ggx</strong>" in html
    assert repr(untimed.ranking).splitlines()[0].strip().startswith("1= lambertian+ggx: rms ln 0.0943")


def test_the_recommended_fit_and_any_other_can_be_had_by_name():
    found = answer()
    assert found.recommended.name == "lambertian+ggx" and found["lambertian+ward"].rms_ln > found.recommended.rms_ln
    assert found.surface is found.recommended.surface
    with pytest.raises(errors.InputError, match="no candidate called 'ward'; there are: lambertian"):
        found["ward"]


def test_the_page_of_a_surface_escapes_what_it_names():
    surface = brdfguide.Surface.named("ggx", {"alpha": 0.2})
    odd = brdfguide.Surface(surface.model, surface.values, ("<b>",))
    assert "<b>" not in odd._repr_html_() and "&lt;b&gt;" in odd._repr_html_()
    assert repr(surface).splitlines()[:2] == ["ggx (550 nm)", "  ggx.alpha = 0.2"]
    assert "spread = 17.19 deg" in repr(brdfguide.Surface.named("oren-nayar", {"spread": 17.19}))


def test_angles_broadcast_and_channels_come_last():
    grey = brdfguide.evaluate("ggx", [[10.0], [45.0]], [30.0, 45.0, 60.0], alpha=0.2, n=1.5)
    assert grey.shape == (2, 3, 1)
    assert grey[1, 1, 0] == brdfguide.evaluate("ggx alpha=0.2 n=1.5", 45, 45)[0]
    assert brdfguide.evaluate("lambertian", 20, -20, albedo=[0.1, 0.2, 0.3]) == pytest.approx(
        np.array([0.1, 0.2, 0.3]) / np.pi
    )
    turned = [brdfguide.evaluate("ggx", 45, 45, phi, alpha=0.2)[0] for phi in (180, 210)]
    assert turned[0] > turned[1]
    waves = [brdfguide.evaluate("he-torrance", 45, 45, wavelength_nm=nm)[0] for nm in (400, 700)]
    assert waves[0] != waves[1]


def test_at_a_measurements_directions_the_fit_reads_what_it_was_fitted_to():
    found = answer()
    ratio = np.log(brdfguide.evaluate(found, found.measurement) / found.measurement.brdf)
    np.testing.assert_allclose(ratio, found.recommended.residuals, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "values", "sentence"),
    [
        (("ggx", 95, 10), {}, "theta_i lies in 0..90"),
        (("ggx", 45), {}, "theta_r is missing"),
        (("gxx", 45, 45), {}, "gxx"),
        (("ggx", 45, 45), {"alpha": 7}, "outside"),
        (("ggx", 45, 45), {"gloss": 7}, "no parameter of ggx called 'gloss'"),
        ((3.0, 45, 45), {}, "wanted a Surface"),
    ],
)
def test_what_cannot_be_evaluated_is_refused_in_a_sentence(arguments, values, sentence):
    with pytest.raises(errors.InputError, match=sentence):
        brdfguide.evaluate(*arguments, **values)


def untimed(document):
    """Without what is measured anew each time."""
    kept = [{k: v for k, v in each.items() if k != "time_per_sample_ns"} for each in document["candidates"]]
    return {**document, "candidates": kept}


def test_a_description_is_a_name_a_mapping_or_keywords():
    by_name = brdfguide.recommend("porcelain")
    assert (
        repr(by_name).startswith("recommended: lambertian+he-torrance, for porcelain\n")
        and by_name.surface.model is by_name.surfaces[0].model
    )
    observed = {"composition": "plastic", "appearance": "clear", "finish": "satin"}
    by_mapping, by_keywords = (
        untimed(each.document) for each in (brdfguide.recommend(observed), brdfguide.recommend(**observed))
    )
    assert by_mapping == by_keywords
    with pytest.raises(errors.InputError, match="finish") as raised:
        brdfguide.recommend(finish="shiny-ish", coat="hair")
    assert len(raised.value.args) == 2 and "coat" in raised.value.args[1], "every mistake at once"
    with pytest.raises(errors.InputError, match="not both"):
        brdfguide.recommend("porcelain", finish="satin")
    with pytest.raises(errors.InputError, match="numbers, words, lists"):
        brdfguide.recommend(finish=object())


def test_a_surface_outside_the_domain_has_no_model_and_says_why():
    outside = brdfguide.recommend(structure="hair")
    assert outside.surfaces == () and "no model is recommended" in repr(outside)
    with pytest.raises(errors.NoAnswer, match="outside the guide's domain"):
        outside.surface  # noqa: B018


def test_an_export_is_text_and_a_file_only_where_a_path_is_given(tmp_path):
    made = brdfguide.export(answer(), "mitsuba")
    assert "<bsdf" in made.content and repr(made).startswith("mitsuba: ")
    brdfguide.export("lambertian", "mitsuba", tmp_path / "white.xml", albedo=0.8)
    assert "0.8" in (tmp_path / "white.xml").read_text()
    with pytest.raises(errors.NoAnswer, match="nothing was written"):
        brdfguide.export("student-t", "gltf", tmp_path / "none.gltf", most_rms_ln=1e-9)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["white.xml"]


def test_a_preview_is_an_array_and_a_picture(tmp_path):
    shown = brdfguide.preview(answer(), "lambertian", size=64, light="back")
    assert shown.pixels.shape == (2, 64, 64, 3) and shown.pixels.dtype == np.uint8 and shown.pixels.std() > 10
    assert shown._repr_png_().startswith(b"\x89PNG") and "lambertian+ggx | lambertian" in repr(shown)
    shown.save(tmp_path / "look.png")
    assert (tmp_path / "look.png").read_bytes() == shown.png
    openexr = pytest.importorskip("OpenEXR")
    shown.save(tmp_path / "look.exr")
    with openexr.File(str(tmp_path / "look.exr")) as file:
        row = file.channels()["RGB"].pixels
    np.testing.assert_array_equal(row, np.concatenate(list(shown.radiance), axis=1).astype(np.float32))
    with pytest.raises(errors.InputError, match="a preview is a .png"):
        shown.save(tmp_path / "look.jpg")
    with pytest.raises(errors.InputError, match="64 to 2048"):
        brdfguide.preview("lambertian", size=9)


NOTEBOOK = """
import numpy as np
import brdfguide
from brdfguide import Measurement, Surface

paint: Measurement = brdfguide.read("paint.csv", theta_max=80.0)
answer = brdfguide.fit(paint, ["lambertian+ggx"], metric="ln")
surface: Surface = answer.surface
values: np.ndarray = brdfguide.evaluate(surface, 45.0, [30.0, 45.0])
text: str | bytes = brdfguide.export(answer, "mitsuba").content
pixels: np.ndarray = brdfguide.preview(surface).pixels
first: Surface = brdfguide.recommend("porcelain").surface
"""
WRONG = "\nbrdfguide.fit(paint, metrik='ln')\nbrdfguide.read(3.5)\nanswer.surfaces\n"


def test_a_type_checker_reads_the_face(tmp_path):
    """Passes a notebook as it should be, and finds each of three mistakes."""
    pytest.importorskip("mypy")
    script = tmp_path / "notebook.py"
    for text, mistakes in ((NOTEBOOK, 0), (NOTEBOOK + WRONG, 3)):
        script.write_text(text)
        run = subprocess.run(
            [sys.executable, "-m", "mypy", "--cache-dir", tmp_path / "cache", "--follow-imports=silent", script],
            cwd=ROOT,
            capture_output=True,
            text=True,
        )
        assert run.stdout.count(": error:") == mistakes, run.stdout


def test_what_the_readme_shows_runs_as_it_stands(tmp_path, monkeypatch):
    block = (ROOT / "README.md").read_text().split("```python\n")[1].split("```")[0]
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    made: dict = {}
    exec(compile(block, "README.md", "exec"), made)
    assert made["answer"].recommended.name == "lambertian+cook-torrance" and (tmp_path / "paint.xml").exists()


# --- compare ---------------------------------------------------------------------------------------------


def test_two_surfaces_are_compared_as_the_command_does():
    words = ("lambertian lambertian.albedo=0.5", "lambertian lambertian.albedo=0.6")
    found = brdfguide.compare(*words)
    assert found.seen == pytest.approx(5.05, rel=5e-3) and found.document["seen"] == found.seen
    run = [sys.executable, "-m", "brdfguide", "compare", *words]
    assert repr(found) + "\n" == subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    surfaces = [brdfguide.recommend(description="porcelain").surface, answer().surface]
    assert brdfguide.compare(*surfaces).seen == brdfguide.compare(*reversed(surfaces)).seen > 1


def test_a_measurement_is_compared_with_its_fit():
    found = brdfguide.compare(answer().measurement, answer())
    row = next(row for row in answer().rows if row.fit is answer().recommended)
    assert found.seen == pytest.approx(row.seen, rel=1e-9) and found.rms_ln > 0
    assert brdfguide.compare(answer().measurement, answer(), aperture_deg=5).seen != found.seen


def test_a_material_takes_the_model_that_stands_behind_it():
    from brdfguide.face.surfaces import named_surface

    found = named_surface("porcelain#lambertian+ggx")
    assert found.model.name == "lambertian+ggx" and found.name == "porcelain lambertian+ggx"
    assert named_surface("porcelain").model.name != found.model.name
