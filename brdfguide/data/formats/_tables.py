"""Sheets whose cells come from a library, as numbers under names, for the reader of tables of text."""

from importlib import import_module

from ...errors import InputError
from .format import Source


def library(name: str, extra: str, source: Source, what: str):
    """An optional package. Raises InputError that says how to have it, and what serves instead."""
    try:
        return import_module(name)
    except ImportError:
        text = f"reading {what} needs the package {name}: pip install 'brdfguide[{extra}]', or save it as CSV"
        raise InputError(f"{source.name}: {text}") from None


def as_text(source: Source, rows) -> Source:
    """The rows as lines parted by tabs, so that the reader of tables counts and words as everywhere."""
    lines = ["\t".join(_cell(cell) for cell in row) for row in rows]
    return Source(source.name, "\n".join(lines).encode(), source.findings)


def _cell(value) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value)
    return " ".join(str(value).replace('"', "'").split())
