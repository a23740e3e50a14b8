"""Typed numbers in real programs: a rendered sphere is as near to our preview as the card says.

The median over the sphere is judged: so small a picture shows the sun in a few pixels, which the preview samples at
their middles.
"""

import os

import numpy as np
import pytest

from brdfguide.report import render

from . import typed_spheres

SIZE, SAMPLES = 40, 16
BLOCK = 5  # pixels a side that are averaged, or the noise of few paths would be judged


@pytest.mark.validate
@pytest.mark.parametrize("program", typed_spheres.PROGRAMS)
def test_five_materials_look_as_the_card_says(program):
    pytest.importorskip("mitsuba", reason="pip install mitsuba")
    if program == "Blender" and not os.environ.get("BPY_PYTHON"):
        pytest.skip("BPY_PYTHON names no interpreter with bpy")
    found = {name: typed_spheres.card_of(name, program) for name in typed_spheres.MATERIALS}
    typed = [card for _, card in found.values()]
    if program == "Blender":
        images = typed_spheres.by_blender(typed, SIZE, SAMPLES)
    else:
        images = [typed_spheres.by_mitsuba(card, SIZE, SAMPLES) for card in typed]
    for (name, (surface, card)), image in zip(found.items(), images, strict=True):
        ours, on = typed_spheres.by_preview(surface, SIZE)
        inside = blocks(on[..., None]) == 1.0
        median, _ = typed_spheres.apart(blocks(image), blocks(ours), inside[..., 0])
        assert median < max(0.03, card.off), name
        assert render.tone(ours).max() > 0.2, "it is lit"


def blocks(image: np.ndarray) -> np.ndarray:
    """Means of squares of pixels."""
    count = SIZE // BLOCK
    return image.reshape(count, BLOCK, count, BLOCK, -1).mean(axis=(1, 3))
