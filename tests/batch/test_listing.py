"""Every name of a list belongs to one shard, whatever it is; folders and patterns are the files that they mean."""

import os
from pathlib import Path

import numpy as np
import pytest

from brdfguide.batch.listing import expanded, from_list, shard_of
from brdfguide.errors import InputError


def names_of_all_kinds(count: int) -> list[str]:
    """With spaces, line ends, and bytes that are no UTF-8."""
    draw = np.random.default_rng(25)
    letters = [b"a", b"\xff", b" ", b"\n", b"\xc3\xa9", b"/", b"'", b"\\", b"*"]
    words = {b"".join(draw.choice(letters, size=12)).rstrip(b"\n") + b"%d" % number for number in range(count)}
    return [os.fsdecode(word) for word in sorted(words)]


@pytest.mark.parametrize("of", range(1, 18))
def test_the_shards_are_the_list_and_share_nothing(of):
    names = names_of_all_kinds(1000)
    owners = [[name for name in names if shard_of(f"{number}/{of}").has(name)] for number in range(of)]
    assert sorted(sum(owners, [])) == sorted(names) and len(names) == 1000
    assert of == 1 or max(map(len, owners)) < 3 * 1000 / of


def test_shards_of_array_jobs():
    slurm = {"SLURM_ARRAY_TASK_ID": "7", "SLURM_ARRAY_TASK_MIN": "5", "SLURM_ARRAY_TASK_COUNT": "4"}
    assert shard_of("auto", slurm) == (2, 4)
    assert shard_of("auto", {"SGE_TASK_ID": "3", "SGE_TASK_FIRST": "1", "SGE_TASK_LAST": "8"}) == (2, 8)
    assert shard_of("auto", {"LSB_JOBINDEX": "8", "LSB_JOBINDEX_END": "8"}) == (7, 8)
    assert shard_of("auto/6", {"JOB_COMPLETION_INDEX": "0"}) == (0, 6)
    assert shard_of("auto/6", {"CUE_IFRAME": "6"}) == (5, 6)


@pytest.mark.parametrize(
    "words, environment, sentence",
    [
        ("3/3", {}, "the last of 3 is 2/3"),
        ("-1/3", {}, "wanted I/N"),
        ("1", {}, "wanted I/N"),
        ("0/0", {}, "wanted I/N"),
        ("1/²", {}, "wanted I/N"),
        ("1/" + "9" * 5000, {}, "wanted I/N"),
        ("auto/0", {}, "wanted I/N"),
        ("auto", {}, "no task of an array job"),
        ("auto", {"SLURM_ARRAY_TASK_ID": "²"}, "no task of an array job"),
        ("auto", {"SLURM_ARRAY_TASK_ID": "2", "SLURM_ARRAY_TASK_MIN": "x"}, "SLURM_ARRAY_TASK_MIN is 'x'"),
        ("auto", {"JOB_COMPLETION_INDEX": "1"}, "say auto/N"),
        ("auto/2", {"JOB_COMPLETION_INDEX": "2"}, "beyond 2 tasks from 0 on"),
    ],
)
def test_what_is_no_shard_is_a_sentence(words, environment, sentence):
    with pytest.raises(InputError, match=sentence):
        shard_of(words, environment)


def test_lists_hold_any_name(tmp_path):
    names = names_of_all_kinds(100)
    (tmp_path / "zeros").write_bytes(b"".join(os.fsencode(name) + b"\0" for name in names))
    assert from_list(str(tmp_path / "zeros"), null=True) == names
    (tmp_path / "lines").write_bytes(b"a b.csv\n\nc.csv")
    assert from_list(str(tmp_path / "lines"), null=False) == ["a b.csv", "c.csv"]
    with pytest.raises(InputError, match="without -0 a list has a name on each line"):
        from_list(str(tmp_path / "lines"), null=True)


def test_folders_and_patterns_are_files(tmp_path):
    (tmp_path / "deep").mkdir()
    for name in ("b.csv", "a.csv", "notes.txt", ".hidden.csv", "deep/c.csv"):
        (tmp_path / name).write_text("x")

    def found(*words, include=(), recurse=False):
        listing = expanded(words, include, recurse, lambda path: path.suffix == ".csv")
        return [os.path.relpath(each, tmp_path) for each in listing.labels], listing.passed_over

    assert found(str(tmp_path)) == (["a.csv", "b.csv"], 1)
    assert found(str(tmp_path), recurse=True) == (["a.csv", "b.csv", "deep/c.csv"], 1)
    assert found(str(tmp_path), include=("*.txt",)) == (["notes.txt"], 0)
    assert found(str(tmp_path / "*.csv")) == (["a.csv", "b.csv"], 0)
    with pytest.raises(InputError, match="no file has such a name"):
        found(str(tmp_path / "*.binary"))
    with pytest.raises(InputError, match="no file like "):
        found(str(tmp_path), include=("*.binary",))
    (tmp_path / "[a].csv").write_text("x")  # a name that looks like a pattern is a name
    assert found(str(tmp_path / "[a].csv")) == (["[a].csv"], 0)


def test_answers_that_lie_in_a_folder_are_no_surfaces_of_it(tmp_path):
    """Tables of residuals could be read, and a second run would take them for measurements."""
    for name in (
        "a.csv",
        "fits/answers/ab/x.residuals.csv",
        "fits/names/ab/x.json",
        "fits/collected.sqlite",
        "more/b.csv",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "fits" / "brdfguide.json").touch()
    (tmp_path / "fits" / "c.csv").touch()  # also where data and answers share a folder
    found = expanded([str(tmp_path)], (), True, lambda path: True)
    assert [str(Path(each).relative_to(tmp_path)) for each in found.labels] == ["a.csv", "fits/c.csv", "more/b.csv"]
