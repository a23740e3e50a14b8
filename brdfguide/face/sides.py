"""What is compared: words for a surface, a table or measured directions, a Surface, a Measurement, an answer."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..data.measurement import Measurement
from ..errors import InputError, NoAnswer
from ..opening import Held, exists, held
from .surfaces import named_surface, surface_from

if TYPE_CHECKING:
    from ..fitting.side_by_side import OneOfTwo


def compared_side(given: Any, anyway: bool = False) -> "OneOfTwo":
    """What is meant by words such as a model with parameters, FIT.json, FIT.json#MODEL, a material or a data
    file; by a Measurement as it is, a Surface, or an answer that has one.

    A file of measured directions is read as for a fit, with `anyway` also outside the guide and against contradictions;
    a table that turns with the sample is then averaged.
    """
    from ..fitting import side_by_side

    if isinstance(given, str):
        return _named_side(given, anyway)
    if isinstance(given, Measurement):
        return side_by_side.of_measurement(given, given.name or "measurement")
    found = surface_from(given)
    return side_by_side.of_surface(found, found.model.name)


def _named_side(words: str, anyway: bool) -> "OneOfTwo":
    from ..data import formats
    from ..fitting import side_by_side
    from ..fitting.job import Job, read_for_fit

    first = (words.split() or [""])[0]
    path = Path(words if exists(words) else first)
    if not is_data(path, first):
        surface = named_surface(words)
        return side_by_side.of_surface(surface, words, _solid_angle(first))
    if len(words.split()) > 1 and not exists(words):
        raise InputError(f"{words}: a data file stands alone, without parameters")
    source = held(path)
    format, _ = formats.opened(source)
    if format.function is not None:
        function, channels = _table(source, anyway)
        return side_by_side.of_function(function, channels, path.name)
    return side_by_side.of_measurement(read_for_fit(source, Job(anyway=anyway)), path.name)


def _table(path: Path | Held, anyway: bool):
    """A table as a function of directions; one that turns with the sample is averaged only `anyway`."""
    from ..data import formats

    try:
        return formats.function(path)
    except InputError:
        if not anyway:
            raise
        return formats.function(path, average_phi_i=True)


def exported(words: str, target: str) -> "list[OneOfTwo]":
    """A surface, and what its file for a target will show.

    Raises NoAnswer where the target cannot express it, and for a mirror alone, which a file holds as a reflectance.
    """
    from .. import exporters
    from ..fitting import side_by_side

    surface = named_surface(words)
    statement = exporters.export(target, surface).statement
    shown = statement.shown
    if shown is None:
        raise NoAnswer(f"{words}: {statement.sentence()}; a mirror is written as its reflectance, which has no S")
    other = side_by_side.of_function(shown, ("R", "G", "B"), f"what {statement.target} shows ({statement.status})")
    return [side_by_side.of_surface(surface, words), other]


def is_data(path: Path, first: str) -> bool:
    """Whether a word names a file of values: not a fit's JSON, not a material's description."""
    from ..data import formats

    if formats.is_described(path):
        return True
    suffix = Path(first.partition("#")[0]).suffix.lower()
    if suffix in (".json", ".yaml", ".yml"):
        return False
    return "/" in first or "." in first or exists(path)


def _solid_angle(first: str) -> float | None:
    """Of the detector that a fit was made through."""
    from ..fitting import saved

    file = first.partition("#")[0]
    return saved.saved_solid_angle(file) if file.lower().endswith(".json") else None
