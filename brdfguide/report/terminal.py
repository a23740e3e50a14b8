"""A fit's document on a terminal: the same numbers as in a pipe, with colour, a bar for the error, and no cut cells."""

from math import log10

from rich.console import Console, Group
from rich.table import Table
from rich.text import Text

from . import ranking

BAR = 12  # cells
BLOCKS = " ▏▎▍▌▋▊▉█"


def show(document: dict, sketch: str = "", notes: bool = True) -> None:
    """Prints the answer: heading, table, recommendation, doubts."""
    console = Console(highlight=False)
    console.print(Text(ranking.heading(document["data"]) + ranking.kind_line(document.get("kind")), style="bold"))
    console.print()
    console.print(_table(document))
    if sketch:
        print("\n" + sketch)
    paragraphs = [ranking.recommendation(document)]
    if notes:
        paragraphs += [text for text in (ranking.scales(document), ranking.doubts(document), ranking.data_notes(document["data"])) if text]
    for place, paragraph in enumerate(paragraphs):
        console.print(Text("\n" + paragraph, style="bold green" if place == 0 else "yellow" if paragraph.startswith("doubts") else "dim"))


def _table(document: dict) -> Table:
    rows = document["ranking"]
    timed = "time_per_sample_ns" in rows[0]
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("rank", "model", "rms ln", "", "held-out", "behind best") + (("ns/sample", "fit s") if timed else ()):
        table.add_column(name, justify="left" if name in ("rank", "model", "", "behind best") else "right", no_wrap=name != "model")
    least, most = log10(max(min(row["rms_ln"] for row in rows), 1e-6)), log10(max(row["rms_ln"] for row in rows))
    for row in rows:
        chosen = row["candidate"] == document["recommended"]
        flags = sorted({flag["code"].partition(":")[0] for flag in row["flags"]})
        below = Text(ranking.parameters_text(row), style="dim")
        if flags:
            below.append("  " + " ".join(flags), style="yellow")
        cells = [ranking.rank_of(row, rows), Group(Text(row["candidate"], style="bold green" if chosen else ""), below), f"{row['rms_ln']:.4f}"]
        cells += [bar(log10(max(row["rms_ln"], 1e-6)), least, most), ranking.number(row["held_out_rms_ln"], ".4f"), ranking.behind(row)]
        cells += [f"{row['time_per_sample_ns']:.0f}" + ("*" if row["on_front"] else " "), f"{row['fit_time_s']:.2f}"] if timed else []
        table.add_row(*cells)
    return table


def bar(value: float, least: float, most: float) -> str:
    """A bar between a stub for the least error and the full width for the largest, on a logarithmic scale."""
    share = 0.08 + 0.92 * ((value - least) / (most - least) if most > least else 0.0)
    eighths = round(share * BAR * 8)
    return "█" * (eighths // 8) + (BLOCKS[eighths % 8] if eighths % 8 else "")
