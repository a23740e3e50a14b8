"""Files of optical engineers' and planners' programs, made from nothing: valid ones, and then damaged."""

import io
import json
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from xml.sax.saxutils import escape
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
from damage import NUMBERS, damaged

_WORDS = """
    OPTIS - Anisotropic BSDF surface file v8.0 brdf v9.0 0 1 180 360 TracePro Table_BSDF_Data Temperature
    Wavelength IncAngle AziAngle ScatterBeta ScatterAzimuth BRDF BTDF LBNL/Klems Full Half Quarter Columns Rows
    TensorTree4 WavelengthDataDirection Reflection Front Transmission Back ScatteringData ColumnAngleBasis
    AngleBasisBlock nPhis UpperTheta Visible Solar theta_i theta_r sheet sample brdf rotation
"""
WORDS = _WORDS.split()
FLAGS = ("1\t0",) * 8 + ("0\t1", "1\t1")  # reflection, transmission


def _value(draw: Random) -> float:
    return draw.choice((round(draw.uniform(0.01, 2), 4), 10 ** draw.uniform(-8, 4), 0.0, -0.01))


def _angles(draw: Random, most: int, high: int) -> list[int]:
    return sorted(draw.sample(range(high), draw.randint(1, most)))


def _speos_table(draw: Random, theta: list[int], phi: list[int]) -> str:
    rows = "".join("\t".join([str(t), *(f"{_value(draw):.4g}" for _ in phi)]) + "\n" for t in theta)
    return f"{len(theta)} {len(phi)}\n\t" + "\t".join(map(str, phi)) + "\n" + rows


def speos(draw: Random) -> bytes:
    incidences, rotations = _angles(draw, 3, 90), _angles(draw, 2, 180)
    if draw.random() < 0.15:
        return _speos_binary(draw)
    listed = "\t".join(map(str, incidences))
    theta, phi = _angles(draw, 5, 91), _angles(draw, 5, 361)
    head = f"OPTIS - Anisotropic BSDF surface file v{draw.choice(('7.0', '8.0', '11'))}\n0\nmade\n4\nmade\n1\t0\t0\n"
    head += f"{draw.choice(FLAGS)}\n{draw.choice('001')}\n{len(rotations)}\n"
    head += "\t".join(map(str, rotations)) + "\n" + f"{len(incidences)}\n{listed}\n" * len(rotations)
    spectrum = f"{incidences[0]}\t0\n\n2\n400\t{draw.choice((20, 20, 20, 0, 150))}\n800\t{draw.choice((20, 30))}\n"
    tables = "".join(_speos_table(draw, theta, phi) for _ in rotations for _ in incidences)
    text = head + spectrum + tables + "End of file\n"
    return text.encode() if draw.random() < 0.3 else damaged(draw, text, WORDS)


def _speos_binary(draw: Random) -> bytes:
    """Bytes behind the title of a binary file, true at first and then anything."""
    head = bytes.fromhex("3103000000010000000000000000000000" + "00" + "000000000000f03f") + b"\0" * 16
    head += b"\1\0" + np.array([1.0, 1.0], "<f8").tobytes() + b"\0\0" + (1).to_bytes(4, "little")
    body = (8).to_bytes(8, "little") + (8).to_bytes(4, "little") + (9).to_bytes(4, "little") + b"\x80" + b"\0" * 8
    data = bytearray(
        b"OPTIS - Anisotropic BSDF surface file v9.0\n" + head + body + draw.randbytes(draw.randrange(600))
    )
    for _ in range(draw.choice((0, 1, 4))):
        data[draw.randrange(43, len(data))] = draw.randrange(256)
    return bytes(data)


def speos_brdf(draw: Random) -> bytes:
    incidences, nm = _angles(draw, 3, 90), sorted(draw.sample(range(380, 780), draw.randint(1, 3)))
    head = "OPTIS - brdf surface file v9.0\n0\nmade\n0\n\n1\t0\n1\n"
    head += f"{len(incidences)}\t{len(nm)}\n" + "\t".join(map(str, incidences)) + "\n" + "\t".join(map(str, nm)) + "\n"
    theta, phi = _angles(draw, 5, 91), _angles(draw, 5, 361)
    tables = [_speos_table(draw, theta, phi) for _ in incidences]
    body = "".join(f"{draw.choice((10, 20, 0))}\n{table}" for table in tables for _ in nm)
    return damaged(draw, head + body, WORDS)


