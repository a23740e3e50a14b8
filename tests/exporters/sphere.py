"""One surface on a sphere twice: by Mitsuba from the exported table, and by our own preview; side by side.

    python -m tests.exporters.sphere docs/pictures/sphere-mitsuba.png

The light is the preview's: its sky and ground as an environment, its sun from the side. Needs mitsuba.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

from brdfguide import exporters, models
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.report import render

# Johnson and Christy 1972
GOLD = {"he-torrance.n": np.array([0.156, 0.424, 1.383]), "he-torrance.k": np.array([3.602, 2.472, 1.916])}
SURFACE = ColouredSurface(
    models.get("he-torrance"),
    {"he-torrance.sigma": 0.4, "he-torrance.slope": 0.12, **GOLD},
    ("R", "G", "B"),
    np.array([0.65, 0.55, 0.45]),
    "gold",
)
MARGIN = 1.05  # half the picture's height over the sphere's radius


def by_mitsuba(surface: ColouredSurface, size: int, samples: int) -> np.ndarray:
    """Radiance (size, size, 3) from the exported table; NaN nowhere, sky beside the sphere."""
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "table.bsdf"
        table.write_bytes(exporters.export("rgl", surface).content)
        return rendered_by_mitsuba({"type": "measured", "filename": str(table)}, size, samples)


def rendered_by_mitsuba(plugin: dict, size: int, samples: int) -> np.ndarray:
    """Radiance (size, size, 3) of a sphere with one of Mitsuba's BSDFs under the preview's light."""
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    height = np.cos(np.pi * (np.arange(2048) + 0.5) / 2048)
    sky = np.repeat(render.sky(height)[:, None, :], 8, axis=1).astype(np.float32)
    sun = render.sun_direction("side")
    to_world = mitsuba.ScalarTransform4f().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]) @ mitsuba.ScalarTransform4f().scale(
        [MARGIN, MARGIN, 1]
    )
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 2},
        "sensor": {
            "type": "orthographic",
            "to_world": to_world,
            "sampler": {"type": "multijitter", "sample_count": samples},
            "film": {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}},
        },
        "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(sky)},
        "sun": {
            "type": "directional",
            "direction": (-sun).tolist(),
            "irradiance": {"type": "rgb", "value": render.SUN.tolist()},
        },
        "sphere": {"type": "sphere", "bsdf": plugin},
    }
    return np.array(mitsuba.render(mitsuba.load_dict(scene)))


def by_preview(surface: ColouredSurface, size: int) -> tuple[np.ndarray, np.ndarray]:
    """The same by the preview, and where the sphere is; sub-pixels are not followed."""
    y, x = np.mgrid[0:size, 0:size] + 0.5
    x, y = (2 * x / size - 1) * MARGIN, (1 - 2 * y / size) * MARGIN
    on = np.hypot(x, y) < 0.995
    normal = np.stack((x[on], y[on], np.sqrt(1 - x[on] ** 2 - y[on] ** 2)), axis=-1)
    sun = render.sun_direction("side")
    image = np.zeros((size, size, 3))
    image[on] = (
        render.around_of(surface, normal) + render.sun_of(surface, normal, sun) + render.mirror_of(surface, normal, sun)
    )
    return image, on


def main(path: str, size: int = 240, samples: int = 256) -> None:
    from matplotlib.figure import Figure

    theirs, (ours, on) = by_mitsuba(SURFACE, size, samples), by_preview(SURFACE, size)
    theirs = np.where(on[..., None], theirs, 0.0)
    difference = np.where(on, (theirs - ours).mean(axis=-1) / ours[on].mean(), np.nan)
    figure = Figure(figsize=(7.2, 2.9), layout="constrained")
    panels = figure.subplots(1, 3)
    for panel, image, title in zip(
        panels, (theirs, ours), ("Mitsuba, from the exported table", "brdfguide preview"), strict=True
    ):
        panel.imshow(np.where(on[..., None], render.tone(image), 1.0))
        panel.set_title(title, fontsize=9)
    shown = panels[2].imshow(100 * difference, cmap="RdBu_r", vmin=-10, vmax=10)
    panels[2].set_title("difference, % of the mean radiance", fontsize=9)
    figure.colorbar(shown, ax=panels[2], shrink=0.8).ax.tick_params(labelsize=8)
    for panel in panels:
        panel.set_axis_off()
    figure.savefig(path, dpi=150, metadata={"Software": None})
    inner = np.abs(difference[on])
    print(
        f"median {np.median(inner):.2%}, 95 % below {np.quantile(inner, 0.95):.2%}, rms "
        f"{np.sqrt(np.mean(inner**2)):.2%} of the mean radiance"
    )


if __name__ == "__main__":
    main(sys.argv[1])
