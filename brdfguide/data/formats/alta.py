"""ALTA text: `#KEY value` lines, then rows of coordinates, values and perhaps their intervals; or the same as doubles.

#DIM gives the numbers of coordinates and of values, #PARAM_IN the coordinates by name (radians), #PARAM_OUT the
quantity, #VS the extra columns of an interval for each value. The mirror direction is at an azimuth difference of 180
degrees.

Source: ALTA's documentation of its parametrisations (Belcour, Barla and Pacanowski).
"""

import re
from collections.abc import Callable

import numpy as np

from ...errors import choices
from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ...physics.geometry import Geometry
from .. import conventions
from ..measurement import Measurement
from . import _half_difference
from .format import (
    Format,
    Options,
    Source,
    check_zenith,
    commented_wavelength,
    degrees,
    measurement,
    nominal_colours,
)

HEADER_LINE = re.compile(r"#[ \t]*([A-Z_]+)(.*)")


def recognises(head: bytes) -> bool:
    return re.search(rb"^[ \t]*#[ \t]*PARAM_IN\b", head, re.MULTILINE) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a parametrisation that is unknown or does not tell the directions, and for ragged rows."""
    head, stream, body = bytes(source.data).partition(b"#BEGIN_STREAM")
    source = Source(source.name, head)
    header, table, lines = _binary(source, body) if stream else _content(source)
    name = header.get("PARAM_IN", "").upper()
    if name not in DIRECTIONS:
        raise choices(f"ALTA parametrisation in {source.name}", name, DIRECTIONS)
    wanted, directions = DIRECTIONS[name]
    inputs, outputs = _dimensions(source, header, table.shape[1], wanted)
    coordinates, values = table[:, :inputs].T, table[:, inputs : inputs + outputs]
    if not np.all(np.isfinite(coordinates)):
        raise source.error(
            "a coordinate is not finite", lines[int(np.flatnonzero(~np.all(np.isfinite(coordinates), axis=0))[0])]
        )
    quantity = header.get("PARAM_OUT", ASSUMED).upper()
    if quantity not in QUANTITIES:
        raise choices(f"ALTA quantity in {source.name}", quantity, QUANTITIES)
    theta_i, phi_i, theta_r, phi_r = (degrees(a) for a in directions(*coordinates))
    for each, angles in (("theta_i", theta_i), ("theta_r", theta_r)):
        check_zenith(source, each, angles, lines)
    channels = [f"value{k + 1}" for k in range(outputs)] if outputs > 1 else ["brdf"]
    if outputs == 3:
        channels = ["X", "Y", "Z"] if quantity == "XYZ_COLOR" else ["R", "G", "B"]
    um, notes = commented_wavelength(source, options)
    if outputs == 3:
        um, notes = np.array([CHANNEL_UM[each] for each in channels]), [nominal_colours(channels)]
    notes.append(_quantity_note(name, quantity, stated="PARAM_OUT" in header))
    result = measurement(
        source, "ALTA text", theta_i, phi_i, theta_r, phi_r, values, channels=channels, wavelength=um, findings=notes
    )
    return conventions.as_brdf(result, "brdf" if options.quantity else QUANTITIES[quantity])


def _content(source: Source):
    header, content, lines = {}, [], []
    for number, text in enumerate(source.lines, 1):
        stripped = text.strip()
        if match := HEADER_LINE.match(stripped):
            header[match[1]] = match[2].strip().strip('"')
        elif stripped and not stripped.startswith("#"):
            content.append(stripped)
            lines.append(number)
    if not content:
        raise source.error("no rows below the header")
    try:
        table = np.loadtxt(content, ndmin=2, comments=None)
    except ValueError:
        width = len(content[0].split())
        for number, text in zip(lines, content, strict=True):
            values = source.numbers(text.split(), number)
            if len(values) != width:
                raise source.error(f"found {len(values)} numbers, the rows above have {width}", number) from None
        raise source.error("its rows are no table of numbers") from None
    return header, table, lines


def _binary(source: Source, body: bytes):
    """A body of doubles behind a text header, as ALTA writes it too."""
    header = {match[1]: match[2].strip() for text in source.lines if (match := HEADER_LINE.match(text.strip()))}
    counts = header.get("DIM", "").split()
    extra = {"1": 2, "2": 2}.get(header.get("VS", "0"), 0)  # an interval is always stored by both its ends
    width = (
        int(counts[0]) + int(counts[1]) * (1 + extra)
        if len(counts) == 2 and all(word.isdecimal() for word in counts)
        else 0
    )
    rows = int(header["SAMPLE_COUNT"]) if header.get("SAMPLE_COUNT", "").isdecimal() else 0
    body = body.removeprefix(b"\r").removeprefix(b"\n")
    if not 0 < rows * width * 8 <= len(body):
        raise source.error(
            f"truncated: {rows} samples of {width} doubles promised; {len(body)} bytes follow #BEGIN_STREAM"
        )
    kind = ">f8" if header.get("ENDIAN", "little").lower() == "big" else "<f8"
    table = np.frombuffer(body, kind, rows * width).reshape(rows, width).astype(float)
    return header, table, np.full(rows, len(source.lines))


def _quantity_note(name: str, quantity: str, *, stated: bool) -> Finding:
    """What the values are, as the header states it; what they are taken for where it does not."""
    if not stated:
        text = f"coordinates {name}; no PARAM_OUT: values taken as {quantity}, the BRDF"
        return Finding("quantity-assumed", text, consequence="examined further on", option="--quantity")
    text = f"coordinates {name}, values {quantity}"
    text += ": divided by cos theta_r" if quantity.endswith("COSINE_FACTOR") else ""
    return Finding("quantity-stated", text, option="--quantity", settles=("cosine", "scale"))


def _dimensions(source: Source, header, width: int, wanted: int):
    words = header.get("DIM", "").split()
    if len(words) != 2 or not all(word.isdecimal() for word in words):
        raise source.error(f"#DIM '{header.get('DIM', '')}': wanted two counts, such as #DIM 3 1")
    inputs, outputs = int(words[0]), int(words[1])
    if inputs != wanted:
        raise source.error(f"#DIM says {inputs} coordinates; {header['PARAM_IN']} has {wanted}")
    if not 1 <= outputs <= width - inputs:
        raise source.error(f"#DIM promises {inputs} + {outputs} columns; the rows have {width}")
    return inputs, outputs


def _projected(theta_l, x, y):
    return theta_l, 0 * x, np.hypot(x, y), np.arctan2(y, x)


def _retro(theta_l, x, y):
    """About the light: distance times cosine and sine of the azimuth, which is 0 toward the normal."""
    apart, turn = np.hypot(x, y), np.arctan2(y, x)
    toward, aside = np.sin(apart) * np.cos(turn), np.sin(apart) * np.sin(turn)
    along = np.cos(apart) * np.sin(theta_l) - toward * np.cos(theta_l)
    up = np.cos(apart) * np.cos(theta_l) + toward * np.sin(theta_l)
    return theta_l, 0 * x, np.arctan2(np.hypot(along, aside), up), np.arctan2(aside, along)


def _back(theta_l, x, y):
    """Schlick's back vector, halfway between the view and the mirror direction."""
    theta, turn = np.hypot(x, y), np.arctan2(y, x)
    back = np.stack([np.sin(theta) * np.cos(turn), np.sin(theta) * np.sin(turn), np.cos(theta)])
    mirror = np.stack([-np.sin(theta_l), 0 * theta_l, np.cos(theta_l)])
    view = 2 * np.sum(back * mirror, axis=0) * back - mirror
    return theta_l, 0 * x, np.arctan2(np.hypot(view[0], view[1]), view[2]), np.arctan2(view[1], view[0])


