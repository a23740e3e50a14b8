"""Speos' spectral `.brdf`: for each incidence and wavelength a table of theta by phi about the normal, and its total.

Title, mode, comment, description, flags for reflection and transmission, the kind of value (1: proportional to the
BSDF, 0: to an intensity), numbers and lists of incidences and wavelengths [nm]; then for each incidence and wavelength
the reflectance in percent and a table. Values count in relation to each other: every table is scaled to its
reflectance. The mirror direction is at azimuth 0; where the values say otherwise, at 180.

Source: "Structure of BRDF files", Speos user's guide (Ansys 2024), and the files that its public converters write.
"""

import re

import numpy as np

from ...errors import InputError
from ...finding import Finding
from .. import stated_total
from ..measurement import Measurement
from ._hemisphere import total
from ._product_grid import product_grid
from ._sides import azimuths_on_their_side
from ._speos import MIRROR_DEG, Words, header
from ._writing import about, angle, value, wavelengths
from .format import Format, Options, Source, check_zenith, measurement

TITLE = re.compile(rb"OPTIS - brdf surface file", re.IGNORECASE)
TITLE_WRITTEN = "OPTIS - brdf surface file v9.0"


def recognises(head: bytes) -> bool:
    return TITLE.match(head.lstrip()) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for binary, for transmission, and where a count does not agree."""
    words = Words(source)
    header(source, words, vector=False)
    kind = int(words.numbers(1, "the kind of value")[0])
    incidences, waves = words.count("the number of incidences"), words.count("the number of wavelengths")
    theta_i = words.numbers(incidences, "angle of incidence")
    nm = words.numbers(waves, "wavelength")
    check_zenith(source, "the angle of incidence", theta_i)
    parts, totals, blocks = [], [], []
    for incidence in theta_i:
        spectrum = []
        for wave in nm:
            percent = float(words.numbers(1, "a reflectance in percent")[0])
            table = words.table(f"the table at {incidence:g} degrees and {wave:g} nm")
            whole = table.scattered(kind)
            if not (0 < whole < np.inf and 0 <= percent < np.inf):
                text = f"the table at {incidence:g} degrees and {wave:g} nm scatters nothing: it cannot be scaled"
                raise source.error(f"{text} to {percent:g} %", words.at)
            theta, phi, values = table.rows(kind)
            spectrum.append((theta, phi, values * (percent / 100 / whole)))
            totals.append(percent / 100)
        parts.append(spectrum)
        blocks += [incidence] * waves
    note = Finding("scaled-to-total", "each table is scaled to the reflectance that the file states for it")
    channels = tuple(f"{each:g}nm" for each in nm)
    spread = _joined(source, theta_i, parts)
    findings = [note, stated_total.total_note(blocks, totals)]
    made = measurement(source, "Speos .brdf", *spread, channels=channels, wavelength=nm / 1000, findings=findings)
    return azimuths_on_their_side(made, options, doubtful=True)


def _joined(source: Source, theta_i, parts):
    """theta_i, phi_i, theta_r, phi_r and BRDF (rows, wavelengths); the tables of one incidence share their angles."""
    columns = []
    for incidence, spectrum in zip(theta_i, parts, strict=True):
        theta, phi, _ = spectrum[0]
        for other, azimuths, _ in spectrum[1:]:
            if len(other) != len(theta) or not (np.allclose(other, theta) and np.allclose(azimuths, phi)):
                raise source.error(f"at {incidence:g} degrees the wavelengths have different angles")
        values = np.stack([each[2] for each in spectrum], axis=1)
        columns.append((np.full(len(theta), incidence), theta, phi - MIRROR_DEG + 180.0, values))
    light, theta, phi, values = (np.concatenate(each) for each in zip(*columns, strict=True))
    return light, 0.0, theta, phi, values


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as a Speos `.brdf`, a table for each incidence and wavelength, and sentences on what was made of
    it.

    Raises InputError for several rotations, and where an incidence's directions lie on no grid about the normal.
    """
    grid = product_grid(measurement, about_mirror=False, what="Speos")
    if len(grid.rotations) > 1:
        text = f"a Speos .brdf holds one rotation of the sample, there are {len(grid.rotations)}"
        raise InputError(f"{measurement.name}: {text}; convert to speos-anisotropic")
    nm = wavelengths(measurement)
    turned, places = grid.whole_turn(180.0)
    turned, places = np.append(turned, turned[0] + 360.0), np.append(places, places[0])
    lines = [TITLE_WRITTEN, "0", about(measurement)[0], "0", "", "1\t0", "1", f"{len(grid.theta_i)}\t{len(nm)}"]
    lines += ["\t".join(map(angle, grid.theta_i)), "\t".join(f"{each:.9g}" for each in nm)]
    for incidence in range(len(grid.theta_i)):
        for channel in range(len(nm)):
            rows = np.nan_to_num(grid.values[0, incidence, places, :, channel]).T
            lines.append(f"{100 * float(total(grid.polar, turned, rows)):.12g}")
            lines += [f"{len(grid.polar)} {len(turned)}", "\t" + "\t".join(map(angle, turned))]
            lines += ["\t".join([angle(theta), *map(value, row)]) for theta, row in zip(grid.polar, rows, strict=True)]
    return "\n".join(lines) + "\n", list(grid.sentences)


FORMAT = Format("speos-brdf", (".brdf",), recognises, read, own_side=False, write=write)
