"""Speos' `.anisotropicbsdf`, text or binary: for each rotation and incidence a table of theta by phi about the normal.

Title, mode, comment, description, anisotropy vector, flags, the kind of value (1: proportional to the BSDF, 0: to an
intensity), rotations, incidences of each, then a spectrum: where its total was measured, and reflectances in percent at
wavelengths [nm]; then the tables. One factor for each wavelength scales all tables: that which gives the table at the
measured incidence its total. A spectrum of one value throughout is one channel, of no wavelength. The guide puts the
mirror direction at azimuth 0, and files of other programs at 180: the values decide, however slightly one side is
brighter.

Source: "Structure of Anisotropic BSDF files", Speos user's guide (Ansys 2024).
"""

import re

import numpy as np

from ...errors import InputError
from ...finding import Finding
from .. import stated_total
from ..measurement import Measurement
from . import _speos_binary
from ._hemisphere import total
from ._product_grid import product_grid
from ._rotations import turns_of
from ._sides import azimuths_on_their_side
from ._speos import MIRROR_DEG, Table, Words, header
from ._writing import about, angle, only_channel, value
from .format import Format, Options, Source, check_zenith, measurement

TITLE_WRITTEN = "OPTIS - Anisotropic BSDF surface file v11"
TITLE = re.compile(rb"OPTIS - Anisotropic BSDF surface file", re.IGNORECASE)


