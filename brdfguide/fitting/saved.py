"""The JSON of `brdfguide fit` and `recommend` read back as a Surface: its shape, and what its parts must agree on."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from .. import models
from ..errors import InputError, NoAnswer, choices
from ..models.surface import Surface
from ..physics.geometry import WAVELENGTH_UM
from ..printable import short
from ..records import dataclass
from ..typed_json import Schema, parsed, read_typed

SHORTEST_NM = 100.0  # as of measurements
LONGEST_NM = 100_000.0


@dataclass(frozen=True)
class Value:
    """One parameter as a fit prints it."""

    value: float | tuple[float | None, ...] | None  # null: derived from the others, which say nothing of it
    stderr: float | tuple[float | None, ...] | None = None  # null: it was not fitted, or the data do not determine it


@dataclass(frozen=True)
class SavedFinding:
    """What was noticed."""

    code: str


@dataclass(frozen=True)
class SavedRow:
    """One candidate of a ranking."""

    model: str
    candidate: str
    parameters: dict[str, Value | None]
    freed: tuple[str, ...] = ()
    rms_ln: float | None = None
    held_out_rms_ln: float | None = None


@dataclass(frozen=True)
class SavedData:
    """What was fitted."""

    channels: tuple[str, ...] = ("brdf",)
    wavelength_nm: tuple[float, ...] = (WAVELENGTH_UM * 1e3,)
    solid_angle_sr: float | None = None
    findings: tuple[SavedFinding, ...] = ()


@dataclass(frozen=True)
class SavedNoise:
    """What values near the dark level were weighed by."""

    missed: float | None = None


@dataclass(frozen=True)
class Described:
    """A candidate of a description, with values ready to type: angles in degrees."""

    model: str
    start: dict[str, float | tuple[float, ...]]


@dataclass(frozen=True)
class FitDocument:
    """What a fit says of itself."""

    ranking: tuple[SavedRow, ...]
    recommended: str
    data: SavedData = SavedData()
    metric: str = "ln"
    noise: SavedNoise = SavedNoise()


@dataclass(frozen=True)
class SavedRecommendation:
    """What a recommendation says: candidates of a description, a ranking where something was measured, or both."""

    candidates: tuple[Described, ...] | None = None
    ranking: tuple[SavedRow, ...] | None = None
    recommended: str | None = None
    data: SavedData = SavedData()


FIT = Schema({"brdfguide/fit/1": FitDocument, "brdfguide/recommend/1": SavedRecommendation},
             "the output of `brdfguide fit --json` or `recommend --json`")  # fmt: skip


def read_fit(path, name: str | None = None) -> Surface:
    """The recommended row of a fit's JSON, or the one called `name`.

    Raises InputError where the file is not such a JSON, and where it has no row of that name.
    """
    return read_reading(path, name)[0]


def read_reading(path, name: str | None = None) -> tuple[Surface, float | None]:
    """The same, and the detector's solid angle [sr] that the fit was made through; None where that was a point."""
    document = read_typed(path, FIT)
    return _fitted(document, str(path), name), document.data.solid_angle_sr


@dataclass(frozen=True, eq=False)
class SavedFit:
    """A fit with what is needed to go on from it."""

    surface: Surface
    held: tuple[str, ...]  # parameters that were not fitted, or that the data did not determine
    metric: str
    rms_ln: float
    solid_angle: float | None  # of the detector [sr]
    weighing: frozenset[str]  # codes of what weighs the values
    per_channel: bool  # whether shapes too have a value for each channel
    missed: float | None  # relative error that was expected of bright values


def read_minimum(path, name: str | None = None) -> SavedFit:
    """The recommended row of a fit's JSON, or the one called `name`. Raises InputError as `read_fit`."""
    document = read_typed(path, Schema({"brdfguide/fit/1": FitDocument}, "the output of `brdfguide fit --json`"))
    surface, wanted = _fitted(document, str(path), name), name or document.recommended
    row = next(each for each in document.ranking if wanted in (each.candidate, each.model))
    known = {key: np.size(entry.value) for key, entry in row.parameters.items() if entry and _is_known(entry.stderr)}
    shapes = [key for key, p in surface.model.parameters.items() if not p.per_channel and known.get(key, 1) > 1]
    weighing = frozenset(each.code for each in document.data.findings if each.code.startswith("weighed-by-"))
    return SavedFit(
        surface=surface,
        held=tuple(key for key in surface.model.parameters if key not in known),
        metric=document.metric,
        rms_ln=row.rms_ln or 0.0,
        solid_angle=document.data.solid_angle_sr,
        weighing=weighing,
        per_channel=bool(shapes),
        missed=document.noise.missed,
    )


