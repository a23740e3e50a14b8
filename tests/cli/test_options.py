"""Every option of every command acts, or is refused where it could not: the table beside it has a row for each.

The options are listed from the parser itself, so that a new one without a row fails here.
"""

import io
import json
import shlex
import shutil
from contextlib import chdir, redirect_stderr, redirect_stdout
from functools import cache
from pathlib import Path
from unittest import mock

import numpy as np
import pytest
from typer.main import get_command

from brdfguide import catalog
from brdfguide.cli import main
from brdfguide.cli._app import build

from .. import schemas
from ..conftest import ROOT
from ..data.formats.containers import rgl_fields, tensor_file
from ..photographs.charts import codes, desk
from ..photographs.pictures import write_codes
from ..surfaces import dome_run, geometry, table, value
from .option_table import ACTS, EXEMPT, LINES, READING, SOONER
from .refused_options import EVERY_REFUSED


def options() -> list[str]:
    """ "COMMAND --option" for every option of the program, with the name that stands first."""
    group = get_command(build(catalog.names("cli")))
    found = [f" {parameter.opts[0]}" for parameter in group.params]
    for name, command in group.commands.items():
        found += [f"{name} {each.opts[0]}" for each in command.params if each.param_type_name == "option"]
    return sorted(found)


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> dict[str, str]:
    """Small inputs on which the options matter, by the name that stands for them in a command line."""
    folder = tmp_path_factory.mktemp("options")
    theta_i, theta_r, phi, grey = dome_run("satin plastic", seed=1)
    geom = geometry(theta_i, theta_r, phi)
    colours = [
        value(geom, albedo, width, 0.04)[:, 0] * grey / grey.mean() for albedo, width in ((0.5, 0.15), (0.1, 0.3))
    ]
    header = ("theta_i", "theta_r", "phi_r", "R", "G", "B")
    (folder / "dome.csv").write_text(table(header, theta_i, theta_r, phi, grey, *colours))
    some = slice(None, None, 7)
    few = (each[some] for each in (theta_i, theta_r, phi, grey, 0.2 * theta_i + 1))
    (folder / "doubtful.csv").write_text(table((*header[:3], "brdf", "stderr"), *few))
    away = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_cos, -1, 1)))[:, 0]  # from the light
    tape = table((*header[:3], "brdf"), theta_i, theta_r, phi, 0.1 * grey + 8 * np.exp(-((away / 4) ** 2)))
    (folder / "tape.csv").write_text(tape)
    both = table(
        ("paint", *header[:3], "brdf"),
        np.repeat([1.0, 2.0], len(theta_i[some])),
        *(np.tile(each[some], 2) for each in (theta_i, theta_r, phi)),
        np.r_[grey[some], 2 * grey[some]],
    )
    (folder / "paints.csv").write_text(both)
    near = (theta_i <= 20) & (theta_r <= 20)
    small = table((*header[:3], "brdf"), theta_i[near] / 20, theta_r[near] / 20, phi[near] / 100, grey[near])
    (folder / "small.csv").write_text(small)
    grained = table(
        ("sample_rotation", *header[:3], "brdf"),
        np.repeat([0.0, 30.0], len(theta_i[some])),
        *(np.tile(each[some], 2) for each in (theta_i, theta_r, phi)),
        np.r_[grey[some], 1.1 * grey[some]],
    )
    (folder / "grained.csv").write_text(grained)
    (folder / "turned.bsdf").write_bytes(tensor_file(**rgl_fields(3, phis=5)))
    angles = np.r_[-70.0:0.0:7.0, 11.0:80.0:7.0]
    x = np.abs(np.sin(np.radians(angles)) - np.sin(np.radians(5)))
    (folder / "mirror.csv").write_text(
        table(("aoi", "theta_s", "brdf"), 0 * angles + 5, angles, 1e-4 / (1e-5 + x**1.8))
    )
    (folder / "whole").mkdir()
    (folder / "whole" / "describe.sh").write_text("it was there before")
    (folder / "hair.yaml").write_text("structure: hair\n")
    write_codes(folder / "desk.png", codes(desk((0.5, 0.3, 0.1))))
    (folder / "angles.txt").write_text("80\n75 slope=0.2\n")
    (folder / "dimmed.csv").write_text("theta_deg,R,G,B\n60,0.03,0.01,0.001\n75,0.28,0.18,0.08\n85,0.71,0.63,0.5\n")
    several(folder)
    names = {path.stem: str(path) for path in sorted(folder.iterdir())}
    names["fit"] = str(folder / "fit.json")
    names["answers"] = str(folder / "answers")
    run("fit {few} --recurse -m lambertian+ward --no-timing --out {answers}", names)
    run("collect {answers} -o {answers}/../all.csv", names)
    names["left"] = left_behind(folder)
    (folder / "rim.yaml").write_text("directions:\n  - {theta_i_deg: 60, theta_r_deg: 0}\n")
    names["rim"] = str(folder / "rim.yaml")
    status, out, _ = run(LINES["fit"], names)
    assert status < 2
    (folder / "fit.json").write_text(out)
    return names | {"out": str(folder / "out"), "there": str(folder / "out" / "there.csv")}


