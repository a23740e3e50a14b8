"""Answers as a table, and surfaces found among them by words, numbers and looks."""

import json
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from brdfguide.batch import collected, conditions, described_rows, searching, store
from brdfguide.batch.run import run_tasks
from brdfguide.cli import main
from brdfguide.errors import InputError
from brdfguide.models.looks import looks
from brdfguide.models.surface import Surface
from brdfguide.physics import gloss, seen
from brdfguide.scene import scene as scenes

from .. import patience
from ..conftest import ROOT
from .test_run import some
from .test_store import WORK, Task


def plastic(draw) -> Surface:
    """A body under a rough lobe, in three colours."""
    albedo = draw.uniform(0.03, 0.9) * draw.uniform(0.4, 1.0, 3)
    values = {"albedo": albedo, "ggx.alpha": np.exp(draw.uniform(np.log(0.05), np.log(0.5))), "ggx.n": 1.5}
    return Surface.named("lambertian+ggx", values)


def document(surface: Surface, key: str = "0" * 64) -> dict:
    """What a fit says of a surface, as far as a table wants it."""
    known = {"stderr": 0.002, "unit": "", "at_bound": None}
    parameters = {name: {"value": np.array(value).tolist(), **known} for name, value in surface.values.items()}
    row = {
        "model": surface.model.name,
        "candidate": surface.model.name,
        "freed": [],
        "parameters": parameters,
        "rms_ln": 0.05,
        "held_out_rms_ln": None,
        "behind": 0.0,
        "seen": 1.0,
        "tied": False,
        "rank": 1,
        "free_parameters": 5,
        "flags": [],
    }
    data = {"channels": list(surface.channels), "wavelength_nm": (surface.wavelengths * 1000).tolist(), "samples": 9}
    stored = {"key": key, "data": {"sha256": key}, "fingerprint": "f"}
    return {
        "schema": "brdfguide/fit/1",
        "data": {**data, "solid_angle_sr": None},
        "kind": {"verdict": "dielectric"},
        "ranking": [row],
        "recommended": surface.model.name,
        "no_answer": None,
        "stored": stored,
    }


def database(path: Path, surfaces: list[Surface]) -> Path:
    """A table of surfaces called 0.csv, 1.csv..."""
    with collected.opened(path, make=True) as base, base:
        for number, surface in enumerate(surfaces):
            key = f"{number:064x}"
            assert collected._add(base, key, document(surface, key))
            base.execute("INSERT INTO name VALUES (?, ?)", (f"{number}.csv", key))
    return path


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    draw = np.random.default_rng(25)
    surfaces = [plastic(draw) for _ in range(60)]
    return database(tmp_path_factory.mktemp("many") / "all.sqlite", surfaces), surfaces


def test_answers_become_a_table_that_grows_and_shrinks_with_the_folder(tmp_path):
    answers = store.store_at(tmp_path / "d")
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    bad = tmp_path / "bad.csv"
    bad.write_text("theta_i,theta_r,brdf\n10,x,0.1\n")
    base_path = tmp_path / "all.sqlite"
    for count, new in ((2, 2), (2, 0)):
        list(run_tasks([Task(str(file), file, WORK, answers) for file in (*files[:2], bad)], answers))
        assert collected.collect_into(answers, base_path) == (count, new)
    list(run_tasks([Task(str(files[2]), files[2], WORK, answers)], answers))
    assert collected.collect_into(answers, base_path) == (3, 1)
    with collected.opened(base_path) as base:
        rows_there = collected.flat_rows(base)
        assert [row[0] for row in rows_there] == sorted(map(str, files))
        assert base.execute("SELECT count(*) FROM failure WHERE state = 'bad input'").fetchone() == (1,)
        values = base.execute("SELECT value FROM parameter WHERE name = 'lambertian.albedo'").fetchall()
        assert len(values) == 3 and all(0 < value < 1 for (value,) in values)
    next((tmp_path / "d").glob("answers/*/*.json")).unlink()
    assert collected.collect_into(answers, base_path) == (2, 0)


