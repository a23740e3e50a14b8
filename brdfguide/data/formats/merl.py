"""MERL `.binary`: a whole isotropic BRDF over half and difference angles, for red, green and blue.

Three int32 (90, 90, 180), then three planes of float64 in units of 1/1500, 1.15/1500 and 1.66/1500 per sr. The index is
phi_d + 180 (theta_d + 90 theta_h), with theta_h growing as the square of its index. Every cell becomes a sample at its
centre; negative values and directions below the horizon are no data. A variant without reciprocity has 360 phi_d.

Source: Matusik, Pfister, Brand and McMillan 2003, "A data-driven reflectance model".
"""

import numpy as np

from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ...physics.directions import FIELDS, Directions
from ...physics.geometry import Geometry
from ..measurement import Measurement
from .format import Format, Options, Source, nominal_colours

SCALE = np.array([1.0, 1.15, 1.66]) / 1500
THETA_H = 90  # cells along each angle
THETA_D = 90
PHI_D = 180  # over half a turn; the other half is the same by reciprocity
NOTHING = -1.0  # a cell without a value
LIMIT = 12 + 3 * 8 * THETA_H * THETA_D * 2 * PHI_D


def recognises(head: bytes) -> bool:
    dimensions = np.frombuffer(head[:12], "<i4").tolist() if len(head) >= 12 else None
    return dimensions in ([THETA_H, THETA_D, PHI_D], [THETA_H, THETA_D, 2 * PHI_D])


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where the file is not exactly as long as its header says, or holds no value."""
    planes, phis = _planes(source)
    cells = THETA_D * phis  # of one theta_h
    # no more than that many rows; what is not written takes no memory
    fields = {name: np.empty((THETA_H * cells, 1)) for name in FIELDS if name != "phi_i_deg"}
    brdf = np.empty((THETA_H * cells, 3))
    count = below = invalid = 0
    for theta_h in range(THETA_H):
        values = planes[:, theta_h * cells : (theta_h + 1) * cells]
        angles = directions(theta_h, phis)
        lit = (angles["cos_i"] > 0) & (angles["cos_r"] > 0)
        picked = np.flatnonzero(lit & _filled(values))
        rows = slice(count, count + len(picked))
        for name, each in angles.items():
            each.take(picked, out=fields[name][rows, 0])
        np.multiply(values.take(picked, axis=1).T, SCALE, out=brdf[rows])
        seen = int(np.count_nonzero(lit))
        count, below, invalid = rows.stop, below + cells - seen, invalid + seen - len(picked)
    if not count:
        raise source.error("no cell above the horizon holds a value")
    fields, brdf = {name: each[:count] for name, each in fields.items()}, brdf[:count]
    phi_i = np.broadcast_to(np.zeros(1), (count, 1))
    geom = Geometry(Directions(phi_i_deg=phi_i, **fields), np.array([CHANNEL_UM[name] for name in "RGB"]))
    text = (
        f"{count} of {THETA_H * THETA_D * phis} cells hold a value, each a sample at its centre that counts alike; "
        f"{below} lie below the horizon"
    )
    consequence = "cells crowd toward the mirror direction: half of them lie within 22.5 degrees of it in half angle"
    notes = [
        Finding(
            "table",
            text,
            consequence=consequence,
            numbers=(("cells", count), ("below_horizon", below), ("invalid", invalid)),
        )
    ]
    if invalid:
        notes.append(
            Finding(
                "invalid-cells",
                f"{invalid} cells above the horizon are marked as invalid and were dropped",
                numbers=(("cells", invalid),),
            )
        )
    text = (
        "values near grazing were extrapolated when such tables were made; published comparisons leave out what lies "
        "beyond 80 degrees"
    )
    notes += [Finding("extrapolated-grazing", text, option="--theta-max 80"), nominal_colours("RGB")]
    return Measurement(geom, brdf, ("R", "G", "B"), name=source.name, format="MERL .binary", findings=tuple(notes))


def function(source: Source, options: Options):
    """The value of the cell in which a direction lies, NaN where it holds none."""
    planes, phis = _planes(source)

    def value(geom: Geometry) -> np.ndarray:
        cells = planes[:, cell_of(geom, phis)].T
        return np.where(cells >= 0, cells * SCALE, np.nan)

    return value, ("R", "G", "B")


def table(brdf) -> np.ndarray:
    """(cells, 3) [1/sr]: `brdf` (geometry) -> (samples, 3) at the cells' centres, NaN below the horizon."""
    values = np.full((THETA_H * THETA_D * PHI_D, 3), np.nan)
    for theta_h in range(THETA_H):
        fields = directions(theta_h, PHI_D)
        lit = (fields["cos_i"] > 0) & (fields["cos_r"] > 0)
        fields = {name: each[lit, None] for name, each in fields.items()}
        geom = Geometry(Directions(phi_i_deg=np.zeros((np.count_nonzero(lit), 1)), **fields))
        values[theta_h * THETA_D * PHI_D + np.flatnonzero(lit)] = brdf(geom)
    return values


