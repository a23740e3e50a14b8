"""MERL tables: geometry against the definition of half and difference angles, masks, and errors in sentences."""

import gzip
import lzma
import os
import struct

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.data.formats import _open, merl
from brdfguide.errors import InputError
from brdfguide.physics.geometry import Geometry

CELLS = 90 * 90 * 180


def written(path, planes, phis=180):
    path.write_bytes(struct.pack("<3i", 90, 90, phis) + np.asarray(planes, "<f8").tobytes())
    return path


@pytest.fixture(scope="module")
def numbered(tmp_path_factory):
    """Each cell holds its own index (+1), so that it is known which cell became which sample."""
    plane = np.arange(1.0, CELLS + 1)
    return written(
        tmp_path_factory.mktemp("merl") / "numbered.binary", [plane * 1500, plane * 1500 / 1.15, plane * 1500 / 1.66]
    )


def test_every_sample_lies_in_the_cell_that_the_published_index_names(numbered):
    measurement = formats.read(numbered)
    geom = measurement.geom
    draw = np.random.default_rng(1).integers(0, len(geom), 3000)
    index = np.round(measurement.brdf[draw, 0]).astype(int) - 1
    np.testing.assert_allclose(measurement.brdf[draw], np.repeat(index[:, None] + 1.0, 3, axis=1), rtol=1e-12)
    theta_i, theta_r, phi = (np.radians(a[draw, 0]) for a in (geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg))
    light = np.stack([np.sin(theta_i), 0 * phi, np.cos(theta_i)], axis=1)
    view = np.stack([np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)], axis=1)
    half = light + view
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    theta_h, phi_h = np.arctan2(np.hypot(half[:, 0], half[:, 1]), half[:, 2]), np.arctan2(half[:, 1], half[:, 0])
    turned = np.stack(
        [
            np.cos(phi_h) * light[:, 0] + np.sin(phi_h) * light[:, 1],
            -np.sin(phi_h) * light[:, 0] + np.cos(phi_h) * light[:, 1],
        ]
    )
    x = np.cos(theta_h) * turned[0] - np.sin(theta_h) * light[:, 2]
    z = np.sin(theta_h) * turned[0] + np.cos(theta_h) * light[:, 2]
    phi_d = np.arctan2(turned[1], x)
    phi_d = np.where(phi_d < 0, phi_d + np.pi, phi_d)
    theta_d = np.arccos(np.clip(z, -1, 1))
    found = np.floor(phi_d / np.pi * 180) + 180 * (
        np.floor(theta_d / (np.pi / 2) * 90) + 90 * np.floor(np.sqrt(np.degrees(theta_h) * 90))
    )
    np.testing.assert_array_equal(found.astype(int), index)


def test_geometry_agrees_with_geometry_from_angles(numbered):
    geom = formats.read(numbered).geom[::997]
    again = Geometry.from_degrees(geom.theta_i_deg, 0.0, geom.theta_r_deg, geom.phi_deg)
    for name in ("cos_i", "sin_r", "vxy2", "dot_xy", "cos_difference"):
        np.testing.assert_allclose(getattr(geom, name), getattr(again, name), atol=1e-9)


def test_negative_cells_are_no_data(tmp_path):
    plane = np.full(CELLS, -1.0)
    plane[CELLS // 3] = 750.0
    measurement = formats.read(written(tmp_path / "one.binary", [plane] * 3))
    np.testing.assert_allclose(measurement.brdf, [[0.5, 0.575, 0.83]])


def test_variant_with_360_azimuths_is_read(tmp_path):
    measurement = formats.read(written(tmp_path / "full.binary", np.full((3, 2 * CELLS), 1500.0), phis=360))
    assert len(measurement.geom) > 2_000_000
    assert measurement.geom.phi_deg.min() < -170


def test_compressed_tables_give_the_same(tmp_path):
    plain = struct.pack("<3i", 90, 90, 180) + np.repeat(np.arange(-1.0, 161.0), 27000).astype("<f8").tobytes()
    (tmp_path / "plain").write_bytes(plain)
    want = formats.read(tmp_path / "plain").brdf
    for name, pack in (
        ("a.gz", lambda data: gzip.compress(data, 1)),
        ("a.xz", lambda data: lzma.compress(data, preset=0)),
    ):
        path = tmp_path / name
        path.write_bytes(pack(plain))
        np.testing.assert_array_equal(formats.read(path).brdf, want)


def test_truncated_table_says_how_long_it_should_be(tmp_path):
    path = tmp_path / "short.binary"
    path.write_bytes(struct.pack("<3i", 90, 90, 180) + bytes(1000))
    with pytest.raises(InputError, match="found 1012 bytes, wanted 34992012"):
        formats.read(path)


@pytest.mark.parametrize("name", ["red-plastic", "alum-bronze"])
def test_tables_at_hand_are_read_whole(data, name):
    measurement = formats.read(data / "merl_format" / f"{name}.binary.xz")
    assert 1_000_000 < len(measurement.geom) <= 1_100_000
    assert measurement.channels == ("R", "G", "B")


def test_a_file_of_another_size_is_a_sentence_also_one_that_is_cut_while_it_is_read(tmp_path, monkeypatch):
    content = merl.packed(merl.table(lambda geom: np.full((len(geom), 3), 0.2)))
    path = tmp_path / "grey.binary"
    path.write_bytes(content)
    packed = tmp_path / "grey.binary.xz"
    packed.write_bytes(lzma.compress(content, preset=0))
    assert np.array_equal(formats.read(path).brdf, formats.read(packed).brdf)
    format, source = formats.opened(path)
    os.truncate(path, 1000)  # of a file mapped to memory the process would end here
    assert np.array_equal(format.read(source, formats.Options()).brdf, formats.read(packed).brdf)
    path.write_bytes(content[:-8])
    with pytest.raises(InputError, match="wanted 34992012 for a table"):
        formats.read(path)
    path.write_bytes(content + bytes(len(content) + 100))
    with pytest.raises(InputError, match="goes on beyond"):
        formats.read(path)
    path.write_bytes(content)
    whole_content = _open.whole_content

    def cut_before(*args, **options):
        os.truncate(path, 10**7)
        return whole_content(*args, **options)

    monkeypatch.setattr(_open, "whole_content", cut_before)
    with pytest.raises(InputError, match="found 10000000 bytes, wanted 34992012 for a table"):
        formats.read(path)
