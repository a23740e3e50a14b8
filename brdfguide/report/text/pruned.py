"""What a scene does not need, in words."""

from .folding import folded, wrapped_text
from .ranking import notes_text
from .table import columns

UNITS = {
    "JND": "just noticeable differences of luminance (JND)",
    "ΔE_ITP": "just noticeable differences of colour (ΔE_ITP)",
}


def text(block: dict, notes: bool = True) -> str:
    """The block for people: what is left, what that costs and saves, where it holds, what was doubtful."""
    paragraphs = [_verdict(block), _parts_table(block), _pareto_table(block), _angular_range(block)]
    if notes:
        paragraphs.append(notes_text("doubts:", block["findings"]))
    return "\n\n".join(paragraph for paragraph in paragraphs if paragraph)


def _verdict(block: dict) -> str:
    out, error, fresh = block["without"], block["error"], block["error_fresh"]
    unit = _short(block)
    lines = [wrapped_text(f"scene: {block['assumptions']}").lstrip()]
    if not out:
        return "\n".join(
            [
                *lines,
                (
                    f"keep all of {block['model']}: nothing that can be left out within the tolerance saves "
                    f"measurable time"
                ),
            ]
        )
    does = (
        f"use {block['pruned']} in place of {block['model']}, without {', '.join(out)}"
        if block["other_law"]
        else f"leave out {', '.join(out)} of {block['model']}"
    )
    lines.append(wrapped_text(does).lstrip())
    lines.append(
        f"  differs by {_jnd(error['mean'])} {unit} on average, {_jnd(error['p95'])} at most for 95 % of the "
        f"picture, {_jnd(error['worst_visible'])} at worst"
    )
    lines.append(
        f"  ({_where(error)})"
        + (
            ""
            if block["quadrature"]["listed"]
            else f"; {_jnd(fresh['worst_visible'])} at worst on directions drawn anew"
        )
    )
    beyond = (
        f"beyond this scene, on a sphere under lamps all around, seen {block['seen']:.1f} L*: {block['seen_words']}"
    )
    lines.append(wrapped_text(beyond))
    time = block.get("time_per_sample_ns")
    if time:
        lines.append(
            f"  {time['whole']:.0f} -> {time['pruned']:.0f} ns per sample ({time['whole'] / time['pruned']:.1f} "
            f"times faster), saving {time['saved']:.0f} ± {time['saved_stderr']:.0f}"
        )
    lines.append(
        f"  operations per sample: {_operations(block['operations']['whole'])} -> "
        f"{_operations(block['operations']['pruned'])}"
    )
    lines.append(
        wrapped_text("with " + " ".join(f"{key}={_word(value)}" for key, value in block["parameters"].items()))
    )
    return "\n".join(lines)


def _parts_table(block: dict) -> str:
    if not block["parts"]:
        return ""
    timed = "time_per_sample_ns" in block
    header = (
        "left out alone",
        "mean",
        "p95",
        "worst",
        "bound",
        "at",
        *(("saves ns",) if timed else ()),
        "",
    )
    lines = []
    for each in block["parts"]:
        error = each["error_alone"]
        line = [
            each["part"],
            f"{error['mean']:.2f}",
            f"{error['p95']:.2f}",
            f"{error['worst_visible']:.2f}",
            _bound(each["bound"]),
            _place(error),
        ]
        line += [_saving(each)] if timed else []
        lines.append([*line, "left out" if each["left_out"] else "kept"])
    key = (
        f"mean, p95, worst: {UNITS[_short(block)]} over the picture, for 95 % of it, and at worst; bound: what a "
        f"closed form says of the worst; at: theta_i, theta_r, phi [deg] of the worst"
    )
    return columns(header, lines, right=(1, 2, 3, 4, 6) if timed else (1, 2, 3, 4)) + "\n" + folded(key, "", "  ")


def _saving(part: dict) -> str:
    if not part["saving_measurable"]:
        return "not measurable"
    return f"{part['saving_ns']:.0f} ± {part['saving_stderr_ns']:.0f}"


def _bound(value) -> str:
    """A closed form's upper bound, where there is one that says something."""
    return "-" if value is None or value > 999 else f"{float(f'{value:.2g}'):g}"


def _pareto_table(block: dict) -> str:
    timed = "time_per_sample_ns" in block
    header = ("worst", "p95", "operations", *(("ns",) if timed else ()), "what")
    lines = [
        [
            f"{each['worst']:.2f}",
            f"{each['p95']:.2f}",
            f"{each['operations']:.0f}",
            *([f"{each['time_per_sample_ns']:.0f}"] if timed else []),
            _label(each) + ("  <- picked" if each["picked"] else ""),
        ]
        for each in block["pareto"]
    ]
    return "cheapest for each error:\n" + columns(header, lines, right=(0, 1, 2, 3) if timed else (0, 1, 2))


def _label(each: dict) -> str:
    if each["other_law"]:
        return f"{each['model']} instead, without {', '.join(each['without'])}"
    return f"without {', '.join(each['without'])}" if each["without"] else "all of it"


def _angular_range(block: dict) -> str:
    angles = ", ".join(f"{name.removesuffix('_deg')} {low:g}..{high:g}" for name, (low, high) in block["box"].items())
    q = block["quadrature"]
    if q["listed"]:
        return wrapped_text(f"holds for the {q['pixels']} directions listed: {angles} degrees").lstrip()
    change = f", doubling them changed the deciding numbers by {_jnd(q['convergence'])} {_short(block)}"
    dark = f", {q['skipped_dark']} too dark to compare" if q["skipped_dark"] else ""
    return wrapped_text(f"holds for {angles} degrees; {q['pixels']} pixels{change}{dark}, seed {q['seed']}").lstrip()


def _jnd(value: float) -> str:
    """Two digits of what might be seen, 0 of what is far from it."""
    return f"{value:.2g}" if value >= 0.005 else "0"


def _where(error: dict) -> str:
    at = error["at"]
    if at["theta_i_deg"] >= 90:
        return f"theta_r {at['theta_r_deg']:.0f}, turned from the light"
    return f"theta_i {at['theta_i_deg']:.0f}, theta_r {at['theta_r_deg']:.0f}, phi {at['phi_deg']:.0f}"


def _place(error: dict) -> str:
    at = error["at"]
    if at["theta_i_deg"] >= 90:
        return f"-, {at['theta_r_deg']:.0f}, -"
    return ", ".join(f"{at[name]:.0f}" for name in ("theta_i_deg", "theta_r_deg", "phi_deg"))


def _operations(counted: dict) -> str:
    return ", ".join(f"{number:.0f} {group}" for group, number in counted.items() if round(number)) or "none"


def _word(value) -> str:
    return ",".join(f"{each:.4g}" for each in value) if isinstance(value, list) else f"{value:.4g}"


def _short(block: dict) -> str:
    return "JND" if block["unit"] == "JND" else "ΔE_ITP"
