"""HDF5 and zarr: the same numbers are the same answer as in a table of text; what is no table is a sentence."""

import gzip
import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

import brdfguide
from brdfguide.batch.keys import bytes_of
from brdfguide.batch.listing import expanded
from brdfguide.cli import main
from brdfguide.data import formats
from brdfguide.data.blocks import Blocks, joined
from brdfguide.data.formats import _named_arrays
from brdfguide.errors import BrdfguideError, InputError
from brdfguide.fitting.residuals import rms_over_all

NAMES = ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", "R", "G", "B")
ROWS = 3000


def columns(rows: int = ROWS) -> dict[str, np.ndarray]:
    """A made paint with 3 % of noise."""
    draw = np.random.default_rng(3)
    theta_i, theta_r = np.round(np.degrees(np.arccos(np.sqrt(draw.uniform(0.03, 1.0, (2, rows))))), 3)
    phi = np.round(draw.uniform(0, 360, rows), 3)
    grey = 0.1 + 0.2 * np.exp(-(((theta_i - theta_r) / 10) ** 2) - ((phi - 180) / 20) ** 2)
    brdf = grey[:, None] * [1.0, 0.7, 0.4] * (1 + 0.03 * draw.standard_normal((rows, 3)))
    return dict(zip(NAMES, (theta_i, np.zeros(rows), theta_r, phi, *brdf.T), strict=True))


class Hdf5:
    name, extra, suffix = "h5py", "hdf5", ".h5"

    def __init__(self, path):
        self.path, self.h5py = path.with_suffix(self.suffix), pytest.importorskip("h5py")
        self.group = self.root = self.h5py.File(self.path, "w")

    def inside(self, name):
        self.group = self.root.create_group(name)
        return self

    def array(self, name, data, chunk=None, **attributes):
        made = self.group.create_dataset(name, data=data, chunks=chunk and (chunk, *np.shape(data)[1:]))
        made.attrs.update(attributes)
        return self

    def attributes(self, **attributes):
        self.group.attrs.update(attributes)
        return self

    def done(self):
        self.root.close()
        return self.path


class Zarr(Hdf5):
    name, extra, suffix = "zarr", "zarr", ".zarr"

    def __init__(self, path):
        self.path, self.zarr = path.with_suffix(self.suffix), pytest.importorskip("zarr")
        self.group = self.root = self.zarr.open_group(str(self.path), mode="w")

    def array(self, name, data, chunk=None, **attributes):
        data = np.asarray(data)
        more = {"chunks": (chunk, *data.shape[1:])} if chunk else {}
        made = self.group.create_array(name, data=data, **more)
        made.attrs.update(attributes)
        return self

    def done(self):
        return self.path


class Zipped(Zarr):
    def done(self):
        return Path(shutil.make_archive(str(self.path), "zip", self.path))


@pytest.fixture(params=[Hdf5, Zarr, Zipped], ids=["hdf5", "zarr", "zipped"])
def made(request, tmp_path):
    return request.param(tmp_path / "wall")


def filled(made, content=None, chunk=None):
    for name, each in (content or columns()).items():
        made.array(name, each, chunk)
    return made


def as_text(path, content, comments=""):
    rows = "".join(",".join(map(repr, row)) + "\n" for row in np.transpose(list(content.values())).tolist())
    path.write_text(comments + ",".join(content) + "\n" + rows)
    return path


def told(capsys, *words) -> str:
    with pytest.raises(SystemExit) as end:
        main(list(map(str, words)))
    assert not end.value.code
    return capsys.readouterr().out


# --- what is a table ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("layout", ["columns", "rows"])
def test_the_answer_is_that_of_the_same_numbers_as_text(layout, made, tmp_path, capsys):
    content = columns(200)
    text = as_text(tmp_path / "wall.csv", content, "# wavelength_nm: 633\n")
    if layout == "columns":
        path = filled(made, content).attributes(wavelength_nm=633, columns=list(content)).done()
    else:
        values = np.transpose(list(content.values()))
        made.inside("scan").array("table", values, columns=",".join(content), wavelength_nm=633)
        path = made.done()
    asked = ["-m", "lambertian+ggx", "--json", "--no-timing"]
    expected, answer = (json.loads(told(capsys, "fit", each, *asked)) for each in (text, path))
    assert answer["data"].pop("format") in ("HDF5 table", "zarr table") and expected["data"].pop("format") == "table"
    for each in (expected, answer):
        each["data"].pop("file")
        each.pop("digest")
    assert json.dumps(answer) == json.dumps(expected)


def test_columns_come_in_an_order_of_their_own(made):
    names = ["400nm", "1000nm", "phi_i", "theta_i", "R", "G", "B"]
    assert _named_arrays.sorted_names(sorted(names)) == names
    path = filled(made).done()
    assert formats.read(path).channels == ("R", "G", "B")


def test_an_attribute_says_the_order(made):
    path = filled(made, columns(100)).attributes(columns=[*NAMES[:4], "B", "R", "G"]).done()
    assert formats.read(path).channels == ("B", "R", "G")


