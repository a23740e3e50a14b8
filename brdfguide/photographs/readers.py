"""Picture files: OpenEXR, PNG and TIFF of 8 and 16 bits, JPEG, camera raw. What a library would lose is refused.

Pillow reads JPEG and all of 8 bits; a 16-bit PNG it would cut to 8 bits without a word, so that is left to OpenCV,
which reads it exactly, as it does TIFF of 16 bits and of floats. Raw files are developed by LibRaw through rawpy:
linearly, with the daylight balance of the camera's model, and white where the sensor's is. The camera's own balance and
LibRaw's own white follow what is in the picture, and a sample would not compare with its reference.
"""

import io
import struct
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image, ImageOps

from .. import opening
from ..errors import InputError
from ..finding import Finding
from .picture import TRANSFERS, Exposure, Photograph

MOST_BYTES = 2**30
MOST_PIXELS = 80_000_000  # beyond, no camera of this use; 240 MB at 8 bits
LEAST_SIDE = 32
WHITE_8 = 250  # of 255: JPEG's ringing reaches so far below a clipped area (ours)
WHITE_16 = 0.98 * 65535
RAW_SUFFIXES = (
    ".dng", ".cr2", ".cr3", ".crw", ".nef", ".nrw", ".arw", ".srf", ".sr2", ".raf", ".orf", ".rw2", ".pef", ".srw",
    ".3fr", ".fff", ".iiq", ".mef", ".mos", ".mrw", ".x3f", ".kdc", ".dcr",
)  # fmt: skip
WITHOUT = "needs the package {}, which is not installed: pip install 'brdfguide[photo]'"
EXR, PNG, JPEG, TIFF = b"\x76\x2f\x31\x01", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", (b"II*\0", b"MM\0*")
BITS, WIDTH, HEIGHT, DNG_VERSION = 258, 256, 257, 50706  # tags of TIFF 6.0, and of DNG 1.4


def read_picture(path, transfer: str | None = None) -> Photograph:
    """The picture in a file; `transfer` says how its codes stand for light, where the file does not or is wrong.

    Raises InputError for what is no picture, for one that is cut off, too large, or without colours, and where the
    package that reads it is not installed.
    """
    name = str(path)
    data = opening.content(path, MOST_BYTES, name)
    if not data.strip(b"\0 \n"):
        raise InputError(f"{name}: the file is empty; wanted a picture")
    picture = replace(_read(path, name, data), name=name)
    rows, columns = picture.codes.shape[:2]
    if min(rows, columns) < LEAST_SIDE:
        raise InputError(f"{name}: {columns} x {rows} pixels; wanted at least {LEAST_SIDE} on each side")
    if transfer is None:
        return picture
    if transfer not in TRANSFERS:
        raise InputError(f"{name}: transfer '{transfer}'; it is one of: {', '.join(TRANSFERS)}")
    return replace(picture, transfer=transfer)


def _read(path, name: str, data: bytes) -> Photograph:
    if data.startswith(EXR):
        return _exr(path, name)
    tags = _tiff_tags(data) if data.startswith(TIFF) else {}
    if DNG_VERSION in tags or Path(name).suffix.lower() in RAW_SUFFIXES:
        return _raw(name, data)
    if data.startswith(TIFF) and tags.get(BITS, 8) != 8:
        _check_size(name, tags.get(WIDTH, 0), tags.get(HEIGHT, 0))
        return _deep(name, data)
    if data.startswith(PNG) and len(data) > 25 and data[24] == 16:
        _check_size(name, *struct.unpack(">II", data[16:24]))
        return _deep(name, data)
    return _shallow(name, data)


def _check_size(name: str, columns: int, rows: int) -> None:
    if columns * rows > MOST_PIXELS:
        raise InputError(
            f"{name}: says that it holds {columns} x {rows} pixels; wanted at most {MOST_PIXELS // 10**6} million"
        )


# --- 8 bits, by Pillow ------------------------------------------------------------------------------------


