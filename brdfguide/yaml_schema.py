"""YAML files with a declared shape: every error at once, each with file, line and column.

Declare what may stand in a file as `Field`s, then `read(path, fields)` gives a `Document`: plain values, and
where each stood. Numbers, true and false are YAML 1.2's: 1e-3 is a number, `no` is a word, a key given twice is
an error. Anchors, aliases, tags, deep nesting and large files are refused before anything is built from them.
"""

import re
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field

import yaml

from . import opening
from .errors import InputError, nearest_words
from .printable import short
from .records import dataclass

MOST_BYTES = 65536  # ours: the largest sensible description is a few kilobytes
MOST_DEPTH = 12
NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")

HEX = re.compile(r"#[0-9a-fA-F]{6}")
SYMBOL = 3  # letters of a quantity's symbol, which a typing error makes another's


@dataclass(frozen=True)
class Field:
    """One key of a file: what it may hold, in which unit and between which bounds."""

    name: str
    kind: str  # number, numbers, colour (#rrggbb or numbers), word, text, texts, flag, group, groups
    unit: str = ""
    low: float | None = None  # bounds are closed
    high: float | None = None
    above: float | None = None  # an open lower bound
    choices: tuple[str, ...] = ()  # of a word; of number, numbers or a group: words that may stand in its place
    meant: Mapping[str, str] = field(default_factory=dict)  # words that people use -> the choice to propose
    counts: tuple[int, ...] = ()  # how many numbers; empty: any
    fields: tuple["Field", ...] = ()  # of a group, and of each group in groups
    required: bool = False
    meaning: str = ""


@dataclass(frozen=True)
class Document:
    """A file as read: values by field name (groups nest), places by dotted path (`gloss.60`, `lights.0.size`)."""

    name: str
    values: Mapping
    places: Mapping[str, tuple[int, int]] = field(default_factory=dict)

    def place(self, path: str) -> tuple[int, int]:
        """Line and column of `path`, or of the nearest thing around it."""
        while path and path not in self.places:
            path = path.rpartition(".")[0]
        return self.places.get(path, (1, 1))

    def at(self, path: str, sentence: str) -> str:
        """`sentence` with the file, line and column where `path` stands."""
        line, column = self.place(path)
        return f"{self.name}:{line}:{column}: {sentence}"


def read(path, fields: tuple[Field, ...], rules: Iterable[Callable] = ()) -> Document:
    """The file at `path` (`-`: standard input). Each of `rules` takes the Document and yields (path, sentence) for what
    no field can say alone. Raises InputError with all that is wrong, a line each."""
    name = "<stdin>" if str(path) == "-" else str(path)
    return parse(_text(path, name), fields, rules, name)


def written(values: Mapping) -> str:
    """Plain values as a text that `parse` reads. Raises InputError for what such a file cannot hold."""
    try:
        return yaml.safe_dump(dict(values), allow_unicode=True, sort_keys=False)
    except yaml.representer.RepresenterError as error:
        raise InputError(
            f"wanted numbers, words, lists and groups of them; found {short(str(error.args[-1]))}"
        ) from None


def parse(text: str, fields: tuple[Field, ...], rules: Iterable[Callable] = (), name: str = "<text>") -> Document:
    """The same from text."""
    if len(text.encode(errors="replace")) > MOST_BYTES:
        raise InputError(f"{name}: larger than {MOST_BYTES // 1024} kB, which is no description of this kind")
    walk = _Walk()
    try:
        root = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise InputError(
            f"{name}:{mark.line + 1}:{mark.column + 1}: not valid YAML: {error.problem or error.context}"
        ) from None
    except yaml.reader.ReaderError as error:
        raise InputError(
            f"{name}:{text.count(chr(10), 0, error.position) + 1}:1: not text: contains the character "
            f"{error.character:#x}"
        ) from None
    if root is None:
        raise InputError(f"{name}:1:1: empty; a description needs at least one of: {', '.join(f.name for f in fields)}")
    values = walk.group(root, fields, "")
    document = Document(name, values, walk.places)
    problems = list(walk.problems)
    for rule in rules:  # what follows from an error that is already named is left unsaid
        problems += [
            (document.place(where), sentence) for where, sentence in rule(document) if where not in walk.broken
        ]
    if problems:
        lines = [
            f"{name}:{line}:{column}: {sentence}"
            for (line, column), sentence in sorted(problems, key=lambda each: each[0])
        ]
        raise InputError(*dict.fromkeys(lines))
    return document


