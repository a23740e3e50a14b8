"""A table too large to be held gets the answer that it would get if it were not."""

from dataclasses import replace

import numpy as np
import pytest

import brdfguide
from brdfguide.data import blocks as in_blocks
from brdfguide.data import formats
from brdfguide.data.blocks import Blocks, Reservoir, drawn, joined
from brdfguide.data.formats import _rows
from brdfguide.data.measurement import Measurement
from brdfguide.errors import InputError
from brdfguide.fitting.over_blocks import block_sums, sums_over
from brdfguide.fitting.residuals import rms_over_all
from brdfguide.models.surface import Surface
from brdfguide.physics.colour import CHANNEL_UM
from brdfguide.physics.geometry import Geometry, rows

PAINT = Surface.named("lambertian+ggx", {"albedo": [0.4, 0.2, 0.1], "ggx.alpha": 0.25, "ggx.n": 1.5})
ROWS = 3000


def made(number: int) -> Measurement:
    """A block of a made measurement with 3 % of noise; the same for the same number."""
    draw = np.random.default_rng(number)
    theta_i, theta_r = np.degrees(np.arccos(np.sqrt(draw.uniform(0.03, 1.0, (2, ROWS)))))
    um = np.array([CHANNEL_UM[name] for name in "RGB"])
    geom = rows(Geometry.from_degrees(np.round(theta_i), 0.0, theta_r, draw.uniform(0, 360, ROWS), um))
    brdf = PAINT.brdf(geom) * (1 + 0.03 * draw.standard_normal((ROWS, 3)))
    return Measurement(geom, brdf, ("R", "G", "B"), name=f"block {number}", format="made")


def every(count: int) -> Blocks:
    return Blocks("made", lambda: map(made, range(count)))


def test_sums_of_blocks_are_those_of_the_whole_in_any_order_and_on_any_machine():
    surfaces = [PAINT, PAINT.with_value("ggx.alpha", 0.3)]
    whole = joined([made(number) for number in range(4)])
    total = sums_over(surfaces, every(4))
    assert total.rms() == pytest.approx(rms_over_all(surfaces, whole), rel=1e-12)
    here, there = sums_over(surfaces, map(made, (3, 1))), sums_over(surfaces, map(made, (2, 0)))
    assert (here + there).rms() == pytest.approx(total.rms(), rel=1e-12)
    assert total.counts.sum() == np.count_nonzero(whole.clear)
    bands = total.by_theta_i(1)
    assert list(bands) == [float(angle) for angle in range(0, 81, 10)] and 0.03 < bands[10.0] < 0.5
    few = block_sums(surfaces, whole[np.isin(np.rint(whole.geom.theta_i_deg[:, 0]), (20, 45))])
    assert list(few.by_theta_i(0)) == [20.0, 45.0]


def test_a_reservoir_takes_every_row_as_often_as_any_other():
    """200 draws of 50 of 3000 rows, seeds 0 to 199: each third of the rows a third of the times, to four sigma."""
    picked = []
    for seed in range(200):
        whole = replace(made(0), stderr=np.broadcast_to(np.arange(ROWS)[:, None], (ROWS, 3)))
        sample, size = drawn((whole[part : part + 700] for part in range(0, ROWS, 700)), 50, seed)
        assert size == ROWS and len(sample.brdf) == 50
        picked.append(sample.stderr[:, 0])
    thirds = np.histogram(np.concatenate(picked), bins=3, range=(0, ROWS))[0]
    assert np.all(np.abs(thirds - 200 * 50 / 3) < 4 * np.sqrt(200 * 50 * 2 / 9))


def test_reservoirs_of_two_machines_merge():
    one, other = Reservoir(100, seed=1), Reservoir(100, seed=2)
    one.add(made(1))
    other.add(made(2))
    one.merge(other)
    sample = one.sample()
    assert one.size == 2 * ROWS and len(sample.brdf) == 100
    of_first = np.isin(sample.brdf[:, 0], made(1).brdf[:, 0]).sum()
    assert 25 < of_first < 75


def test_a_fit_of_blocks_tells_errors_over_all_of_them(monkeypatch):
    monkeypatch.setattr(Blocks.sample, "__defaults__", (4000, 0))
    answer = brdfguide.fit(every(5), ["lambertian+ggx", "lambertian+ward"], timing=False)
    whole = joined([made(number) for number in range(5)])
    for row in answer.rows:
        assert row.rms_ln == row.fit.rms_ln == pytest.approx(rms_over_all([row.fit.surface], whole)[0], rel=1e-12)
    assert answer.document["data"]["samples"] == 4000 and answer.document["recommended"] == "lambertian+ggx"
    assert "4000 of 15000 directions, drawn while the table was read" in str(answer.document["data"]["findings"])
    held = brdfguide.fit(whole, ["lambertian+ggx", "lambertian+ward"], timing=False)
    assert answer.recommended.rms_ln == pytest.approx(held.recommended.rms_ln, rel=1e-3)
    alpha = answer.recommended
    assert abs(alpha.values["ggx.alpha"] - 0.25) < 4 * alpha.stderr["ggx.alpha"]


@pytest.fixture
def table(tmp_path, monkeypatch):
    """A table of text in blocks of 16 kB, and what it is when it is read at once."""
    path = tmp_path / "wall.csv"
    whole = joined([made(number) for number in range(3)])
    path.write_text(formats.write("csv", whole)[0])
    read_at_once = formats.read(path)
    monkeypatch.setattr(formats, "LARGEST_TABLE", 1000)
    monkeypatch.setattr(_rows, "PIECE", 2**14)
    monkeypatch.setattr(_rows, "MOST_OF_A_HEAD", 2**12)
    return path, read_at_once