def test_folders_in_which_nothing_was_written_since_are_not_looked_at(tmp_path, monkeypatch):
    answers, base_path = store.store_at(tmp_path / "d"), tmp_path / "all.sqlite"
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    list(run_tasks([Task(str(file), file, WORK, answers) for file in files[:2]], answers))
    monkeypatch.setattr(collected, "JUST_NOW_NS", -(10**12))  # as if all had been long ago
    assert collected.collect_into(answers, base_path) == (2, 2)
    with monkeypatch.context() as without:
        without.setattr(store.Store, "names", None)
        without.setattr(store.Store, "read", None)
        assert collected.collect_into(answers, base_path) == (2, 0)
    list(run_tasks([Task(str(files[2]), files[2], WORK, answers)], answers))
    assert collected.collect_into(answers, base_path) == (3, 1)
    other = store.store_at(tmp_path / "e")
    list(run_tasks([Task(str(files[0]), files[0], WORK, other)], other))
    with pytest.raises(InputError, match="it holds the answers of .*/d, which those of .*/e would replace"):
        collected.collect_into(other, base_path)
    with collected.opened(base_path) as base:
        assert base.execute("SELECT count(*) FROM fit").fetchone() == (3,)
    (tmp_path / "d").rename(tmp_path / "moved")
    assert collected.collect_into(store.known_store(tmp_path / "moved"), base_path) == (3, 0)
    (tmp_path / "moved").rename(tmp_path / "d")
    shutil.rmtree(tmp_path / "d")
    assert collected.collect_into(other, base_path) == (1, 0)


@pytest.mark.parametrize("suffix", [".csv", ".jsonl", ".parquet"])
def test_a_flat_table_of_other_answers_or_of_something_else_is_not_replaced(tmp_path, suffix):
    if suffix == ".parquet":
        pytest.importorskip("pyarrow")
    folders = [store.store_at(tmp_path / name) for name in "de"]
    for part, folder in enumerate(folders):
        file = some(tmp_path, f"{part}.csv", part)
        list(run_tasks([Task(str(file), file, WORK, folder)], folder))
    table = tmp_path / f"all{suffix}"
    table.touch()  # as `mktemp` leaves one

    def status(folder) -> int:
        with pytest.raises(SystemExit) as ended:
            main(["collect", str(folder.folder), "-o", str(table)])
        return ended.value.code

    assert [status(folders[0]), status(folders[0]), status(folders[1])] == [0, 0, 2]
    measured = b"theta_i,theta_r,brdf\n10,10,0.2\n"
    table.write_bytes(measured)
    assert (status(folders[0]), table.read_bytes()) == (2, measured)


def test_the_row_of_an_answer_says_what_its_surface_is():
    surface = Surface.named(
        "lambertian+beckmann", {"albedo": [0.5, 0.25, 0.1], "beckmann.alpha": 0.2, "beckmann.n": 1.5}
    )
    row, shown = described_rows.described_row(document(surface))
    assert row["f0"] == pytest.approx(0.04) and row["albedo_g"] == pytest.approx(0.25)
    assert row["alpha_equivalent"] == 0.2
    phong = Surface.named("lambertian+phong", {"albedo": 0.05, "phong.ks": 0.1, "phong.exponent": 200.0})
    alpha = described_rows.described_row(document(phong))[0]["alpha_equivalent"]
    assert alpha == pytest.approx(1 / np.sqrt(2 * 200), rel=0.15)  # cos(2 θh) to the power e is exp(-2 e θh²)
    for angle in gloss.ANGLES:
        body = gloss.DIFFUSE[angle] * np.mean([0.5, 0.25, 0.1])
        assert row[f"gloss{angle}"] == pytest.approx(gloss.facet_units(angle, 0.2, 1.5) + body, abs=0.03)
    again = described_rows.look_vector(described_rows.saved.surface_in(row["surface"].encode(), "x"))
    assert np.array_equal(shown, again) and 0 < row["doubt"] < 2


def test_looks_order_pairs_as_the_whole_sphere_does():
    """400 pairs, seed 3: the small sphere's S within 6 % in the median, and pairs that differ by a fifth in order."""
    draw = np.random.default_rng(3)
    surfaces = [plastic(draw) for _ in range(400)]
    pairs = list(zip(surfaces[::2], surfaces[1::2], strict=True))
    full = np.array([looks(pair).apart(0, 1) for pair in pairs])
    weights = seen.sphere(described_rows.LOOKS).weights
    small = np.array([seen.apart(*map(described_rows.look_vector, pair), weights) for pair in pairs])
    assert np.median(np.abs(np.log(small / full))) < 0.06
    clear = np.log(full[:100] / full[100:])
    decided = np.abs(clear) > 0.2
    assert np.all(np.sign(np.log(small[:100] / small[100:]))[decided] == np.sign(clear)[decided])


