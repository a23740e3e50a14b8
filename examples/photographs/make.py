"""Renders the example's pictures from a law with known parameters: `python examples/photographs/make.py`.

A painted ball and a white one under a point lamp at two phases, as a camera keeps them: 8-bit JPEG, the highlight
clipped. And a drawing of the set-up, `docs/pictures/photographs.png`.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

import brdfguide
from brdfguide.photographs.lamp import position_of
from brdfguide.photographs.solids import Pinhole, points
from brdfguide.physics.colour import encoded

HERE = Path(__file__).parent
DRAWING = HERE.parents[1] / "docs" / "pictures" / "photographs.png"
SIZE = 240  # pixels
RAYS = 3  # along each side of a pixel
VIEW = Pinhole((SIZE * RAYS / 2, SIZE * RAYS / 2), 112.0 * RAYS, 24.0)
LAMP_RADII = 40.0
PHASES = (40, 110)
WHITE_ALBEDO = 0.9
ALBEDO = (0.10, 0.22, 0.38)
ALPHA = 0.18
INDEX = 1.5
EXPOSURE = 0.85  # of the code for white, that the white ball reaches


def main() -> None:
    for phase in PHASES:
        for name, albedos in (("blue", ALBEDO), ("white", None)):
            codes = np.uint8(np.round(255 * encoded(np.clip(EXPOSURE * picture(phase, albedos), 0, 1))))
            Image.fromarray(codes).save(HERE / f"{name}_{phase:03d}.jpg", quality=95, subsampling=0)
    drawing().savefig(DRAWING, dpi=110, metadata={"Software": None})


def picture(phase: float, albedos) -> np.ndarray:
    """Light (SIZE, SIZE, 3) of a ball; the white one's is about 1. `albedos` None: the white ball."""
    y, x = np.mgrid[0 : SIZE * RAYS, 0 : SIZE * RAYS] + 0.5
    with np.errstate(invalid="ignore"):
        seen = points("sphere", VIEW, x, y)
        lamp = position_of(phase, 0.0, LAMP_RADII)
        irradiance = np.nan_to_num(seen.irradiance(lamp))
    lit = irradiance > 0
    at = seen[lit].directions(lamp)
    light = np.zeros((*lit.shape, 3))
    for channel in range(3):
        f = WHITE_ALBEDO / np.pi
        if albedos is not None:
            values = {"lambertian.albedo": albedos[channel], "ggx.alpha": ALPHA, "ggx.n": INDEX}
            f = brdfguide.evaluate("lambertian+ggx", at.theta_i_deg, at.theta_r_deg, at.phi_deg, **values).reshape(
                at.cos_i.shape
            )
        light[lit, channel] = np.pi * f * irradiance[lit]
    return light.reshape(SIZE, RAYS, SIZE, RAYS, 3).mean(axis=(1, 3))


def drawing() -> Figure:
    """The set-up seen from above, not to scale."""
    fig = Figure(figsize=(7.2, 3.4), layout="constrained")
    axis = fig.subplots()
    axis.set_aspect("equal")
    axis.axis("off")
    axis.set_xlim(-2.4, 11.5)
    axis.set_ylim(-2.6, 5.0)
    axis.add_patch(Circle((0, 0), 0.7, fc="#9db7cf", ec="#222222"))
    axis.text(
        0,
        -1.15,
        "the painted ball, then a\nmatt white one of the same\nsize in the same place",
        ha="center",
        va="top",
        fontsize=8,
    )
    axis.add_patch(Circle((10, 0), 0.28, fc="#444444", ec="#222222"))
    axis.text(
        10, -0.5, "camera on a tripod,\nfixed exposure, focus\nand white balance", ha="center", va="top", fontsize=8
    )
    axis.plot([0.75, 9.6], [0, 0], color="#888888", lw=0.8)
    axis.text(5.2, -0.14, "24 radii or more, measured", ha="center", va="top", fontsize=8, color="#555555")
    for phase, style in zip(PHASES, ("-", "--"), strict=True):
        along = np.array([np.cos(np.radians(phase)), np.sin(np.radians(phase))])
        near, lamp = 0.8 * along, 4.1 * along
        axis.plot(*np.stack([near, lamp], 1), style, color="#c78a00", lw=1)
        axis.add_patch(Circle(lamp, 0.2, fc="#ffc83d", ec="#7a5600"))
        arc = np.radians(np.linspace(0, phase, 40))
        radius, share, ha, va = (2.1, 0.5, "left", "center") if phase == PHASES[0] else (1.4, 0.65, "center", "bottom")
        axis.plot(radius * np.cos(arc), radius * np.sin(arc), color="#c78a00", lw=0.7)
        middle, off = np.radians(share * phase), radius + 0.1
        axis.text(off * np.cos(middle), off * np.sin(middle), f"phase {phase}°", fontsize=8, ha=ha, va=va)
    axis.text(3.5, 3.1, "one small lamp, first here,\nthen there; nothing else lit", fontsize=8)
    note = "from above, not to scale; black cloth behind and below"
    axis.text(11.4, 4.9, note, fontsize=8, color="#555555", va="top", ha="right")
    return fig


if __name__ == "__main__":
    main()
