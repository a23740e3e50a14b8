"""Photographs of a lit sphere, rod or plate, described in YAML with the key `photographs`: `docs/photographs.md`."""

import re
from pathlib import Path

import numpy as np

from ...physics.geometry import Geometry, rows
from ..measurement import Measurement
from ..otherwise import Otherwise
from .format import Format, Options, Source

KEY = re.compile(rb"^photographs[ \t]*:", re.MULTILINE)
CHANNELS = ("R", "G", "B")


def recognises(head: bytes) -> bool:
    """A line that begins with the key."""
    return b"\0" not in head and KEY.search(head) is not None


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a description or a picture that cannot be read."""
    from ...photographs import extract, plan

    described = plan.planned(source.text, source.name)
    found = extract.extract(described)
    geom = rows(Geometry(found.directions, described.wavelength_um))
    keep = np.isfinite(found.f)
    otherwise = tuple(
        Otherwise(each.fault, rows(Geometry(each.directions, described.wavelength_um)), each.factor)
        for each in found.changed
    )
    return Measurement(
        geom,
        np.where(keep, found.f, np.nan),
        CHANNELS,
        stderr=np.where(keep, found.stderr, np.nan),
        name=source.name,
        format="photographs",
        findings=found.findings,
        otherwise=otherwise,
    )


def beside(source: Source) -> list[Path]:
    """The pictures, whether they are there or not. Raises InputError for a description that cannot be read."""
    from ...photographs import plan

    shots = plan.planned(source.text, source.name).shots
    return [path for shot in shots for path in (shot.file, shot.reference) if path is not None]


FORMAT = Format("photographs", (".yaml", ".yml"), recognises, read, limit=65536, beside=beside)
