"""sigma and tau from how much weaker a mirror image is than in black glass, over angles and colours.

    A(θ) = e^-g S² cos²θ    (the mirror part of He et al. 1991 over F(θ); `wave_gloss.mirror_share`)

A is the step at the image of a bright straight edge in the sample over that in black glass, each divided by its
Fresnel reflectance. Davies' e^-g alone, g = (4π sigma cos θ/λ)², makes sigma 13 to 81 % too small: shadows make the
surface smoother toward grazing, and how much tells the slope.
"""

import csv
from dataclasses import replace
from io import StringIO
from math import isfinite

from .. import opening
from ..errors import InputError
from ..physics import emergence
from ..physics.colour import SRGB_UM
from ..records import dataclass
from .evidence import Evidence, Observation, dimming_doubt
from .inference import Inference, infer

MOST_BYTES = 2**20
COLOURS = dict(zip("rgb", SRGB_UM, strict=True))
ANGLE = ("theta_deg", "theta", "angle_deg", "angle")  # names of the column of angles from the normal [°]
ALONE = ("attenuation", "ratio", "a")  # names of a single column without a wavelength
MOST_RATIO = 2.0  # a rough surface reflects less than a smooth one; errors aside


@dataclass(frozen=True)
class MirrorTable:
    """Rows of a table: (angle [°], wavelength [µm], ratio)."""

    name: str
    rows: tuple[tuple[float, float, float], ...]


def read_mirror_table(path, wavelength: float | None = None) -> MirrorTable:
    """A CSV with a column of angles and one of ratios for each colour: R, G, B, a wavelength in nm, or `attenuation`.

    Takes  wavelength [µm] of a column `attenuation`, 0.55 unless given; an error where there is none.
    Raises InputError with the line, what was found and what was wanted.
    """
    name = str(path)
    try:
        text = opening.content(path, MOST_BYTES, name).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{name}: not text in UTF-8; wanted a CSV") from None
    lines = [(number, row) for number, row in enumerate(csv.reader(StringIO(text)), 1) if "".join(row).strip()]
    lines = [(number, row) for number, row in lines if not row[0].lstrip().startswith("#")]
    if not lines:
        raise InputError(f"{name}: empty; wanted a header such as theta_deg,R,G,B and a row for each angle")
    (first, header), *rows = lines
    columns = _columns([each.strip() for each in header], f"{name}:{first}", wavelength)
    found = []
    for number, row in rows:
        if len(row) != len(header):
            raise InputError(f"{name}:{number}: {len(row)} values under a header of {len(header)} columns")
        angle, *ratios = (
            _number(text, f"{name}:{number}") for text in [row[columns[0][0]]] + [row[c] for c, _ in columns[1:]]
        )
        if not 0 <= angle < 90:
            raise InputError(f"{name}:{number}: an angle of {angle:g}; wanted degrees from the normal, 0 to below 90")
        for ratio, (_, um) in zip(ratios, columns[1:], strict=True):
            if not 0 <= ratio <= MOST_RATIO:
                raise InputError(
                    f"{name}:{number}: a ratio of {ratio:g}; wanted 0 to {MOST_RATIO:g}, 1 for black glass"
                )
            found.append((angle, um, ratio))
    if not found:
        raise InputError(f"{name}: no row below the header; wanted one for each angle")
    return MirrorTable(name, tuple(found))


def _columns(header: list[str], where: str, wavelength: float | None) -> list[tuple[int, float]]:
    """Number of the column of angles, then those of ratios, with their wavelengths [µm]."""
    names = [each.lower() for each in header]
    angles = [place for place, each in enumerate(names) if each in ANGLE]
    if len(angles) != 1:
        raise InputError(f"{where}: {len(angles)} columns of angles; wanted one called theta_deg")
    found = [(angles[0], 0.0)]
    for place, each in enumerate(names):
        um = COLOURS.get(each, _wavelength(each))
        if each in ALONE:
            um = wavelength or emergence.WAVELENGTH
        if um is not None and place != angles[0]:
            found.append((place, um))
        elif place != angles[0]:
            raise InputError(
                f"{where}: a column called '{header[place]}'; wanted R, G, B, a wavelength in nm, or attenuation"
            )
    if len(found) < 2:
        raise InputError(f"{where}: no column of ratios; wanted R, G, B, a wavelength in nm, or attenuation")
    if wavelength is not None and not set(names) & set(ALONE):
        raise InputError(f"{where}: --wavelength-nm is for a column called attenuation; these name their own colours")
    return found


def _wavelength(name: str) -> float | None:
    """A column's wavelength [µm] where its name is one in nm."""
    try:
        nm = float(name.removesuffix("nm").strip())
    except ValueError:
        return None
    return nm / 1000 if 200 <= nm <= 20000 else None


def _number(text: str, where: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not isfinite(number):
        raise InputError(f"{where}: found '{text.strip()}', wanted a number")
    return number


def inferred_from(table: MirrorTable, solid_angle: float = emergence.OMEGA) -> Inference:
    """What the table says of the surface, by He and Torrance's law."""
    readings = tuple(
        replace(
            Observation(f"mirror.{place}", "dimming", ratio, dimming_doubt(ratio), angle),
            wavelength=um,
        )
        for place, (angle, um, ratio) in enumerate(table.rows, 1)
    )
    return infer(Evidence(readings, solid_angle=solid_angle))
