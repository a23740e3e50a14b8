"""A surface from whatever names one: words, a fit's JSON, a described material, an answer.

Imports stand inside of functions: who names a model needs neither materials nor YAML.
"""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from .. import catalog
from ..errors import InputError, NoAnswer, nearest_words
from ..models.surface import Surface
from ..printable import short

if TYPE_CHECKING:
    from ..advice.recommend import Recommendation
    from ..exporters.exporter import ColouredSurface


def surface_from(given: Any, values: Mapping[str, Any] | None = None) -> Surface:
    """The Surface that is meant by one, by an answer that has one as its `surface`, or by words.

    Takes  words such as "lambertian+ggx ggx.alpha=0.1", "fit.json", "fit.json#ggx", "porcelain", "my_paint.yaml";
    `values` take the place of what is there, angles in degrees.    Raises InputError for what is no surface and for a
    value where the law does not hold; NoAnswer for a material outside the guide's domain.
    """
    if isinstance(given, (str, PathLike)):
        return named_surface(str(given), values or {})
    found = getattr(given, "surface", given)
    if not isinstance(found, Surface):
        raise InputError(f"wanted a Surface, an answer that has one, or words for one; found {type(given).__name__}")
    return found.with_values(values) if values else found


def named_surface(words: str, values: Mapping[str, Any] = MappingProxyType({})) -> "ColouredSurface":
    """The surface of one shell word: FIT.json, FIT.json#MODEL, a material, MATERIAL#MODEL, a model with NAME=VALUE
    words; with `values` in place of what is there."""
    from .. import exporters
    from ..fitting import saved

    first, *given = words.split() or [""]
    file, _, row = first.partition("#")
    if Path(file).suffix.lower() == ".json":
        found = saved.read_surface(file, row or None).with_values(values)
        return exporters.coloured(found, row or found.model.name)
    if is_material(file):
        name = f"{Path(file).stem} {row}".rstrip()
        return exporters.coloured(described(file, row or None).with_values(values), name)
    if not given and not values:
        _check_name(first)
    return exporters.coloured(typed_out(first, given, values), first)


def _check_name(word: str) -> None:
    """Raises InputError for a word that is neither a model nor a material, with the nearest of both."""
    from ..advice import library

    models, materials = catalog.names("models"), library.library_names()
    if word.split("+")[0].partition(":")[0].replace("_", "-") in models or "+" in word or " " in word:
        return
    near = nearest_words(word.lower(), [*materials, *models], 3, 0.6)
    hint = (
        f"; did you mean {' or '.join(near)}?" if near else "; `brdfguide models` and `brdfguide materials` list them"
    )
    raise InputError(f"no model or material called '{short(word)}'{hint}")


def described(text: str, model: str | None = None) -> Surface:
    """The first candidate, or the one called `model`, for a material by name or YAML."""
    from ..advice import library, material
    from ..advice import recommend as advisor

    path = text if text == "-" or text.endswith((".yaml", ".yml")) else library.path(text)
    return of_recommendation(advisor.recommend(material.read_material(path), names=[model] if model else None))


def every_described(text: str) -> list[Surface]:
    """All candidates for a material by name or YAML, best first. Raises NoAnswer where there is none."""
    from ..advice import library, material
    from ..advice import recommend as advisor

    path = text if text == "-" or text.endswith((".yaml", ".yml")) else library.path(text)
    return every_candidate(advisor.recommend(material.read_material(path)))


def every_candidate(found: "Recommendation") -> list[Surface]:
    """All candidates, best first. Raises NoAnswer where there is none."""
    of_recommendation(found)
    return [each.surface for each in found.candidates]


def is_material(word: str) -> bool:
    """Whether a word is a material, by name or YAML, and not a model."""
    from ..advice import library

    term = word.split("+")[0].partition(":")[0].replace("_", "-")
    if Path(word).suffix.lower() in (".yaml", ".yml"):
        return True
    return word in library.library_names() and term not in catalog.names("models")


def of_recommendation(found: "Recommendation") -> Surface:
    """The first candidate. Raises NoAnswer where there is none."""
    if not found.candidates:
        raise NoAnswer(
            f"{found.material.name or 'this surface'} is outside the guide's domain: {found.reasons[0].says}"
        )
    return found.candidates[0].surface


def typed_out(model: str, given: list[str], more: Mapping[str, Any] = MappingProxyType({})) -> Surface:
    """A model and its parameters from words: ggx.alpha=0.2, lambertian.albedo=0.1,0.2,0.3; angles in degrees."""
    return Surface.named(model, {**numbers_from(given), **more})


def numbers_from(words: list[str]) -> dict[str, list[float]]:
    """NAME=VALUE words, one number or three with commas for a colour."""
    values = {}
    for word in words:
        key, _, text = word.partition("=")
        try:
            values[key] = [float(part) for part in text.split(",")]
        except ValueError:
            raise InputError(f"{word}: wanted one number, or three with commas for red, green and blue") from None
    return values
