"""No regular expression of the package takes longer than its text is long.

Every pattern is collected from the source, whether it is compiled, literal or put together from others. From its own
syntax tree come texts on which it has to work hardest: all that leads to a repetition, the repetition over and over,
and a last letter that spoils the match.
"""

import ast
import re
import time
from collections import deque
from dataclasses import dataclass
from importlib import import_module
from re import _constants as constants  # type: ignore[attr-defined]
from re import _parser as parser  # type: ignore[attr-defined]

import pytest

from brdfguide.data.formats import _unread

from . import patience
from .conftest import ROOT

CALLS = {"compile", "search", "match", "fullmatch", "sub", "subn", "split", "findall", "finditer"}
# letters -> seconds that a search may take at most: thousands of times what one that is linear takes
LIMITS = {16: 0.1, 25: 0.1, 1_000: 0.1, 10_000: 0.1, 30_000: 0.2, 100_000: 0.5}
SPOILERS = ("\0", "!", "x", "\n")


@dataclass(frozen=True)
class Pattern:
    text: str | bytes
    flags: re.RegexFlag
    methods: frozenset[str]  # how it is applied: search, match, fullmatch, sub ...


def patterns() -> dict[str, Pattern]:
    """file:line -> pattern of every call of `re` in the package."""
    found = {}
    for path in sorted((ROOT / "brdfguide").rglob("*.py")):
        tree = ast.parse(path.read_text())
        for node in ast.walk(tree):
            if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in CALLS):
                continue
            if isinstance(node.func.value, ast.Name) and node.func.value.id == "re" and node.args:
                arguments = (*node.args[1:], *(each.value for each in node.keywords))
                flags = re.NOFLAG
                for name in named_flags(arguments):
                    flags |= getattr(re, name.attr)
                methods = {node.func.attr} if node.func.attr != "compile" else applied(tree, node)
                place = f"{path.relative_to(ROOT)}:{node.lineno}"
                found[place] = Pattern(text_of(node.args[0], path), flags, frozenset(methods))
    return found


def applied(tree: ast.Module, compiled: ast.Call) -> set[str]:
    """The methods that a module calls of a compiled pattern; `search`, the hardest, where it calls none."""
    names = {
        target.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign) and node.value is compiled
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    calls = (node.func for node in ast.walk(tree) if isinstance(node, ast.Call))
    used = {
        call.attr
        for call in calls
        if isinstance(call, ast.Attribute) and isinstance(call.value, ast.Name) and call.value.id in names
    }
    return used or {"search"}


def named_flags(arguments) -> list[ast.Attribute]:
    """The `re.MULTILINE` and the like among arguments."""
    nodes = (node for argument in arguments for node in ast.walk(argument))
    return [
        node
        for node in nodes
        if isinstance(node, ast.Attribute)
        and isinstance(getattr(re, node.attr, None), re.RegexFlag)
        and isinstance(node.value, ast.Name)
        and node.value.id == "re"
    ]


