"""Damage that knows what a text is made of: numbers, words, lines, signs, an encoding, a compression."""

import bz2
import gzip
import lzma
import re
from random import Random

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
WORD = re.compile(r"[^\W\d]\w+")
_NUMBERS = """
    0 -0 1 -1 90 89.999999999 90.0000001 180 360 1e-300 1e-320 1e300 -1e300 1e400 inf -inf nan NaN 1e308 0.5
    45 550 0x10 1_000 1,5 1.5D-03 1e 1e+ --1 .5 5. 1e5 99999999999999999999 ١٢ ½ 4294967296 -2147483649 2e-16
    1/2 50% 1.2.3
"""
NUMBERS = _NUMBERS.split()
SIGNS = "\0\x01\x07\x0b\x0c\x1b\x7f\x85\xa0\xad\u200b\u202e\u2028\u2029\u2066\ufeff\ufffe\U000e0001"
SIGNS += "$%\\'\"`<>&{}[]()|;#!,:=\t\r"
LONG = (300, 5_000, 70_000, 140_000)


def damaged(draw: Random, text: str, words: list[str]) -> bytes:
    """A text with none to six changes, as a file. `words` are those that its reader knows."""
    for _ in range(draw.choice((0, 1, 1, 1, 2, 2, 3, 6))):
        text = draw.choice(CHANGES)(draw, text, words)
    return packed(draw, encoded(draw, text))


def _number(draw: Random, text: str, words) -> str:
    found = list(NUMBER.finditer(text))
    return _put(text, draw.choice(found), draw.choice(NUMBERS)) if found else text


def _all_numbers(draw: Random, text: str, words) -> str:
    """One column, or all of it, of one extreme kind."""
    share, value = draw.choice((0.05, 0.5, 1.0)), draw.choice(NUMBERS)
    return NUMBER.sub(lambda found: value if draw.random() < share else found[0], text)


def _word(draw: Random, text: str, words) -> str:
    found = list(WORD.finditer(text))
    return _put(text, draw.choice(found), draw.choice(words)) if found else text


def _put(text: str, found: re.Match, new: str) -> str:
    return text[: found.start()] + new + text[found.end() :]


def _lines(draw: Random, text: str, words) -> str:
    """A line left out, doubled, moved, cut, joined, or many of them."""
    lines = text.split("\n")
    at, kind = draw.randrange(len(lines)), draw.randrange(7)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines[at:at] = [lines[at]] * draw.choice((1, 2, 50))
    elif kind == 2:
        other = draw.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 3:
        lines[at] = lines[at][: draw.randrange(len(lines[at]) + 1)]
    elif kind == 4:
        lines[at : at + 2] = ["".join(lines[at : at + 2])]
    elif kind == 5:
        lines[at:at] = [draw.choice(("", " ", "#", "\t"))] * draw.choice((1, 3, 5_000))
    else:
        draw.shuffle(lines)
    return "\n".join(lines)


def _said(draw: Random, text: str, words) -> str:
    """A comment or a header of words that mean something."""
    said = " ".join(draw.choice(words + NUMBERS) for _ in range(draw.randint(1, 6)))
    lines = text.split("\n")
    lines.insert(draw.randrange(len(lines) + 1), draw.choice(("# ", "", "% ", "! ", "// ", ";")) + said)
    return "\n".join(lines)


def _sign(draw: Random, text: str, words) -> str:
    for _ in range(draw.choice((1, 1, 5, 40))):
        at = draw.randrange(len(text) + 1)
        text = text[:at] + draw.choice(SIGNS) + text[at + draw.randrange(2) :]
    return text


def _longer(draw: Random, text: str, words) -> str:
    """A run of one sign, a word or a number of many letters, somewhere."""
    at = draw.randrange(len(text) + 1)
    piece = draw.choice((" ", "\n", "(", "[", "1", "-", "9e", '"', ",", "a", "theta_i ", "#", "\t", "nm "))
    count = draw.choice(LONG) // len(piece)
    return text[:at] + piece * count + text[at:]


def _mark(draw: Random, text: str, words) -> str:
    """Another separator everywhere."""
    old, new = draw.choice(",;\t "), draw.choice((",", ";", "\t", " ", ", ", "  ", "|", ",,"))
    return text.replace(old, new)


def _cut(draw: Random, text: str, words) -> str:
    return text[: draw.randrange(len(text) + 1)]


CHANGES = (_number, _number, _number, _all_numbers, _word, _word, _lines, _lines, _said, _sign, _longer, _mark, _cut)


def encoded(draw: Random, text: str) -> bytes:
    """Mostly UTF-8, sometimes not, sometimes with other ends of lines, now and then with a bit turned."""
    text = text.replace("\n", draw.choice(("\n",) * 8 + ("\r\n", "\r", "\n\r")))
    how = draw.choice(("utf-8",) * 10 + ("utf-8-sig", "utf-16", "utf-16-be", "latin-1", "utf-32"))
    data = bytearray(text.encode(how, "replace" if how == "latin-1" else "surrogatepass"))
    if draw.random() < 0.1 and data:
        for _ in range(draw.randint(1, 8)):
            data[draw.randrange(len(data))] = draw.randrange(256)
    return bytes(data)


def packed(draw: Random, data: bytes) -> bytes:
    """Seldom compressed, in one member or several, with something behind, or damaged."""
    if draw.random() > 0.08:
        return data
    pack = draw.choice((gzip.compress, bz2.compress, lzma.compress))
    half = draw.randrange(len(data) + 1)
    made = draw.choice((pack(data), pack(data[:half]) + pack(data[half:]), pack(data) + b"behind", pack(pack(data))))
    return made[: draw.randrange(len(made) + 1)] if draw.random() < 0.2 else made