def tracepro(draw: Random) -> bytes:
    lines = ["TracePro Surface Property Data", "File Name\tx", "", "Table_BSDF_Data"]
    lines.append("Temperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF")
    turns, waves = draw.choice(((0,), (0, 90))), draw.choice(((0.55,), (0.45, 0.65)))
    for angle in _angles(draw, 3, 90):
        for beta in (0, 0.2, 0.6, 1.1):
            where = [(turn, wave, phi) for turn in turns for wave in waves for phi in (0, 90, 180)]
            lines += [f"300\t{w}\t{angle}\t{t}\t{beta}\t{phi}\t{_value(draw):.4g}\t0" for t, w, phi in where]
    return damaged(draw, "\n".join(lines) + "\n", WORDS)


def klems(draw: Random) -> bytes:
    own = draw.random() < 0.7
    count = draw.choice((1, 5)) if own else 41
    rings = [(10, 1)] if count == 1 else [(10, 1), (90, 4)]
    blocks = "".join(
        f"<AngleBasisBlock><nPhis>{each}</nPhis><ThetaBounds><UpperTheta>{upper}</UpperTheta></ThetaBounds>"
        "</AngleBasisBlock>"
        for upper, each in rings
    )
    name = "made" if own else "LBNL/Klems Quarter"
    basis = f"<AngleBasis><AngleBasisName>made</AngleBasisName>{blocks}</AngleBasis>" if own else ""
    data = ",\n".join(f"{_value(draw):.4g}" for _ in range(count**2))
    text = (
        '<?xml version="1.0"?>\n<WindowElement><DataDefinition>'
        f"<IncidentDataStructure>Columns</IncidentDataStructure>"
        f"{basis}</DataDefinition><WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock>"
        "<WavelengthDataDirection>Reflection Front</WavelengthDataDirection>"
        f"<ColumnAngleBasis>{name}</ColumnAngleBasis>"
        f"<RowAngleBasis>{name}</RowAngleBasis><ScatteringData>\n{data}\n</ScatteringData></WavelengthDataBlock>"
        "</WavelengthData></WindowElement>\n"
    )
    return damaged(draw, text, WORDS)


def utia(draw: Random) -> bytes:
    """Doubles of the one size, or nearly; of one value, of few, or of any bits."""
    values = np.full(3 * 288 * 288, draw.choice((0.1, 0.0, -1.0, 1e300, np.nan, np.inf, 1e-300)))
    for _ in range(draw.randrange(4)):
        at = draw.randrange(len(values))
        values[at : at + draw.choice((1, 100, 10**5))] = draw.choice((0.2, -0.1, np.nan, 1e308, 5.0))
    data = values.astype("<f8").tobytes()
    return data[: draw.choice((len(data), len(data), len(data) - 8, draw.randrange(len(data))))]


def _cells(draw: Random) -> list[list]:
    """A table as a library holds it: numbers, words, and what nobody puts in a cell."""
    rows: list[list] = [["theta_i", "theta_r", "brdf", "sample"][: draw.choice((3, 3, 4))]]
    width = len(rows[0])
    rows += [[10.0, float(r), _value(draw), "white"][:width] for r in range(-60, 61, 20)]
    for _ in range(draw.choice((0, 0, 1, 3))):
        other = (None, "x", True, draw.choice(NUMBERS), float("nan"), "\t", 10**40, "theta_i")
        draw.choice(rows)[draw.randrange(width)] = draw.choice(other)
    return rows


def _bent(draw: Random, data: bytes) -> bytes:
    bent = bytearray(data)
    for _ in range(draw.choice((0, 0, 1, 3, 20))):
        bent[draw.randrange(len(bent))] = draw.randrange(256)
    return bytes(bent[: draw.choice((len(bent), len(bent), draw.randrange(len(bent) + 1)))])


def spreadsheet(draw: Random) -> bytes:
    import openpyxl

    book = openpyxl.Workbook()
    for place in range(draw.choice((1, 1, 2))):
        sheet = book.active if place == 0 else book.create_sheet("second")
        for row in _cells(draw):
            sheet.append([str(cell) if isinstance(cell, int) and cell > 2**53 else cell for cell in row])
    stream = io.BytesIO()
    book.save(stream)
    return _bent(draw, stream.getvalue())


