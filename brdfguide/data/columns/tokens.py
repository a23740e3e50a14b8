"""A name or a line as words, numbers and signs, however it is spelt: `BRDF_550nm`, `thetaIn [°]`, `u(f) / sr⁻¹`."""

import re
import unicodedata
from dataclasses import dataclass

LONGEST = 1000  # letters of a name or a line that are looked at: nobody says more with one
PIECE = re.compile(r"[^\W\d_]+|\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?|[.,]\d+|\S")  # a word, a number, or one sign
CASE_CHANGE = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")  # where ThetaIn and BRDFStd fall apart
OPENING = "([{"
CLOSING = ")]}"
# what Unicode's compatibility form leaves apart or would spoil; μ stays, since μm is a unit
SPELT_OUT = str.maketrans(
    {
        **dict.fromkeys("º˚", "°"),
        **dict.fromkeys("−–—‐‑", "-"),
        **dict.fromkeys("×·∙⋅", "*"),
        **dict.fromkeys("Δδ∆", " delta "),
        **dict.fromkeys("θϑΘ", " theta "),
        **dict.fromkeys("φϕΦ", " phi "),
        **dict.fromkeys("λΛ", " lambda "),
        **dict.fromkeys("ψΨ", " psi "),
        "α": " alpha ",
        "β": " beta ",
        "σ": " sigma ",
        "π": " pi ",
        "Å": " angstrom ",
        "\N{ANGSTROM SIGN}": " angstrom ",
        "µ": "μ",
        "±": " +- ",
    }
)


@dataclass(frozen=True, slots=True)
class Token:
    """A word in lower case, a number, or a sign; `depth` counts the brackets around it."""

    text: str
    depth: int = 0

    @property
    def is_number(self) -> bool:
        return self.text[-1] in "0123456789"

    @property
    def is_word(self) -> bool:
        return self.text[0].isalpha()

    @property
    def is_power_of_ten(self) -> bool:
        """Whether it is 10, 100, 1000, or written as 1e-3."""
        return self.text.startswith("1e") or len(self.text) > 1 and self.text[0] == "1" and not self.text[1:].strip("0")

    @property
    def number(self) -> float:
        return float(self.text.replace(",", "."))


def tokens(text: str, known: frozenset[str] = frozenset()) -> list[Token]:
    """The tokens of the first thousand letters; a word that is not `known` is taken apart into words that are."""
    plain = unicodedata.normalize("NFKC", text[:LONGEST].translate(SPELT_OUT)).translate(SPELT_OUT)
    plain = plain.replace("..", " - ")  # 400..700
    found, depth = [], 0
    for piece in PIECE.findall(plain):
        if piece in OPENING:
            depth += 1
        elif piece in CLOSING:
            depth = max(depth - 1, 0)
        elif piece[0].isalpha():
            found += [Token(word, depth) for word in words_of(piece, known)]
        elif piece not in ("_", "."):
            found.append(Token(piece, depth))
    return found


def words_of(piece: str, known: frozenset[str]) -> list[str]:
    """`ThetaIn` as theta, in; `incidentangle` as incident, angle; a word without known parts stays whole."""
    if piece.lower() in known:
        return [piece.lower()]
    found = []
    for part in CASE_CHANGE.split(piece):
        found += _parted(part.lower(), known)
    return found


def _parted(word: str, known: frozenset[str]) -> list[str]:
    """The fewest known words of three letters and more that together make this one; itself where there are none."""
    if word in known or not 6 <= len(word) <= 60:
        return [word]
    fewest: list[list[str] | None] = [[]] + [None] * len(word)
    for end in range(3, len(word) + 1):
        for start in range(end - 2):
            before = fewest[start]
            if before is None or word[start:end] not in known:
                continue
            best = fewest[end]
            if best is None or len(before) + 1 < len(best):
                fewest[end] = [*before, word[start:end]]
    return fewest[-1] or [word]
