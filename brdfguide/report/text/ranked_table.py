"""The candidates of a fit in tables: six columns that fit 80, and the rest of what is known of each."""

from math import floor, log10

from ...printable import off_words, off_words_of
from ..documents.findings import codes
from .table import columns, row_lines

HEADER = ("rank", "model", "off", "seen L*", "held-out", "doubts")
RIGHT = (2, 3, 4)
LEAST_LEFT_OUT = 3  # rows for which a line is worth saying


def ranked_lines(rows: list[dict]) -> list[list[str]]:
    """The lines of the header and of each candidate: where it stands, how far off, what is doubtful of it alone."""
    shared = shared_doubts(rows)
    return row_lines(HEADER, [_line(row, rows, shared) for row in rows], RIGHT)


def _line(row: dict, rows: list[dict], shared: list[str]) -> tuple:
    held = row["held_out_rms_ln"]
    names = dict.fromkeys(code.partition(" ")[0] for code in sorted(codes(row["flags"])))
    doubts = [name for name in names if name not in shared]
    return (
        rank_of(row, rows),
        row["candidate"],
        off_words(row["off_percent"]),
        seen_cell(row),
        "-" if held is None else off_words_of(held),
        ", ".join(doubts) or "-",
    )


def told_rows(document: dict, full: bool) -> list[dict]:
    """The rows that are shown; where it is not to be `full`, without those far behind: 4 times the least error."""
    rows = document["ranking"]
    near = [row for row in rows if row["candidate"] == document["recommended"] or not _is_coarse(row)]
    return rows if full or len(rows) - len(near) < LEAST_LEFT_OUT else near


def _is_coarse(row: dict) -> bool:
    return any(flag["code"] == "coarse" for flag in row["flags"])


def shared_doubts(rows: list[dict]) -> list[str]:
    """Codes that every candidate has, where there are several: said once."""
    if len(rows) < 2:
        return []
    of_each = [[code.partition(" ")[0] for code in codes(row["flags"])] for row in rows]
    return [code for code in of_each[0] if all(code in others for others in of_each)]


def legend(rows: list[dict]) -> str:
    """What the signs in the table mean, those that stand there."""
    said = []
    if any("=" in rank_of(row, rows) for row in rows):
        said.append("= these data cannot tell them apart")
    if any(row["close"] for row in rows) and len(rows) > 1:
        said.append("~ close enough to the best for the eye")
    if any(row["held_out_rms_ln"] is not None for row in rows):
        said.append("held-out: off at incidence angles that were not fitted")
    if shared := shared_doubts(rows):
        said.append(f"doubts of every model: {', '.join(shared)}")
    return "; ".join(said)


def detail_tables(rows: list[dict]) -> str:
    """Errors in numbers with their doubt, times where they were taken, and every model's parameters."""
    timed = "time_per_sample_ns" in rows[0]
    header = ("model", "rms ln", "held-out", "behind best", "free", *(("ns/sample", "fit s") if timed else ()))
    lines = []
    for row in rows:
        line = [
            row["candidate"],
            f"{row['rms_ln']:.4f}",
            number_text(row["held_out_rms_ln"], ".4f"),
            behind(row),
            row["free_parameters"],
        ]
        if timed:
            line.append(f"{row['time_per_sample_ns']:.0f}" + ("*" if row["on_front"] else ""))
            line.append(f"{row['fit_time_s']:.2f}")
        lines.append(line)
    text = columns(header, lines, right=(1, 2, 4, 5, 6) if timed else (1, 2, 4))
    text += "\n* no other candidate is better in both error and operations" if timed else ""
    return f"{text}\n\n{columns(('model', 'parameters'), [(row['candidate'], parameters_text(row)) for row in rows])}"


def rank_of(row: dict, rows: list[dict]) -> str:
    tied = row["tied"] and sum(each["tied"] for each in rows) > 1
    return f"{row['rank']}{'=' if tied else ''}"


def seen_cell(row: dict) -> str:
    """S [L*], with ~ where the model comes close enough to the best."""
    return f"{number_text(row['seen'], '.1f')}{'~' if row['close'] else ' '}"


def behind(row: dict) -> str:
    return f"{row['behind']:.4f} ± {row['behind_se']:.4f}" if row["behind"] else "-"


def number_text(value, form: str) -> str:
    return "-" if value is None else format(value, form)


def parameters_text(row: dict) -> str:
    """What was fitted, shapes first, with standard errors, and lengths that follow; F0 in place of k, and F at 82
    degrees in place of n, or beside them where the data tell both; a range where channels differ."""
    replaced = {entry["in_place_of"] for entry in row["parameters"].values() if entry.get("in_place_of")}
    entries = {
        key: entry
        for key, entry in row["parameters"].items()
        if key not in replaced
        and (entry.get("fitted") or "in_place_of" in entry or (entry.get("derived") and entry["unit"]))
    }
    short = {key: key.rpartition(".")[2] for key in entries}
    names = list(short.values())
    ordered = sorted(entries, key=lambda key: hasattr(entries[key]["value"], "__len__"))
    return "  ".join(value_text(short[key] if names.count(short[key]) == 1 else key, entries[key]) for key in ordered)


def value_text(name: str, entry: dict) -> str:
    value, error, unit = entry["value"], entry["stderr"], f" {entry['unit']}" if entry["unit"] else ""
    if hasattr(value, "__len__") and len(value) > 1:
        return f"{name} {min(value):.3g}..{max(value):.3g}{unit}"
    value, error = (each[0] if hasattr(each, "__len__") else each for each in (value, error))
    if value is None:
        return f"{name} without a bound"
    if entry.get("above"):
        return f"{name} >{entry['above']:.2g}{unit}"
    if entry["at_bound"]:
        return f"{name} {value:.3g}{unit} (at its {entry['at_bound']} bound)"
    return f"{name} {with_error(value, error)}{unit}"


def with_error(value: float, error: float | None) -> str:
    """Value and standard error with the digits that the error allows."""
    if error is None or not 0 < error < 1e3 * max(abs(value), 1e-300):
        return f"{value:.4g}" + (" (undetermined)" if error else "")
    digits = max(0, 1 - floor(log10(error)))
    if digits > 6 or abs(value) >= 1e5:
        return f"{value:.6g}±{error:.2g}"
    return f"{value:.{digits}f}±{error:.{digits}f}"
