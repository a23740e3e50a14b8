"""Every word that an answer heads a column with, and every section that a rule comes from, is explained."""

import re

from brdfguide import glossary
from brdfguide.advice import guidelines
from brdfguide.report.page_words import section_links, words_used

from .conftest import ROOT

WORDS = {word for words in glossary.WORDS.values() for word in words}


def test_the_page_is_the_list():
    written = (ROOT / "docs" / "glossary.md").read_text()
    assert written == glossary.glossary_page(), "python -m brdfguide.glossary > docs/glossary.md"


def test_every_section_of_a_rule_has_a_line():
    parts = {part.strip() for rule in guidelines.rules() for part in rule.section.split(",")}
    assert parts <= set(glossary.SECTIONS), parts - set(glossary.SECTIONS)


def test_the_columns_of_a_ranking_are_explained():
    source = "".join((ROOT / "brdfguide/report/text" / name).read_text() for name in ("ranking.py", "ranked_table.py"))
    heads = {"off", "seen L*", "held-out", "rms ln", "behind best", "free"}
    assert all(f'"{head}"' in source for head in heads) and heads <= WORDS


def test_a_page_explains_what_stands_on_it_and_nothing_else():
    document = {"advice": [{"section": "5.1, Eq. 2"}]}
    shown = words_used(document, "<td>F0</td><p>the lobe</p>")
    assert "lobe" in shown and "F0" in shown and "tau" not in re.findall(r"<d[td]>(\w+)", shown)
    assert 'id="section-5-1"' in shown and 'id="section-eq-2"' in shown and "section-4" not in shown
    assert section_links("5.1, Eq. 2") == '<a href="#section-5-1">5.1</a>, <a href="#section-eq-2">Eq. 2</a>'
