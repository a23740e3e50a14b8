"""Pictures of a sphere under a point lamp, rendered from formulas of their own, and the files that hold them."""

import struct
from dataclasses import dataclass

import numpy as np
from PIL import Image

DISTANCE = 24.0  # of the camera [radii]
LAMP = 40.0
SAMPLES = 4  # rays along each side of a pixel


@dataclass(frozen=True)
class Paint:
    """GGX over a Lambertian body (Walter et al. 2007), as the renderer's `roughplastic` is not: no light is lost."""

    alpha: float = 0.15
    n: float = 1.5
    albedo: tuple[float, ...] = (0.3, 0.2, 0.1)

    def brdf(self, cos_i, cos_r, cos_h, cos_d):
        tan2 = (1 - cos_h**2) / cos_h**2
        d = 1 / (np.pi * self.alpha**2 * cos_h**4 * (1 + tan2 / self.alpha**2) ** 2)
        shadow = 1.0
        for c in (cos_i, cos_r):
            shadow = shadow * 2 / (1 + np.sqrt(1 + self.alpha**2 * (1 - c**2) / c**2))
        g = np.sqrt(self.n**2 - 1 + cos_d**2)
        fresnel = 0.5 * ((g - cos_d) / (g + cos_d)) ** 2
        fresnel = fresnel * (1 + ((cos_d * (g + cos_d) - 1) / (cos_d * (g - cos_d) + 1)) ** 2)
        lobe = fresnel * d * shadow / (4 * cos_i * cos_r)
        return np.asarray(self.albedo) / np.pi + lobe[..., None]


@dataclass(frozen=True)
class Matt:
    albedo: float = 0.9

    def brdf(self, cos_i, cos_r, cos_h, cos_d):
        return np.full((*np.shape(cos_i), 3), self.albedo / np.pi)


def lamp_at(phase_deg: float, roll_deg: float = 0.0, distance: float = LAMP) -> np.ndarray:
    p, q = np.radians((phase_deg, roll_deg))
    return distance * np.array([np.sin(p) * np.cos(q), np.sin(p) * np.sin(q), np.cos(p)])


def sphere(surface, lamp, size=160, centre=(80.0, 80.0), radius=72.0, distance=DISTANCE) -> np.ndarray:
    """Radiance (size, size, 3) of a unit sphere, averaged over 4 x 4 rays a pixel; the white sphere is about 1."""
    steps = (np.arange(size * SAMPLES) + 0.5) / SAMPLES
    slope = np.tan(np.arcsin(1 / distance))
    x, y = np.meshgrid((steps - centre[0]) / radius * slope, (centre[1] - steps) / radius * slope)
    ray = np.stack([x, y, -np.ones_like(x)], -1)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    b = ray[..., 2] * distance
    inside = b**2 - distance**2 + 1
    hit = inside > 0
    ray, t = ray[hit], -b[hit] - np.sqrt(inside[hit])
    normal = t[:, None] * ray + [0, 0, distance]
    away = lamp - normal
    length = np.linalg.norm(away, axis=-1)
    light = away / length[:, None]
    half = light - ray
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    cos_i = np.einsum("nk,nk->n", normal, light)
    lit = cos_i > 0
    cosines = (cos_i, -np.einsum("nk,nk->n", normal, ray), *(np.einsum("nk,nk->n", half, e) for e in (normal, light)))
    values = np.zeros((*hit.shape, 3))
    shaded = np.zeros((len(ray), 3))
    f = surface.brdf(*(each[lit] for each in cosines))
    shaded[lit] = f * (np.pi * cos_i * np.dot(lamp, lamp) / length**2)[lit, None]
    values[hit] = shaded
    return values.reshape(size, SAMPLES, size, SAMPLES, 3).mean(axis=(1, 3))


def srgb(light) -> np.ndarray:
    """Codes 0..1 (IEC 61966-2-1)."""
    light = np.clip(light, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)


def write_codes(path, codes, **more) -> None:
    """An 8-bit picture of codes 0..1."""
    Image.fromarray(np.uint8(np.round(255 * codes))).save(path, **more)