@pytest.mark.parametrize(("name", "units"), [("theta_i_deg", "rad"), ("phi_r_rad", "degree")])
def test_a_unit_that_contradicts_the_name_is_a_sentence(name, units, made):
    content = columns(9)
    content = {name if key[:5] == name[:5] else key: each for key, each in content.items()}
    values = content.pop(name)
    path = filled(made, content).array(name, values, units=units).done()
    with pytest.raises(InputError, match=rf"'{name}' is in (deg|rad) by its name and in .* 'units' \('{units}'\)"):
        formats.read(path)


def test_units_marks_and_packing_are_heeded(made):
    content = columns(100)
    brdf = np.round(content["G"] * 1e4).astype("i4")
    brdf[7] = -9
    for name, role in (("in", "theta_i_deg"), ("out", "theta_r_deg")):
        made.array({"in": "theta_i", "out": "theta_r"}[name], np.radians(content[role]), units="rad")
    made.array("phi_r", content["phi_r_deg"], units="degree")
    path = made.array("brdf", brdf, _FillValue=-9, scale_factor=1e-4).done()
    found = formats.read(path)
    kept = np.arange(100) != 7
    np.testing.assert_allclose(found.brdf[np.isfinite(found.brdf[:, 0]), 0], brdf[kept] * 1e-4, rtol=1e-12)
    np.testing.assert_allclose(found.geom.theta_i_deg[0], content["theta_i_deg"][0], rtol=1e-9)


@pytest.mark.parametrize("version", [2, 3])
def test_a_fill_value_of_zarr_is_a_mark_for_missing(tmp_path, version):
    zarr = pytest.importorskip("zarr")
    group = zarr.open_group(str(tmp_path / "wall.zarr"), mode="w", zarr_format=version)
    content = columns(100)
    content["G"][7] = -1.0
    for name, each in content.items():
        group.create_array(name, data=each, fill_value=-1.0 if name == "G" else 0.0)
    lost = np.isnan(formats.read(tmp_path / "wall.zarr").brdf)
    assert lost.sum() == 1 and lost[7].any()


def test_words_name_groups(made):
    content = columns(100) | {"sample": np.array(["white"] * 60 + ["black"] * 40, dtype="S5")}
    if made.name == "zarr":
        content["sample"] = content["sample"].astype("U5")
    with pytest.warns() if made.name == "zarr" else pytest.MonkeyPatch.context():
        filled(made, content)
    path = made.done()
    assert formats.groups(path, "sample") == ("white", "black")
    with pytest.raises(BrdfguideError, match="the column 'sample' names 2 groups"):
        formats.read(path)
    assert len(formats.read(path, select=("sample=black",)).brdf) == 40


def test_of_several_tables_one_is_chosen(made):
    filled(made.inside("white"), columns(50))
    path = filled(made.inside("black"), columns(70)).done()
    with pytest.raises(InputError, match=r"2 tables \(/black, /white\): choose one with --select group=/black"):
        formats.read(path)
    assert len(formats.read(path, select=("group=white",)).brdf) == 50
    with pytest.raises(InputError, match="no table called 'grey'; there are: /black, /white"):
        formats.read(path, select=("group=grey",))


# --- what is none -------------------------------------------------------------------------------------------


def refused(path, capsys) -> str:
    """The one sentence with which the command ends."""
    with pytest.raises(SystemExit) as end:
        main(["fit", str(path)])
    error = capsys.readouterr().err
    assert end.value.code == 2 and path.name in error
    return " ".join(error.split())


def test_what_is_no_table_is_a_sentence_with_what_was_found_and_wanted(made, capsys):
    made.array("cube", np.zeros((3, 4, 5))).inside("deep").array("table", np.ones((9, 4)))
    said = refused(made.done(), capsys)
    assert "/deep/table (9, 4)" in said and "/cube (3, 4, 5)" in said and "wanted a group of 1-D arrays" in said


def test_columns_of_two_lengths_are_a_sentence(made, capsys):
    path = made.array("theta_i", np.ones(5)).array("brdf", np.ones(4)).done()
    assert "found 4 values of 'brdf' and 5 of 'theta_i'; wanted columns of one length" in refused(path, capsys)


def test_names_that_do_not_go_with_the_columns_are_a_sentence(made, capsys):
    path = made.array("table", np.ones((9, 4)), columns="theta_i,theta_r,brdf").done()
    assert "/table has 4 columns, and its attribute names 3" in refused(path, capsys)


def test_an_order_that_does_not_name_the_arrays_is_a_sentence(made):
    path = filled(made, columns(9)).attributes(columns="theta_i_deg,brdf").done()
    with pytest.raises(InputError, match="the attribute that names the columns does not go with its arrays"):
        formats.read(path)


