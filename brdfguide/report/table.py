"""Results as text: plain aligned columns that a script can cut and a person can read."""

import sys
from dataclasses import replace
from textwrap import dedent


def columns(header: tuple[str, ...], lines, right: tuple[int, ...] = ()) -> str:
    """Aligned columns, never folded or cut; those numbered in `right` are set flush right."""
    cells = [tuple(str(cell) for cell in line) for line in (header, *lines)]
    widths = [max(len(line[place]) for line in cells) for place in range(len(header))]
    set_cell = lambda place, text: text.rjust(widths[place]) if place in right else text.ljust(widths[place])  # noqa: E731
    return "\n".join("  ".join(set_cell(place, text) for place, text in enumerate(line)).rstrip() for line in cells)


def law(model) -> str:
    """The docstring of a model's file: the law in words, its source, what it is good and bad for."""
    return dedent(sys.modules[model.module].__doc__ or "").strip()


def model_entry(model) -> dict:
    """One model as a document."""
    return {
        "name": model.name,
        "law": law(model),
        "summary": model.summary,
        "source": model.source,
        "roles": list(model.roles),
        "parameters": [
            {"name": p.name, "unit": p.outside_unit, "default": p.outside(p.default), "low": p.outside(p.low), "high": p.outside(p.high),
             "per_channel": p.per_channel, "meaning": p.meaning}
            for p in model.parameters
        ],
        "derived": [{"name": d.name, "unit": d.unit, "meaning": d.meaning} for d in model.derived],
        "breaks": dict(model.breaks),
    }  # fmt: skip


def model_text(model) -> str:
    """One model for people: the law, then its parameters with units and bounds."""
    entry = model_entry(model)
    table = columns(
        ("parameter", "default", "from", "to", "unit", "meaning"),
        [(p["name"], f"{p['default']:g}", f"{p['low']:g}", f"{p['high']:g}", p["unit"], p["meaning"]) for p in entry["parameters"]],
        right=(1, 2, 3),
    )
    broken = "".join(f"\nbreaks {name}: {why}" for name, why in entry["breaks"].items())
    return f"{entry['law']}\n\n{table}{broken}"


def inner(field) -> tuple:
    """The fields of a group, named with a dot; none for `sources`, whose keys are those of the file."""
    return () if field.name == "sources" else tuple(replace(each, name=f"{field.name}.{each.name}") for each in field.fields)


def takes(field) -> str:
    """What a field of a YAML file may hold, in short."""
    if field.kind == "word":
        return " | ".join(field.choices)
    if field.kind in ("group", "groups", "flag", "text", "texts"):
        return {"group": "", "groups": "list", "flag": "true | false", "text": "text", "texts": "text, or a list"}[field.kind]
    low = field.above if field.above is not None else field.low
    bounds = f" {low:g}..{field.high:g}" if low is not None and field.high is not None else ""
    count = "number" if field.kind == "number" else "1 or 3 numbers"
    return count + bounds + (f" {field.unit}" if field.unit else "") + "".join(f" | {choice}" for choice in field.choices)
