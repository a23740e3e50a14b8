"""Files of every kind that is read, made from nothing: valid ones, and then damaged by what their readers look at."""

import json
import struct
from io import BytesIO
from math import exp, radians
from pathlib import Path
from random import Random

import numpy as np
import programs
from damage import NUMBERS, damaged, packed
from PIL import Image

_VOCABULARY = """
    theta_i theta_r phi_i phi_r phi theta_s brdf BRDF brf bsdf reflectance factor stderr sigma wavelength
    wavelength_nm lambda nm um µm deg rad degrees radians gon sr 1/sr sr^-1 angle aoi AOI AOE incidence
    emission phase azimuth zenith elevation sample mirror side detector light source R G B X Y Z value 400nm
    550 cos sin log ln dB percent % band in_plane units unit quantity color red green blue type format value
    scale VARS NUM_POINTS KEY DIM PARAM_IN PARAM_OUT RUSIN_TH_TD ISOTROPIC_TV_TL_DPHI INV_STERADIAN
    COSINE_FACTOR VS TIS DataBegin DataEnd SampleRotation ScatterRadial ScatterAzimuth AngleOfIncidence
    ScatterType BTDF Monochrome TristimulusX POI Side Front Back angles=deg bsdf=log
"""
VOCABULARY = _VOCABULARY.split()


def _angles(draw: Random, low=0.0, high=80.0, most=5) -> list[float]:
    return sorted({round(draw.uniform(low, high), draw.choice((0, 1, 3))) for _ in range(draw.randint(1, most))})


def _value(draw: Random) -> float:
    return draw.choice((round(draw.uniform(0.01, 2), 4), 10 ** draw.uniform(-8, 4), 0.0, -0.01))


def _in_plane(draw: Random):
    for theta_i in _angles(draw):
        for theta_r in _angles(draw, -80, 80, 9):
            yield theta_i, theta_r


def table(draw: Random) -> bytes:
    """Columns with names of the field, perhaps several channels, perhaps comments and units."""
    channels = draw.choice((["brdf"], ["brdf", "stderr"], ["R", "G", "B"], ["450nm", "550nm", "650nm"], ["fr"]))
    angles = draw.choice(
        (("theta_i", "theta_r"), ("theta_i_deg", "phi_i", "theta_r", "phi_r"), ("AOI", "theta_s", "phi"))
    )
    mark = draw.choice((",", ";", "\t", " "))
    lines = [f"# {draw.choice(VOCABULARY)}: {draw.choice(NUMBERS)}" for _ in range(draw.choice((0, 0, 1, 2)))]
    lines.append(mark.join((*angles, *channels)))
    for theta_i, theta_r in _in_plane(draw):
        side = 180.0 if theta_r > 0 else 0.0
        where = {2: (theta_i, theta_r), 3: (theta_i, abs(theta_r), side), 4: (theta_i, 0.0, abs(theta_r), side)}
        row = (*where[len(angles)], *(_value(draw) for _ in channels))
        lines.append(mark.join(f"{each:g}" for each in row))
    return damaged(draw, "\n".join(lines) + "\n", VOCABULARY)


_EXTREMES = """
    0 -0.01 1e-320 2e-308 1e-150 1e-105 3e-99 1e-60 1e-12 1e-5 1e5 1e12 1e60 9e99 1e105 1e150 1e308 -1e-320 -1e-60 -1e60
    -1e300 nan 0.5
"""
_SCALES = (1.0, 1.0, 1e-90, 1e90, 1e-50, 1e50, 1e-12)


def extremes(draw: Random) -> bytes:
    """Whole scans of a glossy surface on some scale, in which some values are at the end of arithmetic."""
    names = draw.choice((["brdf"], ["brdf", "stderr"], ["R", "G", "B"], ["450nm", "550nm", "650nm"]))
    share, kinds, scale = draw.choice((0.02, 0.1, 0.5, 1.0)), draw.choices(_EXTREMES.split(), k=5), draw.choice(_SCALES)
    width, noise = draw.uniform(3, 20), draw.choice((0.0, 0.03))
    lines = [",".join(("theta_i", "theta_r", *names))]
    for theta_i in draw.choice(((30,), (10, 50), (0, 20, 45, 70))):
        for theta_r in range(-76, 80, draw.choice((4, 8))):
            value = 0.1 + 2 * exp(-(((theta_r - theta_i) / width) ** 2))
            sizes = [(value if name != "stderr" else 0.05 * value) * scale * draw.gauss(1, noise) for name in names]
            told = [draw.choice(kinds) if draw.random() < share else f"{size:g}" for size in sizes]
            lines.append(",".join((str(theta_i), str(theta_r), *told)))
    return "\n".join(lines).encode()