def read_stderr(path, name: str | None = None) -> dict[str, float]:
    """Standard errors of `read_fit`'s parameters, inside units, means over channels; those that are known."""
    document = read_typed(path, FIT)
    wanted = name or document.recommended
    rows = (each for each in document.ranking if wanted in (each.candidate, each.model))
    entries = next(rows, SavedRow("", "", {})).parameters
    return {
        key: float(np.mean([each for each in np.ravel(np.array(entry.stderr, float)) if each == each]))
        for key, entry in entries.items()
        if entry and _is_known(entry.stderr)
    }


def _is_known(stderr) -> bool:
    return stderr is not None and (not isinstance(stderr, tuple) or any(each is not None for each in stderr))


def saved_solid_angle(path) -> float | None:
    """Of the detector [sr] that the fit in a JSON was made through; None where it was taken for a point."""
    return read_typed(path, FIT).data.solid_angle_sr


def read_surface(path, name: str | None = None) -> Surface:
    """The same as `read_fit`, and of a recommendation without a measurement its first candidate, or the one called
    `name`. Raises NoAnswer where it recommends none."""
    document = read_typed(path, FIT)
    if document.ranking or not isinstance(document, SavedRecommendation) or document.candidates is None:
        return _fitted(document, str(path), name)
    if not document.candidates:
        raise NoAnswer(f"{path}: recommends no model")
    named = {each.model: place for place, each in reversed(list(enumerate(document.candidates)))}
    wanted = name or document.candidates[0].model
    if wanted not in named:
        raise choices("candidate", wanted, named)
    where = f"{path}: candidates[{named[wanted]}]"
    model = _model(wanted, where)
    return Surface.of_colours(model, _values(model, document.candidates[named[wanted]].start, 3, f"{where}.start"))


def surface_in(data: bytes, name: str) -> Surface:
    """The recommended row of a fit's JSON that is at hand. Raises InputError where it is damaged."""
    return _fitted(parsed(data, Schema({"brdfguide/fit/1": FitDocument}, FIT.wanted), name), name, None)


def _fitted(document: FitDocument | SavedRecommendation, name: str, wanted: str | None) -> Surface:
    """A row of its ranking, all of whose parts agree. Raises InputError with the place of one that does not."""
    if not document.data.channels:
        raise InputError(f"{name}: data.channels: found none; wanted at least one")
    if not document.ranking:
        raise InputError(f"{name}: ranking: found none; wanted {FIT.wanted}")
    rows = {row.candidate: place for place, row in enumerate(document.ranking)}
    rows.update({row.model: place for place, row in reversed(list(enumerate(document.ranking)))})
    if wanted is None and document.recommended not in rows:
        raise InputError(f"{name}: recommended: found '{short(document.recommended)}'; wanted a row of the ranking")
    wanted = wanted or document.recommended
    if wanted not in rows:
        raise choices("fitted model", str(wanted), rows)
    where, row = f"{name}: ranking[{rows[wanted]}]", document.ranking[rows[wanted]]
    model, channels = _model(row.model, where), document.data.channels
    given = {key: entry.value for key, entry in row.parameters.items() if entry and key in model.parameters}
    values = _values(model, given, len(channels), f"{where}.parameters")
    if unknown := set(row.freed) - model.parameters.keys():
        raise InputError(f"{where}.freed: found {unknown.pop()}, which is no parameter of {model.name}")
    return Surface(replace(model, free=row.freed), values, channels, _wavelength(document.data, name))


def _model(expression: str, where: str) -> models.Composite:
    try:
        return models.get(expression)
    except InputError as error:
        raise InputError(f"{where}.model: {error}") from None


def _values(model: models.Composite, given: Mapping, channels: int, where: str) -> dict:
    """Values of a model, one or one a channel, within its bounds and in its units."""
    values = {}
    for key, value in given.items():
        if key not in model.parameters:
            raise InputError(f"{where}: {short(key)} is no parameter of {model.name}")
        numbers = np.array(value, float)
        if np.isnan(numbers).any():
            raise InputError(f"{where}.{key}.value: found null; wanted a number or a list of numbers")
        if numbers.ndim and len(numbers) not in (1, channels):
            raise InputError(f"{where}.{key}: found {len(numbers)} values; wanted one, or {channels} for the channels")
        try:
            values[key] = model.parameters[key].inside(numbers if numbers.ndim else float(numbers))
        except InputError as error:
            raise InputError(f"{where}.{key}: {error}") from None
    return values


def _wavelength(data: SavedData, name: str) -> np.ndarray:
    """[µm], one or one for each channel."""
    nm = np.array(data.wavelength_nm, float)
    if len(nm) not in (1, len(data.channels)):
        wanted = f"one, or {len(data.channels)} for the channels"
        raise InputError(f"{name}: data.wavelength_nm: found {len(nm)} wavelengths; wanted {wanted}")
    if not np.all((nm >= SHORTEST_NM) & (nm <= LONGEST_NM)):
        outside = nm[~((nm >= SHORTEST_NM) & (nm <= LONGEST_NM))][0]
        raise InputError(f"{name}: data.wavelength_nm: found {outside:g}; wanted 100 to 100000 nm")
    return nm * 1e-3