def _text(path, name: str) -> str:
    """The file's text; never more than a little above the limit is read."""
    if name == "<stdin>":
        raw = sys.stdin.buffer.read(MOST_BYTES + 1)
    else:
        with opening.open_for_reading(path, name) as stream:
            raw = stream.read(MOST_BYTES + 1)
    if len(raw) > MOST_BYTES:
        raise InputError(f"{name}: larger than {MOST_BYTES // 1024} kB, which is no description of this kind")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - (raw.rfind(b"\n", 0, error.start) + 1) + 1
        raise InputError(f"{name}:{line}:{column}: not UTF-8 text") from None


class _Loader(yaml.SafeLoader):
    """PyYAML's nodes, without aliases and without bottomless nesting; no value is ever constructed by it."""

    depth = 0

    def compose_node(self, parent, index):
        event = self.peek_event()
        if isinstance(event, yaml.AliasEvent):
            raise yaml.MarkedYAMLError(
                problem=f"aliases (*{short(event.anchor)}) are not used here", problem_mark=event.start_mark
            )
        if event.anchor is not None:
            raise yaml.MarkedYAMLError(
                problem=f"anchors (&{short(event.anchor)}) are not used here", problem_mark=event.start_mark
            )
        if getattr(event, "tag", None) is not None:
            raise yaml.MarkedYAMLError(
                problem=f"tags ({short(event.tag)}) are not used here", problem_mark=event.start_mark
            )
        if self.depth >= MOST_DEPTH:
            raise yaml.MarkedYAMLError(problem=f"nested more than {MOST_DEPTH} deep", problem_mark=event.start_mark)
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


