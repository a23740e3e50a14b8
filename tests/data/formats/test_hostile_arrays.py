"""HDF5 and zarr that no honest program writes: a sentence each, and nothing read that is not there."""

import gc
import io
import json
import os
import shutil
import signal
import zipfile
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.data.blocks import joined
from brdfguide.data.formats import _named_arrays, hdf5
from brdfguide.errors import InputError
from brdfguide.opening import Held
from tests.data.formats.test_named_arrays import Hdf5, Zarr, Zipped, columns, filled


@pytest.fixture(params=[Hdf5, Zarr, Zipped], ids=["hdf5", "zarr", "zipped"])
def made(request, tmp_path):
    return request.param(tmp_path / "wall")


def test_columns_of_what_is_no_number_are_a_sentence(made):
    made.array("table", np.ones((9, 4)) + 1j, columns="theta_i,theta_r,phi_r,brdf")
    path = made.done()
    with pytest.raises(
        InputError, match=r"found '\(1\+1j\)', wanted a number|holds complex128, wanted numbers or words"
    ):
        formats.read(path)


@pytest.mark.parametrize(("value", "said"), [("x", "'x'"), (float("inf"), "'inf'"), ([], r"'\[\]'")])
def test_a_scale_that_is_no_number_is_a_sentence(value, said, made):
    content = columns(9)
    brdf = content.pop("G")
    path = filled(made, content).array("brdf", brdf, scale_factor=value).done()
    with pytest.raises(InputError, match=f"found scale_factor {said}, wanted a finite number"):
        formats.read(path, columns=("brdf=brdf",))


def test_hdf5_with_what_few_files_have_is_read_or_a_sentence(tmp_path):
    h5py = pytest.importorskip("h5py")
    made = filled(Hdf5(tmp_path / "nothing"), columns(20))
    made.group["none"] = h5py.Empty("f8")
    made.attributes(columns=h5py.Empty("S1"))
    made.group["R"].attrs.update(units=h5py.Empty("S1"), missing_value=[-9.0, -8.0])
    assert len(formats.read(made.done()).brdf) == 20
    made = filled(Hdf5(tmp_path / "three"), columns(20))
    made.group.create_dataset("brdf", (20,), np.dtype(("f8", (3,))))
    with pytest.raises(InputError, match="'/brdf' holds .* wanted numbers or words"):
        formats.read(made.done())
    made = filled(Hdf5(tmp_path / "name"), columns(20))
    made.group.id.links.move(b"R", made.group.id, b"R\xff")
    with pytest.raises(InputError, match="the name 'R.*' in it is not UTF-8"):
        formats.read(made.done())


def test_groups_that_meet_again_and_again_are_a_sentence(tmp_path):
    made = Hdf5(tmp_path / "fan")
    last = made.group.create_group("end")
    for level in range(7):
        group = made.group.create_group(f"level{level}")
        for each in range(15):
            group[str(each)] = last
        last = group
    with pytest.raises(InputError, match="more than 10000 arrays and groups in it"):
        formats.read(made.done())


def test_a_promise_is_held_against_what_is_kept_of_the_table(tmp_path):
    made = Hdf5(tmp_path / "padded")
    for name in ("theta_i", "theta_r", "brdf"):
        made.group.create_dataset(name, (10**8,), "f8", chunks=(10**6,))
    made.group["cube"] = np.random.default_rng(1).uniform(size=(1, 1, 10**6))
    with pytest.raises(InputError, match="/ promises 100000000 rows of 3 columns in 0 bytes"):
        formats.read(made.done())


def test_types_that_end_the_process_when_damaged_are_not_read(tmp_path):
    h5py = pytest.importorskip("h5py")
    made = filled(Hdf5(tmp_path / "lists"), columns(20))
    lists = np.empty(1, object)
    lists[0] = np.array([1.0, 2.0])
    made.group.attrs.create("of", lists, dtype=h5py.vlen_dtype("f8"))
    made.group.attrs["other"] = made.group.ref
    path = made.done()
    assert len(formats.read(path).brdf) == 20
    with h5py.File(path, "r+") as file:
        file.create_dataset("brdf", (20,), h5py.vlen_dtype("f8"))
    with pytest.raises(InputError, match="'/brdf' holds object, wanted numbers or words"):
        formats.read(path)


