"""An albedo by comparison, in words."""

from .table import columns


def chart_text(document: dict) -> str:
    """The neutrals, brightest first, by every data set, and their lightness."""
    sets = [name for name in document["patches"][0] if name not in ("patch", "lightness")]
    rows = [
        (each["patch"], *(f"{each[name]:.4f}" for name in sets), f"{each['lightness']:.1f}")
        for each in document["patches"]
    ]
    return columns(("patch", *sets, "L*"), rows, right=(1, 2, 3))


def text(document: dict) -> str:
    value = document["albedo"]
    lines = [f"albedo {value:.4f}   Y {100 * value:.2f} %   L* {document['lightness']:.1f}   ({document['from']})"]
    lines += [f"       {other:.4f} by {name}" for name, other in (document["other_data_set"] or {}).items()]
    return "\n".join(lines)