def cornell(draw: Random) -> bytes:
    nm = sorted(draw.sample(range(380, 780), draw.randint(1, 4)))
    lines = ["# made", f"{len(nm)} " + " ".join(map(str, nm))]
    for theta_i, theta_r in _in_plane(draw):
        where = (radians(theta_i), 0.0, radians(abs(theta_r)), draw.choice((0.0, 1.5, 3.14159)))
        lines.append(" ".join(f"{each:.6g}" for each in (*where, *(_value(draw) for _ in nm))))
    return damaged(draw, "\n".join(lines) + "\n", VOCABULARY)


def alta(draw: Random) -> bytes:
    """Text, or the same header and doubles."""
    from brdfguide.data.formats.alta import DIRECTIONS

    kind = draw.choice(sorted(DIRECTIONS))
    width = DIRECTIONS[kind][0]
    outputs = draw.choice((1, 1, 3))
    head = f"#DIM {width} {outputs}\n#VS {draw.choice((0, 0, 1, 2))}\n#PARAM_IN {kind}\n#PARAM_OUT INV_STERADIAN\n"
    rows = [
        [draw.uniform(0, 1.5) for _ in range(width)] + [_value(draw) for _ in range(outputs)]
        for _ in range(draw.randint(1, 30))
    ]
    if draw.random() < 0.2:
        body = np.array(rows, "<f8").tobytes()
        stream = f"#BINARY {draw.choice(('0', '1', 'x'))}\n#BEGIN_STREAM\n".encode() + body + b"\n#END_STREAM\n"
        return packed(draw, head.encode() + stream[: draw.choice((len(stream), draw.randrange(len(stream) + 1)))])
    return damaged(draw, head + "\n".join(" ".join(f"{x:.6g}" for x in row) for row in rows) + "\n", VOCABULARY)


def astm(draw: Random) -> bytes:
    rows = "".join(f"{radians(i):.5g},{radians(r):.5g},{_value(draw):.5g}\n" for i, r in _in_plane(draw))
    text = f"WAVELENGTH 0.6328\nNUM_POINTS {rows.count(chr(10))}\nVARS theta_i,theta_s,brdf\n{rows}"
    return damaged(draw, text, VOCABULARY)


def fred(draw: Random) -> bytes:
    kind, values = draw.choice(("deg", "deg", "sin")), draw.choice(("value", "log"))
    lines = ["type bsdf_data", f"format angles={kind} bsdf={values} scale=1"]
    most, across = (80, (0, 90, 180)) if kind == "deg" else (0.7, (0, 0.3, -0.6))
    for theta_i in _angles(draw, high=most):
        lines.append(f"{theta_i:g} 0")
        lines += [f"{r:g} {draw.choice(across)} {_value(draw):.4g}" for r in _angles(draw, high=most)]
    return damaged(draw, "\n".join(lines) + "\n", VOCABULARY)


def _zemax_lists(draw: Random, incidences: list[float] | None):
    azimuth, radial = [0, 90, 180][: draw.randint(1, 3)], [0, *range(10, 10 * draw.randint(2, 6), 10)]
    lists = {"ScatterAzimuth": azimuth, "ScatterRadial": radial}
    if incidences is not None:
        lists = {"SampleRotation": [0], "AngleOfIncidence": incidences} | lists
    text = "".join(f"{key} {len(each)}\n{' '.join(map(str, each))}\n" for key, each in lists.items())
    grid = "".join(" ".join(f"{_value(draw):.4g}" for _ in radial) + "\n" for _ in azimuth)
    return text, grid


def zemax(draw: Random) -> bytes:
    incidences = _angles(draw, most=3)
    lists, grid = _zemax_lists(draw, incidences)
    tables = "".join(f"TIS {draw.random():.3f}\n{grid}" for _ in incidences)
    text = f"Source Measured\nSymmetry PlaneSymmetrical\nSpectralContent Monochrome\nScatterType BRDF\n{lists}"
    return damaged(draw, f"{text}Monochrome\nDataBegin\n{tables}DataEnd\n", VOCABULARY)


def lighttools_bsdf(draw: Random) -> bytes:
    lists, grid = _zemax_lists(draw, None)
    blocks = "".join(
        f"AOI {i:g}\nPOI 0\nSide Front\nWavelength 550\nScatterType BRDF\nTIS 0.2\n{grid}" for i in _angles(draw)
    )
    return damaged(
        draw, f"Symmetry Asymmetrical\nSpectralContent Monochrome\n{lists}DataBegin\n{blocks}DataEnd\n", VOCABULARY
    )


