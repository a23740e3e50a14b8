"""Reflectance laws, one term per file; `get("lambertian+ward")` gives their sum."""

from .. import catalog
from ..errors import InputError
from ._base import Model, Sum, Term

SHORT = {"he": "he-torrance"}
MOST_LOBES = 3  # the report's "at most ten coefficients": one diffuse and three lobes of three


def names() -> list[str]:
    """Every term, as typed by users."""
    return catalog.names("models")


def term(name: str) -> Model:
    """One law by its name. Raises InputError with the nearest names."""
    name = name.strip().lower().replace("_", "-")
    return catalog.load("models", SHORT.get(name, name)).MODEL


def get(expression: str) -> Sum:
    """The sum that `lambertian+lafortune:2` names. Raises InputError for an unknown term or lobe count."""
    models: list[Model] = []
    written: list[str] = []
    for word in expression.split("+"):
        name, _, count = word.strip().partition(":")
        if count and not (count.isdecimal() and 1 <= int(count) <= MOST_LOBES):
            raise InputError(f"'{word}': lobes are counted from 1 to {MOST_LOBES}")
        model = term(name)
        models += [model] * int(count or 1)
        written.append(model.name + (f":{count}" if count and count != "1" else ""))
    return Sum("+".join(written), tuple(_labelled(models)))


def _labelled(models: list[Model]):
    """Terms with labels of their own: `lafortune.1`, `lafortune.2` where a law occurs twice."""
    for place, model in enumerate(models):
        if models.count(model) == 1:
            yield Term(model.name, model)
        else:
            yield Term(f"{model.name}.{models[: place + 1].count(model)}", model)
