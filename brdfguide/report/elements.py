"""What pages are made of: tables, lists of findings, numbers as they are read."""

from collections.abc import Iterable
from html import escape

MOST_COLUMNS = 4  # of a table that a phone shows as one


def html_table(header, lines, numbers=frozenset()) -> str:
    """`lines` are (cells, whether it is the pick), cells ready to stand; columns in `numbers` are flush right.

    On a phone each line of a wide table is a paragraph, its cells beside their headings.
    """
    wide = len(header) > MOST_COLUMNS
    marks = [' class="n"' if place in numbers else "" for place in range(len(header))]
    told = [wide and place > 0 and text not in ("", "model") for place, text in enumerate(header)]
    names = [f' data-is="{escape(text, quote=True)}"' * kept for text, kept in zip(header, told, strict=True)]
    head = "".join(f"<th{mark}>{escape(text)}</th>" for mark, text in zip(marks, header, strict=True))

    def row(cells) -> str:
        return "".join(f"<td{mark}{name}>{cell}</td>" for mark, name, cell in zip(marks, names, cells, strict=True))

    picked = ' class="pick"'
    body = "".join(f"<tr{picked if pick else ''}>{row(cells)}</tr>" for cells, pick in lines)
    fold = ' class="fold"' if wide else ""
    return f'<div class="wide"><table{fold}><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def html_definitions(entries, escaped: bool = False) -> str:
    """A list of words with what they are; those without are left out."""
    known = [(key, value) for key, value in entries if value is not None and value != ""]
    shown = [(key, value if escaped else escape(str(value))) for key, value in known]
    return f"<dl>{''.join(f'<dt>{key}</dt><dd>{value}</dd>' for key, value in shown)}</dl>"


def html_findings(found: Iterable[dict]) -> str:
    """What was noticed, with what overrides it and its code; "" where nothing was."""
    items = [
        f'<li class="{escape(each.get("severity", "note"))}">{escape(each["text"])}'
        + (f": {escape(each['consequence'])}" if each.get("consequence") else "")
        + (f" (<code>{escape(each['option'])}</code> overrides it)" if each.get("option") else "")
        + f' <code class="soft">{escape(each["code"])}</code></li>'
        for each in found
    ]
    return f"<ul>{''.join(items)}</ul>" if items else ""


def typed(parameters: dict) -> str:
    """Parameters as they are typed."""
    return " ".join(f'<code class="whole">{escape(key)}={quantity(value)}</code>' for key, value in parameters.items())


def html_number(value: float | None, digits: int = 3) -> str:
    """ "" where there is none."""
    if value is None:
        return ""
    return f"{value:.{digits}g}" if abs(value) < 1000 else f"{value:.0f}"


def quantity(value) -> str:
    """A number, a word or several; of many channels their range."""
    if isinstance(value, list):
        numbers = [each for each in value if isinstance(each, (int, float))]
        if len(numbers) > 3:
            return f"{min(numbers):.3g} to {max(numbers):.3g} ({len(value)} channels)"
        return escape(", ".join(quantity(each) for each in value))
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else escape(str(value))


def percent(share: float) -> str:
    """How far off, of a ratio minus 1."""
    return f"{100 * share:.2g} %" if share < 1 else f"a factor of {1 + share:.2g}"


def html_sentence(reason) -> str:
    """What a reason says, given as a document or as words."""
    return reason.get("text") or reason.get("says") or "" if isinstance(reason, dict) else str(reason)


def name_of(row: dict) -> str:
    """What a row of a ranking is called."""
    return row.get("candidate") or row["model"]