def _shallow(name: str, data: bytes) -> Photograph:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            image: Image.Image = Image.open(io.BytesIO(data))
            _check_size(name, *image.size)
            image.load()
        except Image.DecompressionBombError:
            raise InputError(f"{name}: more than {MOST_PIXELS // 10**6} million pixels; wanted a photograph") from None
        except Image.UnidentifiedImageError:
            kinds = "JPEG, PNG, TIFF, OpenEXR or camera raw"
            raise InputError(f"{name}: is no picture that can be read; wanted {kinds}") from None
        except (OSError, SyntaxError, ValueError, struct.error, EOFError) as error:
            raise InputError(f"{name}: damaged or cut off: {error}") from None
        image = _in_colour(name, image)
        exif = image.getexif()
        turned = ImageOps.exif_transpose(image)
    notes: tuple[Finding, ...] = ()
    if exif.get(ExifTags.Base.Orientation, 1) not in (0, 1):
        text = f"{Path(name).name} was turned upright as its EXIF orientation says; places in pixels count from there"
        notes = (Finding("turned-upright", text),)
    white = 255.0 if image.format == "PNG" else float(WHITE_8)
    transfer = "linear" if image.info.get("gamma") == 1.0 else "srgb"
    profile = image.info.get("icc_profile")
    if isinstance(profile, bytes) and b"AdobeRGB" in profile.replace(b"\0", b"").replace(b" ", b""):
        transfer = "adobe"
    return Photograph(name, np.asarray(turned), transfer, min(white, WHITE_8), _exposure(exif), notes)


def _in_colour(name: str, image: Image.Image) -> Image.Image:
    """The picture if it holds red, green and blue. Raises InputError for another mode."""
    if image.mode == "RGBA":
        if np.any(np.asarray(image.getchannel("A")) < 255):
            raise InputError(
                f"{name}: is transparent in places (an alpha channel); wanted a photograph as it was taken"
            )
        opaque = image.convert("RGB")
        opaque.format = image.format
        return opaque
    found = {
        "P": "holds a palette of at most 256 colours",
        "CMYK": "holds the inks of a printer (CMYK)",
        "1": "is black and white",
    }
    if image.mode != "RGB":
        what = found.get(image.mode, f"holds no red, green and blue (mode {image.mode})")
        raise InputError(f"{name}: {what}; wanted an RGB photograph")
    return image


def _exposure(exif) -> Exposure:
    taken = exif.get_ifd(ExifTags.IFD.Exif)
    iso = taken.get(ExifTags.Base.ISOSpeedRatings)
    if isinstance(iso, (tuple, list)):
        iso = iso[0] if iso else None
    return Exposure(
        _positive(taken.get(ExifTags.Base.ExposureTime)), _positive(iso), _positive(taken.get(ExifTags.Base.FNumber))
    )


def _positive(number) -> float | None:
    try:
        value = float(number)
    except (TypeError, ValueError, ZeroDivisionError):
        return None
    return value if 0 < value < 1e9 else None


# --- 16 bits and floats -----------------------------------------------------------------------------------


def _deep(name: str, data: bytes) -> Photograph:
    """PNG and TIFF of 16 bits or floats, by OpenCV."""
    try:
        import cv2
    except ImportError:
        text = "more than 8 bits a channel, which " + WITHOUT.format("opencv-python-headless")
        raise InputError(f"{name}: {text}; it would be cut to 8 bits otherwise") from None
    with _silent(cv2):
        try:
            codes = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
        except cv2.error:
            codes = None
    if codes is None:
        raise InputError(f"{name}: damaged or cut off, or of a kind that OpenCV does not read")
    if codes.ndim == 2 or codes.shape[2] < 3:
        raise InputError(f"{name}: holds no red, green and blue (one channel); wanted an RGB photograph")
    if codes.shape[2] == 4:
        if np.any(codes[..., 3] < codes[..., 3].max()):
            raise InputError(
                f"{name}: is transparent in places (an alpha channel); wanted a photograph as it was taken"
            )
        codes = codes[..., :3]
    codes = np.ascontiguousarray(codes[..., ::-1])
    if codes.dtype == np.uint16:
        linear = data.startswith(PNG) and _png_gamma(data) == 1.0
        return Photograph(name, codes, "linear" if linear else "srgb", WHITE_16)
    if codes.dtype.kind != "f":
        raise InputError(f"{name}: codes of the type {codes.dtype}; wanted 8 or 16 bits, or floats")
    return Photograph(name, codes.astype(np.float32))


