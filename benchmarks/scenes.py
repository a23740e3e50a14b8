"""Whether pruning keeps its word: random scenes, six materials, fresh draws, and more and less tolerance.

`python benchmarks/scenes.py [SCENES] [SEED]` prints a line for each scene and material, and at the end: on how many
fresh draws the worst visible error, and that of 95 % of the picture, stayed within 1.5 times what was foretold, and
how often more tolerance gave a dearer pick. Costs are operations, which are the same on every machine.
"""

import sys
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from brdfguide import models
from brdfguide.errors import NoAnswer
from brdfguide.models import cost
from brdfguide.models.surface import Surface
from brdfguide.scene import radiance, scene
from brdfguide.scene.difference import Picture, lobe_width
from brdfguide.scene.features import Features
from brdfguide.scene.prune import prune
from examples.scenes.table import MATERIALS
from tests.scene.random_scenes import drawn_scene

SCENES = int(sys.argv[1]) if len(sys.argv) > 1 else 40
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 500
DRAWS = (101, 102, 103)
TOLERANCES = (0.3, 1.0, 3.0)


def held(found) -> list[bool]:
    """Of each fresh draw, whether both errors are within 1.5 times those foretold."""
    width, kept = lobe_width(found.whole), []
    for seed in DRAWS:
        picture = Picture(Features(found.whole), radiance.sample(found.scene, found.pixels, seed, width))
        kept.append(found.errors.reproduces(picture.errors(picture.radiance(found.surface))))
    return kept


def main() -> None:
    draws, dearer, pairs, refused = [], 0, 0, 0
    for place in range(SCENES):
        where = drawn_scene(SEED + place)
        for name, (expression, values) in MATERIALS.items():
            surface, works = Surface(models.get(expression), values), []
            for jnd in TOLERANCES:
                try:
                    found = prune(surface, replace(where, tolerance=scene.Tolerance(jnd, jnd)), timing=False)
                except NoAnswer:
                    refused += 1
                    break
                works.append(cost.work(found.operations[1]))
                if jnd == 1.0 and found.ablation.out:
                    kept = held(found)
                    draws += kept
            steps = [after > before * 1.001 for before, after in zip(works, works[1:], strict=False)]
            dearer, pairs = dearer + sum(steps), pairs + len(steps)
            words = " ".join(f"{work:.0f}" for work in works)
            print(f"{SEED + place} {name}: {words}{' DEARER' if any(steps) else ''}", flush=True)
        print(f"  so far {sum(draws)} of {len(draws)} draws held, {dearer} of {pairs} dearer", flush=True)
    print(
        f"{SCENES} scenes, {len(MATERIALS)} materials: {sum(draws)} of {len(draws)} fresh draws "
        f"({sum(draws) / max(len(draws), 1):.1%}) within 1.5 of what was foretold; more tolerance dearer in {dearer} "
        f"of {pairs}; {refused} scenes show nothing"
    )


if __name__ == "__main__":
    main()
