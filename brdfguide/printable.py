"""Text made fit for where it goes. Names come with files of other people: a name is shown, never obeyed.

`line` is what all of it rests on: one line of letters that print. What does not print is shown by its number, `\\x1b`,
`\\u202e`, `\\r`: everything of Unicode's category C (control and format characters, marks that turn the reading
direction, lone surrogates, unassigned code points) and the separators of lines. A byte of a file's name that is not
UTF-8 is shown as that byte, `\\xff`.
"""

from math import expm1

MOST_LETTERS = 1200  # of a line in an error; the longest of ours, the names of all models, has some 700
MOST_OF_A_WORD = 300  # a path has that much
MOST_OF_A_COMMENT, BYTES_OF_A_COMMENT = 1800, 1900  # of a line of it, such as the command that made a file
MOST_LINES = 60  # of an error
MOST_OF_A_NAME = 80  # letters of an identifier, and of what is quoted in a sentence
LEAST_PERCENT = 1e-3  # what is less is printed as none
LEAST_NOISE = 1e-4  # of values, below which it is told as less than this
MOST_SPELT = 1e5  # of a factor in words; beyond, its power of ten
MOST_BYTES = 255  # of a file's name, where file systems end
SHORT = {"\n": "\\n", "\r": "\\r", "\t": "\\t"}
# Words of the languages that we write; a name may be one of them, an identifier may not.
_WORDS = """
    alias and bool break case catch char class closure color const continue default delete discard do double else enum
    extern false float for friend goto if illuminance illuminate in inherit inline inout int long main matrix new normal
    not operator or out output point private protected public return shader short signed sizeof static string struct
    switch template this throw true try typedef uniform union unsigned varying vector virtual void volatile while
"""
RESERVED = frozenset(_WORDS.split())
# Our own signs where an encoding lacks them. Greek letters are named, letters with accents lose these, of sketches the
# ink is left, and everything else is shown by its number.
PLAIN = {
    "±": "+-", "°": " deg", "µ": "u", "√": "sqrt", "∛": "cbrt", "∫": "integral ", "∂": "d", "∇": "grad ", "∞": "inf",
    "·": "*", "∙": "*", "⋅": "*", "×": "x", "≤": "<=", "≥": ">=", "≈": "~", "≠": "!=", "→": "->", "⟨": "<", "⟩": ">",
    "–": "-", "—": "-", "−": "-", "‐": "-", "‑": "-", "’": "'", "‘": "'", "“": '"', "”": '"', "∆": "Delta",
    "█": "#", "▉": "#", "▊": "#", "▋": "#", "▌": "#", "▍": " ", "▎": " ", "▏": " ", "│": "|", "─": "-", "◆": "*",
}  # fmt: skip


def line(text) -> str:
    """One line of letters that print; spaces of every width are a space."""
    text = str(text)
    return text if text.isprintable() else "".join(map(_letter, text))


def _letter(letter: str) -> str:
    if letter.isprintable():
        return letter
    code = ord(letter)
    if letter in SHORT:
        return SHORT[letter]
    if letter.isspace() and code > 0x9F and code not in (0x2028, 0x2029):
        return " "
    if 0xDC80 <= code <= 0xDCFF:  # how Python carries a byte that is no UTF-8
        return f"\\x{code - 0xDC00:02x}"
    return f"\\x{code:02x}" if code < 0x100 else _number(code)


def _number(code: int) -> str:
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def lines(text: str) -> str:
    """The same of each line of a text of ours, between its tabulators."""
    if text.replace("\n", "").replace("\t", "").isprintable():
        return text
    return "\n".join("\t".join(map(line, each.split("\t"))) for each in text.split("\n"))


