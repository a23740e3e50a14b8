"""What there is, in words."""

from .folding import folded, screen_width
from .table import columns

LEAST_FOR_ALL = 120  # columns of a screen below which what a material is stands in one


def models_text(document: dict) -> str:
    """Every law, a line each."""
    return columns(("model", "what for"), [(each["name"], each["summary"]) for each in document["models"]])


def materials_text(rows: list[tuple[str, str, str, str, str]]) -> str:
    """Name, kind or substance, appearance, finish and what it is of every material; on a narrow screen what it is with
    the other three behind."""
    if (screen_width() or LEAST_FOR_ALL) >= LEAST_FOR_ALL:
        return columns(("material", "kind or substance", "appearance", "finish", "about"), rows)
    told = [(name, f"{about} ({', '.join(filter(None, more))})") for name, *more, about in rows]
    return columns(("material", "about (kind or substance, appearance, finish)"), told)


def model_text(entry: dict) -> str:
    """One model for people: the law, then its parameters with units and bounds."""
    table = columns(
        ("parameter", "default", "from", "to", "unit", "meaning"),
        [
            (p["name"], f"{p['default']:g}", f"{p['low']:g}", f"{p['high']:g}", p["unit"], p["meaning"])
            for p in entry["parameters"]
        ],
        right=(1, 2, 3),
    )
    broken = "".join(f"\nbreaks {name}: {why}" for name, why in entry["breaks"].items())
    cannot = f"\ncannot: {entry['cannot']}" if entry["cannot"] else ""
    tried = "tried by `fit` by default" if entry["tried_by_default"] else f"tried where it is named: -m {entry['name']}"
    shaders = "" if entry["formula_for_shaders"] else "\nstates no formula for shaders: export it as a table or a refit"
    return f"{_reflowed(entry['law'])}\n\n{table}{broken}{cannot}\n{tried}{shaders}"


def _reflowed(law: str) -> str:
    """Prose in lines that fit the screen; formulas, which are indented, as they are."""
    blocks = law.split("\n\n")
    return "\n\n".join(each if each.startswith(" ") else folded(" ".join(each.split("\n"))) for each in blocks)
