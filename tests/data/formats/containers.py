"""Small files of every kind, made here: what the readers are tested with, and what the fuzz damages."""

import gzip
import json
import lzma
import struct

import numpy as np

CODES = {"<f4": 10, "<f8": 11, "|u1": 1, "<i4": 6}


def tensor_file(**fields) -> bytes:
    """A `tensor_file` container with these arrays."""
    head = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields))
    size = len(head) + sum(2 + len(name) + 3 + 8 + 8 * array.ndim for name, array in fields.items())
    table, body = b"", b""
    for name, array in fields.items():
        table += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HB", array.ndim, CODES[array.dtype.str])
        table += struct.pack("<Q", size + len(body)) + struct.pack(f"<{array.ndim}Q", *array.shape)
        body += array.tobytes()
    return head + table + body


def rgl_fields(seed: int, *, phis=1, spectral=False, size=8) -> dict:
    """Arrays of a made-up but valid table; smooth, positive, anisotropic where `phis` is above 2."""
    draw = np.random.default_rng(seed)

    def ramp(*shape):
        return draw.uniform(0.2, 1.0, shape).astype("<f4")

    fields = {
        "description": np.frombuffer(b"made up", "u1"),
        "phi_i": np.linspace(-np.pi, np.pi, phis).astype("<f4") if phis > 1 else np.zeros(1, "<f4"),
        "theta_i": np.radians([0, 25, 50, 75, 90]).astype("<f4"),
        "sigma": ramp(4, size),
        "ndf": ramp(4, size),
        "vndf": ramp(phis, 5, size, size),
        "luminance": ramp(phis, 5, size, size),
    }
    if spectral:
        fields |= {"spectra": ramp(phis, 5, 6, size, size), "wavelengths": np.linspace(400, 650, 6).astype("<f4")}
    else:
        fields["rgb"] = ramp(phis, 5, 3, size, size)
    for name in ("sigma", "ndf", "vndf", "rgb", "spectra"):
        if name in fields:
            fields[name][..., -1, :] = fields[name][..., 0, :]  # a turn leads back
    if phis == 1:
        fields["sigma"][:] = fields["sigma"][0]  # isotropic: the same for light from everywhere
    return fields


def cornell() -> str:
    rows = [
        f"{i:.6f} 0.000000 {r:.6f} {p:.6f} 0.1 0.2\n0.3"
        for i in (0.349066, 0.872665)
        for r in (0.1, 0.7)
        for p in (0.0, 1.570796, 3.141593)
    ]
    return "# made up\n3\n400 500\n600\n" + "\n".join(rows) + "\n"


def zemax(kind="Monochrome", blocks=1) -> str:
    lists = "SampleRotation 1\n0\nAngleOfIncidence 2\n20 50\nScatterAzimuth 3\n0 90 180\nScatterRadial 3\n0 20 60\n"
    tables = "".join("TIS 0.1\n" + "0.3 0.2 0.1\n" * 3 for _ in range(2))
    data = "".join(f"{kind}\nDataBegin\n{tables}DataEnd\n" for _ in range(blocks))
    return (
        f"# made up\nSource Measured\nSymmetry PlaneSymmetrical\nSpectralContent "
        f"{'XYZ' if blocks == 3 else kind}\nScatterType BRDF\n{lists}\n{data}"
    )


def fred() -> str:
    return (
        "type bsdf_data\nformat angles=deg bsdf=value scale=1\n20 0\n0 0 0.1\n20 0 0.5\n20 180 0.05\n50 0\n50 0 "
        "0.9\n30 90 0.2\n"
    )


def lighttools() -> str:
    head = (
        "Name / Comment :\tmade up\t\r\nData file type :\tIntensity BRDF\t\r\nCalibration Value :\tTM : 30.0 PM : "
        "-90.0     TL : 30.0 Int : 1\t\r\n"
    )
    axes = "".join(
        f"{axis} measure {word} :\t{value}\t\r\n"
        for axis, values in (("Theta", (-30, 30, 30)), ("Phi", (-90, -80, 10)))
        for word, value in zip(("beginning", "end", "step"), values, strict=True)
    )

    def block(lamp, bright):
        return f"Theta Lighting\t{lamp}\t\r\n-30\t0.1\t0.11\r\n0\t0.2\t0.21\r\n30\t{bright}\t0.31\r\n\t\t\r\n"

    return "".join(head + axes + block(lamp, bright) for lamp, bright in ((0, 0.3), (30, 2.0)))


