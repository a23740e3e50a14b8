"""Two surfaces as spheres under three lamps, and the difference in lightness between them."""

import numpy as np

from ...fitting.side_by_side import OneOfTwo
from ...physics import colour, seen
from ...physics.aperture import Instrument
from ...physics.geometry import Geometry
from . import style

LAMPS_DEG = (20.0, 60.0, 110.0)  # from the eye, up to the right
UP = 0.5  # of a lamp's offset that is upward, the rest to the right
FULL = 20.0  # L*, where the difference has its full colour
BEHIND = 0.06  # linear, behind the spheres
LESS = np.array([0.0, 0.447, 0.698])  # linear sRGB: the palette's blue
MORE = np.array([0.835, 0.369, 0.0])  # linear sRGB: the palette's vermilion
MARGIN = 12  # pixels
LINE = 17  # pixels


def pair_figure(one: OneOfTwo, other: OneOfTwo, words: str, size: int = 240):
    """Rows: the two, and how much lighter the second is; columns: lamps at 20, 60 and 110 degrees from the eye.

    A white matt surface that faces the lamp shows as white. A direction without a value is left grey.
    """
    normal, inside = _sphere(size)
    rows: list[list[np.ndarray]] = [[], [], []]
    for angle in LAMPS_DEG:
        geom, lit = _directions(normal, angle)
        instrument = Instrument(geom, one.solid_angle or other.solid_angle)
        values = [side.read(instrument) @ side.colours for side in (one, other)]
        for row, value in zip(rows, values, strict=False):
            row.append(_picture(_shown(value, geom), lit, inside))
        lightness = [seen.lightness(value, geom.cos_i) for value in values]
        rows[2].append(_picture(_difference(np.mean(lightness[1] - lightness[0], axis=1)), lit, inside, ground=1.0))
    labels = (f"A: {one.name}", f"B: {other.name}", "B minus A: orange where B is lighter, blue where darker")
    return _sheet(rows, labels, words, size)


def _sphere(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Normals of the pixels inside the disc (pixels, 3), x right, y up, z to the eye; and which pixels these are."""
    y, x = (np.mgrid[0:size, 0:size] + 0.5) / size * 2 - 1
    inside = np.hypot(x, y) < 0.98
    x, y = x[inside] / 0.98, -y[inside] / 0.98
    return np.stack([x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0.0))], axis=-1), inside


def _directions(normal: np.ndarray, lamp_deg: float) -> tuple[Geometry, np.ndarray]:
    """Lamp and eye in the frame of each normal that the lamp reaches, and which these are."""
    off = np.array([np.sqrt(1 - UP**2), UP, 0.0]) * np.sin(np.radians(lamp_deg))
    lamp = off + np.array([0.0, 0.0, np.cos(np.radians(lamp_deg))])
    lit = (normal @ lamp > 1e-3) & (normal[:, 2] > 1e-3)
    n = normal[lit]
    across = np.cross(n, np.where(np.abs(n[:, 1:2]) < 0.9, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]]))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    along = np.cross(n, across)

    def local(direction):
        return np.stack([across @ direction, along @ direction, n @ direction], axis=-1)[:, None]

    return Geometry.from_vectors(local(lamp), local(np.array([0.0, 0.0, 1.0]))), lit


def _shown(value: np.ndarray, geom: Geometry) -> np.ndarray:
    """Display values (pixels, 3) of π f cos θi, clipped at white."""
    linear = np.clip(np.pi * value * geom.cos_i, 0.0, 1.0)
    return np.broadcast_to(colour.encoded(np.nan_to_num(linear, nan=0.2)), (len(value), 3))


def _difference(brighter: np.ndarray) -> np.ndarray:
    """Colours (pixels, 3) of a difference in lightness [L*]."""
    share = np.clip(np.nan_to_num(brighter) / FULL, -1, 1)[:, None]
    return 1 + np.maximum(share, 0) * (MORE - 1) + np.maximum(-share, 0) * (LESS - 1)


def _picture(colours: np.ndarray, lit: np.ndarray, inside: np.ndarray, ground: float = 0.0) -> np.ndarray:
    behind = colour.encoded(np.array(BEHIND)) if ground == 0.0 else 0.93
    image = np.full((*inside.shape, 3), float(behind))
    on_sphere = np.full((len(lit), 3), ground)
    on_sphere[lit] = colours
    image[inside] = on_sphere
    return image


def _sheet(rows, labels, words: str, size: int):
    """The pictures in exact pixels with words above each row."""
    height = len(rows) * (size + LINE + MARGIN) + 3 * LINE + MARGIN
    width = len(LAMPS_DEG) * (size + MARGIN) + MARGIN
    with style.look():
        fig = style.figure(width / style.DOTS_PER_INCH * 25.4, height / style.DOTS_PER_INCH * 25.4)
        fig.set_layout_engine(None)

        def text(y: int, said: str, **more) -> None:
            fig.text(MARGIN / width, 1 - y / height, said, fontsize=4.5, va="top", **more)

        top = MARGIN
        text(top, words, weight="bold")
        top += 2 * LINE
        for label, pictures in zip(labels, rows, strict=True):
            text(top, label)
            for place, picture in enumerate(pictures):
                fig.figimage(picture, MARGIN + place * (size + MARGIN), height - top - LINE - size, origin="upper")
            top += size + LINE + MARGIN
        lamps = ", ".join(f"{angle:g}" for angle in LAMPS_DEG)
        text(height - LINE, f"lamp {lamps}° from the eye; full colour at {FULL:g} L*")
    return fig
