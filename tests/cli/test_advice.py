"""The commands that need no measurement: recommend, materials, index, albedo, gloss; and recommend with one."""

import io
import json
from contextlib import chdir, redirect_stderr, redirect_stdout
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest

from brdfguide import models
from brdfguide.cli import main
from brdfguide.cli._described import answered_description

from ..conftest import ROOT


def run(*words: str, stdin: str = "", status: int = 0) -> SimpleNamespace:
    """The command in this process: the same door, without the seconds that Python takes to start."""
    out, err = io.StringIO(), io.StringIO()
    with (
        redirect_stdout(out),
        redirect_stderr(err),
        mock.patch("sys.stdin", io.TextIOWrapper(io.BytesIO(stdin.encode()))),
        chdir(ROOT),
        pytest.raises(SystemExit) as end,
    ):
        main(list(words))
    assert (end.value.code or 0) == status, err.getvalue()
    return SimpleNamespace(stdout=out.getvalue(), stderr=err.getvalue())


def answer(*words: str, stdin: str = "", status: int = 0) -> dict:
    return json.loads(run(*words, "--json", stdin=stdin, status=status).stdout)


@pytest.mark.parametrize(
    "words",
    [
        "porcelain --json --no-timing",
        "--full Gold_Leaf --no-timing",
        "--explain -q examples/mug.yaml --no-timing",
        "hair.yaml",
        "hair.yaml --anyway --json --no-timing",
        "hair.yaml --json",
    ],
)
def test_an_answer_without_the_full_parser_is_the_same(words, tmp_path):
    (tmp_path / "hair.yaml").write_text("structure: hair\n")
    status = int(words.startswith("hair") and "--anyway" not in words)
    words = words.replace("hair", str(tmp_path / "hair"))

    def said(*before: str) -> SimpleNamespace:
        return run(*before, "recommend", *words.split(), status=status)

    with mock.patch("brdfguide.cli._app.build", side_effect=AssertionError):
        quickly = said()
    assert quickly == said("--debug")


@pytest.mark.parametrize(
    "words",
    [
        "nosuch",
        "examples/rough_plastic.csv",
        "porcelain --json --full",
        "porcelain gold-leaf",
        "-",
        "--help",
        "--json --json",
    ],
)
def test_all_else_is_left_to_the_full_parser(words):
    assert answered_description(words.split()) is None


def test_a_name_gives_a_pick_with_numbers_ready_to_type():
    found = answer("recommend", "gold-leaf")
    assert (
        found["schema"] == "brdfguide/recommend/1"
        and found["verdict"]["kind"] == "metal"
        and found["domain"]["status"] == "inside"
    )
    pick = found["candidates"][0]
    assert found["recommended"] == pick["model"]
    for each in found["candidates"]:
        assert set(each["start"]) <= set(models.get(each["model"]).parameters)
        assert each["why"] and each["cannot"] and each["time_per_sample_ns"] > 0
    assert found["material"]["n"] == {
        "value": [0.156, 0.424, 1.383],
        "from": "rule",
        "rule": "index_of_composition",
        "section": "5.1, Table 1",
    }


def test_what_is_printed_can_be_typed_into_evaluate():
    pick = answer("recommend", "porcelain")["candidates"][0]
    words = [f"{key}={value if not isinstance(value, list) else value[0]}" for key, value in pick["start"].items()]
    out = run("evaluate", pick["model"], *words, "--theta-i", "30", "--theta-r", "30").stdout
    assert out


def test_text_and_json_say_the_same_and_two_runs_are_alike():
    first, second = (run("recommend", "brass", "--no-timing").stdout for _ in range(2))
    assert first == second
    found = answer("recommend", "brass", "--no-timing")
    assert f"recommended: {found['recommended']}" in first
    assert found == answer("recommend", "brass", "--no-timing")


def test_explain_lists_the_silent_rules_too():
    silent = answer("recommend", "brass", "--explain")["silent"]
    assert answer("recommend", "brass")["silent"] == []
    text = run("recommend", "brass", "--explain").stdout
    assert silent and all(each["rule"] in text for each in silent)


def test_a_description_on_standard_input():
    found = answer("recommend", "-", stdin="kind: metal\nfinish: satin\n")
    assert found["recommended"] == "ward"