@pytest.mark.parametrize("packed", [False, True])
def test_a_table_of_text_is_read_block_by_block(packed, table, tmp_path):
    import gzip

    path, whole = table
    if packed:
        path = tmp_path / "wall.csv.gz"
        path.write_bytes(gzip.compress(table[0].read_bytes()))
    blocks = formats.in_blocks(path, theta_max=70.0)
    parts = list(blocks)
    kept = whole[(np.maximum(whole.geom.theta_i_deg, whole.geom.theta_r_deg) <= 70)[:, 0]]
    assert len(parts) > 10 and np.array_equal(joined(parts).brdf, kept.brdf)
    sample = blocks.sample(500)
    assert 350 < len(sample.brdf) <= 500 and np.all(np.isin(sample.brdf[:, 0], whole.brdf[:, 0]))
    assert formats.in_blocks(path).sample(500).findings[-1].numbers[1] == ("of", 3 * ROWS)


def test_the_command_answers_for_a_table_in_blocks(table, monkeypatch, capsys):
    from brdfguide.cli import main

    monkeypatch.setattr(Blocks.sample, "__defaults__", (4000, 0))
    with pytest.raises(SystemExit) as end:
        main(["fit", str(table[0]), "-m", "lambertian+ggx", "--no-timing"])
    assert not end.value.code and "lambertian+ggx" in capsys.readouterr().out


def test_a_block_that_would_be_read_otherwise_is_a_sentence(tmp_path, monkeypatch):
    path = tmp_path / "small.csv"
    low, high = (f"{theta},{theta / 2},0.3\n" for theta in (1.2, 60.0))
    path.write_text("theta_i,theta_r,brdf\n" + 300 * low + 2000 * high)
    monkeypatch.setattr(formats, "LARGEST_TABLE", 100)
    monkeypatch.setattr(_rows, "PIECE", 2000)
    monkeypatch.setattr(_rows, "MOST_OF_A_HEAD", 100)
    blocks = formats.in_blocks(path)
    blocks.sample(500)
    with pytest.raises(InputError, match="--unit"):
        list(blocks)
    assert len(list(formats.in_blocks(path, unit="deg"))) > 3


def test_a_table_whose_rows_begin_with_words_is_a_sentence(tmp_path, monkeypatch):
    path = tmp_path / "words.csv"
    path.write_text("sample,theta_i,theta_r,brdf\n" + 200 * "white,10,10,0.3\n")
    monkeypatch.setattr(formats, "LARGEST_TABLE", 100)
    with pytest.raises(InputError, match="rows that begin with a number"):
        formats.in_blocks(path).sample(10)


def test_blocks_of_other_channels_and_no_rows_are_sentences():
    with pytest.raises(InputError, match="the same channels"):
        joined([made(0), made(1).of_channels([0])])
    with pytest.raises(InputError, match="no direction"):
        in_blocks.drawn([], 10)


@pytest.fixture
def parquet_table(tmp_path, monkeypatch):
    """A Parquet table that is read in pieces of a thousand rows, and what it is when it is read at once."""
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    from brdfguide.data.formats import parquet as ours

    whole = joined([made(number) for number in range(3)])
    angles = (
        whole.geom.theta_i_deg,
        whole.geom.phi_i_deg,
        whole.geom.theta_r_deg,
        np.remainder(whole.geom.phi_deg, 360),
    )
    names = ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", "R", "G", "B")
    columns = np.concatenate([*angles, whole.brdf], axis=1).T
    path = tmp_path / "wall.parquet"
    parquet.write_table(pyarrow.table(dict(zip(names, columns, strict=True))), path, row_group_size=2500)
    read_at_once = formats.read(path)
    monkeypatch.setattr(ours, "LARGEST_CELLS", 1000)
    monkeypatch.setattr(ours, "TOGETHER", 1000)
    return path, read_at_once


def test_a_parquet_table_is_read_in_pieces_from_the_mapped_file(parquet_table, monkeypatch):
    path, whole = parquet_table
    blocks = formats.in_blocks(path, theta_max=70.0)
    parts = list(blocks)
    kept = whole[(np.maximum(whole.geom.theta_i_deg, whole.geom.theta_r_deg) <= 70)[:, 0]]
    assert len(parts) == 9 and np.array_equal(joined(parts).brdf, kept.brdf)
    np.testing.assert_array_equal(joined(parts).geom.dot_xy, kept.geom.dot_xy)
    sample = blocks.sample(500)
    assert 350 < len(sample.brdf) <= 500 and np.all(np.isin(sample.brdf[:, 0], whole.brdf[:, 0]))
    assert formats.in_blocks(path).sample(500).findings[-1].numbers[1] == ("of", 3 * ROWS)
    monkeypatch.setattr(Blocks.sample, "__defaults__", (4000, 0))
    answer = brdfguide.fit(path, ["lambertian+ggx"], timing=False)
    assert answer.recommended.rms_ln == pytest.approx(rms_over_all([answer.recommended.surface], whole)[0], rel=1e-12)


def test_a_damaged_parquet_table_is_a_sentence_in_pieces_too(parquet_table, tmp_path):
    path, _ = parquet_table
    content = bytearray(path.read_bytes())
    content[40:4000] = bytes(3960)
    (tmp_path / "bad.parquet").write_bytes(content)
    with pytest.raises(InputError, match="a damaged Parquet file"):
        formats.in_blocks(tmp_path / "bad.parquet").sample(10)
    (tmp_path / "cut.parquet").write_bytes(path.read_bytes()[:-20])
    with pytest.raises(InputError, match="a damaged Parquet file"):
        formats.in_blocks(tmp_path / "cut.parquet")
