"""Colours, dashes and markers, and which of them a law has: the same in every picture, for ever.

Colours are Okabe and Ito's, told apart by colour-blind readers; dashes and markers besides, so that a print in grey
still works. Loads no plotting library.
"""

from hashlib import md5

from ...records import dataclass

LIGHT, DARK = THEMES = ("light", "dark")
INK = "#1f2328"  # text, axes and data; the report page turns it over in the dark
RULE = "#c9ced6"  # what stands behind the data
PAPER = "#ffffff"
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8A6D3B", "#777777")
DASHES = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (6, 1.6, 1.2, 1.6)), (0, (3, 1.2)), (0, (9, 2)), (0, (2, 2)), "-")
LAW_DASHES = 5  # how many of them tell apart what a law stands on
# Ours: the first numbers for which the laws that one figure shows (of facets, of wave optics, Lafortune's, Ward's and
# Phong's) have eight colours, and candidates of one colour dashes of their own. A law keeps its look for ever, since
# its name alone decides.
HUE, DASH = 389428, 514346
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")


@dataclass(frozen=True)
class Stroke:
    """How a model is drawn."""

    colour: str
    dashes: str | tuple
    marker: str


def stroke(law: str, name: str) -> Stroke:
    """The look of a model for ever: its colour and marker are those of its law, its dashes those of the sum."""
    hue = _drawn(HUE, law) % len(COLOURS)
    return Stroke(COLOURS[hue], DASHES[_drawn(DASH, name) % LAW_DASHES], MARKERS[hue])


def _drawn(salt: int, name: str) -> int:
    return md5(f"{salt} {name}".encode(), usedforsecurity=False).digest()[0]


# light -> dark; contrast on the dark paper is 4.5 and more for all that is read
SWAPPED = {
    "#1f2328": "#e8eaed",
    "#ffffff": "#14171a",
    "#c9ced6": "#4a525c",
    "#0072b2": "#5291ff",
    "#d55e00": "#ff8a3d",
    "#009e73": "#35c79a",
    "#cc79a7": "#e8a0c8",
    "#e69f00": "#f2b632",
    "#56b4e9": "#9ad2f6",
    "#8a6d3b": "#c9a86a",
    "#777777": "#a8a8a8",
    "#000000": "#e8eaed",
    "#5b3a8c": "#b79be8",
    "#cfe3f2": "#2b3f50",
    "#c1272d": "#ff6b6b",
}