def text_of(node: ast.expr, path) -> str | bytes:
    """A pattern as it would be at run time; a name that only a function knows stands as the word KEY."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    module = import_module(".".join(parts[:-1] if parts[-1] == "__init__" else parts))

    class Names(dict):
        def __missing__(self, key):
            return "KEY"

    return eval(compile(ast.Expression(node), str(path), "eval"), {"__builtins__": {}}, Names(vars(module)))


def hard_texts(pattern: str | bytes, length: int):
    """Texts of about this length: for every repetition of the pattern what leads to it, and then nothing else."""
    text = pattern.decode("latin-1") if isinstance(pattern, bytes) else pattern
    for before, body in repetitions(list(parser.parse(text)), ""):
        for spoiler in SPOILERS:
            yield before + (body * length)[:length] + spoiler
            yield (before + body) * (length // max(len(before + body), 1)) + spoiler
    for letter in " \t\n0aA,.(_\"'":
        yield letter * length


def repetitions(items, before: str):
    """(a text that matches all before it, a text that its body matches) of every repetition, nested ones too."""
    for kind, value in items:
        if kind in (constants.MAX_REPEAT, constants.MIN_REPEAT):
            _, most, body = value
            if most > 99:
                yield before, shortest(body) or "a"
            yield from repetitions(list(body), before)
        elif kind is constants.SUBPATTERN:
            yield from repetitions(list(value[-1]), before)
        elif kind is constants.BRANCH:
            for branch in value[1]:
                yield from repetitions(list(branch), before)
        before += shortest([(kind, value)])


def shortest(items) -> str:
    """A short text that these items match."""
    text = ""
    for kind, value in items:
        if kind is constants.LITERAL:
            text += chr(value)
        elif kind in (constants.MAX_REPEAT, constants.MIN_REPEAT):
            text += shortest(value[2]) * max(value[0], 0)
        elif kind is constants.SUBPATTERN:
            text += shortest(value[-1])
        elif kind is constants.BRANCH:
            text += shortest(value[1][0])
        elif kind is constants.IN:
            text += one_of(value)
        elif kind is constants.ANY:
            text += "a"
        elif kind is constants.NOT_LITERAL:
            text += "a" if value != ord("a") else "b"
    return text


CATEGORIES = {constants.CATEGORY_DIGIT: "0", constants.CATEGORY_SPACE: " ", constants.CATEGORY_WORD: "a"}


def one_of(members) -> str:
    """A letter that a set holds."""
    kind, value = members[0]
    if kind is constants.NEGATE:
        return next(letter for letter in "aA0 ,;" if not holds(members[1:], letter))
    if kind is constants.LITERAL:
        return chr(value)
    if kind is constants.RANGE:
        return chr(value[0])
    return CATEGORIES.get(value, "a")


def holds(members, letter: str) -> bool:
    for kind, value in members:
        if kind is constants.LITERAL and ord(letter) == value:
            return True
        if kind is constants.RANGE and value[0] <= ord(letter) <= value[1]:
            return True
        if kind is constants.CATEGORY and CATEGORIES.get(value) == letter:
            return True
    return False


PATTERNS = patterns() | {
    f"_unread.py: {what}": Pattern(text, re.NOFLAG, frozenset({"match"})) for text, what, _ in _unread.KINDS
}


def worst(pattern: Pattern) -> tuple[float, str]:
    """The share of the limit that the slowest text takes, and its beginning; from short texts to the first bad one."""
    compiled = re.compile(pattern.text, pattern.flags)
    found = (0.0, "")
    for length, limit in LIMITS.items():
        for text in hard_texts(pattern.text, length):
            subject = text.encode("latin-1", "replace") if isinstance(pattern.text, bytes) else text
            for method in pattern.methods:
                share = seconds(compiled, method, subject) / limit
                for _ in range(patience.TRIES):  # the machine may have been busy
                    if 1 < share < 5:
                        share = min(share, seconds(compiled, method, subject) / limit)
                found = max(found, (share, text[:60]))
                if found[0] > 1:
                    return found
    return found


def seconds(compiled: re.Pattern, method: str, subject) -> float:
    """Of the processor, for one application of a pattern."""
    arguments = ("", subject) if method in ("sub", "subn") else (subject,)
    if method in ("sub", "subn") and isinstance(subject, bytes):
        arguments = (b"", subject)
    start = time.process_time()
    result = getattr(compiled, method)(*arguments)
    if method == "finditer":
        deque(result, maxlen=0)
    return time.process_time() - start


@pytest.mark.parametrize("place", PATTERNS)
def test_a_pattern_takes_no_longer_than_its_text_is_long(place):
    share, text = worst(PATTERNS[place])
    assert share <= 1, f"{PATTERNS[place].text!r} takes {share:.1f} times its limit on {text!r}..."


@pytest.mark.parametrize("text", [r"^\s*KEY", r"(\d+(?:\.\d+)?)\s*nm", r"(?:a\s*)?\s*\s*b", r"(a+)+b"])
def test_the_texts_find_what_grows_as_the_square(text):
    assert worst(Pattern(text, re.MULTILINE, frozenset({"search"})))[0] > 1


def test_patterns_are_found():
    assert len(PATTERNS) > 15
