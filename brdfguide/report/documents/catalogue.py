"""What there is, as documents: one law with its parameters, the keys of a description."""

import sys
from dataclasses import replace
from textwrap import dedent

from ...models import coat


def description(model) -> str:
    """The docstring of a model's file: the law in words, its source, what it is good and bad for; a coat's before that
    of the law under it."""
    own = dedent(sys.modules[model.module].__doc__ or "").strip()
    return f"{dedent(coat.__doc__ or '').strip()}\n\n{own}" if model.base else own


def model_entry(model) -> dict:
    """One model as a document."""
    return {
        "name": model.name,
        "law": description(model),
        "summary": model.summary,
        "source": model.source,
        "family": model.family,
        "cannot": model.cannot,
        "tried_by_default": model.candidacy is not None,
        "formula_for_shaders": model.formula is not None,
        "roles": list(model.roles),
        "parameters": [
            {
                "name": p.name,
                "unit": p.outside_unit,
                "default": p.outside(p.default),
                "low": p.outside(p.low),
                "high": p.outside(p.high),
                "per_channel": p.per_channel,
                "meaning": p.meaning,
            }
            for p in model.parameters
        ],
        "derived": [{"name": d.name, "unit": d.unit, "meaning": d.meaning} for d in model.derived],
        "breaks": dict(model.breaks),
    }


def inner(field) -> tuple:
    """The fields of a group, named with a dot; none for `sources`, whose keys are those of the file."""
    return (
        ()
        if field.name == "sources"
        else tuple(replace(each, name=f"{field.name}.{each.name}") for each in field.fields)
    )


def takes(field) -> str:
    """What a field of a YAML file may hold, in short."""
    if field.kind == "word":
        return " | ".join(field.choices)
    if field.kind in ("group", "groups", "flag", "text", "texts"):
        return {"group": "", "groups": "list", "flag": "true | false", "text": "text", "texts": "text, or a list"}[
            field.kind
        ]
    low = field.above if field.above is not None else field.low
    bounds = f" {low:g}..{field.high:g}" if low is not None and field.high is not None else ""
    count = "number" if field.kind == "number" else "1 or 3 numbers"
    return (
        count + bounds + (f" {field.unit}" if field.unit else "") + "".join(f" | {choice}" for choice in field.choices)
    )
