"""Sheets that libraries read, receivers that a file states, and formats that are not read."""

import io
import json
import sys

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.errors import BrdfguideError, InputError
from brdfguide.physics.geometry import Geometry

from .test_programs import codes, paint, read, truth

# --- sheets of libraries ----------------------------------------------------------------------------------

ROWS = [(t, r, float(truth(Geometry.from_degrees(t, 0.0, abs(r), 180.0 if r > 0 else 0.0)).ravel()[0]))
        for t in (10.0, 40.0, 70.0) for r in range(-80, 81, 10)]  # fmt: skip


def workbook(**sheets) -> bytes:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def test_an_excel_sheet_is_read_as_a_table_is(tmp_path):
    head = [["grey paint, 633 nm"], [], ["AOI (deg)", "Scatter angle (deg)", "BRDF (1/sr)"]]
    measurement = read(tmp_path, workbook(notes=[["made up"]], scan=[*head, *ROWS]), "it.xlsx")
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-12)
    assert measurement.geom.wavelength == pytest.approx(0.633) and measurement.format == "Excel workbook"


def test_of_several_sheets_one_is_chosen(tmp_path):
    table = [["theta_i", "theta_r", "brdf"], *ROWS]
    content = workbook(first=table, second=[table[0], *((t, r, 2 * f) for t, r, f in ROWS)])
    with pytest.raises(InputError, match=r"2 sheets hold tables \(first, second\): choose one with --select"):
        read(tmp_path, content, "it.xlsx")
    measurement = read(tmp_path, content, "it.xlsx", select=("sheet=second",))
    np.testing.assert_allclose(measurement.brdf, 2 * truth(measurement.geom), rtol=1e-12)
    with pytest.raises(InputError, match="no sheet called 'third'; there are: first, second"):
        read(tmp_path, content, "it.xlsx", select=("sheet=third",))


def test_a_damaged_workbook_is_a_sentence(tmp_path):
    content = workbook(scan=[["theta_i", "theta_r", "brdf"], *ROWS])
    for damaged in (content[:-100], content[:400] + content[900:]):
        with pytest.raises(InputError, match="a damaged Excel workbook"):
            read(tmp_path, damaged, "it.xlsx")


def test_units_in_a_parquet_fields_metadata_are_heeded(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    rows = np.array(ROWS)
    for name, factor in (("theta_i", np.pi / 180), ("theta_i_deg", 1.0)):
        fields = [pyarrow.field(each, pyarrow.float64()) for each in (name, "theta_r_deg", "brdf")]
        fields[0] = fields[0].with_metadata({"units": "rad"})
        table = pyarrow.table([rows[:, 0] * factor, rows[:, 1], rows[:, 2]], schema=pyarrow.schema(fields))
        parquet.write_table(table, tmp_path / f"{name}.parquet")
    measurement = formats.read(tmp_path / "theta_i.parquet")
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-12)
    with pytest.raises(InputError, match="'theta_i_deg' is in deg by its name and in rad by its attribute 'units'"):
        formats.read(tmp_path / "theta_i_deg.parquet")


def test_a_parquet_table_is_read_as_a_table_is(tmp_path):
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    columns = dict(zip(("theta_i", "theta_r", "brdf"), map(list, zip(*ROWS, strict=True)), strict=True))
    white = pyarrow.table(columns | {"sample": ["white"] * len(ROWS)})
    black = pyarrow.table(columns | {"brdf": [f / 2 for f in columns["brdf"]], "sample": ["black"] * len(ROWS)})
    path = tmp_path / "it.parquet"
    parquet.write_table(pyarrow.concat_tables([white, black]), path)
    with pytest.raises(BrdfguideError, match=r"the column 'sample' names 2 groups \(white, black\)"):
        formats.read(path)
    assert formats.groups(path, "sample") == ("white", "black")
    measurement = formats.read(path, select=("sample=black",))
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom) / 2, rtol=1e-12)
    with pytest.raises(InputError, match="a damaged Parquet file"):
        read(tmp_path, path.read_bytes()[:-20], "cut.parquet")


@pytest.mark.parametrize(("module", "extra", "content"), [("openpyxl", "excel", b"PK\3\4[Content_Types].xml xl/"),
                                                          ("pyarrow", "parquet", b"PAR1....PAR1")])  # fmt: skip