@pytest.mark.parametrize(
    "query, holds",
    [
        ("albedo=0.2..0.4", lambda row: 0.2 <= row["albedo"] <= 0.4),
        ("albedo~0.3, gloss60<40", lambda row: 0.255 <= row["albedo"] <= 0.345 and row["gloss60"] <= 40),
        ("satin", lambda row: 10 <= row["gloss60"] <= 35),
        ("gloss60=35..", lambda row: row["gloss60"] >= 35),
        ("file=1?.csv", lambda row: len(row["file"]) == 6 and row["file"].startswith("1")),
        ("kind=metal", lambda row: False),
        ("kind=DIELECTRIC", lambda row: row["kind"] == "dielectric"),
        ("", lambda row: True),
        ("no_answer=x", lambda row: False),
        ("samples<SAMPLES", lambda row: False),  # those that have just so many are not meant
        ("file=[0-9].csv", lambda row: False),  # a name that has the bracket, such as `a.csv [paint=2]`
    ],
)
def test_words_and_numbers_find_the_rows_of_which_they_hold(query, holds, many):
    with collected.opened(many[0]) as base:
        every = conditions.matching(base, [], "samples")
        query = query.replace("SAMPLES", str(every[0]["samples"]))
        found = conditions.matching(base, conditions.conditions(query), "samples")
    assert [row["file"] for row in found] == [row["file"] for row in every if holds(row)] and len(every) == 60


def test_a_flag_is_one_among_several_and_brackets_are_letters(tmp_path):
    path = database(tmp_path / "all.sqlite", [plastic(np.random.default_rng(1))])
    with collected.opened(path, make=True) as base, base:
        base.execute("UPDATE fit SET flags = 'at-bound,discrepancy'")
        base.execute("UPDATE name SET file = 'd/a.csv [paint=2]'")
        for query, count in (
            ("flags=discrepancy", 1),
            ("flags=at-*", 1),
            ("flags=discrep", 0),
            ("flags=", 0),
            ("file=d/a.csv [paint=2]", 1),
            ("file=*[paint=?]", 1),
            ("file=D/*", 0),
        ):
            assert len(conditions.matching(base, conditions.conditions(query))) == count, query


COLLECTS = """
import sys
from pathlib import Path
from brdfguide.batch import collected, store
sys.stdin.readline()
collected.collect_into(store.known_store(Path(sys.argv[1])), Path(sys.argv[2]))
"""


def test_several_may_collect_into_one_file_at_once(tmp_path):
    answers = store.store_at(tmp_path / "d")
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    list(run_tasks([Task(str(file), file, WORK, answers) for file in files], answers))
    command = [sys.executable, "-c", COLLECTS, str(tmp_path / "d"), str(tmp_path / "all.sqlite")]
    runs = [subprocess.Popen(command, cwd=ROOT, stdin=subprocess.PIPE) for _ in range(3)]
    for each in runs:
        each.stdin.close()
    assert [each.wait(patience.AN_AGE_S) for each in runs] == [0, 0, 0]
    with collected.opened(tmp_path / "all.sqlite") as base:
        for table in ("fit", "name", "ranking"):  # one model each
            assert base.execute(f"SELECT count(*) FROM {table}").fetchone() == (3,), table


def test_what_is_kept_in_a_folder_is_made_anew_where_it_is_damaged_and_elsewhere_where_it_may_not(
    tmp_path, monkeypatch
):
    answers, file = store.store_at(tmp_path / "d"), some(tmp_path, "a.csv", 0)
    list(run_tasks([Task(str(file), file, WORK, answers)], answers))
    index = tmp_path / "d" / store.INDEX
    with monkeypatch.context() as patch:
        patch.setattr(collected.os, "access", lambda *_: False)
        with collected.collected(answers) as (_, *counts):
            assert counts == [1, 1] and not index.exists()
    index.write_bytes(b"no database at all, and longer than the header that one has" * 9)
    with collected.collected(answers) as (_, *counts):
        assert counts == [1, 1]
    with sqlite3.connect(index) as base:
        base.execute("UPDATE brdfguide SET schema = 'of another version'")
    with pytest.raises(InputError, match="another version"), collected.collected(answers, index):
        pass  # one that was named is left alone
    with collected.collected(answers) as (base, *_):
        assert len(collected.flat_rows(base)) == 1