def test_a_folder_in_zarr_that_lost_what_it_is_is_a_sentence(tmp_path):
    path = filled(Zarr(tmp_path / "wall"), columns(20)).done()
    (path / "notes.txt").write_text("a plain file is no part of it")
    assert formats.read(path).channels == ("R", "G", "B")
    (path / "R" / "zarr.json").unlink()
    with pytest.raises(InputError, match="'R' in it is a folder that is neither an array nor a group"):
        formats.read(path)


@pytest.mark.parametrize("codec", ["zlib", "lzma"])
def test_damage_that_a_codec_tells_in_its_own_way_is_a_sentence(codec, tmp_path):
    made = Zarr(tmp_path / codec)
    made.group = made.root = made.zarr.open_group(str(made.path), mode="w", zarr_format=2)
    path = filled(made, columns(20)).done()
    described = path / "R" / ".zarray"
    described.write_text(json.dumps(json.loads(described.read_text()) | {"compressor": {"id": codec}}))
    with pytest.raises(InputError, match="a damaged zarr table"):
        formats.read(path)


def test_zarr_is_what_is_there_and_not_what_a_list_says(tmp_path):
    made = filled(Zarr(tmp_path / "wall"), columns(20))
    with pytest.warns():
        made.zarr.consolidate_metadata(str(made.path))
    shutil.rmtree(made.path / "R")
    with pytest.raises(InputError, match="no column for brdf"):
        formats.read(made.done())


def test_chunks_that_are_not_there_are_told(tmp_path, monkeypatch):
    path = filled(Zarr(tmp_path / "wall"), columns(100), 30).done()
    assert "absent-chunks" not in [
        each.code for each in formats.read(path).findings
    ]  # phi_i is zero, and never written
    (path / "R" / "c" / "1").unlink()
    (path / "G" / "c" / "0").unlink()
    monkeypatch.setattr(_named_arrays, "LARGEST_CELLS", 20)
    for measurement in (formats.read(path), joined(list(formats.in_blocks(path)))):
        (note,) = [each for each in measurement.findings if each.code == "absent-chunks"]
        assert note.severity == "warning" and "1 of 4 of 'R', 1 of 4 of 'G'" in note.text


def test_a_root_of_no_known_kind_is_a_sentence(tmp_path):
    path = tmp_path / "wall.h5"
    with pytest.importorskip("h5py").File(path, "w") as file:
        for name in ("theta_i", "theta_r", "brdf"):
            file[name] = np.arange(10.0)
    content = bytearray(path.read_bytes())
    content[112] ^= 255  # of the first message in the root's header: its type
    path.write_bytes(content)
    with pytest.raises(InputError, match="a damaged HDF5 table: .*unable to determine object type"):
        formats.read(path)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a system that limits processor time")
@pytest.mark.parametrize(
    ("does", "said"),
    [
        ("signal.setitimer(signal.ITIMER_PROF, 0.05)\nwhile True:\n    pass", "reading it does not end"),
        ("os.kill(os.getpid(), signal.SIGSEGV)", "reading it ends the process that does it"),
    ],
)
def test_a_file_that_stops_the_library_stops_another_process(does, said, tmp_path, monkeypatch):
    path = filled(Hdf5(tmp_path / "wall"), columns(9)).done()
    assert len(formats.read(path).brdf) == 9
    path.touch()  # another time: it is tried again
    trial = tmp_path / "trial.py"
    trial.write_text(f"import os, signal\n{does}\n")
    monkeypatch.setattr(hdf5._hdf5_trial, "__file__", str(trial))
    with pytest.raises(InputError, match=f"a damaged HDF5 table: {said}"):
        formats.read(path)


