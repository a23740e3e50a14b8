"""What is typed counts, or is refused by name: options given twice, ranges without an angle, words for surfaces."""

import pytest

from brdfguide.cli import main


def told(capsys, *words) -> tuple[int, str]:
    """Exit status, and what was said on stderr."""
    try:
        status = main([str(word) for word in words]) or 0
    except SystemExit as ended:
        status = int(ended.code or 0)
    return status, capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ("gloss", "--at-60", "50", "--at-60", "60"),
        ("roughness", "--angle", "75", "--angle=60"),
        ("fit", "examples/white_paper.csv", "--metric", "ln", "--metric", "seen"),
        ("evaluate", "ggx", "--theta-i", "10", "--theta-i", "20"),
    ],
)
def test_an_option_that_takes_one_value_is_given_once(capsys, words):
    status, said = told(capsys, *words)
    option = next(word for word in words if word.startswith("--"))
    assert (status, said) == (2, f"brdfguide: {option} is given twice, and only one could count\n")


def test_repeatable_options_and_switches_are_given_as_often_as_one_likes(capsys, tmp_path):
    words = ("ggx.alpha=0.3", "--to", "glsl", "-o", tmp_path / "it.glsl", "-q", "-q")
    assert told(capsys, "export", "--model", "ggx", *words)[0] == 0
    assert told(capsys, "bench", "-m", "ggx", "-m", "lambertian", "--json")[0] == 0


def test_a_switch_is_refused_by_the_name_that_was_typed(capsys):
    words = ("fit", "examples/white_paper.csv", "examples/rough_plastic.csv", "-m", "lambertian")
    for typed in ("--no-numbers", "--numbers"):
        status, said = told(capsys, *words, typed)
        assert (status, said[: len(typed) + 12]) == (2, f"brdfguide: {typed}:")


def test_a_range_without_an_angle_is_refused(capsys):
    status, said = told(capsys, "evaluate", "ggx", "--theta-i", "80:10:5")
    assert status == 2
    assert "--theta-i 80:10:5: wanted degrees such as" in said


@pytest.mark.parametrize(
    ("word", "near"), [("gold", "gold-leaf"), ("porcelan", "porcelain"), ("lambertain", "lambertian")]
)
@pytest.mark.parametrize("command", ["numbers", "preview", "compare"])
def test_a_word_for_a_surface_may_be_a_model_or_a_material(capsys, command, word, near):
    more = {"numbers": (), "preview": ("-o", "it.png"), "compare": ("ggx",)}[command]
    status, said = told(capsys, command, word, *more)
    assert status == 2
    assert f"no model or material called '{word}'; did you mean {near}" in said


def test_export_takes_a_surface_in_one_word_as_the_others_do(capsys, tmp_path):
    one, other = tmp_path / "one.glsl", tmp_path / "other.glsl"
    assert told(capsys, "export", "ggx ggx.alpha=0.3", "--to", "glsl", "--name", "it", "-o", one)[0] == 0
    assert (
        told(capsys, "export", "--model", "ggx", "ggx.alpha=0.3", "--to", "glsl", "--name", "it", "-o", other)[0] == 0
    )
    code = [[line for line in path.read_text().splitlines() if not line.startswith("//")] for path in (one, other)]
    assert code[0] == code[1]
    status, said = told(capsys, "export", "ggx.alpha=0.3", "--to", "glsl", "-o", one)
    assert status == 2
    assert "ggx.alpha=0.3 needs --model beside it" in said


@pytest.mark.parametrize(
    "words", [("--residuals", "{0}"), ("--export", "csv:{0}"), ("--residuals", "{{parent}}/{{stem}}.csv")]
)
@pytest.mark.parametrize("many", [1, 2])
def test_what_is_read_is_not_written(capsys, tmp_path, monkeypatch, words, many):
    monkeypatch.chdir(tmp_path)
    files = [tmp_path / "d" / f"{place}.csv" for place in range(many)]
    files[0].parent.mkdir()
    for file in files:
        file.write_text("theta_i,theta_r,brdf\n" + "".join(f"30,{angle},0.2\n" for angle in range(-70, 71, 10)))
    before = files[0].read_bytes()
    status, said = told(capsys, "fit", *files, "-m", "lambertian", *(word.format(files[0]) for word in words))
    assert (status, files[0].read_bytes()) == (2, before)
    assert "it is read as well, and would be lost" in said or "wanted {stem} in it" in said
