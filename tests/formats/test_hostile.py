"""Damaged and malicious files: a clear error or an honest reading, never a traceback, never more memory than the file can need."""

import gzip
import lzma
import resource
import subprocess
import sys

import numpy as np
import pytest

from brdfguide import formats
from brdfguide.errors import BrdfguideError

from ..conftest import ROOT
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
        absurd = [b"nan", b"-1", b"1e999", b"999999999999", b"inf", b"", b"0", b"\xff\xff\xff\xff", b"1e-320", b"-1e300", b"9" * 50]
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
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1200 * 2**20, 1200 * 2**20))  # noqa: E731
    run = subprocess.run([sys.executable, "-m", "brdfguide", "inspect", str(path)], cwd=ROOT, capture_output=True, text=True, preexec_fn=limit)
    assert run.returncode == 2, run.stderr[-500:]
    assert "Traceback" not in run.stderr and len(run.stderr.strip().splitlines()) == 1


def test_a_whole_table_needs_less_than_200_mb_and_a_second_or_so(data):
    script = (
        "import sys, time; from brdfguide import formats; start = time.process_time(); formats.read(sys.argv[1]); "
        "peak = next(line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')); "
        "print(time.process_time() - start, int(peak) / 1024)"
    )
    path = data / "merl_format" / "red-plastic.binary.xz"
    run = subprocess.run([sys.executable, "-c", script, str(path)], cwd=ROOT, capture_output=True, text=True, check=True)
    seconds, megabytes = (float(word) for word in run.stdout.split())
    assert megabytes < 200
    assert seconds < 3  # 0.7 on an idle machine