def left_behind(folder: Path) -> str:
    """A folder of answers of which one has lost its data."""
    lost, names = folder / "lost.csv", {"left": str(folder / "left")}
    lost.write_text((folder / "dome.csv").read_text().rpartition("\n")[0].rpartition("\n")[0] + "\n")
    run(f"fit {lost} {folder}/dome.csv -m lambertian --no-timing --out {{left}}", names)
    lost.write_text("gone")
    return names["left"]


def several(folder: Path) -> None:
    """A folder with others in it, and lists of files."""
    (folder / "few" / "deep").mkdir(parents=True)
    for place in (
        folder / "few" / "dome.csv",
        folder / "few" / "doubtful.csv",
        folder / "few" / "deep" / "doubtful.csv",
    ):
        shutil.copy(folder / place.name, place)
    (folder / "few" / "notes.txt").write_text("nothing measured\n")
    (folder / "list").write_text(f"{folder / 'dome.csv'}\n{folder / 'doubtful.csv'}\n")
    (folder / "zeros").write_text(f"{folder / 'dome.csv'}\0{folder / 'doubtful.csv'}\0")
    (folder / "empty").write_text("")


def run(line: str, files: dict[str, str]) -> tuple[int, str, str]:
    """Status, standard output with the files written, and standard error, of a command line in this process."""
    out, err = io.StringIO(), io.StringIO()
    words = shlex.split(line.format(**files))
    with (
        redirect_stdout(out),
        redirect_stderr(err),
        mock.patch("sys.argv", ["brdfguide"]),
        chdir(ROOT),
        pytest.raises(SystemExit) as end,
    ):
        main(words)
    text = out.getvalue()
    if text.startswith('{\n  "schema"'):
        assert not schemas.wrong(json.loads(text)), line
    return end.value.code or 0, text, err.getvalue()


@cache
def answer(line: str, files: tuple[tuple[str, str], ...], turn: int = 1) -> tuple[int, str, str]:
    """Status, standard output followed by every file that is there afterwards, and standard error.

    A file stands in the way beforehand. `turn` counts the runs of one line.
    """
    folder = emptied(dict(files))
    (folder / "there.csv").write_text("it was there before")
    status, out, err = run(line, dict(files))
    written = [f"{path.name}: {path.read_bytes()!r}" for path in sorted(folder.rglob("*")) if path.is_file()]
    return status, "\n".join([out, *written]), err


def emptied(files: dict[str, str]) -> Path:
    """The folder to write in, with nothing in it."""
    folder = Path(files["out"])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def test_every_option_has_a_row():
    known = {f"{command} {option}" for command, rows in ACTS.items() for option in rows}
    missing = [
        each for each in options() if each not in known and each not in SOONER and each.split()[-1] not in EXEMPT
    ]
    assert not missing, "what does it change, on which input? add a row to ACTS"
    assert not known - set(options()), "rows of options that are no more"


