"""The formulas written out for a language, and a surface as one expression for each colour."""

import re
from math import pi

import numpy as np

from ..models import Model, every
from ..models.facts import Formula
from ._formulas import FORMULAS, SERIES
from .exporter import ColouredSurface, Refused, number

CALL = re.compile(r"\b([a-z_][a-z0-9_]*)\(")
BUILT_IN = {"exp", "log", "sqrt", "acos", "floor", "ceil"}
PREFIX = "bg_"


def require_formulas(target: str, surface: ColouredSurface, nearest: str) -> None:
    """Refuses a law that states no formula, for a target that writes laws out."""
    for term in surface.model.terms:
        if not _written_out(term.model):
            others = ", ".join(model.name for model in every() if _written_out(model))
            why = f"{term.model.name} states no formula for shaders, as these laws do: {others}"
            raise Refused(target, why, nearest)


def _written_out(model: Model) -> bool:
    """Whether its formula holds all of it."""
    return model.formula is not None and bool(model.formula.mirror) == (model.mirror is not None)


def _formula(model: Model) -> Formula:
    if model.formula is None:
        raise ValueError(f"{model.name} has no formula, and `require_formulas` was not asked")
    return model.formula


def needed(surface: ColouredSurface, expressions: list[str]) -> list[tuple[str, str, str]]:
    """The functions that some expressions of a surface call, directly or not, in an order that defines before use."""
    functions = dict.fromkeys(each for term in surface.model.terms for each in _formula(term.model).functions)
    everything = (*FORMULAS, *SERIES, *functions)
    texts = {name: text for name, _, text in everything}
    wanted, fresh = set(), set(CALL.findall(" ".join(expressions)))
    while fresh:
        wanted |= fresh
        fresh = {call for name in fresh for call in CALL.findall(texts.get(name, ""))} - wanted
    return [each for each in everything if each[0] in wanted]


def prefixed(text: str) -> str:
    """Calls of our own functions under a prefix that no renderer uses."""
    named = CALL.sub(lambda call: call[0] if call[1] in BUILT_IN else f"{PREFIX}{call[1]}(", text)
    return re.sub(r"\bPI\b", f"{pi:.9g}", named)


def literal(value) -> str:
    """A number as every one of the languages reads it: with a point or an exponent."""
    text = f"{number(np.ravel(value)[0], -1e30, 1e30, 'parameter'):.9g}"
    return text if set(text) & set(".e") else text + ".0"


def colour_expressions(surface: ColouredSurface) -> list[str]:
    """One expression in ci, cr, q, p for each of red, green and blue; one alone for a grey surface."""
    return _combined(surface, _finite)


def mirror_colours(surface: ColouredSurface) -> list[str]:
    """The same for the reflectance of the ideal mirror, in ci."""
    return _combined(surface, _mirror)


def _combined(surface: ColouredSurface, term_text) -> list[str]:
    if len(surface.channels) == 1:
        return [_sum(surface, 0, term_text)]
    texts = [_sum(surface, channel, term_text) for channel in range(len(surface.channels))]
    if len(set(texts)) == 1:
        return texts[:1]
    if not surface.colour.mixes:
        return [texts[int(np.argmax(row))] for row in surface.colour.matrix]
    rows = surface.colour.matrix
    return [
        "most(0.0, "
        + " + ".join(
            f"{literal(weight)} * ({text})" for weight, text in zip(row, texts, strict=True) if abs(weight) > 1e-6
        )
        + ")"
        for row in rows
    ]


def _sum(surface: ColouredSurface, channel: int, term_text) -> str:
    one = surface.channel(channel)
    texts = (term_text(term.model, one.values_of(term), float(one.wavelengths[0])) for term in one.model.terms)
    return " + ".join(filter(None, texts)) or "0.0"


def _finite(model: Model, values: dict, wavelength: float) -> str:
    """One term's BRDF with its numbers."""
    return _filled(_formula(model), _formula(model).brdf, values, wavelength)


def _mirror(model: Model, values: dict, wavelength: float) -> str:
    """The reflectance of its mirror part."""
    return _filled(_formula(model), _formula(model).mirror, values, wavelength)


def _filled(formula: Formula, text: str, values: dict, wavelength: float) -> str:
    more = formula.numbers(wavelength=wavelength, **values) if formula.numbers else {}
    return text.format(**{name: literal(value) for name, value in {**values, **more}.items()})
