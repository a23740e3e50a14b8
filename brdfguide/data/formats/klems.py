"""WINDOW and Radiance XML of a layer in Klems' bases: reflection, a value for each pair of patches.

`WindowElement` with `WavelengthDataBlock`s of a direction (`Reflection Front`), the bases of columns (light) and rows
(view), and `ScatteringData`, row after row [1/sr]. A basis is a list of rings of equal theta, each parted in equal
azimuths from 0; the light's patches are turned by half a turn, so that patches of one number mirror each other.

Source: Klems 1994, "A new method for predicting the solar heat gain of complex fenestration systems"; the bases as
Radiance lists them. Values are means over pairs of patches.
"""

import re

import numpy as np

from ...finding import Finding
from ..measurement import Measurement
from .format import Format, Options, Source, check_zenith, measurement

# name -> upper theta of each ring [deg] and its number of azimuths
BASES = {
    "full": ((5, 1), (15, 8), (25, 16), (35, 20), (45, 24), (55, 24), (65, 24), (75, 16), (90, 12)),
    "half": ((6.5, 1), (19.5, 8), (32.5, 12), (46.5, 16), (61.5, 20), (76.5, 12), (90, 4)),
    "quarter": ((9, 1), (27, 8), (46, 12), (66, 12), (90, 8)),
}
DIRECTIONS = ("reflection front", "reflection back")  # the first that is there
VISIBLE = "visible"
MOST_RINGS = 200


def recognises(head: bytes) -> bool:
    return re.match(rb"\s*<", head) is not None and b"<WindowElement" in head


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for XML that is none, for transmission alone, for a tensor tree, and for a wrong count."""
    root = _root(source)
    there = {_text(each, "WavelengthDataDirection").lower() for each in root.iter("WavelengthDataBlock")}
    direction = next((each for each in DIRECTIONS if each in there), "")
    blocks = [
        (_text(data, "Wavelength").lower(), block)
        for data in root.iter("WavelengthData")
        for block in data.iter("WavelengthDataBlock")
        if _text(block, "WavelengthDataDirection").lower() == direction
    ]
    if not blocks:
        found = sorted({_text(each, "WavelengthDataDirection") for each in root.iter("WavelengthDataBlock")})
        raise source.error(f"it holds no reflection; found {', '.join(found)[:80] or 'no data'}")
    structure = next((each.text or "" for each in root.iter("IncidentDataStructure")), "Columns").strip()
    if structure.lower() != "columns":
        text = f"its data are a {structure[:40]}, not a matrix; convert it with Radiance's bsdf2klems"
        raise source.error(text)
    name, block = next((pair for pair in blocks if pair[0] in (VISIBLE, "")), blocks[0])
    bases = BASES | _own_bases(source, root)
    columns = _patches(source, bases, _text(block, "ColumnAngleBasis"))
    rows = _patches(source, bases, _text(block, "RowAngleBasis") or _text(block, "ColumnAngleBasis"))
    values = _matrix(source, block, len(rows), len(columns))
    notes = [Finding("patches", "each value is the mean over a pair of patches, taken at their middles")]
    if direction == DIRECTIONS[1]:
        notes.append(Finding("blocks-skipped", "it holds no reflection of the front: the back's was taken"))
    if len(blocks) > 1:
        others = ", ".join(each or "unnamed" for each, other in blocks if other is not block)
        notes.append(Finding("blocks-skipped", f"taken: {name or 'the unnamed'} band; left out: {others[:80]}"))
    theta_i, theta_r = np.tile(columns[:, 0], len(rows)), np.repeat(rows[:, 0], len(columns))
    phi_i, phi_r = np.tile(columns[:, 1] + 180.0, len(rows)), np.repeat(rows[:, 1], len(columns))
    return measurement(source, "Klems XML", theta_i, phi_i, theta_r, phi_r, values.reshape(-1, 1), findings=notes)


def _root(source: Source):
    from xml.etree import ElementTree

    if b"<!DOCTYPE" in source.data or b"<!ENTITY" in source.data:
        raise source.error("XML with a document type of its own is not read")
    try:
        return _plain(ElementTree.fromstring(bytes(source.data)))
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise source.error(f"not valid XML: {error}") from None


def _plain(root):
    """The same without namespaces."""
    for each in root.iter():
        if isinstance(each.tag, str):
            each.tag = each.tag.rpartition("}")[2]
    return root


def _text(parent, name: str) -> str:
    found = parent.find(name)
    return " ".join((found.text or "").split()) if found is not None else ""


def _own_bases(source: Source, root) -> dict:
    """Bases that the file defines itself, by their whole names."""
    found = {}
    for basis in root.iter("AngleBasis"):
        rings = []
        for ring in basis.iter("AngleBasisBlock"):
            upper = next((each.text for each in ring.iter("UpperTheta")), None)
            rings.append(source.numbers([upper or "", _text(ring, "nPhis")], 0))
        counts = [count for _, count in rings]
        if len(rings) > MOST_RINGS or not all(0 < count < 1000 and count == int(count) for count in counts):
            raise source.error(f"AngleBasis {_text(basis, 'AngleBasisName')[:40]}: its rings are none")
        found[_text(basis, "AngleBasisName").lower()] = tuple((upper, int(count)) for upper, count in rings)
    return found


def _patches(source: Source, bases: dict, name: str) -> np.ndarray:
    """theta and phi [deg] of the middle of each patch, (patches, 2)."""
    word = name.lower()
    key = word if word in bases else next((each for each in BASES if word == f"lbnl/klems {each}"), None)
    if key is None or not bases[key]:
        raise source.error(f"the basis '{name[:40]}' is unknown; known are LBNL/Klems Full, Half and Quarter")
    middles, lower = [], 0.0
    for upper, count in bases[key]:
        theta = 0.0 if count == 1 and lower == 0 else 0.5 * (lower + upper)
        middles += [(theta, 360.0 * place / count) for place in range(count)]
        lower = upper
    patches = np.array(middles)
    check_zenith(source, f"theta of the basis {name[:40]}", patches[:, 0])
    return patches


def _matrix(source: Source, block, rows: int, columns: int) -> np.ndarray:
    """(rows, columns) of ScatteringData."""
    cells = _text(block, "ScatteringData").replace(",", " ").split()
    if len(cells) != rows * columns:
        wanted = f"{rows} x {columns} = {rows * columns}"
        raise source.error(f"ScatteringData of this Klems matrix: found {len(cells)} values, wanted {wanted}")
    return np.array(source.numbers(cells, 0)).reshape(rows, columns)


FORMAT = Format("klems", (".xml",), recognises, read)