def _typed_once(line: str, more: str) -> str:
    """Both, the first without the options and values that the second has: most are taken once."""
    words = line.split()
    for option in (word for word in more.split() if word.startswith("-")):
        if option in words and option not in ("-m", "--models"):
            place = words.index(option)
            del words[place : place + 2]
    return " ".join([*words, more])


@pytest.mark.parametrize("each", [f"{command} {option}" for command, rows in ACTS.items() for option in rows])
def test_an_option_changes_the_answer(each, files):
    command, option = each.rsplit(" ", 1)
    row = ACTS[command][option]
    line = LINES[command] if row.line is None else row.line
    names = tuple(files.items())
    without = answer(line, names)
    again = without if row.shows or row.hides else answer(line, names, 2)
    with_it = answer(row.instead or _typed_once(line, row.more), names)
    assert with_it[0] != 2, with_it[2]
    if row.shows or row.hides:
        for word, there, not_there in ((row.shows, with_it, without), (row.hides, without, with_it)):
            assert word is None or (word in there[1] and word not in not_there[1])
        return
    assert with_it[:2] != without[:2]
    assert again == without, "the answer differs from run to run: the comparison says nothing"


@pytest.mark.parametrize("line", EVERY_REFUSED)
def test_an_option_without_effect_is_refused(line, files):
    folder = emptied(files)
    status, out, err = run(line, files)
    assert status == 2 and out == "", err
    assert err.startswith("brdfguide: ") and err.count("\n") == 1 and EVERY_REFUSED[line].format(**files) in err
    assert not list(folder.iterdir()), "something was written all the same"


# --- one request, whichever road ---------------------------------------------------------------------------

ROADS = sorted({*READING, "--models", "--kind", "--metric", "--close", "--weights", "--robust", "--per-channel-shape"})
ROADS += ["--fix", "--start", "--aperture-deg", "--anyway", "--no-timing"]


@pytest.mark.parametrize("option", ROADS)
def test_a_file_among_many_gets_the_answer_it_gets_alone(option, files):
    row = ACTS["fit"][option]
    line = row.line or LINES["fit"]
    name = next(word for word in line.split() if word[0] == "{").strip("{}")
    typed = f"{line} {row.more} --no-timing --json"
    alone = json.loads(answer(typed, tuple(files.items()))[1].rpartition("there.csv")[0])
    status, out, _ = run(typed.replace(f"{{{name}}}", f"{{{name}}} examples/rough_plastic.csv", 1), files)
    rows = json.loads(out)["rows"]
    assert rows[0]["fit"] == alone


def test_every_option_about_reading_and_fitting_is_part_of_the_answers_key(files, tmp_path):
    for option in ROADS:
        row = ACTS["fit"][option]
        run(f"{row.line or LINES['fit']} --out {tmp_path}", files)
        before = {path.name for path in tmp_path.glob("*/*/*")}
        run(f"{row.line or LINES['fit']} {row.more} --out {tmp_path}", files)
        assert {path.name for path in tmp_path.glob("answers/*/*")} - before, (
            f"{option}: the old answer was taken for the new one"
        )


@pytest.mark.parametrize(
    "line",
    [
        "fit {dome} {doubtful} -m lambertian+ward --aperture-deg 3 --metric cube-root --json --no-timing",
        "fit {paints} --group paint -m lambertian+ward --json --no-timing",
    ],
)
def test_processes_change_no_answer(line, files):
    assert run(f"{line} --jobs 2", files) == run(line, files)


@pytest.mark.parametrize("words", ["{dome} {doubtful}", "{paints} --group paint"])
def test_what_was_answered_is_not_fitted_again(words, files, tmp_path):
    line = f"fit {words} -m lambertian --no-timing --out {tmp_path}"
    first, again = run(line, files), run(line, files)
    lines = first[1].splitlines()
    assert sum(line.endswith(("  answered", "  no trustworthy answer")) for line in lines) == 2, first[1]
    assert again[1] == first[1].replace("answered\n", "answered before\n")
