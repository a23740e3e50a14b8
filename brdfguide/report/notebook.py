"""Answers as HTML for a notebook, from their documents: tables that stand without a style of their own."""

from html import escape

from .elements import html_findings
from .page_ranking import ranking
from .text.ranking import heading, kind_line


def ranking_html(document: dict) -> str:
    """What was fitted, every candidate in its place, which to use and why, and what is doubtful about it."""
    pick = next(row for row in document["ranking"] if row["candidate"] == document["recommended"])
    return (
        f"<p>{escape(heading(document['data']) + kind_line(document))}</p>{ranking(document)}"
        f"<p><strong>{escape(document['recommended'])}</strong>: {escape(document['because'])}</p>"
        f"{html_findings([*pick['flags'], *document['warnings']])}"
    )
