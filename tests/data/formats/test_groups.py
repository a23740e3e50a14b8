"""Several surfaces in one table: named and refused, picked by a value, or fitted each by itself."""

import numpy as np
import pytest

from brdfguide.data import examine, formats
from brdfguide.errors import InputError, NoAnswer

from ...surfaces import table
from .test_conventions import IN_PLANE, PLANE, PLANE_I, PLANE_R, check, codes, read

ROWS = len(IN_PLANE)


def two(name: str, first, second, factor: float = 3.0) -> str:
    """Two runs over the same directions, told apart by a column of this name and these cells."""
    lines = [f"{name},theta_i,theta_r,brdf"]
    for cell, scale in ((first, 1.0), (second, factor)):
        lines += [f"{cell},{i:g},{r:g},{scale * f:.9g}" for i, r, f in zip(PLANE_I, PLANE_R, IN_PLANE, strict=True)]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("name", "first", "second"),
    [
        ("sample", "white", "black"),
        ("sample_id", "1", "2"),
        ("Polarisation", "s", "p"),
        ("finish", "matt", "gloss"),
        ("pol", 0, 90),
    ],
)
def test_a_column_that_names_surfaces_is_refused_with_what_can_be_done(tmp_path, name, first, second):
    text = two(name, first, second)
    sentence = rf"the column '{name}' names 2 groups \({first}, {second}\): fit one with --select {name}={first}, each "
    with pytest.raises(
        NoAnswer, match=sentence + rf"with --group {name}, or all as one surface with --columns ignore={name}"
    ):
        read(tmp_path, text)
    for value, factor in ((first, 1.0), (second, 3.0)):
        measurement = read(tmp_path, text, select=(f"{name}={value}",))
        check(measurement, PLANE, factor * IN_PLANE)
        assert "rows-selected" in codes(measurement)
    assert formats.groups(tmp_path / "run.csv", name) == (str(first), str(second))
    assert len(read(tmp_path, text, columns=f"ignore={name}").geom) == 2 * ROWS


def test_a_column_that_tells_repeated_directions_apart_is_not_ignored(tmp_path):
    with pytest.raises(
        NoAnswer, match=r"45 rows repeat a direction, and their values differ by .*'tilt', which is ignored"
    ):
        read(tmp_path, two("tilt", 0, 12))
    assert len(read(tmp_path, two("tilt", 0, 12, factor=1.01)).geom) == 2 * ROWS  # a repeat, within its noise


def test_repeated_directions_that_nothing_tells_apart_are_doubted(tmp_path):
    text = table(
        ("theta_i", "theta_r", "brdf"),
        *(np.tile(each, 2) for each in (PLANE_I, PLANE_R)),
        np.r_[IN_PLANE, 2 * IN_PLANE],
    )
    assert "repeats-differ" in codes(read(tmp_path, text))
    with pytest.raises(NoAnswer, match="equal directions have values that differ by"):
        examine.prepared(read(tmp_path, text))
    assert examine.prepared(read(tmp_path, text), anyway=True).usable.all()


def test_a_label_without_a_repeated_direction_is_a_question_to_the_user(tmp_path):
    rows = two("sample", "white", "black").split("\n")
    with pytest.raises(InputError, match="the column 'sample' names 2 groups"):
        read(tmp_path, "\n".join([rows[0], *rows[1 : ROWS + 1 : 2], *rows[ROWS + 2 :: 2]]))


def test_text_about_the_run_is_ignored_with_its_reason(tmp_path):
    lines = ["time,theta_i,theta_r,brdf,remark"]
    lines += [
        f"12:{k:02d},{PLANE_I[k]:g},{PLANE_R[k]:g},{IN_PLANE[k]:.9g},{'ok' if k % 2 else 'slow'}" for k in range(ROWS)
    ]
    measurement = read(tmp_path, "\n".join(lines))
    check(measurement, PLANE, IN_PLANE)
    (note,) = [finding for finding in measurement.findings if finding.code == "columns-ignored"]
    assert "'time' ('time' is not understood)" in note.text and "'remark'" in note.text


def test_one_sample_throughout_is_no_question(tmp_path):
    check(
        read(tmp_path, two("sample", "white", "white").replace("\n", "\n", 1), columns="ignore=sample")[:ROWS],
        PLANE,
        IN_PLANE,
    )
    text = "\n".join(two("sample", "white", "black").split("\n")[: ROWS + 1])
    check(read(tmp_path, text), PLANE, IN_PLANE)


def test_a_value_or_column_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match=r"no value of 'sample' in .* called 'whit'; did you mean white\?"):
        read(tmp_path, two("sample", "white", "black"), select=("sample=whit",))
    with pytest.raises(InputError, match=r"no column in .* called 'smaple'; did you mean sample\?"):
        read(tmp_path, two("sample", "white", "black"), select=("smaple=white",))
    with pytest.raises(InputError, match="--select white: wanted column=value"):
        read(tmp_path, two("sample", "white", "black"), select=("white",))
    with pytest.raises(InputError, match="no column in"):
        formats.groups(tmp_path / "run.csv", "paint")


def test_conditions_add_up(tmp_path):
    both = two("sample", "white", "black").replace("\nwhite", "\nwhite").split("\n")
    lines = [f"pol,{both[0]}", *(f"{pol},{line}" for pol in "sp" for line in both[1:] if line)]
    measurement = read(tmp_path, "\n".join(lines), select=("sample=black", "pol=s"))
    check(measurement, PLANE, 3 * IN_PLANE)


def test_text_where_a_number_is_wanted_is_an_error_with_its_line(tmp_path):
    text = "theta_i,theta_r,brdf,note\n10,20,.1,a\n10,thirty,.1,b\n10,40,high,c\n"
    with pytest.raises(InputError, match="line 3: column 'theta_r': found 'thirty', wanted a number"):
        read(tmp_path, text)
    with pytest.raises(InputError, match="line 4: column 'brdf': found 'high', wanted a number"):
        read(tmp_path, text.replace("thirty", "30"))
