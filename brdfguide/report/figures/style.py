"""The one look of all figures: sizes, type, and files that come out the same twice; colours are those of `palette`.

No pyplot and no global state: figures are made and saved inside `look()`.
"""

from io import BytesIO
from pathlib import Path
from textwrap import wrap
from warnings import catch_warnings, filterwarnings

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from ...files import picture_kind, write_whole
from ...printable import label
from . import dark
from .palette import COLOURS, DARK, DASHES, INK, LIGHT, MARKERS, PAPER, RULE

__all__ = [
    "COLOURS", "DARK", "DASHES", "INK", "LIGHT", "MARKERS", "PAPER", "RULE",
    "PageFigure", "figure", "figure_file", "look", "origin", "save", "title", "freeze_layout",
]  # fmt: skip
# of a page: an SVG file, or pictures as (PNG file, name, words); and a caption of the whole
PageFigure = tuple[bytes | list[tuple[bytes, str, str]], str]
DOTS_PER_INCH = 200
MOST_OF_A_LINE = 600  # letters of a line below a figure, before it is folded

RC: dict = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8,
    "legend.fontsize": 7.5,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "axes.linewidth": 0.7,
    "lines.linewidth": 1.3,
    "lines.markersize": 2.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.pad": 5,
    "ytick.major.pad": 5,
    "xtick.top": True,
    "ytick.right": True,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "xtick.minor.width": 0.5,
    "ytick.minor.width": 0.5,
    "xtick.major.size": 3.2,
    "ytick.major.size": 3.2,
    "xtick.minor.size": 1.8,
    "ytick.minor.size": 1.8,
    "axes.titlelocation": "left",
    "axes.titlepad": 4,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "grid.color": RULE,
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "mathtext.fontset": "dejavusans",
    "svg.hashsalt": "brdfguide",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "figure.facecolor": PAPER,
    "axes.facecolor": "none",
}


def look():
    """Inside `with look():` matplotlib draws in this style."""
    return rc_context(RC)


def figure(width_mm: float = 180, height_mm: float = 120) -> Figure:
    """An empty figure of a journal's width; call inside `look()`."""
    return Figure(figsize=(width_mm / 25.4, height_mm / 25.4), dpi=DOTS_PER_INCH, layout="constrained")


def title(fig, text: str) -> None:
    """What the whole figure shows, above it, on as many lines as it takes."""
    fig.suptitle("\n".join(wrap(text, int(fig.get_figwidth() * 72 / 4.55))), fontsize=9, x=0.01, ha="left")


def origin(fig, text: str) -> None:
    """Lines under the figure, none of them a formula: where its data come from."""
    letters = int(fig.get_figwidth() * 72 / 3.6)
    fig.supxlabel(
        "\n".join(
            line
            for each in text.split("\n")
            for line in wrap(label(each, MOST_OF_A_LINE), letters, break_on_hyphens=False)
        ),
        fontsize=6.5,
        x=0.995,
        ha="right",
        color=INK,
    )


def figure_file(fig: Figure, kind: str = "svg", theme: str = LIGHT) -> bytes:
    """The figure as a file, light or dark; the same bytes each time."""
    undated = {
        "png": {"Software": None},
        "svg": {"Date": None, "Creator": None},
        "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    }
    if theme == DARK:
        dark.darken(fig)
    out = BytesIO()
    with look(), catch_warnings():
        filterwarnings("ignore", "Glyph")  # a letter of a name that the font lacks is drawn as a box
        freeze_layout(fig)
        fig.savefig(out, format=kind, metadata=undated[kind], dpi=DOTS_PER_INCH)
    return out.getvalue()


def freeze_layout(fig: Figure) -> None:
    """Lays the figure out for good, its axes where the layout's rounding, which differs from run to run, is gone."""
    if fig.get_layout_engine() is None:
        return
    fig.draw_without_rendering()
    fig.set_layout_engine("none")
    for part in fig.subfigs:
        part.bbox_relative.set_points(np.round(part.bbox_relative.get_points(), 5))
    for axis in fig.axes:
        axis.set_position(np.round(axis.get_position().bounds, 5).tolist())


def save(fig: Figure, path: Path, theme: str = LIGHT) -> None:
    """Write the figure whole or not at all; an old picture is replaced.

    Raises InputError where it cannot be written.
    """
    write_whole(path, figure_file(fig, picture_kind(path), theme))