def lighttools(draw: Random) -> bytes:
    phis, thetas = draw.choice(([0, 90, 180], [0], [-90, 0, 90])), [0, 20, 40][: draw.randint(1, 3)]
    axes = (("Theta", thetas), ("Phi", phis))
    head = "".join(
        f"{axis} measure beginning : {each[0]}\n{axis} measure end : {each[-1]}\n"
        f"{axis} measure step : {each[1] - each[0] if len(each) > 1 else 1}\n"
        for axis, each in axes
    )
    rows = "".join("\t".join((f"{theta:g}", *(f"{_value(draw):.4g}" for _ in phis))) + "\n" for theta in thetas)
    block = "Name / Comment : x\nData file type : BRDF\nCalibration Value : TM : 30 PM : -90 TL : 30\n" + head
    text = "".join(f"{block}Theta Lighting {i:g}\n{rows}\n" for i in _angles(draw, most=3))
    return damaged(draw, text, [*VOCABULARY, "Theta Lighting", "Phi measure end", "PM : 1e9"])


def openmaterial(draw: Random) -> bytes:
    rows: list = [
        [draw.choice((5.5e-7, 6.5e-7)), radians(i), radians(abs(r)), draw.choice((0.0, 3.14)), _value(draw)]
        for i, r in _in_plane(draw)
    ]
    for _ in range(draw.choice((0, 0, 1, 3))):
        draw.choice(rows)[draw.randrange(5)] = draw.choice((None, True, "x", [], 10**400, -1.0, 1e300, {}))
    document = {"name": "x", "brdf": {"lookupTable": rows}}
    text = json.dumps(document, indent=draw.choice((None, 1)))
    if draw.random() < 0.5:  # whose damage is not that of JSON itself, at which the reader stops
        return text.encode()
    return damaged(draw, text, ["brdf", "lookupTable", "null", "true"])


def merl(draw: Random) -> bytes:
    """Dimensions that are true, or lie; planes of one value, of few values, or cut off."""
    phis = draw.choice((180, 180, 180, 360))
    cells = 3 * 90 * 90 * phis
    values = np.full(cells, draw.choice((1.0, 0.0, -1.0, 1e300, np.nan, np.inf, 1e-300)))
    for _ in range(draw.randrange(4)):
        at = draw.randrange(cells)
        values[at : at + draw.choice((1, 100, 10**6))] = draw.choice((1.0, -1.0, np.nan, np.inf, 1e308, -0.0, 5.0))
    data = struct.pack("<3i", *draw.choice(((90, 90, phis), (90, 90, 180), (-1, 90, 180), (90, 90, 2**31 - 1))))
    data += values.astype("<f8").tobytes()
    return data[: draw.choice((len(data), len(data), draw.randrange(len(data)), draw.randrange(100)))]


CODES = {1: "u1", 2: "i1", 3: "<u2", 6: "<i4", 7: "<u8", 10: "<f4", 11: "<f8"}


def rgl(draw: Random) -> bytes:
    """A container of named tensors whose types, shapes and offsets are true, or lie."""
    size, phis = draw.choice((2, 4, 8)), draw.choice((1, 1, 3))
    spectral = draw.random() < 0.5

    def ramp(*shape):
        values = np.random.default_rng(draw.randrange(2**31)).uniform(0.2, 1.0, shape)
        return values * draw.choice((1.0,) * 20 + (0.0, -1.0, np.nan, 1e38))

    fields = {
        "description": (1, np.frombuffer(b"made \x1b[31m\r", "u1")),
        "phi_i": (10, np.linspace(-3.1, 3.1, phis) if phis > 1 else np.zeros(1)),
        "theta_i": (10, np.radians(draw.choice(([0, 25, 50, 75, 90], [0, 90], [0, 30, 60, 90], [45], [50, 25])))),
    }
    incidences = len(fields["theta_i"][1])
    fields |= {name: (10, ramp(4, size)) for name in ("sigma", "ndf")}
    fields |= {name: (10, ramp(phis, incidences, size, size)) for name in ("vndf", "luminance")}
    if spectral:
        fields["spectra"] = (10, ramp(phis, incidences, 5, size, size))
        fields["wavelengths"] = (10, draw.choice((*[np.linspace(400, 700, 5)] * 4, np.zeros((5, 1)), np.full(5, -1.0))))
    else:
        fields["rgb"] = (10, ramp(phis, incidences, 3, size, size))
    fields["jacobian"] = (1, np.ones(1))
    for _ in range(draw.choice((0, 0, 0, 1, 2))):
        name = draw.choice(list(fields))
        code, array = fields[name]
        change = draw.randrange(4)
        if change == 0:
            del fields[name]
        elif change == 1:
            fields[name] = (draw.choice(list(CODES)), array)
        elif change == 2:
            fields[name] = (code, array.reshape(-1))
        else:
            fields[name] = (code, array.reshape((1,) * draw.choice((1, 5)) + array.shape))
    return packed(draw, _container(draw, fields))


