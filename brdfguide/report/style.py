"""The one look of all figures: colours, lines, sizes, and files that come out the same twice.

Colours are Okabe and Ito's, told apart by colour-blind readers; each comes with a line and a marker of its own, so that
a print in grey still works. No pyplot and no global state: figures are made and saved inside `look()`.
"""

from io import BytesIO
from pathlib import Path
from textwrap import wrap

from matplotlib import rc_context
from matplotlib.figure import Figure

from ..outputs import picture_kind, write_whole

INK = "#1f2328"  # text, axes and data; the report page turns it over in the dark
RULE = "#c9ced6"  # what stands behind the data
PAPER = "#ffffff"
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8A6D3B", "#777777")
DASHES = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (6, 1.6, 1.2, 1.6)), (0, (3, 1.2)), "-", (0, (5, 1.6)), (0, (1.2, 1.2)))
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
DOTS_PER_INCH = 200

RC = {
    "font.family": "DejaVu Sans", "font.size": 8, "axes.titlesize": 8.5, "axes.labelsize": 8, "legend.fontsize": 7.5,
    "xtick.labelsize": 7.5, "ytick.labelsize": 7.5, "axes.linewidth": 0.7, "lines.linewidth": 1.3, "lines.markersize": 2.6,
    "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True, "xtick.major.width": 0.7,
    "ytick.major.width": 0.7, "xtick.minor.width": 0.5, "ytick.minor.width": 0.5, "xtick.major.size": 3.2, "ytick.major.size": 3.2,
    "xtick.minor.size": 1.8, "ytick.minor.size": 1.8, "axes.titlelocation": "left", "axes.titlepad": 4, "legend.frameon": False,
    "legend.handlelength": 2.6, "axes.edgecolor": INK, "axes.labelcolor": INK, "text.color": INK, "xtick.color": INK,
    "ytick.color": INK, "grid.color": RULE, "grid.linewidth": 0.5, "axes.axisbelow": True, "mathtext.fontset": "dejavusans",
    "svg.hashsalt": "brdfguide", "svg.fonttype": "path", "pdf.fonttype": 42, "figure.facecolor": PAPER, "axes.facecolor": "none",
}  # fmt: skip


def look():
    """Inside `with look():` matplotlib draws in this style."""
    return rc_context(RC)


def figure(width_mm: float = 180, height_mm: float = 120) -> Figure:
    """An empty figure of a journal's width; call inside `look()`."""
    return Figure(figsize=(width_mm / 25.4, height_mm / 25.4), dpi=DOTS_PER_INCH, layout="constrained")


def origin(fig, text: str) -> None:
    """Lines under the figure: where its data come from."""
    letters = int(fig.get_figwidth() * 72 / 3.6)
    fig.supxlabel("\n".join(line for each in text.split("\n") for line in wrap(each, letters)), fontsize=6.5, x=0.995, ha="right", color=INK)


def render(fig: Figure, kind: str = "svg") -> bytes:
    """The figure as a file; the same bytes each time."""
    undated = {"png": {"Software": None}, "svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None, "Producer": None, "Creator": None}}
    out = BytesIO()
    with look():
        fig.savefig(out, format=kind, metadata=undated[kind], dpi=DOTS_PER_INCH)
    return out.getvalue()


def save(fig: Figure, path: Path) -> None:
    """Write the figure whole or not at all; an old picture is replaced. Raises InputError where it cannot be written."""
    write_whole(path, render(fig, picture_kind(path)))
