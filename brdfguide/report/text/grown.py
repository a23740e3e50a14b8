"""How candidates grew, step by step: what the best so far left, what was tried, what was taken and why."""

from math import expm1
from textwrap import fill

from .values import percent_words


def grown_text(steps: list[dict]) -> str:
    """A paragraph for each step; errors in percent, on few directions and at angles left out."""
    if not steps:
        return "nothing grew: no candidate that can, or one incidence angle only"
    lines = ["how candidates grew, typical errors on few directions (at angles left out):"]
    for step in steps:
        lines += _paragraph(f"{_errors(step['of'], step)}{': ' * bool(step['shown'])}{step['shown']}", "  ")
        for each in step["tried"]:
            mark = " <- taken" if each["candidate"] == step["taken"] else ""
            lines += _paragraph(f"{each['adds']}: {_errors(each['candidate'], each)}{mark}", "    ")
        lines += _paragraph(f"{'taken' if step['taken'] else 'it ends here'}: {step['because']}", "    ")
    return "\n".join(lines)


def _errors(name: str, entry: dict) -> str:
    held = entry["held_out_rms_ln"]
    return f"{name} {_off(entry['rms_ln'])}" + ("" if held is None else f" ({_off(held)})")


def _off(rms_ln: float) -> str:
    return f"{percent_words(expm1(rms_ln))} off"


def _paragraph(text: str, margin: str) -> list[str]:
    further = margin + "    "
    return [fill(text, 110, initial_indent=margin, subsequent_indent=further, break_on_hyphens=False)]
