"""Scenes at random: every shape, near and far cameras, lamps from points to soft boxes, surroundings of each kind."""

import random

from brdfguide.scene import scene
from brdfguide.scene.surroundings import KINDS


def drawn_scene(seed: int) -> scene.Scene:
    """A scene that may be asked for, in grey; the same for the same seed."""
    rng = random.Random(seed)
    shape = rng.choice(scene.SHAPES)
    top = 85 if shape in ("plane", "arbitrary") else 120
    low = rng.uniform(0, 0.7 * top)
    camera = [low, rng.uniform(low, top)] if rng.random() < 0.7 else [low]
    pixels = 10 ** rng.uniform(3, 6)
    lines = [f"shape: {shape}", f"camera: {{theta_deg: {camera}}}", "colour: grey", f"pixels: {pixels:.0f}"]
    form = rng.random()
    if form < 0.8:
        low = rng.uniform(0, 0.8 * top)
        lamp = [low, rng.uniform(low, top)] if rng.random() < 0.7 else [low]
        lines.append(f"lights: [{{theta_deg: {lamp}, radius_deg: {10 ** rng.uniform(-0.7, 1.3):.3g}}}]")
    if form > 0.6:
        up = rng.choice(("{theta_deg: 0}", "{theta_deg: 90}"))
        lines.append(f"surroundings: {{kind: {rng.choice(KINDS)}, irradiance: {rng.uniform(0.2, 1.5):.2f}, up: {up}}}")
    return scene.parse_scene("\n".join(lines), f"<seed {seed}>")
