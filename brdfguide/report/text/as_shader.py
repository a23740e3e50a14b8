"""What one shader can do for a measurement, in words."""

from math import expm1

from ...printable import off_words


def as_shader_text(block: dict) -> str:
    """The shader's numbers and its error against the measurement, with the best law's beside it."""
    best = block["best_law"]
    lines = [
        f"as {block['target']}: {block['candidate']}, typically {off_words(block['off_percent'])} off the measurement "
        f"(rms ln {block['rms_ln']:.2g}); the best law, {best['candidate']}, {off_words(best['off_percent'])} "
        f"(rms ln {best['rms_ln']:.2g})"
    ]
    fitted = [(key, each["value"]) for key, each in block["parameters"].items() if each["fitted"]]
    lines.append("  " + "  ".join(f"{key.rpartition('.')[2]} {_value(value)}" for key, value in fitted))
    for each in block["readings"]:
        off = off_words(each["off_percent"])
        lines.append(f"  as MaterialX's nodes evaluate it; with {each['with']}, as other programs have it, {off} off")
    others = [f"{each['candidate']} {off_words(each['off_percent'])}" for each in block["settings"][1:]]
    lines += [f"  its other settings: {', '.join(others)} off"] if others else []
    for each in block["cannot_follow"]:
        lines.append(f"  {'cannot follow' if each['code'] == 'discrepancy' else 'doubt'}: {each['text']}")
    return "\n".join(lines)


def described_as_text(block: dict) -> str:
    """The shader's numbers for a described surface and their error against the law that they stand for."""
    off = 100 * expm1(min(block["rms_ln"], 50.0))
    lines = [
        f"as {block['target']}: of {block['model']}, typically {off_words(off)} off (rms ln {block['rms_ln']:.2g})"
    ]
    shown = [(name, value) for name, value in block["written"].items() if value or "metal" in name]
    lines.append("  " + "  ".join(f"{name} {_value(value)}" for name, value in shown))
    lines += [f"  cannot: {each}" for each in block["lost"]] + [f"  {each}" for each in block["notes"]]
    return "\n".join(lines)


def _value(value) -> str:
    return ",".join(f"{each:.3g}" for each in value) if isinstance(value, list) else f"{value:.3g}"
