"""`compare`: what it is given, what it says, what it refuses; and S beside an export's error."""

import json

import pytest

from ..data.formats.containers import rgl_fields, tensor_file
from .test_advice import answer, run

ONE, OTHER = "lambertian+ggx ggx.alpha=0.1 lambertian.albedo=0.3", "lambertian+ggx ggx.alpha=0.2 lambertian.albedo=0.3"
DATA = "examples/rough_plastic.csv"


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    path = tmp_path_factory.mktemp("fit") / "fit.json"
    path.write_text(run("fit", DATA, "-m", "lambertian+ggx,lambertian+ward", "--json", "--no-timing").stdout)
    return path


def test_lambert_against_lambert_is_the_number_by_hand():
    found = answer("compare", "lambertian lambertian.albedo=0.5", "lambertian lambertian.albedo=0.6")
    assert found["seen"] == pytest.approx(5.05, rel=5e-3) and found["seen_weights"] == "quadrature"
    assert found["schema"] == "brdfguide/compare/1" and found["directions"] == 4062


def test_the_answer_comes_first_then_what_changes_and_where():
    text = run("compare", ONE, OTHER).stdout
    first, *rest = text.splitlines()
    assert first.startswith("seen 4.0 L*: hardly different side by side (below 5), weights: quadrature")
    assert rest[:2] == [f"  A: {ONE}", f"  B: {OTHER}"]
    for words in (
        "half of the difference lies within 5 deg of the mirror",
        "most of all at",
        "on the sphere",
        "lamp",
    ):
        assert words in text


def test_a_measurement_against_its_fit_is_the_s_that_the_fit_printed(fitted):
    row = json.loads(fitted.read_text())["ranking"][0]
    found = answer("compare", DATA, f"{fitted}#{row['candidate']}")
    assert found["seen"] == pytest.approx(row["seen"], rel=1e-6) and found["seen_weights"] == "ring"


def test_several_are_put_in_order(fitted):
    found = answer("compare", DATA, "lambertian", str(fitted), f"{fitted}#lambertian+ward")
    assert [each["surface"] for each in found["ranking"]] == [str(fitted), f"{fitted}#lambertian+ward", "lambertian"]
    assert [each["before_it"] for each in found["ranking"]] == [None, "clearly closer", "alike to the eye"]
    text = run("compare", DATA, "lambertian", str(fitted), f"{fitted}#lambertian+ward").stdout
    assert "nearest first" in text and "clearly farther" in text


def test_a_surface_against_its_file(tmp_path):
    found = answer("compare", ONE, "--to", "gltf")
    exported = answer("export", "--model", *ONE.split(), "--to", "gltf", "-o", str(tmp_path / "it.gltf"))
    assert found["seen"] == pytest.approx(exported["seen"], rel=1e-9)
    assert exported["seen_words"] == found["seen_words"] and found["surfaces"][1] == "what gltf shows (refit)"


def test_an_exported_table_is_read_and_compared(tmp_path):
    path = tmp_path / "it.bsdf"
    run("export", "--model", *ONE.split(), "--to", "rgl", "-o", str(path), "-q")
    assert answer("compare", ONE, str(path))["seen"] < 0.1


def test_the_sentence_of_an_export_gives_both_errors(tmp_path):
    said = run("export", "--model", "lambertian+ward", "--to", "gltf", "-o", str(tmp_path / "it.gltf")).stderr
    assert "rms ln" in said and " L* over" in said
    assert said.splitlines()[0] in (tmp_path / "it.gltf").read_text()


def test_two_spheres_and_their_difference_are_drawn(tmp_path):
    path = tmp_path / "pair.png"
    said = run("compare", ONE, OTHER, "--plot", str(path)).stderr
    assert path.read_bytes().startswith(b"\x89PNG") and f"wrote {path}" in said
    before = path.read_bytes()
    run("compare", ONE, OTHER, "--plot", str(path), "-q")
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "words, sentence",
    [
        (["ggx"], "one surface has nothing to be compared with; name two, or a target with --to"),
        (["ggx", "nothing.csv"], "nothing.csv: there is no such file"),
        (["ggx", "gxx"], "no model or material called 'gxx'; did you mean ggx?"),
        (["ggx", "ggx ggx.alpha=9"], "alpha = 9 is outside"),
        ([DATA, "examples/metallic_paint.csv"], "measured at different directions, and between them there is nothing"),
        ([DATA, "ggx", "--plot", "it.png"], "--plot: rough_plastic.csv holds measured directions"),
        ([f"{DATA} x=1", "ggx"], "a data file stands alone, without parameters"),
        (["ggx", "--to", "gltff"], "did you mean gltf or gltf-pbr?"),
    ],
)
def test_bad_input_is_one_sentence(words, sentence):
    found = run("compare", *words, status=2)
    assert sentence in found.stderr and found.stderr.count("\n") == 1 and found.stdout == ""


def test_a_mirror_alone_has_no_s_as_a_file():
    assert "a mirror is written as its reflectance" in run("compare", "mirror", "--to", "gltf", status=1).stderr


def test_a_surface_outside_the_guide_is_compared_anyway(tmp_path):
    path = tmp_path / "turned.bsdf"
    path.write_bytes(tensor_file(**rgl_fields(3, phis=5)))
    assert "azimuths" in run("compare", str(path), "ggx", status=2).stderr
    assert answer("compare", str(path), "ggx", "--anyway")["seen"] > 0


def test_two_that_look_alike_themselves_are_alike_however_their_s_compare():
    """S of 2.8 and 4.2 from the first, 1.5 times as much, but 1.5 between the two."""
    first, *others = (f"lambertian+ward ward.alpha={alpha}" for alpha in (0.10, 0.135, 0.16))
    nearer, farther = answer("compare", first, *others)["ranking"]
    assert farther["seen"] > 1.25 * nearer["seen"] and answer("compare", *others)["seen"] < 2.5
    assert farther["before_it"] == "alike to the eye"