def _container(draw: Random, fields: dict) -> bytes:
    head = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields))
    offset = len(head) + sum(2 + len(name) + 3 + 8 + 8 * array.ndim for name, (_, array) in fields.items())
    lists, body = b"", b""
    for name, (code, array) in fields.items():
        shape, place = list(array.shape), offset + len(body)
        if draw.random() < 0.01:
            shape = [draw.choice((0, 1, 2**31, 2**63, 3)) for _ in shape] or [2**40]
        if draw.random() < 0.01:
            place = draw.choice((0, 7, 2**40, 2**64 - 1, place + 3))
        lists += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HBQ", len(shape), code, place)
        lists += struct.pack(f"<{len(shape)}Q", *shape)
        with np.errstate(all="ignore"):
            body += (
                np.nan_to_num(array, nan=0.0, posinf=1.0).astype(CODES[code]).tobytes()
                if code < 10
                else array.astype(CODES[code]).tobytes()
            )
    data = bytearray(head + lists + body)
    for _ in range(draw.choice((0, 0, 0, 1, 4))):
        data[draw.randrange(len(data))] = draw.randrange(256)
    return bytes(data[: draw.choice((len(data), len(data), len(data), draw.randrange(len(data) + 1)))])


def photographs(draw: Random) -> bytes:
    """A description, and beside it the pictures of a ball, of which one may be damaged."""
    phase = radians(draw.choice((0.0, 25.0, 60.0, 110.0)))
    for name, shine in (("matt.png", 0.0), ("ball.png", draw.choice((0.0, 0.5, 3.0)))):
        picture = _ball(phase, shine)
        Path(name).write_bytes(_bitten(draw, picture) if draw.random() < 0.2 else picture)
    lamp = draw.choice(("lamp: reference", "lamp: [10, 0, 20]", "phase_deg: 60", "phase_deg: 60, lamp_distance: 40"))
    shot = f"{{file: ball.png, {draw.choice(('reference: matt.png, ', 'reference: matt.png, ', ''))}{lamp}}}"
    lines = [
        f"photographs: {draw.choice(('sphere', 'sphere', 'sphere', 'cylinder', 'flat'))}",
        f"camera: {draw.choice(('far', '{distance: 24}', '{distance_mm: 600, radius_mm: 25}'))}",
        f"reference_albedo: {draw.choice(('0.9', '[0.9, 0.9, 0.8]', 'white'))}",
        f"outline: {draw.choice(('found', '{centre_px: [48, 48], radius_px: 40}'))}",
        f"shots: [{', '.join([shot] * draw.choice((1, 1, 2)))}]",
    ]
    return damaged(draw, "\n".join(lines) + "\n", VOCABULARY)


def _bitten(draw: Random, content: bytes) -> bytes:
    """Cut short, or with some bytes changed."""
    content = bytearray(content[: draw.choice((len(content), draw.randrange(len(content))))])
    for _ in range(draw.randint(0, 3) if content else 0):
        content[draw.randrange(min(len(content), 200))] = draw.randrange(256)
    return bytes(content)


def _ball(phase: float, shine: float) -> bytes:
    """A PNG of 96 x 96 pixels: a matt ball, with a highlight."""
    y, x = np.mgrid[0:96, 0:96] + 0.5
    x, y = (x - 48) / 40, (48 - y) / 40
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0.0))
    lit = np.where(z > 0, np.maximum(np.sin(phase) * x + np.cos(phase) * z, 0.0), 0.0)
    half = np.where(z > 0, np.sin(phase / 2) * x + np.cos(phase / 2) * z, 0.0)
    light = 0.6 * lit + shine * np.maximum(half, 0.0) ** 60
    held = BytesIO()
    codes = np.uint8(255 * np.clip(light, 0, 1) ** (1 / 2.2))
    Image.fromarray(np.repeat(codes[..., None], 3, axis=-1)).save(held, format="PNG")
    return held.getvalue()


MAKERS = programs.MAKERS | {
    each.__name__: each
    for each in (
        table,
        extremes,
        cornell,
        alta,
        astm,
        fred,
        zemax,
        lighttools_bsdf,
        lighttools,
        openmaterial,
        merl,
        rgl,
        photographs,
    )
}
