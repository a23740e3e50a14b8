"""A fit's document as text: which model, how sure, what it costs, what was doubtful."""

import sys
from shutil import get_terminal_size
from textwrap import fill, indent

from .table import columns


def ranking_text(document: dict, *, notes: bool = True) -> str:
    """The whole answer in plain text: data, table, recommendation, doubts."""
    parts = [heading(document["data"]) + kind_line(document.get("kind")), table(document["ranking"]), recommendation(document)]
    if notes:
        parts += [paragraph for paragraph in (scales(document), doubts(document), data_notes(document["data"])) if paragraph]
    return "\n\n".join(parts)


def heading(data: dict) -> str:
    low, high = data["theta_i_deg"]
    plane = "in the plane of incidence" if data["in_plane"] else "over the hemisphere"
    channels = f"{len(data['channels'])} channels" if len(data["channels"]) > 1 else f"{data['wavelength_nm'][0]:g} nm"
    missing = f", {data['missing']} of {data['values']} values missing" if data["missing"] else ""
    return f"{data['file']}: {data['samples']} directions {plane}, {channels}, theta_i {low:g}..{high:g} deg{missing}"


def kind_line(kind: dict | None) -> str:
    """Metal or dielectric, where the data decide it."""
    return f"\n{kind['verdict']}: {'; '.join(kind['evidence'])}" if kind and kind["verdict"] in ("metal", "dielectric") else ""


def table(rows: list[dict]) -> str:
    """One line for each candidate; times only where they were taken."""
    timed = "time_per_sample_ns" in rows[0]
    header = ("rank", "model", "rms ln", "held-out", "behind best", "free") + (("ns/sample", "fit s") if timed else ()) + ("flags", "parameters")
    lines = []
    for row in rows:
        line = [rank_of(row, rows), row["candidate"], f"{row['rms_ln']:.4f}", number(row["held_out_rms_ln"], ".4f"), behind(row), row["free_parameters"]]
        line += [f"{row['time_per_sample_ns']:.0f}" + ("*" if row["on_front"] else ""), f"{row['fit_time_s']:.2f}"] if timed else []
        lines.append([*line, ",".join(sorted({flag["code"].partition(":")[0] for flag in row["flags"]})) or "-", parameters_text(row)])
    text = columns(header, lines, right=(2, 3, 5, 6, 7) if timed else (2, 3, 5))
    return text + ("\n* no other candidate is better in both error and time" if timed else "")


def rank_of(row: dict, rows: list[dict]) -> str:
    tied = row["tied"] and sum(each["tied"] for each in rows) > 1
    return f"{row['rank']}{'=' if tied else ''}"


def behind(row: dict) -> str:
    return f"{row['behind']:.4f} ± {row['behind_se']:.4f}" if row["behind"] else "-"


def number(value, form: str) -> str:
    return "-" if value is None else format(value, form)


def parameters_text(row: dict) -> str:
    """What was fitted, shapes first, with standard errors, and lengths that follow; a range where channels have their own."""
    entries = {key: entry for key, entry in row["parameters"].items() if entry.get("fitted") or (entry.get("derived") and entry["unit"])}
    short = {key: key.rpartition(".")[2] for key in entries}
    names = list(short.values())
    ordered = sorted(entries, key=lambda key: hasattr(entries[key]["value"], "__len__"))
    return "  ".join(value_text(short[key] if names.count(short[key]) == 1 else key, entries[key]) for key in ordered)


def value_text(name: str, entry: dict) -> str:
    value, error, unit = entry["value"], entry["stderr"], f" {entry['unit']}" if entry["unit"] else ""
    if hasattr(value, "__len__") and len(value) > 1:
        return f"{name} {min(value):.3g}..{max(value):.3g}{unit}"
    value, error = (each[0] if hasattr(each, "__len__") else each for each in (value, error))
    if entry.get("above"):
        return f"{name} >{entry['above']:.2g}{unit}"
    if entry["at_bound"]:
        return f"{name} {value:.3g}{unit} (at its {entry['at_bound']} bound)"
    return f"{name} {with_error(value, error)}{unit}"


def with_error(value: float, error: float | None) -> str:
    """Value and standard error with the digits that the error allows."""
    if error is None or not 0 < error < 1e3 * max(abs(value), 1e-300):
        return f"{value:.4g}" + (" (undetermined)" if error else "")
    from math import floor, log10

    digits = max(0, 1 - floor(log10(error)))
    if digits > 6 or abs(value) >= 1e5:
        return f"{value:.6g}±{error:.2g}"
    return f"{value:.{digits}f}±{error:.{digits}f}"


def recommendation(document: dict) -> str:
    row = next(each for each in document["ranking"] if each["candidate"] == document["recommended"])
    lines = [f"recommended: {document['recommended']}", wrapped(document["because"])]
    if row.get("growth") and _finite(row["growth"]["r_mirror"]):  # a model that is 0 everywhere has none
        lines.append(wrapped(growth_text(row["growth"])))
    return "\n".join(lines)


def growth_text(growth: dict) -> str:
    """How fast model and data rise toward grazing: what models differ in most (Westin et al. 2004, section 5.2)."""
    low, high = growth["theta_i_deg"]
    data = lambda key: f", the data by {growth[key]:.3g}" if _finite(growth[key]) else ""  # noqa: E731
    greatest = f"; its greatest value by {growth['r_max']:.3g}{data('r_max_data')}" if _finite(growth["r_max"]) else ""
    return f"from {low:g} to {high:g} degrees it rises by {growth['r_mirror']:.3g} in the mirror direction{data('r_mirror_data')}{greatest}"


def scales(document: dict) -> str:
    """What each scale counts, and the order on it."""
    paragraphs = ["best three on each scale:"]
    for name, scale in document["scales"].items():
        best = ", ".join(f"{each['candidate']} {number(each['error'], '.3g')}" for each in scale["order"][:3])
        paragraphs += [wrapped(f"{name}, {scale['counts']}:"), indent(wrapped(best), "  ")]
    return "\n".join(paragraphs)


def doubts(document: dict) -> str:
    """Every warning about the recommended model and about the ranking."""
    row = next(each for each in document["ranking"] if each["candidate"] == document["recommended"])
    return notes_text("doubts:", row["flags"] + document["warnings"])


def data_notes(data: dict) -> str:
    return notes_text("about the data:", data["findings"])


def notes_text(title: str, findings: list[dict]) -> str:
    lines = [wrapped(each["text"] + (f": {each['consequence']}" if each.get("consequence") else "") + _option(each)) for each in findings]
    return "\n".join([title, *lines]) if lines else ""


def wrapped(text: str) -> str:
    """An indented paragraph of at most 100 columns, or of the terminal's if it is narrower."""
    width = min(get_terminal_size().columns, 100) if sys.stdout.isatty() else 100
    return fill(text, max(width, 40), initial_indent="  ", subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)


def _option(finding: dict) -> str:
    return f" [{finding['option']}]" if finding.get("option") else ""


def _finite(value) -> bool:
    return value is not None and abs(value) < float("inf")
