"""JSON with a declared shape, checked once: dataclasses say what may stand where, and an error says where it does not.

A field's type is str, bool, int, float, a tuple[T, ...], a dict[str, T], a dataclass, or several of them with `|`; a
field with a default may be missing, and one that ends in _ stands for the key without it, a word of Python's own. Keys
that are not declared are passed over: later versions may write more.
"""

import json
from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from math import isfinite
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from .errors import InputError
from .opening import content
from .printable import short
from .records import dataclass

MOST_BYTES = 2**26  # a fit of a thousand channels has a few millions


@dataclass(frozen=True)
class Schema:
    """Which shapes belong to which `schema` of a document."""

    shapes: dict[str, type]  # "brdfguide/fit/1" -> a dataclass
    wanted: str  # what writes them, for the sentence


def read_typed(path, schema: Schema) -> Any:
    """The document in a file, in the shape of its schema. Raises InputError with the place of what is wrong."""
    return parsed(content(path, MOST_BYTES, str(path)), schema, str(path))


def parsed(data: bytes, schema: Schema, name: str) -> Any:
    """The same of bytes."""
    try:
        document = json.loads(data, parse_constant=_no_number, object_pairs_hook=_once_each)
    except RecursionError:
        raise InputError(f"{name}: nested too deeply for {schema.wanted}") from None
    except ValueError as error:
        raise InputError(f"{name}: not JSON ({error}); wanted {schema.wanted}") from None
    if not isinstance(document, dict):
        raise InputError(f"{name}: found {_found(document)}; wanted {schema.wanted}")
    said = document.get("schema")
    if not isinstance(said, str) or said not in schema.shapes:
        raise InputError(f"{name}: {_unknown(said, schema)}; wanted {schema.wanted}")
    return _Reader(name).of(schema.shapes[said], document, "")


def _no_number(word: str):
    raise ValueError(f"{word} is no number")


def _once_each(pairs: list[tuple[str, Any]]) -> dict:
    """An object; who reads it differently would read another value of a key that stands there twice."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"'{short(twice)}' stands there twice")
    return found


def _unknown(said, schema: Schema) -> str:
    """What a document calls itself, and whether another version wrote it."""
    if said is None:
        return "it has no 'schema'"
    text = short(said)
    kind, _, number = text.rpartition("/")
    ours = [each for each in schema.shapes if each.rpartition("/")[0] == kind]
    if ours and number.isdigit():
        return f"its schema is {text}, of another version of brdfguide, and this one reads {' or '.join(ours)}"
    return f"its schema is '{text}'; this reads {' or '.join(schema.shapes)}"


class _Reader:
    """Walks a document beside its shape."""

    def __init__(self, name: str):
        self.name = name

    def of(self, kind: Any, value: Any, place: str) -> Any:
        """`value` as what `kind` says."""
        for choice in get_args(kind) if isinstance(kind, UnionType) else (kind,):
            if _is(choice, value):
                return self.inside(choice, value, place)
        where = f"{place}: " if place else ""
        raise InputError(f"{self.name}: {where}found {_found(value)}; wanted {_wanted(kind)}")

    def inside(self, kind: Any, value: Any, place: str) -> Any:
        if is_dataclass(kind):
            return self.object(kind, value, place)
        if get_origin(kind) is tuple:
            return tuple(self.of(get_args(kind)[0], item, f"{place}[{number}]") for number, item in enumerate(value))
        if get_origin(kind) is dict:
            return {key: self.of(get_args(kind)[1], item, _inner(place, key)) for key, item in value.items()}
        return float(value) if kind is float else value

    def object(self, kind: Any, value: dict, place: str) -> Any:
        given = {}
        for name, hint, needed in _fields(kind):
            key = name.removesuffix("_")
            if key in value:
                given[name] = self.of(hint, value[key], _inner(place, key))
            elif needed:
                where = f"{place}: " if place else ""
                raise InputError(f"{self.name}: {where}there is no '{key}'; wanted {_wanted(hint)}")
        return kind(**given)


@cache
def _fields(kind: Any) -> tuple[tuple[str, Any, bool], ...]:
    hints = get_type_hints(kind)
    found = []
    for field in fields(kind):
        needed = field.default is MISSING and field.default_factory is MISSING
        found.append((field.name, hints[field.name], needed))
    return tuple(found)


def _inner(place: str, name: str) -> str:
    return f"{place}.{short(name)}" if place else short(name)


def _finite(value: Any) -> bool:
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
    except OverflowError:  # an integer beyond what a float holds
        return False


PLAIN: dict[Any, tuple[Callable[[Any], bool], str]] = {
    str: (lambda value: isinstance(value, str), "a text"),
    bool: (lambda value: isinstance(value, bool), "true or false"),
    int: (lambda value: _finite(value) and value == int(value), "a whole number"),
    float: (_finite, "a number"),
    NoneType: (lambda value: value is None, "null"),
}


def _is(kind: Any, value: Any) -> bool:
    if kind in PLAIN:
        return PLAIN[kind][0](value)
    if get_origin(kind) is tuple:
        return isinstance(value, list) and (... in get_args(kind) or len(value) == len(get_args(kind)))
    return isinstance(value, dict)


def _wanted(kind: Any) -> str:
    if isinstance(kind, UnionType):
        return " or ".join(map(_wanted, get_args(kind)))
    if kind in PLAIN:
        return PLAIN[kind][1]
    if get_origin(kind) is tuple:
        return "a list" if ... in get_args(kind) else f"a list of {len(get_args(kind))}"
    return "an object"


def _found(value: Any) -> str:
    if isinstance(value, (list, dict)):
        return f"{'a list' if isinstance(value, list) else 'an object'} of {len(value)}"
    return short(json.dumps(value)) if not isinstance(value, int) or abs(value) < 10**30 else "a huge number"