def packed(values) -> bytes:
    """The file of a `table`; -1 where it has no value, or a negative one."""
    with np.errstate(invalid="ignore"):
        held = np.where(np.isfinite(values) & (values >= 0), _unscaled(values), NOTHING)
    return np.array([THETA_H, THETA_D, PHI_D], "<i4").tobytes() + np.ascontiguousarray(held.T, "<f8").tobytes()


def _unscaled(values):
    """What a table must hold so that reading it gives these values to the last bit, where a double can."""
    held = values / SCALE
    for other in (np.nextafter(held, np.inf), np.nextafter(held, 0.0)):
        held = np.where((held * SCALE != values) & (other * SCALE == values), other, held)
    return held


def _planes(source: Source):
    """The three planes (3, cells), and how many phi_d they have. Raises InputError for a file of another length."""
    phis = int(np.frombuffer(source.data[:12], "<i4")[2])
    wanted = 12 + 3 * 8 * THETA_H * THETA_D * phis
    if len(source.data) != wanted:
        raise source.error(
            f"found {len(source.data)} bytes, wanted {wanted} for a table of {THETA_H} x {THETA_D} x {phis} "
            f"cells in three colours"
        )
    return np.frombuffer(source.data, "<f8", offset=12).reshape(3, -1), phis


def cell_of(geom: Geometry, phis: int) -> np.ndarray:
    """The cell in which each direction (samples, 1) lies, as a reader takes it."""
    theta_h = np.arctan(np.sqrt(geom.tan2_h))[:, 0]
    theta_d = np.arccos(np.minimum(geom.cos_d, 1.0))[:, 0]
    along = np.divide(-geom.cos_difference[:, 0], 2 * np.sin(theta_h), out=np.zeros_like(theta_h), where=theta_h > 0)
    across = np.sqrt(np.maximum(np.sin(theta_d) ** 2 - along**2, 0.0)) * np.where(
        np.sin(np.radians(geom.phi_deg[:, 0])) > 0, -1.0, 1.0
    )
    phi_d = np.remainder(np.arctan2(across, along), np.pi if phis == PHI_D else 2 * np.pi)

    def place(x, count):
        return np.clip(np.floor(x + 1e-9).astype(int), 0, count - 1)

    row = THETA_D * place(np.sqrt(np.degrees(theta_h) * THETA_H * (THETA_H / 90)), THETA_H)
    row += place(np.degrees(theta_d) * (THETA_D / 90), THETA_D)
    return phis * row + place(np.degrees(phi_d) * (PHI_D / 180), phis)


def _filled(values) -> np.ndarray:
    """Cells with a value in some colour."""
    with np.errstate(invalid="ignore"):
        return np.any((values >= 0) & (values < np.inf), axis=0)


def directions(theta_h: int, phis: int) -> dict[str, np.ndarray]:
    """Geometry of the cells of one theta_h, from half and difference angles at their centres; the light stands at
    azimuth 0."""
    half = np.radians((theta_h + 0.5) ** 2 * (90 / THETA_H) / THETA_H)
    theta_d = np.radians((np.arange(THETA_D) + 0.5) * 90 / THETA_D)[:, None]
    phi_d = np.radians((np.arange(phis) + 0.5) * 180 / PHI_D)[None, :]
    found = Directions.from_half_difference(half, theta_d, phi_d)
    return {name: getattr(found, name).reshape(-1) for name in FIELDS if name != "phi_i_deg"}


FORMAT = Format("merl", (".binary",), recognises, read, limit=LIMIT, whole_table=True, function=function)
