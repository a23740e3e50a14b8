"""What is printed fits the terminal that it is printed on."""

import os
import sys
from types import SimpleNamespace

import pytest

from brdfguide.report import ranking

LONG = "even the best error is many times the noise of a single value: no candidate describes this surface fully, " * 2


@pytest.mark.parametrize("columns, widest", [(60, 60), (100, 100), (300, 100)])
def test_paragraphs_are_as_wide_as_a_terminal_but_no_wider_than_a_page(monkeypatch, columns, widest):
    monkeypatch.setattr(sys, "stdout", SimpleNamespace(isatty=lambda: True))
    monkeypatch.setattr(ranking, "get_terminal_size", lambda: os.terminal_size((columns, 24)))
    lines = ranking.wrapped(LONG).splitlines()
    assert widest - 15 < max(map(len, lines)) <= widest and all(line.startswith("    ") for line in lines[1:])


def test_a_pipe_gets_a_page_of_100_columns_whatever_the_terminal_is(monkeypatch):
    monkeypatch.setattr(sys, "stdout", SimpleNamespace(isatty=lambda: False))
    monkeypatch.setattr(ranking, "get_terminal_size", lambda: os.terminal_size((60, 24)))
    assert 85 < max(map(len, ranking.wrapped(LONG).splitlines())) <= 100
