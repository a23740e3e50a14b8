"""A ColorChecker and a sample on a table under a point lamp, seen askew: pictures with everything known."""

import numpy as np

from brdfguide.photographs import chart_patches

from .pictures import srgb

SIZE = (480, 320)  # columns, rows
CORNERS = ((30.0, 60.0), (300.0, 40.0), (310.0, 235.0), (40.0, 270.0))
SAMPLE = (0.57, -0.2, 0.87, 0.2)  # on the table [chart widths]: left, top, right, bottom
AREA = (335, 100, 50, 70)  # well inside it [px]


def desk(albedo, lamp=(0.9, -0.6, 2.6), gloss=0.0, glare=0.0, data_set="average") -> np.ndarray:
    """Light (rows, columns, 3); `gloss` is the height of a highlight about the lamp's mirror image."""
    columns, rows = SIZE
    to_plane = np.linalg.inv(_homography())
    x, y = np.meshgrid(np.arange(columns * 2) / 2 + 0.25, np.arange(rows * 2) / 2 + 0.25)
    flat = np.stack([x, y, np.ones_like(x)], -1) @ to_plane.T
    u, v = flat[..., 0] / flat[..., 2], flat[..., 1] / flat[..., 2]
    rho = np.full((*u.shape, 3), 0.04)
    half = chart_patches.HEIGHT / 2
    rho[(np.abs(u) < 0.5) & (np.abs(v) < half)] = 0.02
    for (cx, cy), colour in zip(chart_patches.middles(), chart_patches.patches_rgb(data_set), strict=True):
        rho[(np.abs(u - cx) < 0.064) & (np.abs(v - cy) < 0.064)] = np.maximum(colour, 0)
    left, top, right, bottom = SAMPLE
    on_sample = (u > left) & (u < right) & (v > top) & (v < bottom)
    mirror = np.exp(-((u - 0.72 - 0.2 * lamp[0]) ** 2 + (v - 0.2 * lamp[1]) ** 2) / 0.02)
    rho[on_sample] = np.asarray(albedo) + gloss * mirror[on_sample][:, None]
    squared = (u - lamp[0]) ** 2 + (v - lamp[1]) ** 2 + lamp[2] ** 2
    light = rho * ((lamp[2] ** 2 / squared) ** 1.5)[..., None] + glare
    return light.reshape(rows, 2, columns, 2, 3).mean(axis=(1, 3))


def codes(light) -> np.ndarray:
    """As a camera would keep it: sRGB, the white patch a little below white."""
    return srgb(light * 0.9)


def _homography() -> np.ndarray:
    """From the table to pixels, exact for four corners."""
    half = chart_patches.HEIGHT / 2
    rows, right = [], []
    for (u, v), (x, y) in zip(((-0.5, -half), (0.5, -half), (0.5, half), (-0.5, half)), CORNERS, strict=True):
        rows += [[u, v, 1, 0, 0, 0, -x * u, -x * v], [0, 0, 0, u, v, 1, -y * u, -y * v]]
        right += [x, y]
    return np.r_[np.linalg.solve(np.array(rows), np.array(right)), 1.0].reshape(3, 3)
