"""What `export` reads: a fit's or a recommendation's JSON, a described material, or a model with parameters typed out."""

import json
from math import radians
from pathlib import Path
from typing import Annotated

from typer import Option

from ..errors import BrdfguideError, InputError, NoAnswer, choices


def _checked_specs(specs: list[str] | None) -> list[str] | None:
    """The same, before any work is done. Raises InputError for an unknown target, a missing folder, and a file named twice."""
    if specs:
        from .. import exporters
        from ..outputs import writable

        files = [exporters.parse_spec(spec)[1] for spec in specs]
        for place, path in enumerate(files):
            if path in files[:place]:
                raise InputError(f"--export names {path} twice")
            writable(path)
    return specs


def _checked_error(most: float | None) -> float | None:
    if most is not None and not most >= 0:
        raise InputError(f"--max-export-error {most:g}: wanted an rms ln of 0 or more")
    return most


ExportOption = Annotated[
    list[str] | None, Option("--export", help="TARGET:FILE, such as mitsuba:paint.xml, of the recommended model; repeatable.", callback=_checked_specs)
]
MaxErrorOption = Annotated[float | None, Option("--max-export-error", help="Write nothing whose rms ln exceeds this.", callback=_checked_error)]


def export_all(specs, model, values, channels, wavelength, geom, name, most, quiet) -> BrdfguideError | None:
    """Every `--export`; gives the error that stopped it, to be raised once the answer itself is printed.

    Files that the user named are replaced, as pictures are.
    """
    from .. import exporters
    from ..outputs import write_whole
    from ._options import command_line, note

    try:
        for spec in specs or ():
            statement = exporters.export_to(spec, model, values, channels, wavelength, geom, name=name, command=command_line(), most=most, write=write_whole)
            for line in (statement.sentence(), *statement.notes):
                note(line, quiet)
    except BrdfguideError as error:
        return error
    return None


def read_surface(words: list[str], model: str | None, channel: str | None, name: str, command: str):
    """The exporters.Surface that the words and options mean. Raises InputError; NoAnswer for a material outside the guide's domain."""
    from .. import exporters

    inputs = [word for word in words if "=" not in word]
    given = [word for word in words if "=" in word]
    if len(inputs) > 1:
        raise InputError(f"one input at a time, found {' and '.join(inputs)}")
    if inputs:
        if given:
            raise InputError(f"{inputs[0]} has its parameters already; {given[0]} needs --model instead of an input")
        saved = _from_json(inputs[0], model) if inputs[0].endswith(".json") else described(inputs[0], model)
        return exporters.surface_of(saved, name, command, channel)
    if model is None:
        raise InputError("what to export: a fit's JSON, a material's name or YAML, or --model with NAME=VALUE parameters")
    return exporters.surface_of(_typed(model, given), name, command, channel)


def named_surface(words: str):
    """The exporters.Surface of one shell word: FIT.json, FIT.json#MODEL, a material, or a model with NAME=VALUE parameters."""
    from .. import catalog, exporters, shelf

    first, *given = words.split() or [""]
    file, _, row = first.partition("#")
    if Path(file).suffix.lower() == ".json":
        found = _from_json(file, row or None)
        return exporters.surface_of(found, row or found.model.name)
    term = first.split("+")[0].partition(":")[0].replace("_", "-")
    is_material = Path(first).suffix.lower() in (".yaml", ".yml") or (first in shelf.names() and term not in catalog.names("models"))
    if is_material:
        return exporters.surface_of(described(first), Path(first).stem)
    return exporters.surface_of(_typed(first, given), first)


def described(text: str, model: str | None = None):
    """The first candidate, or the one called `model`, for a material by name or YAML, as a Saved."""
    from .. import material, shelf
    from .. import recommend as advisor

    path = text if text == "-" or text.endswith((".yaml", ".yml")) else shelf.path(text)
    return of_recommendation(advisor.recommend(material.read_material(path), names=[model] if model else None))


def of_recommendation(found):
    """The first candidate of a Recommendation as a Saved. Raises NoAnswer where there is none."""
    if not found.candidates:
        raise NoAnswer(f"{found.material.name or 'this surface'} is outside the guide's domain: {found.reasons[0].says}")
    pick = found.candidates[0]
    return _saved(pick.model, dict(pick.start))


def _saved(sum_, values: dict):
    """Values, some of them three colours, as a Saved: grey, or red, green and blue."""
    import numpy as np

    from ..saved import Saved
    from ..substances import RGB_UM

    counts = {len(value) for value in values.values() if isinstance(value, (list, tuple, np.ndarray)) and len(value) > 1}
    if counts - {3}:
        raise InputError(f"a parameter has {max(counts)} values; wanted one, or three for red, green and blue")
    values = {key: np.array(value, float) if isinstance(value, (list, tuple)) and len(value) > 1 else float(np.ravel(value)[0]) for key, value in values.items()}
    if counts:
        return Saved(sum_, values, ("R", "G", "B"), np.array(RGB_UM), {})
    return Saved(sum_, values, ("550 nm",), np.array([0.55]), {})


def _from_json(path: str, model: str | None):
    """A fit's JSON, or a recommendation's without a fit."""
    from .. import models, saved

    try:
        document = json.loads(Path(path).read_text())
    except (OSError, ValueError):
        document = None  # read_fit says what is wrong with it
    if not isinstance(document, dict) or "candidates" not in document or document.get("ranking"):
        return saved.read_fit(path, model)
    if not document["candidates"]:
        raise NoAnswer(f"{path}: recommends no model")
    named = {each["model"]: each["start"] for each in document["candidates"]}
    wanted = model or document["candidates"][0]["model"]
    if wanted not in named:
        raise choices("candidate", wanted, named)
    sum_ = models.get(wanted)
    turned = {key: _inside(value, sum_.parameters[key].unit) for key, value in named[wanted].items() if key in sum_.parameters}
    return _saved(sum_, turned)


def _inside(value, unit: str):
    """Radians for an angle, otherwise the same."""
    if unit != "rad":
        return value
    return [radians(each) for each in value] if isinstance(value, list) else radians(value)


def _typed(model: str, given: list[str]):
    """A model and its parameters from words such as ggx.alpha=0.2 or lambertian.albedo=0.1,0.2,0.3; angles in degrees."""
    from .. import models

    sum_ = models.get(model)
    values = dict(sum_.defaults())
    for word in given:
        key, _, text = word.partition("=")
        if key not in sum_.parameters:
            raise choices(f"parameter of {sum_.name}", key, list(sum_.parameters))
        try:
            numbers = [float(part) for part in text.split(",")]
        except ValueError:
            raise InputError(f"{word}: wanted one number, or three with commas for red, green and blue") from None
        values[key] = _inside(numbers, sum_.parameters[key].unit)
    return _saved(sum_, values)