def parquet(draw: Random) -> bytes:
    import pyarrow
    import pyarrow.parquet

    head, *rows = _cells(draw)
    names = [str(name) for name in head]
    columns = [list(column) for column in zip(*rows, strict=True)]
    plain = [[float(x) if type(x) is float else str(x) for x in column] for column in columns]
    made = [column if len({type(x) for x in column}) == 1 else [str(x) for x in column] for column in plain]
    stream = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(made, names=names), stream)
    return _bent(draw, stream.getvalue())


def _named(cell) -> str:
    """As an array may be called."""
    return str(cell).replace("/", "_").replace("\0", "_").strip("._ ")[:60] or "x"


def hdf5(draw: Random) -> bytes:
    import h5py

    head, *rows = _cells(draw)
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        if draw.random() < 0.5:
            for place, column in enumerate(zip(*rows, strict=True)):
                plain = all(type(x) is float for x in column)
                name = _named(head[place])
                made = file.require_group("it") if place % 5 == 4 and draw.random() < 0.1 else file
                if name not in made:
                    made[name] = list(column) if plain else [str(x).replace("\0", "_") for x in column]
        else:
            numbers = [[x if type(x) is float else 1.0 for x in row] for row in rows]
            file["it"] = numbers
            file["it"].attrs["columns"] = ",".join(map(str, head)).replace("\0", "_")
    return _bent(draw, stream.getvalue())


def zarr(draw: Random) -> dict[str, bytes]:
    """The files of a folder of arrays."""
    import zarr

    head, *rows = _cells(draw)
    numbers = np.array([[x if type(x) is float else 1.0 for x in row] for row in rows])
    with TemporaryDirectory() as folder:
        group = zarr.open_group(folder, mode="w")
        if draw.random() < 0.5:
            for name, column in zip(map(_named, head), numbers.T, strict=True):
                if name not in group:
                    group.create_array(name, data=column)
        else:
            group.create_array("it", data=numbers).attrs["columns"] = list(map(str, head))
        every = sorted(each for each in Path(folder).rglob("*") if each.is_file())
        files = {each.relative_to(folder).as_posix(): each.read_bytes() for each in every}
    bent = draw.choice(sorted(files))
    return files | {bent: _bent(draw, files[bent])}


def _as_words(draw: Random) -> list[list[str]]:
    return [["" if cell is None else f"{cell}" for cell in row] for row in _cells(draw)]


def html(draw: Random) -> bytes:
    rows = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>\n" for row in _as_words(draw))
    head = draw.choice(("", "<html><body>", "<!-- <table> -->", "<table><td rowspan=3 colspan=2>x"))
    return _bent(draw, f"<div>{head}<table>{rows}</table>".encode())


def latex(draw: Random) -> bytes:
    rows = "".join(" & ".join(row) + draw.choice((" \\\\\n", " \\\\ \\hline\n")) for row in _as_words(draw))
    return _bent(draw, f"\\begin{{tabular}}{{rrrr}}\n{rows}\\end{{tabular}}\n".encode())


def json_table(draw: Random) -> bytes:
    head, *rows = _cells(draw)
    rows = [[cell if type(cell) in (float, str, bool) else str(cell) for cell in row] for row in rows]
    named = [dict(zip(map(str, head), row, strict=True)) for row in rows]
    every = (named, {"columns": [*map(str, head)], "data": rows}, {str(key): [row[0] for row in rows] for key in head})
    return _bent(draw, json.dumps(draw.choice((named, named, *every))).encode())


def opendocument(draw: Random) -> bytes:
    def cell(value) -> str:
        kind = f'office:value-type="float" office:value="{value}"' if type(value) is float else ""
        return f"<table:table-cell {kind}><text:p>{escape(str(value))}</text:p></table:table-cell>"

    rows = "".join(f"<table:table-row>{''.join(map(cell, row))}</table:table-row>" for row in _cells(draw))
    text = f'<a xmlns:office="o" xmlns:table="t" xmlns:text="x"><table:table>{rows}</table:table></a>'
    stream = io.BytesIO()
    with ZipFile(stream, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", draw.choice((text.encode(), _bent(draw, text.encode()))), ZIP_DEFLATED)
    return draw.choice((stream.getvalue(), _bent(draw, stream.getvalue())))


MAKERS = {each.__name__: each for each in (speos, speos_brdf, tracepro, klems, utia, spreadsheet, parquet, hdf5, zarr)}
MAKERS |= {each.__name__: each for each in (html, latex, json_table, opendocument)}
