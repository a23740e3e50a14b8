"""What `export` reads: a fit's JSON, a material, or a model with parameters on the command line."""

from math import radians
from pathlib import Path

from ..errors import InputError, choices


def read_surface(words: list[str], model: str | None, channel: str | None, name: str, command: str):
    """The exporters.Surface that the words and options mean. Raises InputError."""
    from .. import exporters

    inputs = [word for word in words if "=" not in word]
    given = [word for word in words if "=" in word]
    if len(inputs) > 1:
        raise InputError(f"one input at a time, found {' and '.join(inputs)}")
    if inputs:
        if given:
            raise InputError(f"{inputs[0]} has its parameters already; {given[0]} needs --model instead of an input")
        return exporters.surface_of(_saved(inputs[0], model), name, command, channel)
    if model is None:
        raise InputError("what to export: a fit's JSON, a material's YAML, or --model with NAME=VALUE parameters")
    return exporters.surface_of(_typed(model, given), name, command, channel)


def named_surface(words: str):
    """The exporters.Surface of one shell word: FIT.json, FIT.json#MODEL, a material, or a model with NAME=VALUE parameters."""
    from .. import catalog, exporters, shelf

    first, *given = words.split() or [""]
    file, _, row = first.partition("#")
    if Path(file).suffix.lower() == ".json":
        found = _saved(file, row or None)
        return exporters.surface_of(found, row or found.model.name)
    term = first.split("+")[0].partition(":")[0].replace("_", "-")
    described = Path(first).suffix.lower() in (".yaml", ".yml") or (first in shelf.names() and term not in catalog.names("models"))
    if described:
        return exporters.surface_of(_recommended(first), Path(first).stem)
    return exporters.surface_of(_typed(first, given), first)


def _recommended(name: str):
    """The first candidate for a material, at its start values. Raises NoAnswer outside the domain."""
    import numpy as np

    from .. import material, recommend, shelf
    from ..errors import NoAnswer
    from ..saved import Saved

    answer = recommend.recommend(material.read_material(name if Path(name).suffix else shelf.path(name)))
    if not answer.candidates:
        raise NoAnswer(f"{name}: no candidate; `brdfguide recommend {name}` says why")
    best = answer.candidates[0]
    values = {key: np.array(value) if isinstance(value, tuple) else value for key, value in best.start.items()}
    colours = max((np.size(value) for value in values.values()), default=1)
    channels, um = (("R", "G", "B"), [0.61, 0.55, 0.46]) if colours == 3 else (("550 nm",), [0.55])
    return Saved(best.model, {**best.model.defaults(), **values}, channels, np.array(um), {})


def _saved(path: str, model: str | None):
    from .. import saved

    if Path(path).suffix.lower() in (".yaml", ".yml"):
        raise InputError(f"{path}: recommend it first: brdfguide recommend {path} --json > fit.json")
    return saved.read_fit(path, model)


def _typed(model: str, given: list[str]):
    """A model and its parameters from words such as ggx.alpha=0.2 or lambertian.albedo=0.1,0.2,0.3; angles in degrees."""
    import numpy as np

    from .. import models
    from ..saved import Saved

    sum_ = models.get(model)
    values = dict(sum_.defaults())
    colours = 1
    for word in given:
        key, _, text = word.partition("=")
        if key not in sum_.parameters:
            raise choices(f"parameter of {sum_.name}", key, list(sum_.parameters))
        try:
            numbers = [float(part) for part in text.split(",")]
        except ValueError:
            raise InputError(f"{word}: wanted one number, or three with commas for red, green and blue") from None
        if len(numbers) not in (1, 3):
            raise InputError(f"{word}: {len(numbers)} numbers; wanted one, or three for red, green and blue")
        if sum_.parameters[key].unit == "rad":
            numbers = [radians(number) for number in numbers]
        colours = max(colours, len(numbers))
        values[key] = np.array(numbers) if len(numbers) == 3 else numbers[0]
    if colours == 3:
        return Saved(sum_, values, ("R", "G", "B"), np.array([0.61, 0.55, 0.46]), {})
    return Saved(sum_, values, ("550 nm",), np.array([0.55]), {})