class _silent:
    """OpenCV keeps its warnings to itself."""

    def __init__(self, cv2):
        self.log = cv2.utils.logging

    def __enter__(self):
        self.level = self.log.getLogLevel()
        self.log.setLogLevel(self.log.LOG_LEVEL_SILENT)

    def __exit__(self, *_):
        self.log.setLogLevel(self.level)


def _png_gamma(data: bytes) -> float | None:
    """The exponent that a PNG's gAMA chunk states: 1 where its codes are light."""
    place = data.find(b"gAMA", 8, 4096)
    if place < 0 or len(data) < place + 8:
        return None
    return struct.unpack(">I", data[place + 4 : place + 8])[0] / 100_000


def _exr(path, name: str) -> Photograph:
    """OpenEXR, half or float. Its library reads from a file alone."""
    try:
        import OpenEXR
    except ImportError:
        raise InputError(f"{name}: an OpenEXR picture " + WITHOUT.format("OpenEXR")) from None
    try:
        with OpenEXR.File(name, header_only=True) as file:
            low, high = file.header()["dataWindow"]
        _check_size(name, int(high[0]) - int(low[0]) + 1, int(high[1]) - int(low[1]) + 1)
        with OpenEXR.File(name, separate_channels=True) as file:
            channels = {key: each.pixels for key, each in file.channels().items()}
    except InputError:
        raise
    except Exception as error:  # the library raises bare RuntimeError, ValueError and its own
        raise InputError(f"{name}: damaged or cut off: {error}") from None
    if not {"R", "G", "B"} <= set(channels):
        raise InputError(f"{name}: its channels are {', '.join(sorted(channels)) or 'none'}; wanted R, G and B")
    if "A" in channels and np.any(channels["A"] < 1):
        channels = {key: np.where(channels["A"] < 1, np.nan, channels[key]) for key in "RGB"}
    codes = np.stack([channels[key] for key in "RGB"], axis=-1)
    if codes.dtype.kind != "f":
        raise InputError(f"{name}: channels of whole numbers; wanted half or float")
    return Photograph(name, codes)


# --- camera raw -------------------------------------------------------------------------------------------


def _raw(name: str, data: bytes) -> Photograph:
    try:
        import rawpy
    except ImportError:
        raise InputError(f"{name}: a camera's raw file " + WITHOUT.format("rawpy")) from None
    try:
        with rawpy.imread(io.BytesIO(data)) as raw:
            _check_size(name, raw.sizes.width, raw.sizes.height)
            codes = raw.postprocess(gamma=(1, 1), no_auto_bright=True, output_bps=16, adjust_maximum_thr=0.0)
    except InputError:
        raise
    except Exception as error:  # LibRaw's errors have no common type that rawpy promises
        said = error.args[0] if error.args else error
        said = said.decode("utf-8", "replace") if isinstance(said, bytes) else said
        raise InputError(f"{name}: damaged, cut off or of a camera that LibRaw does not know: {said}") from None
    exif = Image.Exif()
    try:
        exif.load(data[: 2**20] if data[:4] in TIFF else b"")
        exposure = _exposure(exif)
    except Exception:  # a raw file need not be a TIFF
        exposure = Exposure()
    return Photograph(name, codes, "linear", WHITE_16, exposure)


def _tiff_tags(data: bytes) -> dict[int, int]:
    """First value of every short or long tag of a TIFF's first directory; none where it is cut off."""
    order = "<" if data[:2] == b"II" else ">"
    tags: dict[int, int] = {}
    try:
        (start,) = struct.unpack(order + "I", data[4:8])
        (count,) = struct.unpack(order + "H", data[start : start + 2])
        for place in range(start + 2, start + 2 + 12 * count, 12):
            tag, kind, number = struct.unpack(order + "HHI", data[place : place + 8])
            at = place + 8
            if kind == 3 and number > 2:
                (at,) = struct.unpack(order + "I", data[at : at + 4])
            if kind in (1, 3, 4):
                size = {1: "B", 3: "H", 4: "I"}[kind]
                (tags[tag],) = struct.unpack(order + size, data[at : at + struct.calcsize(size)])
    except struct.error:
        pass
    return tags