def test_what_is_read_of_a_file_is_touched_beforehand(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = filled(Hdf5(tmp_path / "wall"), columns(9)).done()
    with path.open("rb") as file:
        hdf5._hdf5_trial.touch(file, h5py)
    cut = io.BytesIO(path.read_bytes()[:-400])
    with pytest.raises(OSError, match="truncated"):
        hdf5._hdf5_trial.touch(cut, h5py)


def test_hdf5_that_is_cut_while_it_is_read_is_a_sentence(tmp_path):
    """The library takes what lies in memory for numbers that it asked for and was not given."""
    content = {name: np.repeat(values, 4000) for name, values in columns(9).items()}
    path = filled(Hdf5(tmp_path / "wall"), content).done()
    _, source = formats.opened(path)
    tables = hdf5._tables(source)
    os.truncate(path, path.stat().st_size // 2)
    with pytest.raises(InputError, match="a damaged HDF5 table: the file was cut short while it was read"):
        _named_arrays.read_table(source, tables, formats.Options())


LACKS = "packed with a codec that is not installed: "


def test_a_codec_that_is_not_installed_is_told_as_that(tmp_path):
    folder = filled(Zarr(tmp_path / "wall"), columns(20)).done()
    about = json.loads((folder / "R" / "zarr.json").read_text())
    about["codecs"][-1] = {"name": "imaginary", "configuration": {}}
    (folder / "R" / "zarr.json").write_text(json.dumps(about))
    with pytest.raises(InputError, match=f"{LACKS}Unknown codec: 'imaginary'"):
        formats.read(folder)
    made = Hdf5(tmp_path / "wall")
    for name, values in columns(20).items():
        made.group.create_dataset(name, data=values, compression="gzip")
    path = made.done()
    content = path.read_bytes()
    place = content.index(b"deflate\0") - 8
    assert content[place : place + 2] == b"\1\0"  # the number of the filter
    path.write_bytes(content[:place] + b"\x0f\x7d" + content[place + 2 :])
    with pytest.raises(InputError, match=rf"{LACKS}filter 32015 \(deflate\) is not registered"):
        formats.read(path)


def test_a_zip_of_a_folder_is_read_as_the_folder_and_a_damaged_one_is_a_sentence(tmp_path, capsys):
    folder = filled(Zarr(tmp_path / "wall"), columns(20)).done()
    whole = formats.read(folder).brdf
    path = Path(shutil.make_archive(str(tmp_path / "named"), "zip", tmp_path, folder.name))  # wall.zarr/zarr.json...
    np.testing.assert_array_equal(formats.read(path).brdf, whole)
    with pytest.raises(InputError, match="a ZIP of one, is read where it lies, not from a stream"):
        formats.read(Held("-", path.read_bytes()))
    raw = path.read_bytes()
    for place in range(0, len(raw), len(raw) // 40):
        path.write_bytes(raw[:place] + bytes([raw[place] ^ 255]) + raw[place + 1 :])
        with suppress(InputError):
            assert len(formats.read(path).brdf)
        path.write_bytes(raw[: max(place, 60)])
        with pytest.raises(InputError, match="a damaged zarr table: File is not a zip file"):
            formats.read(path)
    gc.collect()
    assert not capsys.readouterr().err  # nor what asyncio says of errors that nobody asked for


def test_a_zip_of_several_folders_or_of_zeros_is_a_sentence(tmp_path):
    for name in ("first", "second"):
        filled(Zarr(tmp_path / "both" / name), columns(9)).done()
    with pytest.raises(InputError, match=r"2 zarr folders in it \(.*\); wanted one"):
        formats.read(shutil.make_archive(str(tmp_path / "both"), "zip", tmp_path / "both"))
    with zipfile.ZipFile(tmp_path / "zeros.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("zarr.json", bytes(2**24))
    with pytest.raises(InputError, match="unpacks to more than 200 times its size"):
        formats.read(tmp_path / "zeros.zip")
