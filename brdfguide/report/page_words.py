"""The words of a page: what the sections that its rules come from are about, and a line for every word that it uses."""

import re
from html import escape

from ..glossary import REPORT, SECTIONS, WORDS, anchor
from .elements import html_definitions


def section_links(section: str) -> str:
    """`5.2, Eq. 2` with each part linked to its line on the page."""
    parts = [part.strip() for part in section.split(",") if part.strip()]
    links = (f'<a href="#{anchor(part)}">{part}</a>' if part in SECTIONS else escape(part) for part in parts)
    return ", ".join(links)


def words_used(document: dict, shown: str) -> str:
    """The sections behind the rules that spoke, and the glossary's words that stand on the page (`shown`, HTML)."""
    spoken = [each.get("section", "") for each in document.get("advice") or ()]
    reasons = (document.get("domain") or {}).get("reasons", ())  # as documents or as words
    spoken += [each.get("section", "") for each in reasons if isinstance(each, dict)]
    used = {part.strip() for each in spoken for part in each.split(",")}
    lines = "".join(
        f'<li id="{anchor(name)}"><strong>{escape(name)}</strong> {escape(about)}</li>'
        for name, about in SECTIONS.items()
        if name in used
    )
    sections = f"<h3>Sections of the report</h3><p>{escape(REPORT)}</p><ul>{lines}</ul>" if lines else ""
    text = re.sub(r"<[^<>]+>", " ", shown)
    known = [(word, meaning) for words in WORDS.values() for word, meaning in words.items() if _stands(word, text)]
    return html_definitions(known) + sections


def _stands(word: str, text: str) -> bool:
    return any(re.search(rf"(?<!\w){re.escape(part)}(?!\w)", text) for part in word.split(", "))
