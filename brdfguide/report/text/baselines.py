"""General representations beside a ranking, as a table that ranks nothing."""

from .table import columns


def baselines_text(rows: list[dict]) -> str:
    """A line for each: how many numbers, how far off at the directions it was fitted to and at those left out."""
    timed = "ns_per_sample" in rows[0]
    header = ("representation", "numbers", "rms ln", "left out", *(("ns/sample",) if timed else ()), "")
    lines = [
        [
            row["name"],
            row["coefficients"],
            _number(row["rms_ln"], ".3f"),
            _number(row["left_out_rms_ln"], ".3f"),
            *((_number(row["ns_per_sample"], ".0f"),) if timed else ()),
            _note(row),
        ]
        for row in rows
    ]
    title = "what general representations take, ranked with nothing (docs/baselines.md):"
    return f"{title}\n{columns(header, lines, right=(1, 2, 3, 4) if timed else (1, 2, 3))}"


def _note(row: dict) -> str:
    negative = f"{100 * row['negative']:.2g} % negative" if row["negative"] else ""
    return "; ".join(filter(None, [row["note"], negative]))


def _number(value, form: str) -> str:
    return "-" if value is None else format(value, form)
