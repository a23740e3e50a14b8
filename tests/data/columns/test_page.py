"""docs/columns.md is what the code reads."""

import re

import pytest

from brdfguide.data.columns import columns_page, vocabulary
from brdfguide.data.columns.grammar import understood

from ...conftest import ROOT


def test_the_page_is_written_from_the_tables():
    written = (ROOT / "docs" / "columns.md").read_text()
    assert written == columns_page.columns_page(), "python -m brdfguide.data.columns.columns_page > docs/columns.md"


@pytest.mark.parametrize("role", vocabulary.ROLES)
def test_every_example_of_the_page_is_read_as_the_page_says(role):
    for name in columns_page.EXAMPLES[role]:
        assert understood(name).role == role, name


def test_every_role_of_a_rule_is_on_the_page_and_the_other_way_round():
    rules = {rule.role for rule in (*vocabulary.RULES, *vocabulary.WEAK_RULES)}
    assert rules | {"value", "beta_from_mirror"} == vocabulary.ROLES.keys() == columns_page.EXAMPLES.keys()


def test_every_sense_of_a_rule_has_words():
    needed = {sense for rule in vocabulary.RULES for need in (*rule.needs, *rule.may) for sense in need.split("/")}
    assert needed <= vocabulary.SENSES.keys()


def test_tables_are_whole():
    for line in columns_page.columns_page().splitlines():
        if line.startswith("|"):
            assert len(re.findall(r"(?<!\\)\|", line)) in (3, 4, 5), line
