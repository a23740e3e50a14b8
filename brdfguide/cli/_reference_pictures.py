"""The pictures of the reference, every law drawn and every material on a ball, and with names those alone:
`python -m brdfguide.cli._reference_pictures docs/pictures [NAME...]`.

A law is drawn with its default parameters; a material as the model that `recommend` names first for it.
"""

import io
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from .. import exporters, models
from ..advice import library, material, recommend
from ..models.surface import Surface
from ..physics.geometry import rows, signed
from ..report import render
from ..report.figures import style
from ..report.grained_view import has_grain

LAWS, MATERIALS = "laws", "materials"  # folders
INCIDENCES_DEG = (10.0, 45.0, 75.0)
DECADES = 5.0  # from the greatest value down
WIDTH_MM, HEIGHT_MM = 70.0, 40.0
BALL = 96  # pixels
FINER = 2  # times: the picture is drawn, and then made smaller
PICTURE = 312  # pixels of the whole, of which the ball takes a square of FINER * BALL
INKS, BALL_COLOURS = 32, 128  # colours that a picture needs, which make its file small
UNDRAWN = {"mirror"}  # without a finite part


def law_picture(name: str) -> bytes:
    """A PNG of a law's BRDF against the reflection angle, in the plane of incidence, at three incidences."""
    surface = Surface(models.get(name), {})
    theta_r = np.linspace(-89.0, 89.0, 713)
    with style.look():
        fig = style.figure(WIDTH_MM, HEIGHT_MM)
        axis = fig.add_subplot()
        greatest = 0.0
        for theta_i, colour, dashes in zip(INCIDENCES_DEG, style.COLOURS, style.DASHES, strict=False):
            value = np.mean(surface.brdf(rows(signed(theta_i, theta_r))), axis=1)
            greatest = max(greatest, float(np.max(value)))
            shown = np.where(value > 0, value, np.nan)
            axis.plot(theta_r, shown, color=colour, linestyle=dashes, label=f"light at {theta_i:g}°")
        axis.set_yscale("log")
        low = greatest * 10**-DECADES
        axis.set_ylim(low, 3 * greatest)
        axis.set_xlim(-90, 90)
        axis.set_xticks([-90, -45, 0, 45, 90])
        axis.set_xlabel("reflection angle [deg]")
        axis.set_ylabel("BRDF [1/sr]")
        axis.legend(fontsize=6, loc="lower left" if _is_free(axis, low) else "best")
        return _small(style.figure_file(fig, "png"), INKS)


def _is_free(axis, low: float) -> bool:
    """Whether no curve passes through the corner below, on the left."""
    for line in axis.lines:
        angles, values = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        if np.any((angles < -25) & (values < low * 10 ** (0.45 * DECADES))):
            return False
    return True


def material_picture(name: str) -> bytes | None:
    """A PNG of a described material on a ball; None where no model is named for it."""
    from PIL import Image

    found = recommend.recommend(material.read_material(library.path(name)), anyway=True)
    if not found.candidates:
        return None
    surface = exporters.coloured(found.candidates[0].surface, name)
    pixels = np.clip(render.tone(render.render(surface, PICTURE, "side")), 0, 1)
    left, top = (PICTURE - FINER * BALL) // 2, round(0.34 * PICTURE) - FINER * BALL // 2  # about the ball's centre
    image = Image.fromarray(np.round(255 * pixels).astype(np.uint8))
    if not has_grain(surface):  # whose picture is of a ball and a disc beside it
        image = image.crop((left, top, left + FINER * BALL, top + FINER * BALL))
    stream = io.BytesIO()
    image.resize((BALL, BALL), Image.Resampling.BOX).save(stream, "PNG")
    return _small(stream.getvalue(), BALL_COLOURS)


def _small(png: bytes, colours: int) -> bytes:
    """The same picture with so many colours at most."""
    from PIL import Image

    image = Image.open(io.BytesIO(png)).convert("RGB")
    fewer = image.quantize(colours, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    stream = io.BytesIO()
    fewer.save(stream, "PNG", optimize=True)
    return stream.getvalue()


def write_pictures(folder: Path, only: Sequence[str] = (), *, missing: bool = False) -> None:
    """Draws those of the names, or all, into two folders; where it says so, what is there already is left."""
    drawn: dict[str, tuple[list[str], Callable[[str], bytes | None]]] = {
        LAWS: ([name for name in models.names() if name not in UNDRAWN], law_picture),
        MATERIALS: ([name for name in library.library_names() if name not in UNDRAWN], material_picture),
    }
    for kind, (names, picture) in drawn.items():
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for name in names:
            path = folder / kind / f"{name}.png"
            if (only and name not in only) or (missing and path.exists()):
                continue
            if (content := picture(name)) is not None:
                path.write_bytes(content)


if __name__ == "__main__":
    write_pictures(Path(sys.argv[1]), sys.argv[2:])