def lighttools_bsdf() -> str:
    lists = "ScatterAzimuth 4\n0 90 180 270\nScatterRadial 3\n0 30 60\n"

    def block(aoi, kind, values):
        return f"AOI {aoi}\nPOI 0\nSide Front\nWavelength 550\nScatterType {kind}\nTIS 0.2\n{values}\n"

    rows = "0.1 0.1 0.1\n0.1 0.05 0.05\n0.1 0.1 0.1\n0.1 {} 0.3"
    blocks = block(30, "BRDF", rows.format(5)) + block(30, "BTDF", rows.format(9)) + block(60, "BRDF", rows.format(9))
    return f"# made up\nSymmetry Asymmetric\nSpectralContent Monochrome\n{lists}DataBegin\n{blocks}DataEnd\n"


def alta(
    kind="ISOTROPIC_TV_TL_DPHI",
    out="INV_STERADIAN",
    dimensions="3 1",
    rows=((0.5, 0.4, 3.1, 0.2), (0.6, 0.7, 0.0, 0.3)),
) -> str:
    lines = "\n".join(" ".join(f"{cell:.12g}" for cell in row) for row in rows)
    return f"#DIM {dimensions}\n#VS 0\n#PARAM_IN {kind}\n#PARAM_OUT {out}\n{lines}\n"


def alta_binary(order="little") -> bytes:
    head = (
        alta().split("0.5")[0]
        + f"#FORMAT binary\n#PRECISION ieee754-double\n#SAMPLE_COUNT 2\n#ENDIAN {order}\n#BEGIN_STREAM\n"
    )
    rows = np.array([(0.5, 0.4, 3.1, 0.2), (0.6, 0.7, 0.0, 0.3)], "<f8" if order == "little" else ">f8")
    return head.encode() + rows.tobytes() + b"\n#END_STREAM\n"


def astm(
    names="theta_i,phi_i,theta_s,phi_s,R,G,B",
    rows=((0.5, 1.0, 0.4, 4.1415926, 0.1, 0.2, 0.3), (1.0, 1.0, 0.9, -2.1, 0.4, 0.5, 0.6)),
) -> str:
    lines = "\n".join(",".join(f"{cell:.9g}" for cell in row) for row in rows)
    return f'LAB_NAME made up\nSAMPLE_NAME "paint"\nNUM_POINTS {len(rows)}\nVARS {names}\n{lines}\n'


def openmaterial() -> str:
    rows = [
        [w, i, r, p, 0.1 + r]
        for w in (5.5e-7, 9.05e-7)
        for i in (0.0, 0.523599)
        for r in (0.0, 0.523599)
        for p in (0.0, 3.141593)
    ]
    return json.dumps(
        {"metadata": {"name": "made up"}, "brdf": {"wavelengths": [5.5e-7, 9.05e-7], "lookupTable": rows}}
    )


def table() -> str:
    lines = [f"{i},{r},{0.1 + 0.01 * r * r / (1 + i)}" for i in (15, 30, 45) for r in range(-60, 61, 20)]
    return "theta_i,theta_r,brdf\n" + "\n".join(lines) + "\n"


def every() -> dict[str, bytes]:
    """One small file of each kind."""
    texts = {
        "cornell": cornell(),
        "zemax": zemax(),
        "fred": fred(),
        "lighttools": lighttools(),
        "lighttools-bsdf": lighttools_bsdf(),
        "alta": alta(),
        "astm": astm(),
        "openmaterial": openmaterial(),
        "table": table(),
    }
    files = {name: text.encode() for name, text in texts.items()}
    files["alta-binary"] = alta_binary()
    files["rgl"] = tensor_file(**rgl_fields(1))
    files["rgl-spectral"] = tensor_file(**rgl_fields(2, spectral=True))
    files["table.gz"], files["table.xz"] = gzip.compress(files["table"]), lzma.compress(files["table"])
    return files
