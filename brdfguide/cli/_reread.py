"""The data of an answer, read once more as they were read for it."""

import json
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path

from ..data import examine, formats
from ..data.measurement import Measurement
from ..errors import InputError, NoAnswer, choices
from ..opening import content
from ..typed_json import MOST_BYTES
from ._data import Reading, wavelength_choice


def told_of_data(answer_file: Path) -> dict:
    """What an answer of `fit` that was found to be one says of its data."""
    return json.loads(content(answer_file, MOST_BYTES, str(answer_file)))["data"]


def reread(file: Path, told: Mapping, answer_file: Path) -> Measurement:
    """The data as an answer's block `data` says that they were read, through its detector, and without what its fit
    left out.

    With `--anyway` nothing was left out: so it was where that gives the answer's count of missing values, and without
    it does not. Raises InputError for an option of reading that there is not, and as `formats.read`.
    """
    measurement = _as_said(file, told, answer_file)
    try:
        found = examine.prepared(measurement)
    except (InputError, NoAnswer):  # they contradict themselves, or lie outside the guide, and were answered for
        return examine.prepared(measurement, anyway=True)
    if found.censored == told["missing"]:
        return found
    whole = examine.prepared(measurement, anyway=True)
    return whole if whole.censored == told["missing"] else found


def reread_whole(file: Path, told: Mapping, answer_file: Path) -> Measurement:
    """The same with what a fit left out: spikes, cut-off edges. Raises InputError as `reread`."""
    return examine.corrected(_as_said(file, told, answer_file), anyway=True)


def _as_said(file: Path, told: Mapping, answer_file: Path) -> Measurement:
    known = {each.name for each in fields(Reading)}
    said = told.get("read_with") or {}
    if unknown := sorted(said.keys() - known):
        raise choices(f"option of reading in {answer_file}: data.read_with", unknown[0], sorted(known))
    wavelength = said.get("wavelength")
    typed = {"wavelength": wavelength_choice(wavelength)} if isinstance(wavelength, str) else {}
    measurement = formats.read(file, **{**said, **typed})
    if measurement.solid_angle is None and told.get("solid_angle_sr"):
        measurement = replace(measurement, solid_angle=told["solid_angle_sr"])
    return measurement