def test_outside_the_domain_there_is_no_recommendation_unless_asked_for():
    done = run("recommend", "-", stdin="structure: hair", status=1)
    assert "outside the guide's domain: hair: not one surface with bumps" in done.stderr
    assert "needs a fibre model" in done.stdout
    assert answer("recommend", "-", stdin="structure: hair", status=1)["candidates"] == []
    assert answer("recommend", "-", "--anyway", stdin="structure: hair")["candidates"]


def test_several_bad_files_are_named_at_once(tmp_path):
    for name, text in (("a.yaml", "knid: metal"), ("b.yaml", "f0: 2")):
        (tmp_path / name).write_text(text)
    done = run("recommend", str(tmp_path / "a.yaml"), str(tmp_path / "b.yaml"), status=2)
    assert "a.yaml:1:1: no key called 'knid'" in done.stderr and "b.yaml:1:5: 'f0' is 2" in done.stderr


def test_of_several_measurements_each_is_answered_that_can_be(tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("a,b\n1,2\n")
    files = [str(ROOT / "examples" / "white_paper.csv"), str(bad), str(ROOT / "examples" / "white_paper.csv")]
    words = ("-m", "lambertian,oren-nayar", "--no-numbers")
    done = run("recommend", *files, *words, status=2)
    assert done.stdout.count("recommended: ") == 2 and done.stdout.count("white_paper.csv\n\n") == 2
    assert done.stderr.count("no column for theta_i") == 1
    found = json.loads(run("recommend", *files[:2], *words, "--json", status=2).stdout)
    assert len(found["recommendations"]) == 1
    done = run("recommend", str(bad), str(bad), *words, status=2)
    assert not done.stdout and done.stderr.count("no column for theta_i") == 2


def test_models_of_the_users_choice_are_started_too():
    found = answer("recommend", "rough-plastic", "--models", "lambertian+ward,lambertian+cook-torrance")
    assert [each["model"] for each in found["candidates"]] == ["lambertian+ward", "lambertian+cook-torrance"]
    alpha = found["material"]["alpha"]["value"]
    assert found["candidates"][1]["start"]["cook-torrance.alpha"] == pytest.approx(alpha, rel=1e-3)


def test_a_mistyped_name_gets_the_nearest():
    assert "did you mean porcelain?" in run("recommend", "porcelin", status=2).stderr
    assert "no model called" in run("recommend", "brass", "--models", "wrad", status=2).stderr


def test_with_a_measurement_the_fit_decides_and_the_eye_is_compared(tmp_path):
    (tmp_path / "it.yaml").write_text("kind: metal\nfinish: mirror\n")
    found = answer(
        "recommend",
        str(tmp_path / "it.yaml"),
        "examples/rough_plastic.csv",
        "--models",
        "lambertian+ggx,lambertian+ward",
        "-q",
    )
    assert found["schema"] == "brdfguide/recommend/1" and found["ranking"] and found["advice"]
    assert found["recommended"] in [each["candidate"] for each in found["ranking"]]
    assert {each["code"] for each in found["disagreements"]} >= {"kind-disagrees"} or found["measured_verdict"][
        "kind"
    ] == "cannot tell from this"


def test_what_was_measured_is_the_answer_and_stands_above_what_was_described(tmp_path):
    """The description's own pick stood first, under the same word."""
    for words, below in (("finish: mirror\n", "alone: "), ("structure: hair\n", "alone no model is recommended: ")):
        (tmp_path / "it.yaml").write_text(f"kind: dielectric\n{words}")
        said = run("recommend", str(tmp_path / "it.yaml"), "examples/rough_plastic.csv", "-m", "lambertian+ggx").stdout
        assert said.startswith("recommended: lambertian+ggx, typically 9.9 % off")
        assert said.index("eye against instrument") < said.index("rank ") < said.index(f"by the description {below}")
        assert said.count("recommended: ") == 1 + ("hair" in words)


def test_measurements_named_in_a_description_are_read_beside_it(tmp_path):
    (tmp_path / "scan.csv").write_text((ROOT / "examples" / "rough_plastic.csv").read_text())
    (tmp_path / "it.yaml").write_text("kind: dielectric\nfinish: satin\nmeasurements: scan.csv\n")
    found = answer("recommend", str(tmp_path / "it.yaml"), "--models", "lambertian+ggx", "-q")
    assert (
        found["ranking"][0]["candidate"] == "lambertian+ggx" and found["recommended_by_guidelines"] == "lambertian+ggx"
    )


def test_one_measurement_belongs_to_one_description():
    assert (
        "2 descriptions with a measurement"
        in run("recommend", "brass", "copper", "examples/rough_plastic.csv", status=2).stderr
    )


@pytest.mark.parametrize(
    "words", [("materials",), ("materials", "brass"), ("materials", "--keys"), ("index",), ("albedo",)]
)
def test_lists_come_as_text_and_as_json(words):
    assert run(*words).stdout.count("\n") >= 3
    assert answer(*words)["schema"].startswith("brdfguide/")


def test_index_both_ways():
    assert answer("index", "--f0", "0.04")["entries"][0]["n"] == pytest.approx(1.5)
    assert answer("index", "--n", "1.5")["entries"][0]["f0"] == pytest.approx(0.04)
    absorbing = answer("index", "--n", "1.5", "--k", "0.2")["entries"][0]
    assert absorbing["simplified"]["worst_to_85_deg"] == pytest.approx(0.04 / absorbing["f0"] - 1)  # it was 0
    silver = answer("index", "silver")["entries"][0]
    assert silver["f0"] == pytest.approx(0.9635, abs=5e-5) and silver["wavelength_nm"] is None
    assert [each["wavelength_nm"] for each in answer("index", "gold")["entries"]] == [650, 550, 450]


def test_index_warns_where_eq_2_misleads():
    found = answer("index", "--f0", "0.9211")
    assert found["entries"][0]["n"] == pytest.approx(48.7, abs=0.1) and found["warnings"][0]["code"] == "eq2-on-a-metal"
    assert "0 <= f0 < 1" in run("index", "--f0", "1", status=2).stderr
    assert "did you mean" in run("index", "coper", status=2).stderr
    assert "give one of" in run("index", "gold", "--n", "2", status=2).stderr


def test_albedo_in_each_way():
    assert answer("albedo", "--patch", "neutral 5")["albedo"] == 0.1913
    assert answer("albedo", "--patch", "neutral 5", "--data-set", "iso17321")["albedo"] == 0.2031
    half = answer("albedo", "--between", "white", "black", "--position", "0.5")
    assert half["lightness"] == pytest.approx((96.505 + 20.815) / 2, abs=0.02) and half["albedo"] == pytest.approx(
        0.266, abs=0.002
    )
    assert answer("albedo", "--ratio", "0.3", "--reference", "0.99")["albedo"] == pytest.approx(0.297)
    assert half["warnings"][0]["code"] == "brightness-not-linear"


@pytest.mark.parametrize(
    "words, sentence",
    [
        (("--patch", "neutral 9"), "no neutral patch called 'neutral 9'; did you mean neutral 8"),
        (("--ratio", "2", "--reference", "0.9"), "a reflectance of 1.8; a diffuse surface has at most 1"),
        (("--ratio", "2"), "--ratio and --reference go together"),
        (("--patch", "white", "--between", "white", "black"), "are different comparisons; give one"),
        (("--between", "white", "black", "--position", "2"), "from 0, the first, to 1, the second"),
        (("--data-set", "mine"), "no ColorChecker data set called 'mine'"),
    ],
)
def test_albedo_refuses(words, sentence):
    assert sentence in run("albedo", *words, status=2).stderr


def test_gloss_to_roughness_and_back():
    forward = answer("gloss", "--alpha", "0.05", "--lobe", "ggx")["gloss_gu"]["ggx"]
    words = [word for angle, value in forward.items() for word in (f"--at-{angle}", str(value))]
    back = answer("gloss", *words, "--lobe", "ggx")
    assert (
        back["agrees"]
        and back["fits"][0]["alpha"] == pytest.approx(0.05, rel=0.01)
        and back["fits"][0]["n"] == pytest.approx(1.5, abs=0.01)
    )


def test_gloss_at_the_end_of_the_indices_is_no_answer():
    done = run("gloss", "--at-60", "15", "--at-85", "25", status=1)
    assert "no single lobe gives these readings" in done.stderr


def test_stainless_steel_is_no_iron():
    found = answer("recommend", "-", stdin="composition: 316L stainless steel\nfinish: mirror\n")
    n, k = (found["material"][key]["value"][1] for key in ("n", "k"))
    assert ((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k) == pytest.approx(0.65, abs=0.011)
    told = run("recommend", "-", "--full", stdin="composition: stainless steel").stdout
    assert "stands for 304 and 316" in " ".join(told.split())


def test_gloss_that_no_lobe_gives_is_no_answer():
    done = run("gloss", "--at-20", "80", "--at-60", "30", status=1)
    assert "not averaged" in done.stderr
    assert "outside ISO 2813" in run("gloss", "--at-60", "500", status=2).stderr
    assert "give readings" in run("gloss", status=2).stderr


def test_no_number_is_infinite_or_nan():
    for name in ("retro-tape", "silicon-wafer", "metallic-paint"):
        text = run("recommend", name, "--json").stdout
        assert "NaN" not in text and "Infinity" not in text
        assert np.isfinite(json.loads(text)["candidates"][0]["time_per_sample_ns"])


@pytest.mark.parametrize("suffix, begins", [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_the_candidates_can_be_drawn(tmp_path, suffix, begins):
    run("recommend", "metallic-paint", "--plot", str(tmp_path / f"it.{suffix}"))
    assert (tmp_path / f"it.{suffix}").read_bytes().startswith(begins)


def test_plot_and_report_say_what_they_want(tmp_path):
    assert "show one answer" in run("recommend", "brass", "copper", "--plot", str(tmp_path / "it.png"), status=2).stderr


def test_red_of_a_described_surface_is_at_one_wavelength():
    from brdfguide.face.surfaces import described
    from brdfguide.physics.colour import SRGB_UM

    gold = described("gold-leaf")
    assert gold.channels == ("R", "G", "B") and tuple(gold.wavelength) == SRGB_UM


# --- how well a number need be known for the eye -----------------------------------------------------------


def test_the_pick_says_which_change_begins_to_show():
    found = answer("recommend", "office-paper")
    first, *others = found["candidates"]
    assert 0.05 < first["shows_from"]["lambertian.albedo"] < 0.15 and "ggx.k" not in first["shows_from"]
    assert not any("shows_from" in each for each in others)
    assert "for the eye: a change shows from 8.6 % of lambertian.albedo" in run("recommend", "office-paper").stdout


def test_gloss_says_it_for_its_body():
    light, black = (answer("gloss", "--alpha", "0.1", "--albedo", albedo) for albedo in ("0.3", "0"))
    assert light["alpha_shows_from"]["ggx"] > 1.3 * black["alpha_shows_from"]["ggx"] > 0.1
    text = run("gloss", "--alpha", "0.1", "--albedo", "0.3").stdout
    assert "on a body of albedo 0.3: alpha shows from a change of" in text
    readings = answer("gloss", "--at-60", "85", "--at-20", "55")
    assert all(0.1 < fit["alpha_shows_from"] < 1 for fit in readings["fits"])
    assert "on a black body" in run("gloss", "--at-60", "85", "--at-20", "55").stdout


def test_roughness_says_it_for_three_surfaces():
    assert answer("roughness", "--angle", "75")["slopes"]["shows_from"]["bare metal"] == 0.035
    assert "a change of sigma/tau shows from 3.5 % on a bare metal, 16 %" in run("roughness", "--angle", "75").stdout


@pytest.mark.parametrize("angle, percent_a_degree", [(45, 1.7), (60, 2.7), (75, 6.4), (83, 18)])
def test_roughness_says_what_an_error_of_the_angle_does(angle, percent_a_degree):
    doubt = answer("roughness", "--angle", str(angle), "--angle-error", "0.1")["doubt"]
    width = np.log(doubt["high"] / doubt["low"]) / (2 * 1.96 * 0.1)
    assert doubt["of"] == "sigma_um" and 100 * width == pytest.approx(percent_a_degree, rel=0.15)
    usual, stated = (answer("roughness", "--angle", str(angle), *more) for more in ((), ("--angle-error", "2")))
    assert usual == stated and usual["doubt"]["low"] < usual["criterion"]["sigma_um"]


def test_roughness_near_grazing_has_no_upper_end():
    assert answer("roughness", "--angle", "86")["doubt"]["high"] is None
    assert "sigma lies above" in run("roughness", "--angle", "86").stdout