def document(value):
    """The same of every text in a document, keys included: what words are made of."""
    if isinstance(value, str):
        return line(value)
    if isinstance(value, dict):
        return {line(key): document(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [document(item) for item in value]
    return value


def short(text, most: int = MOST_OF_A_NAME) -> str:
    """A line of at most so many letters, without its middle where there are more."""
    text = line(text)
    if len(text) <= most:
        return text
    gap = f"...({len(text)} letters)..."
    kept = max(most - len(gap), 6)
    return text[: kept - kept // 3] + gap + text[len(text) - kept // 3 :]


def sentence(text) -> str:
    """A line for an error: neither it nor a word of it grows with what it speaks of."""
    text = line(text)
    if len(text) > MOST_OF_A_WORD:
        text = " ".join(short(word, MOST_OF_A_WORD) for word in text.split(" "))
    return short(text, MOST_LETTERS)


def sentences(texts) -> str:
    """Several of them, a line each."""
    texts = list(texts)
    more = [f"and {len(texts) - MOST_LINES} more"] if len(texts) > MOST_LINES else []
    return "\n".join([*map(sentence, texts[:MOST_LINES]), *more])


def comment(text) -> str:
    """A line of a comment in any language: it does not go on into the next one, nor beyond what a reader takes as one.

    Radiance reads 2047 bytes of a comment and takes the rest for a scene, in which `!` is a command.
    """
    made, most = short(text, MOST_OF_A_COMMENT), MOST_OF_A_COMMENT
    while len(made.encode()) > BYTES_OF_A_COMMENT:
        most //= 2
        made = short(text, most)
    return made.rstrip("\\ ")


def identifier(name: str) -> str:
    """A name that every target takes: ASCII letters, digits and single underscores, first a letter, no word of a
    language and none of our own functions."""
    clean = "".join(letter if letter.isascii() and letter.isalnum() else " " for letter in name[: 10 * MOST_OF_A_NAME])
    clean = "_".join(clean.split())[:MOST_OF_A_NAME].rstrip("_") or "surface"
    first = clean.partition("_")[0]
    return clean if clean[0].isalpha() and clean not in RESERVED and first not in ("bg", "gl") else f"m_{clean}"


def cell(text) -> str:
    """A cell of a CSV: quoted where it must be, and never a formula for a spreadsheet."""
    text = line(text)
    if text[:1] in ("=", "+", "-", "@"):
        text = f"'{text}"
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',";') or text != text.strip() else text


def label(text, most: int = 200) -> str:
    """Text in a figure: never a formula."""
    return short(text, most).replace("$", r"\$")


def stem(name: str, room: int = 0) -> str:
    """The name of a file without control characters and separators, with room for so many bytes behind it."""
    clean = line(name).replace("/", "_").replace("\\", "_").replace("\0", "_")
    return clean.encode()[: MOST_BYTES - room].decode(errors="ignore") or "_"


def word(name: str) -> str:
    """The name of a file as one word of a scene: ASCII letters, digits, dots, hyphens and underscores.

    Radiance takes no word of more than 127.
    """
    clean = "".join(letter if letter.isascii() and (letter.isalnum() or letter in "._-") else "_" for letter in name)
    return (clean if clean[:1].isalnum() else f"m{clean}")[:MOST_OF_A_NAME]


def width(text: str) -> int:
    """Columns of a terminal that a line takes: two for a letter of East Asia, none for a mark upon another letter."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(letter) else 1 + (east_asian_width(letter) in "WF") for letter in text)


def shown(error: UnicodeError):
    """Of codecs: what an encoding lacks, in signs that it has. `codecs.register_error("shown", shown)`."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_plain, error.object[error.start : error.end])), error.end


def _plain(letter: str) -> str:
    """A letter in ASCII."""
    from unicodedata import combining, name, normalize

    if letter in PLAIN:
        return PLAIN[letter]
    if "\u2800" <= letter <= "\u28ff":  # braille
        return ":" if letter > "\u2800" else " "
    found = ""
    for part in normalize("NFKD", letter):
        kind, _, word = name(part, "").partition(" LETTER ")
        if kind.startswith("GREEK") and word:
            found += word.split()[0].lower() if "SMALL" in kind else word.split()[0].capitalize()
        elif part.isascii():
            found += part
    if found or combining(letter):
        return found
    return _number(ord(letter)) if letter.isprintable() else _letter(letter)


def off_words(percent: float) -> str:
    """How far off a model typically is; what is no longer a percentage as a factor."""
    if percent < 9.95:
        return f"{percent if percent >= LEAST_PERCENT else 0:.2g} %"
    if percent < 99.5:
        return f"{percent:.0f} %"
    factor = float(f"{min(1 + percent / 100, 1e9):.2g}")
    return f"a factor {factor:.0f}" if 100 <= factor < MOST_SPELT else f"a factor {factor:.2g}"


def off_words_of(rms_ln: float) -> str:
    """The same of an rms of ln."""
    return off_words(100 * expm1(min(rms_ln, 50.0)))
