"""Gonioreflectometer tables: rows of numbers under named columns, separated by anything sensible.

Long form has one value a row (and perhaps a wavelength column), wide form a column for each wavelength or colour. Without
azimuth columns the scan lies in the plane of incidence and theta_r carries a sign, positive on the mirror side.
What a name does not say is inferred from the values, and noted.
"""

from ..measurement import Measurement
from . import _meaning
from ._base import Format, Options, Source
from ._sheet import sheet


def recognises(head: bytes) -> bool:
    """Any text: this reader takes what no other claims."""
    return b"\0" not in head or head[:2] in (b"\xff\xfe", b"\xfe\xff")


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError naming line and column, what was found and what was wanted."""
    headerless = options.columns if isinstance(options.columns, tuple) else None
    return _meaning.measured(source, sheet(source, headerless), options)


FORMAT = Format("table", (".csv", ".txt", ".dat", ".tsv"), recognises, read, own_side=False)