def test_without_the_library_the_sentence_says_how_to_have_it(tmp_path, monkeypatch, module, extra, content):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match=rf"needs the package {module}: pip install 'brdfguide\[{extra}\]', or save"):
        read(tmp_path, content)


# --- OpenMATERIAL -----------------------------------------------------------------------------------------


def openmaterial(**more) -> str:
    rows = [[5.5e-7, 0.5, 0.1 * k, np.pi, 0.2] for k in range(10)]
    return json.dumps({"brdf": {"wavelengths": [5.5e-7], "lookupTable": rows} | more})


def test_the_receivers_solid_angle_is_the_detectors(tmp_path):
    stated = [{"wavelength": 5.5e-7, "solidAngle": 0.003}]
    measurement = read(tmp_path, openmaterial(receiverSolidAngles=stated))
    assert measurement.solid_angle == 0.003
    assert "0.003 sr, a cone of 1.8 degrees half angle" in codes(measurement)["receiver-solid-angle"].text
    assert read(tmp_path, openmaterial()).solid_angle is None


@pytest.mark.parametrize("angle", [0, -1, "x", None, 7, True])
def test_a_solid_angle_that_is_none_is_refused(tmp_path, angle):
    with pytest.raises(InputError, match="receiverSolidAngles, entry 1: found"):
        read(tmp_path, openmaterial(receiverSolidAngles=[{"solidAngle": angle}]))


# --- what is not read -------------------------------------------------------------------------------------

UNREAD = {
    "OPTIS - Coated surface file v1.0\nx\n2 3\n": "this is a Speos 'coated' file: it holds a model's parameters",
    "OPTIS - Scattering surface file v2.0\n": "this is a Speos 'scattering' file",
    b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 600: "an Excel workbook of before 2007",
    b"PK\x03\x04" + b"\0" * 26 + b"mimetypeapplication/vnd.oasis.opendocument.text": "an OpenDocument text",
    b"PK\x03\x04" + b"\0" * 26 + b"scan.csv": "a ZIP archive, which is not read; unpack it",
    b"MATLAB 5.0 MAT-file, Platform" + b"\0" * 100: "a MATLAB file",
    b"MATLAB 7.3 MAT-file, Platform" + b"\0" * 100: "a MATLAB file",
    "# made\nVERSION 1.0\n\nAPI libbsdf\nDATA_TYPE BRDF\n": "Surface Scattering Distribution Data",
    ";; This file is generated\n\nSource Measured\nTypeSym ASymmetrical\nTypeColorModel BW\n": "an Integra distr",
    "IESNA:LM-63-2002\n": "an IES photometry of a lamp",
    "<!DOCTYPE html>\n<html><body>404</body></html>": "a web page without a table, which is not read; download",
    '<?xml version="1.0"?>\n<materialx version="1.39">\n': "a MaterialX document",
    '<?xml version="1.0"?>\n<root><a>1</a></root>\n': "XML of another kind",
    "[10, -80, 0.066]\n": "JSON of another kind",
    b"\x28\xb5\x2f\xfd\x04" + b"\0" * 60: "a file packed by Zstandard, which is not read; unpack it",
    b"\x5d\0\0\x80\0" + b"\xff" * 60: "a file packed by LZMA",
    b"scan.csv" + b"\0" * 249 + b"ustar": "a tar archive",
    "theta_i\n".encode("utf-32"): "text in UTF-32",
    "version https://git-lfs.github.com/spec/v1\noid sha256:1\n": "the pointer to a file in Git LFS",
}


@pytest.mark.parametrize("content", UNREAD, ids=lambda content: UNREAD[content][:30])
def test_a_format_that_is_not_read_is_named_with_what_to_export_instead(tmp_path, content):
    with pytest.raises(InputError, match=UNREAD[content]) as caught:
        read(tmp_path, content)
    assert "columns" not in str(caught.value)


def test_fred_text_with_exclamation_marks_is_read(tmp_path):
    lines = ["!! made up", "type bsdf_data", "!! wavelength 633 nm", "format angles=deg bsdf=value scale=1", "30 0"]
    lines += [f"{r} 0 {paint(30.0, abs(r), 180.0 if r > 0 else 0.0).item()!r} !! one" for r in range(-80, 81, 10)]
    measurement = read(tmp_path, "\n".join(lines))
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)
    assert measurement.geom.wavelength == pytest.approx(0.633)
