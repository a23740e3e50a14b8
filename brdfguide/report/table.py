"""Results as text: plain aligned columns that a script can cut and a person can read."""

import sys
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
            {"name": p.name, "unit": p.unit, "default": p.default, "low": p.low, "high": p.high,
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
