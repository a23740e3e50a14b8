"""Photographs beside what was made of them: the pixels used, the recommended model's rendering, and the difference."""

from pathlib import Path

import numpy as np
from matplotlib.colors import TwoSlopeNorm

from ... import printable
from ...fitting.reading import reading
from ...models.surface import Surface
from ...photographs import extract, plan
from ...photographs.sight import Sight
from ...physics import colour
from ...physics.aperture import Instrument
from ...physics.geometry import Geometry, rows
from . import style

ACROSS = 240  # pixels that are drawn of a shot
GRAZING = 0.03  # cosine below which nothing is rendered
OFF = 0.2  # ln of model over photograph, where the difference has its full colour
USED = np.array([0.0, 0.447, 0.698])  # linear sRGB: the palette's blue
CAPTION = (
    "Each photograph; in blue the pixels that were used; the recommended model rendered under the lamp that was found; "
    "and model over photograph, orange where the model is brighter."
)


def shot_figures(file, surface: Surface) -> list[style.PageFigure]:
    """The pictures that a description names, with a surface fitted to them."""
    described = plan.planned(Path(file).read_text(encoding="utf-8-sig"), str(file))
    found = extract.extract(described)
    with style.look():
        fig = style.figure(180, 46 * len(found.sights))
        axes = fig.subplots(len(found.sights), 4, squeeze=False)
        for row, seen in zip(axes, found.sights, strict=True):
            _shot(row, seen, surface, described.wavelength_um)
        return [(style.figure_file(fig), CAPTION)]


def _shot(row, seen: Sight, surface: Surface, wavelength) -> None:
    stride = max(1, max(seen.used.shape) // ACROSS)
    part = (slice(None, None, stride), slice(None, None, stride))
    light, used, unit = seen.light[part].astype(float), seen.used[part], seen.unit[part].astype(float)
    points = seen.points[part]
    with np.errstate(invalid="ignore"):
        cos_i = np.einsum("...k,...k", points.normal, points.toward_lamp(seen.lamp))
        lit = (points.cos_r > GRAZING) & (cos_i > GRAZING) & np.isfinite(unit).all(-1)
    geom = rows(Geometry(points[lit].directions(seen.lamp), wavelength))
    model = np.zeros(light.shape)
    model[lit] = reading(surface, Instrument(geom, None)) * unit[lit]
    white = float(np.quantile(light[used], 0.995))
    photograph = _displayed(light / white)
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.where(used, np.log(model.mean(-1) / light.mean(-1)), np.nan)
    marked = np.where(used[..., None], 0.5 * photograph + 0.5 * _displayed(USED), photograph)
    pictures = (photograph, marked, _displayed(model / white))
    for axis, picture, title in zip(
        row, pictures, (printable.label(seen.label.replace(" degrees", "°"), 40), "used", "model"), strict=False
    ):
        axis.imshow(picture, interpolation="nearest")
        axis.set_title(title, fontsize=7)
    drawn = row[3].imshow(off, cmap="PuOr_r", norm=TwoSlopeNorm(0, -OFF, OFF), interpolation="nearest")
    row[3].set_title(f"ln(model/photograph), median {np.nanmedian(np.abs(off)):.1%} off", fontsize=7)
    row[3].figure.colorbar(drawn, ax=row[3], shrink=0.8)
    for axis in row:
        axis.set_xticks([])
        axis.set_yticks([])


def _displayed(light) -> np.ndarray:
    return colour.encoded(np.clip(np.nan_to_num(light), 0.0, 1.0))
