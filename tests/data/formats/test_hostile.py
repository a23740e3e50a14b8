"""Damaged and malicious files: a clear error or an honest reading, never a traceback, never more memory than the file
can need.
"""

import bz2
import gzip
import lzma
import os
import resource
import subprocess
import sys
from random import Random

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.data.columns.vocabulary import KNOWN
from brdfguide.errors import BrdfguideError, InputError

from ...conftest import ROOT
from ...patience import takes_less_than
from .containers import every

FILES = every()
ROUNDS = 40  # a few minutes of the same, with other seeds, were run once; see test names for the seed


def survives(path, content) -> None:
    """Either a measurement or one sentence."""
    path.write_bytes(content)
    try:
        measurement = formats.read(path)
    except BrdfguideError as error:
        assert str(error) and "\n" not in str(error)
    else:
        assert measurement.brdf.shape == (len(measurement.geom), len(measurement.channels))
        assert np.all(np.isfinite(measurement.geom.cos_r)) and np.all(measurement.geom.cos_r > 0)


@pytest.mark.parametrize("name", FILES)
def test_cut_off_at_every_kind_of_place(tmp_path, name):
    content = FILES[name]
    for cut in sorted({*range(0, min(len(content), 40)), *np.linspace(0, len(content), 60).astype(int).tolist()}):
        survives(tmp_path / "cut", content[:cut])


@pytest.mark.parametrize("name", FILES)
def test_random_damage_seed_2026(tmp_path, name):
    draw = np.random.default_rng([2026, len(name), len(FILES[name])])
    for _ in range(ROUNDS):
        survives(tmp_path / "damaged", damaged(FILES[name], draw))


def damaged(content: bytes, draw) -> bytes:
    """Bytes flipped, numbers replaced by absurd ones, pieces doubled, removed or exchanged."""
    data = bytearray(content)
    kind = draw.integers(6)
    at, length = int(draw.integers(len(data))), int(draw.integers(1, 60))
    if kind == 0:
        for place in draw.integers(len(data), size=draw.integers(1, 8)):
            data[place] = draw.integers(256)
    elif kind == 1:
        del data[at : at + length]
    elif kind == 2:
        data[at:at] = data[at : at + length]
    elif kind == 3:
        absurd = [
            b"nan",
            b"-1",
            b"1e999",
            b"999999999999",
            b"inf",
            b"",
            b"0",
            b"\xff\xff\xff\xff",
            b"1e-320",
            b"-1e300",
            b"9" * 50,
        ]
        data[at : at + int(draw.integers(1, 6))] = absurd[draw.integers(len(absurd))]
    elif kind == 4:
        to = int(draw.integers(len(data)))
        data[at : at + length], data[to : to + length] = data[to : to + length], data[at : at + length]
    else:
        lines = bytes(data).split(b"\n")
        draw.shuffle(lines)
        data = bytearray(b"\n".join(lines))
    return bytes(data)


BOMBS = {
    "zeros in gzip": lambda: gzip.compress(bytes(2**20) * 100, 1),
    "text in xz": lambda: lzma.compress(b"1 2 3\n" * 2**20 * 22, preset=0),
    "a table in gzip": lambda: gzip.compress(b"\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0" + bytes(2**20) * 100, 1),
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_compressed_bomb_ends_in_a_sentence_within_600_mb(tmp_path, name):
    path = tmp_path / "bomb"
    path.write_bytes(BOMBS[name]())

    def limit():
        return resource.setrlimit(resource.RLIMIT_AS, (1200 * 2**20, 1200 * 2**20))

    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "inspect", str(path)],
        cwd=ROOT,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},  # each of them takes its share of the memory that is addressed
        capture_output=True,
        text=True,
        preexec_fn=limit,
    )
    assert run.returncode == 2, run.stderr[-500:]
    assert "Traceback" not in run.stderr and len(run.stderr.strip().splitlines()) == 1