def _bounded(vectors):
    """The same directions, of lengths whose squares are numbers."""
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    return vectors / np.where(largest > 1, largest, 1.0)


def _cartesian(rx, ry, rz, ix, iy, iz):
    geom = Geometry.from_vectors(_bounded(np.stack([ix, iy, iz], -1)), _bounded(np.stack([rx, ry, rz], -1)))
    return [np.radians(a) for a in (geom.theta_i_deg, geom.phi_i_deg, geom.theta_r_deg, geom.phi_i_deg + geom.phi_deg)]


# name -> how many coordinates, and the function to theta_i, phi_i, theta_r, phi_r [rad]
DIRECTIONS: dict[str, tuple[int, Callable]] = {
    "ISOTROPIC_TL_TV_PROJ_DPHI": (3, _projected),
    "ISOTROPIC_TV_TL_DPHI": (3, lambda theta_v, theta_l, dphi: (theta_l, 0 * dphi, theta_v, dphi)),
    "SPHERICAL_TL_PL_TV_PV": (4, lambda theta_l, phi_l, theta_v, phi_v: (theta_l, phi_l, theta_v, phi_v)),
    "RUSIN_TH_TD_PD": (
        3,
        lambda theta_h, theta_d, phi_d: _half_difference.light_and_view(theta_h, 0 * theta_h, theta_d, phi_d),
    ),
    "RUSIN_TH_PH_TD_PD": (4, _half_difference.light_and_view),
    "RETRO_TL_TVL_PROJ_DPHI": (3, _retro),
    "SCHLICK_TL_TK_PROJ_DPHI": (3, _back),
    "CARTESIAN": (6, _cartesian),
}
ASSUMED = "INV_STERADIAN"  # where the header does not say
QUANTITIES = {
    "INV_STERADIAN": "brdf",
    "INV_STERADIAN_COSINE_FACTOR": "brdf-cos",
    "RGB_COLOR": "brdf",
    "XYZ_COLOR": "brdf",
}
FORMAT = Format("alta", (".dat", ".alta"), recognises, read)
