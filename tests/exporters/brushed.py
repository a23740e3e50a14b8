"""A brushed metal on a sphere and on a disc twice: by our own preview and by Mitsuba from the exported file.

    brdfguide fit brushed_aluminium_azimuths.csv --json > brushed.json
    python -m tests.exporters.brushed docs/pictures/brushed-mitsuba.png brushed.json

Without a fit, of a metal of widths 0.35 and 0.06. Mitsuba's u runs round a sphere's axis, along the grooves, and
outward on its disc, across them: on the sphere the two widths of the file change places. The light is the preview's.
Printed is, of each panel, where the bright part lies, along which angle, and how long and wide it is: second moments of
the luminance above half of the 99th percentile. Needs mitsuba.
"""

import sys

import numpy as np

from brdfguide import exporters, models
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.fitting.saved import read_fit
from brdfguide.report import grained_view, render

VALUES = {"alpha_x": 0.35, "alpha_y": 0.06, "axis": 0.0, "n": 1.0, "k": 4.0}
SURFACE = ColouredSurface(models.get("ggx-aniso"), {f"ggx-aniso.{key}": value for key, value in VALUES.items()})
MARGIN = 1.08  # half the picture's height over the radius
SIZE, SAMPLES, SHEET = 200, 196, 600  # pixels of a panel, rays a pixel, pixels of the preview that panels are cut from
PLACES = {"sphere": (0.265, 0.235), "disc": (0.745, 0.225)}  # centre and radius in the preview


def by_mitsuba(mitsuba, surface: ColouredSurface, shape: str) -> np.ndarray:
    """Radiance (SIZE, SIZE, 3)."""
    text = exporters.export("mitsuba", surface).content
    transform = mitsuba.ScalarTransform4f
    if shape == "sphere":
        text = text.replace("alpha_u", "-").replace("alpha_v", "alpha_u").replace('"-"', '"alpha_v"')
        placed = {"type": "sphere", "to_world": transform().rotate([1, 0, 0], -90)}
    else:
        placed = {"type": "disk", "to_world": transform().rotate([1, 0, 0], -grained_view.DISC_TILT_DEG)}
    height = np.cos(np.pi * (np.arange(2048) + 0.5) / 2048)
    sky = np.repeat(render.sky(height)[:, None, :], 8, axis=1).astype(np.float32)
    camera = transform().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]) @ transform().scale([MARGIN, MARGIN, 1])
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 2},
        "sensor": {
            "type": "orthographic",
            "to_world": camera,
            "sampler": {"type": "multijitter", "sample_count": SAMPLES},
            "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"}},
        },
        "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(sky)},
        "sun": {
            "type": "directional",
            "direction": (-render.sun_direction("front")).tolist(),
            "irradiance": {"type": "rgb", "value": render.SUN.tolist()},
        },
        "shape": {**placed, "bsdf": mitsuba.load_string(text)},
    }
    return np.array(mitsuba.render(mitsuba.load_dict(scene), seed=1))


def cut(image: np.ndarray, place: tuple[float, float]) -> np.ndarray:
    centre, radius = place[0], MARGIN * place[1]
    rows = slice(int((1 - 0.68 - radius) * SHEET), int((1 - 0.68 + radius) * SHEET))
    return image[rows, int((centre - radius) * SHEET) : int((centre + radius) * SHEET)]


def bright_part(image: np.ndarray) -> dict[str, float]:
    """Centre x and y of the bright part, in radii from the middle, its angle [deg] from the picture's x counted
    counter-clockwise, and the length and width of its spread."""
    light = image @ np.array([0.2126, 0.7152, 0.0722])
    y, x = (MARGIN * (2 * np.indices(light.shape) / (np.array(light.shape)[:, None, None] - 1) - 1)) * [[[-1]], [[1]]]
    light = np.where(np.hypot(x, y) < 0.97, light, 0.0)
    weight = np.clip(light / np.quantile(light[light > 0], 0.99), 0.0, 1.0)
    weight = np.where(weight > 0.5, weight, 0.0)
    place = np.stack([x, y]).reshape(2, -1)
    centre = np.average(place, axis=1, weights=weight.ravel())
    spread, axes = np.linalg.eigh(np.cov(place, aweights=weight.ravel()))
    angle = np.degrees(np.arctan2(axes[1, 1], axes[0, 1])) % 180
    return {"x": centre[0], "y": centre[1], "angle": angle, "length": spread[1] ** 0.5, "width": spread[0] ** 0.5}


def main(path: str, fit: str | None = None) -> None:
    import mitsuba
    from matplotlib.figure import Figure

    mitsuba.set_variant("scalar_rgb")
    surface = SURFACE if fit is None else exporters.coloured(read_fit(fit), "fit")
    preview, figure = render.render(surface, SHEET, "front"), Figure(figsize=(7.2, 7.4), layout="constrained")
    for row, shape in enumerate(PLACES):
        for column, (image, who) in enumerate(
            (
                (cut(preview, PLACES[shape]), "brdfguide preview"),
                (by_mitsuba(mitsuba, surface, shape), "Mitsuba, exported file"),
            )
        ):
            print(shape, who, *(f"{name} {number:.3g}" for name, number in bright_part(image).items()))
            panel = figure.add_subplot(2, 2, 2 * row + column + 1)
            panel.imshow(render.tone(image))
            panel.set_title(f"{shape}: {who}", fontsize=9)
            panel.set_axis_off()
    figure.savefig(path, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
