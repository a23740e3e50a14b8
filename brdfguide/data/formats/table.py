"""Gonioreflectometer tables: rows of numbers under named columns, separated by anything sensible.

Long form has one value a row (and perhaps a wavelength column), wide form a column for each wavelength or colour.
Without azimuth columns the scan lies in the plane of incidence and theta_r carries a sign, positive on the mirror side.
What a name does not say is inferred from the values, and noted.
"""

from math import isfinite

import numpy as np

from ...printable import comment
from ..measurement import Measurement
from . import _groups, _meaning
from ._stated import sheet_of
from .format import OF_TABLES, Format, Options, Source, wide_encoding


def recognises(head: bytes) -> bool:
    """Any text: this reader takes what no other claims."""
    return b"\0" not in head or wide_encoding(head) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError naming line and column, what was found and what was wanted."""
    return _meaning.measurement_of(source, sheet_of(source, options), options)


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    table, _ = _groups.selected(source, sheet_of(source, options), options.select)
    return _groups.values_of_group(source, table, column)


def written(measurement: Measurement):
    """The measurement as lines of our own CSV; reading them gives back the same values, to the last bit."""
    geom, channels = measurement.geom, list(measurement.channels)
    yield "# brdfguide table 1"
    yield _comment(f"source: {measurement.name} ({measurement.format})")
    yield "# quantity: brdf"
    yield "# mirror-side: phi=180"
    yield "# angles: degrees, both directions point away from the surface; values in 1/sr"
    nm = np.broadcast_to(np.asarray(geom.wavelength, float) * 1000, len(channels))
    if channels == ["brdf"]:
        yield f"# wavelength_nm: {nm[0]:.9g}"
    elif not set(channels) <= {"R", "G", "B", "X", "Y", "Z"}:
        channels = [f"{each:.9g}nm" for each in nm]
    for finding in measurement.findings:
        yield _comment(f"note {finding.printed}: {finding.text}")
    columns = [
        geom.theta_i_deg,
        _turn(geom.phi_i_deg),
        geom.theta_r_deg,
        _turn(geom.phi_i_deg + geom.phi_deg),
        measurement.brdf,
    ]
    names = ["theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", *channels]
    if measurement.stderr is not None:
        columns.append(measurement.stderr)
        names += [f"stderr_{name}" for name in channels]
    yield ",".join(names)
    for row in np.concatenate([np.broadcast_to(column, (len(geom), column.shape[1])) for column in columns], axis=1):
        yield ",".join(repr(cell) if isfinite(cell) else "" for cell in row.tolist())


def _turn(degrees):
    """An azimuth within 0..360, free of what rounding left."""
    return np.remainder(np.round(np.remainder(degrees, 360.0), 9), 360.0)


def _comment(text: str) -> str:
    return "# " + comment(" ".join(text.split()))


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as our own CSV; nothing is lost."""
    return "\n".join(written(measurement)) + "\n", []


FORMAT = Format(
    "table",
    (".csv", ".txt", ".dat", ".tsv"),
    recognises,
    read,
    own_side=False,
    groups=groups,
    options=OF_TABLES,
    write=write,
)