def recognises(head: bytes) -> bool:
    return TITLE.match(head.lstrip()) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for transmission, and where a count does not agree."""
    binary = source.data.partition(b"\n")[2][:1] == b"1"
    kind, rotations, incidences, measured, nm, percent, tables = (
        _speos_binary.read_binary(source) if binary else _text(source)
    )
    for each in incidences[1:]:
        if len(each) != len(incidences[0]) or not np.allclose(each, incidences[0]):
            raise source.error("its rotations have different incidences; save it with one list for all")
    theta_i = incidences[0]
    check_zenith(source, "the angle of incidence", theta_i)
    if not np.isfinite(measured):
        raise source.error(f"found {measured:g} as the incidence where the total was measured, wanted a number")
    alpha = _factor(source, theta_i, [table.scattered(kind) for table in tables[0]], measured)
    if not (np.all(np.isfinite(percent)) and np.all(percent >= 0)):
        raise source.error(f"found a reflectance of {percent.min():g} %, wanted 0 or more")
    flat = bool(len(percent) > 1 and np.ptp(percent) <= 1e-6 * abs(percent[0]))
    shares = percent[:1] / 100 if flat else percent / 100
    angles, turned = _rows(source, theta_i, tables, kind)
    if not len(angles[0]):
        raise source.error("no direction above the horizon is left")
    if not np.all(np.isfinite(turned)):
        raise source.error("a table holds a value that is no number")
    values = turned[..., None] * (alpha * shares)
    notes = [_scaled(alpha, measured, percent)]
    azimuths = np.zeros(1)
    if len(rotations) > 1:
        azimuths, values, turns = turns_of(values, rotations, angles[1] < 80, options)
        notes += turns
    notes.append(stated_total.total_note([measured], shares[:1]))
    channels = ("brdf",) if flat else tuple(f"{each:g}nm" for each in nm)
    theta_i, theta_r, phi_r = (np.tile(each, len(azimuths)) for each in angles)
    phi_i = np.repeat(azimuths, len(angles[0]))
    made = measurement(
        source,
        "Speos .anisotropicbsdf",
        theta_i,
        phi_i,
        theta_r,
        phi_i + phi_r,
        values.reshape(len(phi_i), -1),
        channels=channels,
        wavelength=None if flat else nm / 1000,
        findings=notes,
    )
    return azimuths_on_their_side(made, options, doubtful=True)


def _text(source: Source):
    """What `_speos_binary.read_binary` gives, from text."""
    words = Words(source)
    header(source, words, vector=True)
    kind = int(words.numbers(1, "the kind of value")[0])
    rotations = words.numbers(words.count("the number of rotations"), "a rotation")
    incidences = [
        words.numbers(words.count("the number of incidences"), "an angle of incidence") for _ in range(len(rotations))
    ]
    measured = float(words.numbers(2, "where the total was measured")[0])
    words.line("the description of the spectrum")
    count = words.count("the number of wavelengths")
    nm, percent = words.numbers(2 * count, "a wavelength or its reflectance").reshape(count, 2).T
    tables = [[words.table(f"the table at {angle:g} degrees") for angle in each] for each in incidences]
    return kind, rotations, incidences, measured, nm, percent, tables


def _factor(source: Source, theta_i, wholes, measured: float) -> float:
    """What makes the table at the measured incidence scatter 1, interpolated between the incidences about it."""
    if not all(np.finfo(float).tiny <= whole < np.inf for whole in wholes):
        raise source.error("a table scatters nothing: it cannot be scaled to the total that the file states")
    order = np.argsort(theta_i)
    return float(np.interp(measured, np.asarray(theta_i)[order], 1 / np.array(wholes)[order]))


def _rows(source: Source, theta_i, tables: list[list[Table]], kind: int):
    """(theta_i, theta_r, phi_r) [deg], each (cells,), and values (rotations, cells)."""
    turned, angles = [], None
    for rotation in tables:
        parts = [table.rows(kind) for table in rotation]
        here = tuple(
            np.concatenate(each)
            for each in (
                [np.full(len(theta), angle) for angle, (theta, _, _) in zip(theta_i, parts, strict=True)],
                [theta for theta, _, _ in parts],
                [phi - MIRROR_DEG + 180.0 for _, phi, _ in parts],
            )
        )
        if angles is not None and not all(
            len(a) == len(b) and np.allclose(a, b) for a, b in zip(here, angles, strict=True)
        ):
            raise source.error("its rotations have tables of different angles; save it with one grid for all")
        angles = here
        turned.append(np.concatenate([values for _, _, values in parts]))
    return angles, np.array(turned)


def _scaled(alpha: float, measured: float, percent) -> Finding:
    span = f"{percent.min():g}" if np.ptp(percent) == 0 else f"{percent.min():g} to {percent.max():g}"
    text = f"all tables are scaled alike, so that the one at {measured:g} degrees scatters the {span} % that it states"
    return Finding("scaled-to-total", text, numbers=(("factor", alpha),))


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as a Speos `.anisotropicbsdf`, a table for each rotation and incidence, and sentences on what was
    made of it.

    Raises InputError for several channels, where the directions lie on no grid about the normal, and where nothing
    scatters.
    """
    nm = only_channel(measurement, "Speos .anisotropicbsdf")
    grid = product_grid(measurement, about_mirror=False, what="Speos")
    azimuth, places = grid.whole_turn(180.0)
    azimuth, places = np.append(azimuth, azimuth[0] + 360.0), np.append(places, places[0])
    tables = np.swapaxes(grid.values[..., 0], -1, -2)[..., places]  # (rotations, incidences, polars, azimuths)
    # what is written is what is scaled to the total
    totals = total(grid.polar, azimuth, np.vectorize(value)(tables[0]).astype(float))
    brightest = int(np.argmax(totals))
    if not totals[brightest] > 0:
        raise InputError(f"{measurement.name}: it scatters nothing, and Speos scales its tables to what is scattered")
    percent = f"{100 * float(totals[brightest]):.12g}"
    lines = [TITLE_WRITTEN, "0", about(measurement)[0], "0", "", "1\t0\t0", "1\t0", "1", f"{len(grid.rotations)}"]
    lines.append("\t".join(map(angle, grid.rotations)))
    lines += [f"{len(grid.theta_i)}", "\t".join(map(angle, grid.theta_i))] * len(grid.rotations)
    lines += [f"{angle(grid.theta_i[brightest])}\t0", "", "1", f"{nm:.9g}\t{percent}"]
    head = [f"{len(grid.polar)} {len(azimuth)}", "\t" + "\t".join(map(angle, azimuth))]
    for table in tables.reshape(-1, *tables.shape[2:]):
        rows = (map(value, row.tolist()) for row in table)
        lines += [*head, *("\t".join([angle(theta), *row]) for theta, row in zip(grid.polar, rows, strict=True))]
    return "\n".join(lines) + "\n", list(grid.sentences)


FORMAT = Format(
    "speos",
    (".anisotropicbsdf",),
    recognises,
    read,
    own_side=False,
    options=("average_phi_i", "rotation_sense"),
    write=write,
)