def test_a_whole_table_needs_less_than_200_mb_and_a_second_or_so(data):
    script = (
        "import sys; from brdfguide.data import formats; formats.read(sys.argv[1]); "
        "print(next(line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')))"
    )
    path = data / "merl_format" / "red-plastic.binary.xz"
    run = subprocess.run(
        [sys.executable, "-c", script, str(path)], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert int(run.stdout) / 1024 < 200
    assert takes_less_than(3, lambda: formats.read(path))


WORDS = [
    *sorted(KNOWN),
    "theta_i",
    "550nm",
    "400",
    "k=2",
    "(°)",
    "[1/sr]",
    "log10(",
    ")",
    "β-β0",
    "1e-3/sr",
    "x",
    "½",
    "①",
    "٣",
]
CELLS = [
    "0.1",
    "-45",
    "",
    "nan",
    "inf",
    "1e308",
    "white",
    "450 nm",
    "0,5",
    "red",
    "1e-320",
    "90",
    "200",
    "#N/A",
    '"',
    "12:30",
]


def soup(draw) -> str:
    """A table of random names over random cells; often the three that are needed are among them."""
    names = ["theta_i", "theta_r", "brdf"] if draw.random() < 0.6 else []
    for _ in range(draw.randint(1, 5)):
        names.append(draw.choice("_ ").join(draw.choice(WORDS) for _ in range(draw.randint(1, 4))))
    separator, odd = draw.choice(",;\t|"), draw.choice((0.02, 0.3))
    lines = [f"# {' '.join(draw.choice(WORDS) for _ in range(8))} = 633 nm", separator.join(names)]
    for _ in range(draw.randint(1, 14)):
        cells = (draw.choice(CELLS) if draw.random() < odd else f"{draw.uniform(0, 80):.3f}" for _ in names)
        lines.append(separator.join(cells))
    return "\n".join(lines) + "\n"


def test_soups_of_words_are_read_or_refused_without_a_warning_seed_2026(tmp_path, recwarn):
    draw = Random(2026)
    for _ in range(400):
        survives(tmp_path / "soup.csv", soup(draw).encode())
    assert not recwarn


ROWS = "theta_i,theta_r,brdf\n" + "".join(f"{i},{r},0.2\n" for i in (10, 30, 50) for r in range(-40, 61, 20))
SLOW = {  # texts that took from seconds to for ever
    "a unit in brackets that the name has too": ROWS.replace("theta_i", "theta_i_deg (°)").replace(
        "theta_r", "theta_r_deg (°)"
    ),
    "words for units": ROWS.replace("theta_i", "theta_i_rad [radians]", 1).replace("30,", "0.3,"),
    "a row of units under names with units": ROWS.replace(
        "theta_i,theta_r,brdf", "theta_i_deg,theta_r_deg,brdf\ndegrees,degrees,1/sr"
    ),
    "two hundred thousand blanks": "# wavelength" + " " * 200_000 + "word\n" + ROWS,
    "two hundred thousand digits": "# " + "1" * 200_000 + "\n" + ROWS,
    "blank lines in front": "\n" * 200_000 + ROWS,
    "blank lines of blanks": (" " * 20 + "\n") * 20_000 + ROWS,
    "a field of two hundred thousand letters": "theta_i,theta_r,brdf,remark\n"
    + "10,20,0.2,"
    + "x" * 200_000
    + "\n"
    + ROWS.partition("\n")[2].replace("0.2\n", "0.2,y\n"),
    "brackets": "(" * 16_000 + ROWS,
    "quotes": '"' * 100_000 + ROWS,
    "a long name": ROWS.replace("brdf", "brdf " + "very " * 20_000, 1),
    "signs": "# " + "-" * 200_000 + "\n" + ROWS,
    "twenty names of five hundred numbers": "theta_i,theta_r,brdf,"
    + ",".join(f"c{k}" + "-9" * 500 for k in range(20))
    + "\n"
    + "".join(f"10,{r},0.2{',1' * 20}\n" for r in range(20)),
    "four thousand columns": "theta_i,theta_r,brdf,"
    + ",".join(f"c{k}" for k in range(4000))
    + "\n"
    + "".join(f"10,{r},0.2{',1' * 4000}\n" for r in range(20)),
}


@pytest.mark.parametrize("name", SLOW)
def test_ends_soon_whatever_the_text(tmp_path, name):
    assert takes_less_than(5, lambda: survives(tmp_path / "slow", SLOW[name].encode()))


def members(name: str, parts) -> bytes:
    packed = {"gz": gzip.compress, "bz2": bz2.compress, "xz": lzma.compress}[name]
    return b"".join(packed(part) for part in parts)


@pytest.mark.parametrize("kind", ["gz", "bz2", "xz"])
def test_every_member_of_a_compressed_file_is_read(tmp_path, kind):
    lines = ROWS.encode().splitlines(keepends=True)
    path = tmp_path / f"run.csv.{kind}"
    for parts in ((b"".join(lines[:7]), b"".join(lines[7:])), lines, (b"".join(lines), b"")):
        path.write_bytes(members(kind, parts))
        measurement = formats.read(path)
        assert len(measurement.geom) == len(lines) - 1 and "bytes-behind" not in codes(measurement)
    path.write_bytes(members(kind, [ROWS.encode()]) + b"\0" * 512)  # padding, as on tapes
    assert "bytes-behind" not in codes(formats.read(path))
    path.write_bytes(members(kind, [ROWS.encode()]) + b"something else")
    (note,) = [finding for finding in formats.read(path).findings if finding.code == "bytes-behind"]
    assert note.text.startswith("14 bytes behind the")
    path.write_bytes(members(kind, lines)[:-9])
    with pytest.raises(InputError, match="truncated|ends early|damaged"):
        formats.read(path)


def test_a_hundred_thousand_members_are_read_in_a_few_seconds(tmp_path):
    path = tmp_path / "many.gz"
    path.write_bytes(gzip.compress(b"theta_i,theta_r,brdf\n") + gzip.compress(b"10,20,0.5\n") * 100_000)
    assert len(formats.read(path).geom) == 100_000
    assert takes_less_than(10, lambda: formats.read(path))


def codes(measurement):
    return {finding.code for finding in measurement.findings}


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("1," * 1_200_000, "line 1: found a line of 2400000 letters; wanted rows of at most 2097152"),
        ("theta_i,theta_r,brdf\n" + "1±" * 1_200_000, "line 2: found a line of 2400000 letters"),
        ("\\begin{tabular}{l}" + "1&2\\\\" * 450_000, "line 1: found a line of 2250018 letters"),
        ("\\begin{tabular}{l}\n" + "1&2\n" * 5000, "line 2501: found a row of more than 10000 letters"),
        ("\\begin{tabular}\n" * 5000, "its tables have more than 1000000 cells"),
        ("<table>" + "<tr><td rowspan=1000 colspan=1000>1" * 3000, "its tables have more than 1000000 cells"),
        ("<table>" + "<td colspan=1000>1" * 3000, "its tables have more than 1000000 cells"),
        ("<table>" + "<" * 100_000, "none of its tables"),
        ("theta_i,theta_r,brdf\n" + "a\n" * 30_000, "no row of numbers found"),
    ],
)
def test_what_stands_for_more_than_it_is_has_an_end(tmp_path, content, sentence):
    path = tmp_path / "scan.csv"
    path.write_text(content)

    def refused():
        with pytest.raises(InputError, match=sentence):
            formats.read(path)

    assert takes_less_than(5.0, refused)
