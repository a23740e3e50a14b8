"""Scans of one sample under several turns, a file each or a column's value each, as one measurement.

Laboratories turn a brushed sheet and scan it again in the plane of incidence, and no file says by how much. Whatever a
grain does, the mirror direction has the same facets under every turn: scans that differ there differ in scale, or are
not of one sample.
"""

from dataclasses import replace

import numpy as np

from ..errors import InputError
from ..finding import Finding
from ..opening import held
from ..physics.geometry import Geometry
from . import formats
from .measurement import Measurement, row_median

MOST_GAIN = 0.05  # by which scans of one sample may differ in the mirror direction, beside their noise
MIRROR_DEG = 0.6  # within which a value is one of the mirror direction
LEAST = 2  # such pairs that tell a gain


def turn_angles(text: str) -> tuple[float, ...]:
    """The angles [deg] in `0,90`. Raises InputError for anything but two or more different numbers."""
    try:
        turns = tuple(float(word) for word in text.split(","))
    except ValueError:
        turns = ()
    if len(turns) < 2 or len(set(turns)) < len(turns) or not all(-360 <= each <= 360 for each in turns):
        raise InputError(f"--turned {text}: wanted the angle of each scan in degrees, such as 0,90")
    return turns


def read_turned(files, turns, *, anyway: bool = False, rotation_sense: str | None = None, **options) -> Measurement:
    """The scans in some files, or in one whose column `scan` tells them apart, under these turns [deg] of the sample.

    A sample turned by +psi, counter-clockwise, has its light at -psi; clockwise (`cw`) at +psi. `options` are those of
    `formats.read`. Raises InputError for another number of scans than turns, for scans that have azimuths of their own,
    and, unless `anyway`, where they differ in the mirror direction.
    """
    parts = _scans(files, turns, options)
    if len(parts) != len(turns):
        found = f"{len(parts)} scan{'s' * (len(parts) != 1)} for {len(turns)} angles"
        raise InputError(f"--turned {','.join(f'{each:g}' for each in turns)}: found {found}; wanted an angle for each")
    sign = 1.0 if rotation_sense == "cw" else -1.0
    gains = _gains(parts)
    worst = max((abs(each) for each in gains), default=0.0)
    if worst > MOST_GAIN and not anyway:
        text = ", ".join(f"{np.exp(each):.2f}" for each in gains)
        raise InputError(
            f"{parts[0].name}: --turned: in the mirror direction the scans are {text} times the first one's; under "
            f"every turn it must be the same, so they differ in scale or are not of one sample; --anyway joins them"
        )
    return _together([_at(each, sign * turn) for each, turn in zip(parts, turns, strict=True)], turns, sign)


def _scans(files, turns, options) -> list[Measurement]:
    files = list(files)
    if len(files) > 1:
        return [formats.read(each, **options) for each in files]
    source = held(files[0])
    values = formats.groups(source, "scan", **{key: options[key] for key in ("columns", "select") if key in options})
    chosen = tuple(options.pop("select", None) or ())
    return [formats.read(source, **options, select=(*chosen, ("scan", value))) for value in values]


def _at(measurement: Measurement, azimuth: float) -> Measurement:
    """With the light at this azimuth [deg]. Raises InputError where it has several of its own."""
    phi = measurement.geom.phi_i_deg
    if np.ptp(phi) > 0.01:
        raise InputError(f"{measurement.name}: --turned has no effect: its light has azimuths of its own")
    directions = replace(measurement.geom.directions, phi_i_deg=np.full_like(phi, azimuth))
    return replace(measurement, geom=Geometry(directions, measurement.geom.wavelength))


def _gains(parts: list[Measurement]) -> list[float]:
    """ln of the value of each scan but the first over that of the first, in the mirror direction, median over
    incidences; 0 where too few are shared."""
    first, *others = (_at_mirror(each) for each in parts)
    found = []
    for each in others:
        shared = [each[theta] - first[theta] for theta in first.keys() & each.keys()]
        found.append(float(np.median(shared)) if len(shared) >= LEAST else 0.0)
    return found


def _at_mirror(measurement: Measurement) -> dict[float, float]:
    """Incidence [deg] -> ln of the value nearest to the mirror direction."""
    level, away = row_median(measurement.ln), np.degrees(np.sqrt(measurement.geom.mirror_distance2[:, 0]))
    found = {}
    for theta, rows in measurement.theta_i_groups.items():
        rows = rows[np.isfinite(level[rows]) & (away[rows] < MIRROR_DEG)]
        if len(rows) and theta < 80:
            found[theta] = float(level[rows[np.argmin(away[rows])]])
    return found


def _together(parts: list[Measurement], turns, sign: float) -> Measurement:
    first = parts[0]
    for each in parts[1:]:
        if each.channels != first.channels or not np.allclose(each.geom.wavelength, first.geom.wavelength):
            here, there = ", ".join(first.channels), ", ".join(each.channels)
            raise InputError(f"{each.name}: --turned joins scans of like channels; found {there}, wanted {here}")
    fields = {
        name: np.concatenate([getattr(each.geom.directions, name) for each in parts])
        for name in first.geom.directions.__dataclass_fields__
    }
    doubts = [each.stderr for each in parts]
    stated = [each for each in doubts if each is not None]
    text = (
        f"{len(parts)} scans of one sample, turned by {', '.join(f'{each:g}' for each in turns)} degrees "
        f"{'clockwise' if sign > 0 else 'counter-clockwise'}: the light stands at "
        f"{', '.join(f'{sign * each + 0.0:g}' for each in turns)} degrees of it"
    )
    notes = [Finding("scans-joined", text, option="--turned")]
    if len(parts) == 2:
        said = "two turns do not tell an axis: one is taken to lie across the grain, the other along it"
        notes.append(Finding("axis-assumed", said, consequence="--fix axis=DEG says another", option="--fix"))
    return Measurement(
        Geometry(type(first.geom.directions)(**fields), first.geom.wavelength),
        np.concatenate([each.brdf for each in parts]),
        first.channels,
        np.concatenate(stated) if len(stated) == len(parts) else None,
        first.solid_angle,
        f"{first.name} and {len(parts) - 1} more" if len({each.name for each in parts}) > 1 else first.name,
        first.format,
        (*first.findings, *notes),
    )
