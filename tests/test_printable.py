"""Nothing that a name holds acts where it is shown: sampled over all of Unicode."""

import random
from unicodedata import category

import pytest

from brdfguide import printable

# A letter of every category, the whole of those that do harm, and a sample of the rest.
HARMFUL = [chr(code) for code in range(0x110000) if category(chr(code)) in ("Cc", "Cf", "Cs", "Zl", "Zp")]
REST = random.Random(16).sample(range(0x110000), 3000)
HOSTILE = "a\r\n\t\0\x1b[31m\x85\u2028\u2029\u202e\ud800\udcff\x7f\xa0$\\frac{$ -- */ \" ' \\"


def prints(text: str) -> bool:
    """One line in which every sign is a letter, by Unicode's own categories."""
    return all(category(each)[0] != "C" and category(each) not in ("Zl", "Zp") for each in text)


def test_a_line_has_nothing_that_acts():
    for letter in [*HARMFUL, *map(chr, REST)]:
        shown = printable.line(f"a{letter}b")
        assert prints(shown) and shown[0] == "a" and shown[-1] == "b", ascii(letter)


def test_what_prints_stays_as_it_is():
    for text in ("rough plastic", "größe", "白い塗料", "±0.1 °", "a\\b $x$", "👍"):
        assert printable.line(text) == text


def test_a_byte_of_a_name_is_shown_as_that_byte():
    assert printable.line(b"a\xff\xe9.csv".decode("utf-8", "surrogateescape")) == r"a\xff\xe9.csv"
    assert printable.line("a\rb\nc\x1b\u202e\ud800\u2028") == r"a\rb\nc\x1b\u202e\ud800\u2028"


def test_a_document_is_shown_with_its_keys_and_lists():
    shown = printable.document({"a\n": ["b\r", {"c": "d\x1b"}], "n": 1.5, "t": ("e\t",)})
    assert shown == {"a\\n": ["b\\r", {"c": "d\\x1b"}], "n": 1.5, "t": ["e\\t"]}


def test_lines_of_ours_keep_their_ends_and_tabulators():
    assert printable.lines("a\tb\nc\x1b\td\n") == "a\tb\nc\\x1b\td\n"


@pytest.mark.parametrize("most", [20, 80, 300])
def test_what_is_shortened_says_so_and_keeps_both_ends(most):
    text = "begin" + "x" * 10_000 + "end"
    shown = printable.short(text, most)
    assert len(shown) <= max(most, 30) and shown.startswith("b") and shown.endswith("d") and "10008 letters" in shown
    assert printable.short("x" * most, most) == "x" * most


def test_sentences_do_not_grow_with_what_they_speak_of():
    long = printable.sentence("found '" + "k" * 60_000 + "' in line 3")
    assert len(long) < 400 and long.endswith("in line 3")
    assert len(printable.sentence("a b " * 60_000)) <= printable.MOST_LETTERS
    many = printable.sentences(f"x.yaml:{number}: wrong" for number in range(10_000)).split("\n")
    assert len(many) == printable.MOST_LINES + 1 and many[-1] == f"and {10_000 - printable.MOST_LINES} more"


def test_a_comment_ends_with_its_line():
    for name in (HOSTILE, "a\\", "a\\\\ ", "x" * 100_000 + "\\", "👍" * 3000, "\udcff" * 3000):
        shown = printable.comment(name)
        assert prints(shown) and not shown.endswith("\\") and len(shown.encode()) <= printable.BYTES_OF_A_COMMENT


@pytest.mark.parametrize(
    "name", ["", " ", "1", "größe", "color", "void", "bg", "bg brdf", "gl_x", "a--b", HOSTILE, "白", "x" * 10**6, "_a_"]
)
def test_an_identifier_is_one_in_every_language(name):
    made = printable.identifier(name)
    assert made.isascii() and made.isidentifier() and made[0].isalpha() and "__" not in made and made[-1] != "_"
    assert made not in printable.RESERVED and not made.startswith(("bg_", "gl_")) and made not in ("bg", "gl")
    assert len(made) <= printable.MOST_OF_A_NAME + 2


def test_a_cell_is_quoted_where_it_must_be_and_no_formula():
    assert printable.cell("550 nm") == "550 nm"
    assert printable.cell('a,"b"') == '"a,""b"""'
    assert printable.cell("=HYPERLINK(1)") == "'=HYPERLINK(1)" and printable.cell("@x")[0] == "'"
    assert printable.cell("a\nb\rc") == r"a\nb\rc"


def test_a_label_is_no_formula():
    assert printable.label("$\\frac{$") == "\\$\\frac{\\$"


def test_a_stem_fits_into_a_name_of_a_file():
    assert printable.stem("paint 1.csv") == "paint 1.csv"
    for name in ("a/b\\c\0d\n", "é" * 300, "\udcff" * 300, ""):
        made = printable.stem(name, room=30)
        assert made and prints(made) and not set(made) & set("/\0") and len(made.encode()) <= 225


def test_a_word_of_a_scene_has_no_spaces():
    assert printable.word("paint-2.b") == "paint-2.b"
    for name in ("my paint", "x\n!touch P\n#", "-a", ".a", "", "größe"):
        assert not set(printable.word(name)) - set("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-")
        assert printable.word(name)[0].isalnum()


def test_columns_count_what_a_terminal_shows():
    assert [printable.width(text) for text in ("abc", "白い", "e\u0301", "±")] == [3, 4, 1, 1]


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "latin-1", "cp437", "utf-8"])
def test_signs_that_an_encoding_lacks_are_shown_in_those_that_it_has(encoding):
    import codecs

    codecs.register_error("shown", printable.shown)
    text = "0.1±0.02 at 45° σ 1 µm, é 白 ⣿ █ \udcff"
    shown = text.encode(encoding, "shown").decode(encoding)
    assert prints(shown) and "0.1" in shown and "?" not in shown
    if encoding == "ascii":
        assert shown == r"0.1+-0.02 at 45 deg sigma 1 um, e \u767d : # \xff"


def test_how_far_off_is_a_percentage_or_a_factor_in_plain_digits():
    told = {
        0.0001: "0 %",
        7.44: "7.4 %",
        42.4: "42 %",
        99.6: "a factor 2",
        10_700.0: "a factor 110",
        1e13: "a factor 1e+09",
    }
    assert {percent: printable.off_words(percent) for percent in told} == told