@pytest.mark.parametrize(
    "query, sentence",
    [
        ("satinn", "did you mean satin"),
        ("glos60=3", "did you mean gloss60"),
        ("albedo=x", "wanted a number, or LOW..HIGH"),
        ("albedo", "there are: matt"),
        ("gloss60=30..10", "found 30 before 10"),
    ],
)
def test_what_cannot_be_searched_by_is_a_sentence(query, sentence):
    with pytest.raises(InputError, match=sentence):
        conditions.conditions(query)


def test_the_nearest_to_a_surface_is_itself_and_distances_are_those_of_compare(many):
    path, surfaces = many
    with collected.opened(path) as base:
        found = searching.nearest(searching.all_looks(base), surfaces[7])
    order = sorted(found.distance, key=lambda key: found.distance[key])
    assert int(order[0], 16) == 7 and found.distance[order[0]] < 0.01
    apart = looks((surfaces[7], surfaces[int(order[30], 16)])).apart(0, 1)
    assert found.distance[order[30]] == pytest.approx(apart, rel=0.15)
    assert found.tenth == pytest.approx(sorted(found.distance.values())[9])


def test_a_scene_counts_the_directions_that_it_asks_for(many):
    """Lit and seen at 60 and 0 degrees alone, surfaces that differ by their lobes only look the same."""
    scene = scenes.Scene(pairs=(scenes.DirectionPair(60.0, 0.0),))
    weights = searching.scene_weights(scene)
    assert np.count_nonzero(weights) == 1
    one, other = (Surface.named("lambertian+ggx", {"albedo": 0.5, "ggx.alpha": alpha}) for alpha in (0.1, 0.2))
    shown = [described_rows.look_vector(each) for each in (one, other)]
    everywhere = seen.apart(*shown, seen.sphere(described_rows.LOOKS).weights)
    assert seen.apart(*shown, weights) < 0.2 * everywhere


def test_twins_are_grouped_and_strangers_are_not(tmp_path):
    """60 surfaces, seed 4, of each a second fit that differs by less than its doubt."""
    draw = np.random.default_rng(4)
    surfaces = [plastic(draw) for _ in range(60)]
    twins = [each.with_value("ggx.alpha", float(each.values["ggx.alpha"]) + 0.001) for each in surfaces]
    path = database(tmp_path / "all.sqlite", [*surfaces, *twins])
    with collected.opened(path) as base:
        rows_there = conditions.matching(base, [], "doubt")
        groups = searching.alike_groups(searching.all_looks(base), {row["key"]: row["doubt"] for row in rows_there})
    pairs = {tuple(sorted(int(key, 16) for key in group)) for group in groups}
    assert {(number, number + 60) for number in range(60)} <= pairs and len(pairs) == 60


def test_another_database_is_left_alone(tmp_path):
    path = tmp_path / "other.sqlite"
    with sqlite3.connect(path) as base:
        base.execute("CREATE TABLE cats(name TEXT)")
    for file in (path, tmp_path / "none.sqlite"):
        with pytest.raises(InputError, match="wanted what `brdfguide collect` makes"), collected.opened(file):
            pass
    (tmp_path / "text.sqlite").write_text("no database at all, and longer than a header of sixteen bytes")
    with pytest.raises(InputError, match="not a database"), collected.opened(tmp_path / "text.sqlite"):
        pass


def test_tables_of_every_kind_hold_the_same(many, tmp_path):
    from brdfguide.batch import flat_files

    with collected.opened(many[0]) as base:
        flat = collected.flat_rows(base)
    flat_files.write_table(flat, collected.FLAT, tmp_path / "all.jsonl")
    flat_files.write_table(flat, collected.FLAT, tmp_path / "all.csv")
    lines = [json.loads(line) for line in (tmp_path / "all.jsonl").read_text().splitlines()]
    assert (
        len(lines) == 60
        and lines[0]["file"] == "0.csv"
        and lines[3]["gloss60"] == flat[3][collected.FLAT.index("gloss60")]
    )
    head, *body = (tmp_path / "all.csv").read_text().splitlines()
    assert head.split(",") == collected.FLAT and len(body) == 60
    parquet = pytest.importorskip("pyarrow.parquet")
    flat_files.write_table(flat, collected.FLAT, tmp_path / "all.parquet")
    assert parquet.read_table(tmp_path / "all.parquet").num_rows == 60