class _Walk:
    """Goes through the nodes beside the fields, keeping values' places and what is wrong."""

    def __init__(self):
        self.places, self.problems, self.broken = {}, [], set()

    def wrong(self, node, sentence: str) -> None:
        self.problems.append(((node.start_mark.line + 1, node.start_mark.column + 1), sentence))

    def group(self, node, fields, path: str) -> dict:
        """The values of a mapping."""
        what = f"'{path}'" if path else "the file"
        if not isinstance(node, yaml.MappingNode):
            self.wrong(
                node, f"{what} is {_shown(node)}; wanted lines of `key: value` with {', '.join(f.name for f in fields)}"
            )
            return {}
        known, values, sound = {f.name: f for f in fields}, {}, len(self.problems)
        first: dict[str, tuple[int, int]] = {}
        for key_node, value_node in node.value:
            key = _key(key_node)
            if key in first:
                line, column = first[key]
                self.wrong(key_node, f"'{short(key)}' is given twice; first in line {line}, column {column}")
                continue
            first[key] = key_node.start_mark.line + 1, key_node.start_mark.column + 1
            if key not in known:
                self.wrong(key_node, f"no key called '{short(key)}'{_nearest(key, known, path)}")
                continue
            inner = f"{path}.{key}" if path else key
            self.places[inner] = value_node.start_mark.line + 1, value_node.start_mark.column + 1
            count = len(self.problems)
            value = self.value(value_node, known[key], inner)
            if len(self.problems) > count:
                self.broken.add(inner)
            if value is not None:
                values[key] = value
        for each in fields:
            if each.required and each.name not in first:
                self.wrong(node, f"{what} needs '{each.name}': {each.meaning}")
        if len(self.problems) > sound:
            self.broken.add(path)
        return values

    def value(self, node, wanted: Field, path: str):
        """One value, or None with the problem noted."""
        if isinstance(node, yaml.ScalarNode) and node.style is None and node.value in ("", "~", "null", "Null", "NULL"):
            hint = "; a colour such as #c83232 stands in quotes" if wanted.kind == "colour" else ""
            return self.wrong(node, f"'{path}' has no value; give one, or remove the line{hint}")
        if wanted.kind == "group":
            if wanted.choices and isinstance(node, yaml.ScalarNode):
                return self.word(node, wanted, path)
            return self.group(node, wanted.fields, path)
        if wanted.kind == "groups":
            return self.several(node, path, lambda each, inner: self.group(each, wanted.fields, inner))
        if wanted.kind in ("numbers", "colour") and isinstance(node, yaml.SequenceNode):
            if wanted.counts and len(node.value) not in wanted.counts:
                return self.wrong(
                    node, f"'{path}' has {len(node.value)} numbers; wanted {' or '.join(map(str, wanted.counts))}"
                )
            return self.several(node, path, lambda each, inner: self.scalar(each, wanted, inner))
        if wanted.kind == "texts" and isinstance(node, yaml.SequenceNode):
            return self.several(node, path, lambda each, inner: self.scalar(each, wanted, inner))
        listed = wanted.kind == "numbers" and wanted.counts and 1 not in wanted.counts
        if wanted.choices and listed and isinstance(node, yaml.ScalarNode):
            return self.word(node, wanted, path)
        if listed:
            return self.wrong(
                node, f"'{path}' is {_shown(node)}; wanted a list of {' or '.join(map(str, wanted.counts))} numbers"
            )
        single = self.scalar(node, wanted, path)
        if wanted.kind in ("numbers", "colour") and isinstance(single, str):
            return single
        return [single] if wanted.kind in ("numbers", "colour", "texts") and single is not None else single

    def several(self, node, path: str, one):
        """A list, each item by `one`."""
        if not isinstance(node, yaml.SequenceNode):
            return self.wrong(node, f"'{path}' is {_shown(node)}; wanted a list")
        items = []
        for place, each in enumerate(node.value):
            inner = f"{path}.{place}"
            self.places[inner] = each.start_mark.line + 1, each.start_mark.column + 1
            items.append(one(each, inner))
        return None if any(item is None for item in items) else items

    def scalar(self, node, wanted: Field, path: str):
        """A number, word, flag or text."""
        if not isinstance(node, yaml.ScalarNode):
            return self.wrong(node, f"'{path}' is {_shown(node)}; wanted {_wanted(wanted)}")
        text, plain = node.value.strip(), node.style is None
        if wanted.kind in ("text", "texts"):
            return text
        if wanted.kind == "flag":
            if plain and text.lower() in ("true", "false"):
                return text.lower() == "true"
            return self.wrong(node, f"'{path}' is '{short(text)}'; wanted true or false")
        if wanted.kind == "word":
            return self.word(node, wanted, path)
        if wanted.kind == "colour" and HEX.fullmatch(text):
            return text
        word = _word(text, wanted.choices)
        return self.number(node, text, plain, wanted, path) if word is None else word

    def word(self, node, wanted: Field, path: str):
        """One of the choices, of a word or in place of a group."""
        text = node.value.strip()
        found = _word(text, wanted.choices)
        if found is not None:
            return found
        typed = _plain(text)
        near = [wanted.meant[typed]] if typed in wanted.meant else nearest_words(typed, wanted.choices, 1, 0.5)
        hint = f"did you mean '{near[0]}'? " if near else ""
        keys = f", or lines of `key: value` with {', '.join(f.name for f in wanted.fields)}" if wanted.fields else ""
        return self.wrong(node, f"'{path}' is '{short(text)}'; {hint}it is one of: {', '.join(wanted.choices)}{keys}")

    def number(self, node, text: str, plain: bool, wanted: Field, path: str):
        if not (plain and NUMBER.fullmatch(text)):
            return self.wrong(
                node, f"'{path}' is '{short(text)}'; wanted {_wanted(wanted)}{_hint(text, plain, wanted)}"
            )
        number = float(text)
        outside = (
            abs(number) == float("inf")
            or (wanted.low is not None and number < wanted.low)
            or (wanted.high is not None and number > wanted.high)
            or (wanted.above is not None and number <= wanted.above)
        )
        if outside:
            return self.wrong(node, f"'{path}' is {short(text)}; wanted {_wanted(wanted)}")
        return number