def test_a_promise_that_no_file_can_hold_is_a_sentence(made):
    if made.name == "h5py":
        for name in ("theta_i", "theta_r", "brdf"):
            made.group.create_dataset(name, (10**11,), "f8", chunks=(10**6,))
    else:
        for name in ("theta_i", "theta_r", "brdf"):
            made.group.create_array(name, shape=(10**11,), dtype="f8", chunks=(10**6,))
    path = made.done()
    for take in (formats.read, formats.in_blocks):
        with pytest.raises(InputError, match="more than such a file can honestly hold"):
            take(path)


def test_without_the_library_the_sentence_says_how_to_have_it(made, monkeypatch):
    path = filled(made, columns(9)).done()
    monkeypatch.setitem(sys.modules, made.name, None)
    with pytest.raises(InputError, match=rf"needs the package {made.name}: pip install 'brdfguide\[{made.extra}\]'"):
        formats.read(path)


def test_hdf5_that_lies_elsewhere_is_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    other = filled(Hdf5(tmp_path / "other"), columns(9)).done()
    links = {"soft": h5py.SoftLink("/x"), "external": h5py.ExternalLink(str(other), "/R")}
    for name, link in links.items():
        made = Hdf5(tmp_path / name)
        made.group["x"] = np.ones(9)
        made.group["y"] = link
        with pytest.raises(InputError, match="'y' is a link to another place or file"):
            formats.read(made.done())
    made = Hdf5(tmp_path / "virtual")
    layout = h5py.VirtualLayout((9,), "f8")
    layout[:] = h5py.VirtualSource(str(other), "R", (9,))
    made.group.create_virtual_dataset("v", layout)
    with pytest.raises(InputError, match="'v' keeps its numbers in other files"):
        formats.read(made.done())
    made = Hdf5(tmp_path / "raw")
    made.group.create_dataset("e", (9,), "f8", external=[(str(other), 0, 72)])
    with pytest.raises(InputError, match="'e' keeps its numbers in other files"):
        formats.read(made.done())


def test_damaged_hdf5_is_a_sentence(tmp_path):
    path = filled(Hdf5(tmp_path / "wall"), columns(200)).done()
    content = path.read_bytes()
    for damaged in (content[:-2000], content[:600], content[:8] + bytes(200) + content[208:]):
        path.write_bytes(damaged)
        with pytest.raises(InputError, match="a damaged HDF5 table"):
            formats.read(path)


def test_damaged_zarr_is_a_sentence(tmp_path):
    path = filled(Zarr(tmp_path / "wall"), columns(200)).done()
    chunk = next(each for each in sorted(path.rglob("*")) if each.parent.name == "c")
    kept = chunk.read_bytes()
    chunk.write_bytes(kept[:20])
    with pytest.raises(InputError, match="a damaged zarr table"):
        formats.read(path)
    chunk.unlink()
    chunk.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="in it is no plain file"):
        formats.read(path)
    chunk.unlink()
    (path / "zarr.json").write_text("{")
    with pytest.raises(InputError, match="a damaged zarr table"):
        formats.read(path)


# --- where they come from -----------------------------------------------------------------------------------


def test_packed_hdf5_is_read(tmp_path):
    path = filled(Hdf5(tmp_path / "wall")).done()
    packed = tmp_path / "wall.h5.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    assert np.array_equal(formats.read(packed).brdf, formats.read(path).brdf)


def test_a_zarr_folder_is_one_file_of_a_folder(tmp_path):
    scans = tmp_path / "scans"
    scans.mkdir()
    as_text(scans / "a.csv", columns(9))
    path = filled(Zarr(scans / "wall"), columns(9)).done()
    assert expanded([str(scans)], (), True, formats.is_readable).labels == [str(scans / "a.csv"), str(path)]
    assert expanded([str(path)], (), False, formats.is_readable).labels == [str(path)]
    before = bytes_of(path)
    Zarr.array(Hdf5.inside(Zarr(scans / "wall"), "more"), "x", np.ones(3))
    assert bytes_of(path) != before


# --- in pieces ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("chunk", [None, 300, 2500])
def test_large_ones_are_read_in_pieces(chunk, made, monkeypatch):
    path = filled(made, chunk=chunk).done()
    whole = formats.read(path)
    monkeypatch.setattr(_named_arrays, "LARGEST_CELLS", 20_000)
    monkeypatch.setattr(_named_arrays, "TOGETHER", 1000)
    blocks = formats.in_blocks(path, theta_max=70.0)
    parts = list(blocks)
    kept = whole[(np.maximum(whole.geom.theta_i_deg, whole.geom.theta_r_deg) <= 70)[:, 0]]
    assert chunk is None or len(parts) == {300: 4, 2500: 2}[chunk]
    assert np.array_equal(joined(parts).brdf, kept.brdf)
    sample = blocks.sample(500)
    assert 350 < len(sample.brdf) <= 500 and np.all(np.isin(sample.brdf[:, 0], whole.brdf[:, 0]))
    monkeypatch.setattr(Blocks.sample, "__defaults__", (2000, 0))
    answer = brdfguide.fit(path, ["lambertian+ggx"], timing=False)
    assert answer.recommended.rms_ln == pytest.approx(rms_over_all([answer.recommended.surface], whole)[0], rel=1e-12)