def write_float_tiff(path, light) -> None:
    """An uncompressed TIFF of 32-bit floats, by the letter of TIFF 6.0."""
    rows, columns, _ = light.shape
    body = np.ascontiguousarray(light, "<f4").tobytes()
    write_tiff(path, columns, rows, body, bits=32, photometric=2, samples=3, more=((339, 3, 3, (3, 3, 3)),))


def write_tiff(path, columns, rows, body, *, bits, photometric, samples, more=()) -> None:
    """A little-endian TIFF with one strip; `more` are tags (number, type, count, values)."""
    tags = [
        (256, 4, 1, (columns,)), (257, 4, 1, (rows,)), (258, 3, samples, (bits,) * samples), (259, 3, 1, (1,)),
        (262, 3, 1, (photometric,)), (273, 4, 1, (0,)), (277, 3, 1, (samples,)), (278, 4, 1, (rows,)),
        (279, 4, 1, (len(body),)), (284, 3, 1, (1,)), *more,
    ]  # fmt: skip
    tags.sort()
    codes = {1: "B", 2: "B", 3: "H", 4: "I", 5: "II", 10: "ii"}
    start = 8 + 2 + 12 * len(tags) + 4
    extra, entries = b"", b""
    strip = start + sum(
        len(struct.pack("<" + codes[kind] * count, *values)) + 1
        for _, kind, count, values in tags
        if struct.calcsize(codes[kind]) * count > 4
    )
    for number, kind, count, values in tags:
        values = (strip,) if number == 273 else values
        packed = struct.pack("<" + codes[kind] * count, *values)
        if len(packed) > 4:
            entries += struct.pack("<HHII", number, kind, count, start + len(extra))
            extra += packed + b"\0" * (len(packed) % 2)
        else:
            entries += struct.pack("<HHI", number, kind, count) + packed.ljust(4, b"\0")
    head = struct.pack("<2sHIH", b"II", 42, 8, len(tags)) + entries + b"\0" * 4 + extra
    path.write_bytes(head.ljust(strip, b"\0") + body)


def write_dng(path, light, white=4000) -> None:
    """A camera's raw file (DNG 1.4) of light 0..1: a red-green/green-blue mosaic, its matrix that of sRGB."""
    codes = np.uint16(np.round(white * np.clip(light, 0, 1)))
    mosaic = np.empty(codes.shape[:2], "<u2")
    mosaic[0::2, 0::2], mosaic[0::2, 1::2] = codes[0::2, 0::2, 0], codes[0::2, 1::2, 1]
    mosaic[1::2, 0::2], mosaic[1::2, 1::2] = codes[1::2, 0::2, 1], codes[1::2, 1::2, 2]
    xyz_to_camera = (32406, -15372, -4986, -9689, 18758, 415, 557, -2040, 10570)  # sRGB's, ten-thousandths
    matrix = tuple(number for each in xyz_to_camera for number in (each, 10000))
    name = b"made for a test\0"
    more = (
        (254, 4, 1, (0,)), (271, 2, len(name), tuple(name)), (272, 2, len(name), tuple(name)), (274, 3, 1, (1,)),
        (33421, 3, 2, (2, 2)), (33422, 1, 4, (0, 1, 1, 2)), (50706, 1, 4, (1, 4, 0, 0)),
        (50708, 2, len(name), tuple(name)),
        (50714, 4, 1, (0,)), (50717, 4, 1, (white,)), (50721, 10, 9, matrix), (50728, 5, 3, (1, 1, 1, 1, 1, 1)),
        (50778, 3, 1, (21,)),
    )  # fmt: skip
    rows, columns = mosaic.shape
    write_tiff(path, columns, rows, mosaic.tobytes(), bits=16, photometric=32803, samples=1, more=more)


def describe(folder, shots, name="shots.yaml", head="camera: {distance: 24}\nreference_albedo: 0.9\n", solid="sphere"):
    """A description of shots (file, reference or None, lamp) in `folder`; the path of it."""
    lines = [f"photographs: {solid}", head.strip(), "shots:"]
    for file, reference, lamp in shots:
        of = f", reference: {reference}" if reference else ""
        where = lamp if isinstance(lamp, str) else [round(float(each), 6) for each in lamp]
        lines.append(f"  - {{file: {file}{of}, lamp: {where}}}")
    path = folder / name
    path.write_text("\n".join(lines) + "\n")
    return path
