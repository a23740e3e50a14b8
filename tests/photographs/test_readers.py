"""Every kind of picture is read to the last bit, and every hostile one is refused in one sentence."""

import struct
import subprocess
import sys
import zlib
from importlib.util import find_spec

import numpy as np
import pytest
from PIL import Image

from brdfguide.errors import InputError
from brdfguide.photographs.readers import read_picture

from .pictures import Matt, lamp_at, sphere, srgb, write_codes, write_dng, write_float_tiff

LIGHT = np.random.default_rng(5).random((40, 50, 3))


def refused(path, *words):
    with pytest.raises(InputError) as caught:
        read_picture(path)
    sentence = str(caught.value)
    assert "\n" not in sentence and path.name in sentence and all(word in sentence for word in words), sentence


def test_8_bit_pictures_are_decoded_as_srgb(tmp_path):
    write_codes(tmp_path / "a.png", srgb(LIGHT))
    assert read_picture(tmp_path / "a.png").light(slice(None)) == pytest.approx(LIGHT, abs=0.005)
    write_codes(tmp_path / "a.jpg", srgb(np.full((40, 50, 3), 0.3)), quality=95)
    assert read_picture(tmp_path / "a.jpg").light(slice(None)) == pytest.approx(0.3, abs=0.01)


def test_16_bits_are_read_exactly(tmp_path):
    cv2 = pytest.importorskip("cv2")
    codes = np.uint16(65535 * LIGHT)
    for name in ("a.png", "a.tif"):
        cv2.imwrite(str(tmp_path / name), codes[..., ::-1])
        picture = read_picture(tmp_path / name, "linear")
        assert np.array_equal(picture.codes, codes)
        assert picture.light(slice(None)) == pytest.approx(LIGHT, abs=2e-5)


def test_floats_are_read_exactly(tmp_path):
    pytest.importorskip("cv2")
    write_float_tiff(tmp_path / "a.tif", LIGHT)
    assert np.array_equal(read_picture(tmp_path / "a.tif").codes, np.float32(LIGHT))


@pytest.mark.parametrize("kind", [np.float16, np.float32])
def test_exr_is_read_exactly(tmp_path, kind):
    OpenEXR = pytest.importorskip("OpenEXR")
    path = tmp_path / "a.exr"
    OpenEXR.File({"type": OpenEXR.scanlineimage}, {"RGB": LIGHT.astype(kind)}).write(str(path))
    assert np.array_equal(read_picture(path).codes, LIGHT.astype(kind))


def test_a_raw_file_is_developed_linearly_with_white_where_the_sensor_has_it(tmp_path):
    pytest.importorskip("rawpy")
    light = sphere(Matt(0.5), lamp_at(40))
    for exposure in (1.0, 0.25):  # whatever is in the picture, light per code stays
        write_dng(tmp_path / "a.dng", exposure * light)
        got = read_picture(tmp_path / "a.dng").light(slice(None))
        inner = (light[..., 0] > 0.1) & (np.hypot(*(np.mgrid[0:160, 0:160] - 80)) < 60)
        assert got[inner] == pytest.approx(exposure * light[inner], rel=0.03)
        assert np.median(got[inner] / light[inner]) == pytest.approx(exposure, rel=0.002)


@pytest.mark.parametrize(
    "name, module", [("a.exr", "OpenEXR"), ("a.png", "cv2"), ("a.dng", "rawpy")], ids=["exr", "png16", "raw"]
)
def test_a_missing_package_is_named(tmp_path, monkeypatch, name, module):
    monkeypatch.setitem(sys.modules, module, None)
    content = {"a.exr": b"\x76\x2f\x31\x01" + b"x" * 90, "a.png": _png(50, 40, 16), "a.dng": b"II*\0" + b"x" * 90}
    (tmp_path / name).write_bytes(content[name])
    refused(tmp_path / name, "not installed", "brdfguide[photo]")


def _png(columns, rows, bits, colour=2, body=b""):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", columns, rows, bits, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def test_hostile_pictures_are_refused_in_a_sentence(tmp_path):
    def file(name, content):
        (tmp_path / name).write_bytes(content)
        return tmp_path / name

    refused(file("empty.png", b""), "empty")
    refused(file("text.jpg", b"no picture at all"), "no picture")
    refused(file("bomb.png", _png(60000, 60000, 8, body=zlib.compress(bytes(1000)))), "million")
    refused(file("bomb16.png", _png(60000, 60000, 16)), "million")
    Image.new("RGB", (1, 1)).save(tmp_path / "one.png")
    refused(tmp_path / "one.png", "1 x 1")
    Image.new("CMYK", (64, 64)).save(tmp_path / "inks.jpg")
    refused(tmp_path / "inks.jpg", "CMYK")
    Image.new("P", (64, 64)).save(tmp_path / "palette.png")
    refused(tmp_path / "palette.png", "palette")
    Image.new("L", (64, 64)).save(tmp_path / "grey.png")
    refused(tmp_path / "grey.png", "red, green and blue")
    Image.new("RGBA", (64, 64), (9, 9, 9, 128)).save(tmp_path / "alpha.png")
    refused(tmp_path / "alpha.png", "alpha")
    whole = tmp_path / "whole.jpg"
    write_codes(whole, srgb(LIGHT))
    refused(file("cut.jpg", whole.read_bytes()[:900]), "cut off")
    refused(tmp_path / "nothing.png", "no such file")
    raw = file("folder.dng", b"II*\0" + bytes(100))
    refused(raw, "damaged" if find_spec("rawpy") else "needs the package rawpy, which is not installed")


def test_an_exr_that_is_cut_off_or_holds_no_colours_is_refused(tmp_path):
    OpenEXR = pytest.importorskip("OpenEXR")
    path = tmp_path / "a.exr"
    OpenEXR.File({"type": OpenEXR.scanlineimage}, {"RGB": np.float32(LIGHT)}).write(str(path))
    (tmp_path / "cut.exr").write_bytes(path.read_bytes()[:3000])
    refused(tmp_path / "cut.exr", "cut off")
    OpenEXR.File({"type": OpenEXR.scanlineimage}, {"Z": np.float32(LIGHT[..., 0])}).write(str(path))
    refused(path, "wanted R, G and B")


def test_a_picture_is_turned_as_its_exif_says(tmp_path):
    exif = Image.Exif()
    exif[274] = 6  # the camera was turned by a quarter
    codes = np.uint8(255 * LIGHT)
    Image.fromarray(codes).save(tmp_path / "a.png", exif=exif)
    picture = read_picture(tmp_path / "a.png")
    assert np.array_equal(picture.codes, np.rot90(codes, -1))
    assert [each.code for each in picture.findings] == ["turned-upright"]


def test_an_opaque_alpha_channel_does_no_harm(tmp_path):
    codes = np.dstack([np.uint8(255 * LIGHT), np.full((40, 50), 255, np.uint8)])
    Image.fromarray(codes).save(tmp_path / "a.png")
    assert np.array_equal(read_picture(tmp_path / "a.png").codes, codes[..., :3])


def test_a_bad_picture_ends_the_command_with_status_2_and_one_sentence(tmp_path):
    (tmp_path / "a.png").write_bytes(b"")
    (tmp_path / "s.yaml").write_text("photographs: sphere\ncamera: far\nshots: [{file: a.png, phase_deg: 40}]\n")
    ran = subprocess.run(
        [sys.executable, "-m", "brdfguide", "inspect", str(tmp_path / "s.yaml")], capture_output=True, text=True
    )
    assert ran.returncode == 2 and ran.stdout == "" and ran.stderr.count("\n") == 1 and "a.png" in ran.stderr