def _key(node) -> str:
    return node.value if isinstance(node, yaml.ScalarNode) else _shown(node)


def _word(text: str, choices: tuple[str, ...]) -> str | None:
    """The choice that `text` names; case, hyphens, underscores and the American colour do not matter."""
    return next((choice for choice in choices if _plain(choice) == _plain(text)), None)


def _plain(word: str) -> str:
    return re.sub(r"[\s_-]+", " ", word.lower()).replace("color", "colour").strip()


def _nearest(key: str, known, path: str) -> str:
    """The nearest known keys; with none near, all of them."""
    alike = [each for each in nearest_words(key.lower(), known, 2, 0.55) if _one_quantity(key, each)]
    near = " or ".join(f"'{each}'" for each in alike)
    inside = f" in '{path}'" if path else ""
    return f"{inside}; did you mean {near}?" if near else f"{inside}; there are: {', '.join(known)}"


def _one_quantity(typed: str, known: str) -> bool:
    """Whether a key is spelt so much like another that it means the same: what stands before the unit counts, and short
    symbols such as Ra and Rq are alike only where they are the same."""
    stems = [re.sub(r"_(um|nm|mm|deg|m)$", "", word.lower()) for word in (typed, known)]
    if min(map(len, stems)) <= SYMBOL:
        return stems[0] == stems[1]
    return bool(nearest_words(stems[0], stems[1:], 1, 0.55))


def _shown(node) -> str:
    if isinstance(node, yaml.MappingNode):
        return "a mapping"
    return "a list" if isinstance(node, yaml.SequenceNode) else f"'{short(node.value)}'"


def _wanted(wanted: Field) -> str:
    """What a field takes, in words."""
    if wanted.kind == "word":
        return f"one of: {', '.join(wanted.choices)}"
    if wanted.kind == "flag":
        return "true or false"
    if wanted.kind in ("text", "texts"):
        return "text"
    bounds = ""
    if wanted.above is not None:
        bounds = f" above {wanted.above:g}" + (f" and at most {wanted.high:g}" if wanted.high is not None else "")
    elif wanted.low is not None and wanted.high is not None:
        bounds = f" from {wanted.low:g} to {wanted.high:g}"
    elif wanted.low is not None:
        bounds = f" of at least {wanted.low:g}"
    elif wanted.high is not None:
        bounds = f" of at most {wanted.high:g}"
    unit = f" [{wanted.unit}]" if wanted.unit else ""
    if wanted.kind == "colour":
        return f"'#rrggbb' in quotes, or linear numbers{bounds}"
    words = "".join(f" or '{choice}'" for choice in wanted.choices)
    return f"a number{bounds}{unit}{words}"


def _hint(text: str, plain: bool, wanted: Field) -> str:
    """What the writer may have meant."""
    if not plain and NUMBER.fullmatch(text):
        return "; write it without quotes"
    if text.endswith("%") and NUMBER.fullmatch(text[:-1].strip()):
        return f"; write {float(text[:-1]) / 100:g}"
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", text):
        return f"; write {text.replace(',', '.')}"
    begin = re.match(r"[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?(?![0-9xX])", text)
    if begin and NUMBER.fullmatch(begin[0]):
        return f"; write the number alone, {begin[0]}"
    return ""
