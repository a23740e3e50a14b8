"""The same answer on a terminal, in colours that mean something: green the answer, yellow a doubt, faint the rest."""

from .ranked_table import told_rows
from .ranking import ranking_parts

BOLD, GREEN, YELLOW, FAINT = "1", "1;32", "33", "2"
STYLES = {"answer": GREEN, "no answer": "1;33", "doubts": YELLOW, "detail": FAINT, "data": ""}


def coloured_text(document: dict, *, sketch: str = "", notes: bool = True, full: bool = False) -> str:
    """The parts of the answer in their colours; the sketch stands below the table."""
    shown = []
    for part in ranking_parts(document, notes=notes, full=full):
        if part.role == "table":
            shown.append(_table(part.rows, document, full))
            shown += [sketch] if sketch else []
        elif part.role == "answer":
            first, _, rest = part.text.partition("\n")
            shown.append(painted(first, GREEN) + ("\n" + rest if rest else ""))
        else:
            shown.append(painted(part.text, STYLES[part.role]))
    return "\n\n".join(shown)


def _table(rows: list[list[str]], document: dict, full: bool) -> str:
    """The head in bold, the recommended row in green, faint what is neither tied nor close to it."""
    styles = [BOLD]
    for row in told_rows(document, full):
        behind = "" if row["tied"] or row["close"] else FAINT
        styles.append(GREEN if row["candidate"] == document["recommended"] else behind)
    return "\n".join(painted("\n".join(lines), style) for lines, style in zip(rows, styles, strict=True) if any(lines))


def painted(text: str, style: str) -> str:
    """Every line in a style; a line ends as it began."""
    if not style:
        return text
    return "\n".join(f"\x1b[{style}m{line}\x1b[0m" if line else line for line in text.split("\n"))
