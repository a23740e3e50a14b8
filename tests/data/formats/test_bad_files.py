"""Thirty wrong files, thirty sentences: each names the file, what was found and what was wanted.

Status 2, no traceback.
"""

import re
import subprocess
import sys

import pytest

from brdfguide.data import formats
from brdfguide.errors import InputError

from ...conftest import ROOT
from .test_table import plain

HEAD = "theta_i,theta_r,brdf\n"
BAD = {
    "no column for the value": (
        HEAD.replace("brdf", "reading") + "30,30,1\n",
        {},
        r"no column for brdf.*Columns found: theta_i, theta_r, reading",
    ),
    "nearly the right name": (
        "theta_i,theta_rr,brdf\n30,30,1\n",
        {},
        r"no column for theta_r; is it 'theta_rr' \('rr' is not understood\)\?",
    ),
    "text in a number": (HEAD + "30,30,1\n30,40,high\n", {}, r"line 3: column 'brdf': found 'high', wanted a number"),
    "an empty file": ("", {}, r"the file is empty"),
    "blank lines only": ("\n\n  \n", {}, r"the file is empty"),
    "comments only": ("# nothing\n# here\n", {}, r"only comments and blank lines"),
    "no rows": (HEAD, {}, r"no row of numbers found"),
    "binary": (bytes(range(256)) * 20, {}, r"it is binary, and no reader knows it"),
    "a picture": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", {}, r"this is a picture, which is not read; export"),
    "an angle of 200 degrees": (
        HEAD + "30,30,1\n200,30,1\n",
        {},
        r"line 3: theta_i = 200 degrees; a zenith angle lies within -90..90",
    ),
    "one column name twice": ("theta_i,theta_r,brdf,brdf\n30,30,1,2\n", {}, r"two columns are called 'brdf'"),
    "two columns for one angle": (
        "theta_i,incidence,theta_r,brdf\n30,30,30,1\n",
        {},
        r"both look like theta_i; say which with --columns",
    ),
    "a short row": (HEAD + "30,30,1\n30,40\n", {}, r"line 3: found 2 cells, wanted 3"),
    "a long row": (HEAD + "30,30,1\n30,40,1,7\n", {}, r"line 3: found 4 cells, wanted 3"),
    "no header": (
        "30,30,1\n30,40,2\n",
        {},
        r"no header row above the numbers \(3 columns\); name the columns with --columns",
    ),
    "no unit, small angles": (
        HEAD + "0.7,0.31,1\n0.7,0.42,1\n0.3,0.77,1\n",
        {},
        r"no angle exceeds 0.77 and no column names a unit; say --unit deg or --unit rad",
    ),
    "units that differ": (
        "theta_i_deg,theta_r_rad,dphi,brdf\n30,1,1,1\n",
        {},
        r"column 'dphi' names no unit, and others are in deg and rad; write the unit into its name",
    ),
    "a small unit beside none": (
        "theta_i (arcmin),theta_r,brdf\n3000,50,1\n1800,30,1\n",
        {},
        r"column 'theta_r' names no unit, and others are in arcmin",
    ),
    "radians beside named degrees": (
        "theta_i_deg,theta_r,brdf\n30,0.523599,1\n30,0.785398,1\n30,1.308997,1\n",
        {},
        r"column 'theta_r' names no unit, and its values look like radians beside degrees",
    ),
    "an azimuth of half a turn beside degrees": (
        "theta_i,theta_r,phi,brdf\n30,30,3.1415927,1\n30,45,0,1\n30,60,3.1415927,1\n",
        {},
        r"column 'phi' names no unit, and its values look like radians .* --unit deg if all are",
    ),
    "azimuths all around beside degrees": (
        "theta_i_deg,theta_r_deg,phi,brdf\n" + "".join(f"30,30,{0.0721 * n:.4f},1\n" for n in range(88)),
        {},
        r"names no unit, and its values look like radians",
    ),
    "an option that names no column": (
        plain(),
        {"columns": "brdf=brfd"},
        r"no column in .* called 'brfd'; did you mean brdf\?",
    ),
    "an unknown role": (
        plain(),
        {"columns": "thetai=theta_i"},
        r"no column role called 'thetai'; did you mean theta_i",
    ),
    "an unknown unit": (plain(), {"unit": "grad"}, r"no unit called 'grad'.*there are: deg, rad"),
    "an unknown quantity": (plain(), {"quantity": "brdfcos"}, r"no quantity called 'brdfcos'; did you mean brdf-cos"),
    "an unknown side": (plain(), {"mirror_side": "left"}, r"no mirror side called 'left'"),
    "no such channel": (
        "theta_i,theta_r,400nm,500nm\n30,30,1,1\n",
        {"wavelength": (600, 700)},
        r"no channel within 600..700 nm; there are 400..500 nm",
    ),
    "nothing in the plane": (
        "theta_i,theta_r,dphi,brdf\n30,30,90,1\n",
        {"in_plane": True},
        r"no direction in the plane of incidence",
    ),
    "nothing below the limit": (plain(), {"theta_max": 10}, r"no direction within 10 degrees of the normal"),
    "all below the horizon": (HEAD + "90,90,1\n90,90,2\n", {}, r"no direction above the horizon is left"),
    "damaged compression": (b"\x1f\x8b\x08\0" + b"garbage" * 30, {}, r"its gzip compression is damaged"),
    "a truncated table": (b"\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0" + bytes(80), {}, r"found 92 bytes, wanted 34992012"),
    "a truncated stream of numbers": ("3\n400 500 600\n0.1 0 0.2 0 1 2\n", {}, r"truncated: 3 wavelengths promised"),
    "a wrong record": ("2\n400 500\n0.1 0 0.2 0 1 2\n0.1 0 0.2 0 1\n", {}, r"the last record has 5 of 6 numbers"),
    "JSON that is something else": ('{"brdf": {"lookupTable": []}}', {}, r"no rows under brdf.lookupTable"),
    "wavelengths without a unit": (
        "lambda,theta_i,theta_r,brdf\n50,30,30,1\n",
        {},
        r"column 'lambda': wavelengths near 50; wanted nm or um",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_one_clear_sentence_for(tmp_path, name):
    content, options, sentence = BAD[name]
    path = tmp_path / "run.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError, match=sentence) as caught:
        formats.read(path, **options)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


def test_one_clear_sentence_for_what_is_no_file(tmp_path):
    with pytest.raises(InputError, match="is a directory; wanted a file"):
        formats.read(tmp_path)
    (tmp_path / "steel.csv").write_text(plain())
    with pytest.raises(InputError, match=r"there is no such file; did you mean steel.csv\?"):
        formats.read(tmp_path / "stell.csv")
    (tmp_path / "link.csv").symlink_to("gone.csv")
    with pytest.raises(InputError, match=r"it is a link to 'gone.csv', and there is no such file$"):
        formats.read(tmp_path / "link.csv")


def test_two_readers_that_claim_one_file_are_both_named(tmp_path):
    path = tmp_path / "both.txt"
    path.write_text("type bsdf_data\n#PARAM_IN CARTESIAN\nformat angles=deg bsdf=value scale=1\n0 0\n1 2 3\n")
    with pytest.raises(InputError, match="two readers claim this file: alta and fred"):
        formats.read(path)


@pytest.mark.parametrize("name", ["text in a number", "binary", "an angle of 200 degrees"])
def test_the_command_ends_with_status_2_and_one_line(tmp_path, name):
    path = tmp_path / "run.csv"
    content = BAD[name][0]
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "inspect", str(path)], cwd=ROOT, capture_output=True, text=True
    )
    assert run.returncode == 2 and run.stdout == ""
    assert len(run.stderr.strip().splitlines()) == 1 and re.search(BAD[name][2], run.stderr)
