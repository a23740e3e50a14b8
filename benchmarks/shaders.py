"""How near each shader comes to measured surfaces, beside the best law that `fit` finds: the table of docs/exports.md.

    python benchmarks/shaders.py examples/white_paper.csv metal:examples/rough_aluminium.csv garnet_red.brdf

A file may stand behind `metal:` or `dielectric:`, where it is known and the data do not tell. Tables of the whole
hemisphere are taken in the plane of incidence.
"""

import sys
from pathlib import Path

from brdfguide.face.beyond import fitted_as
from brdfguide.face.functions import answered
from brdfguide.fitting.job import Job, case
from brdfguide.fitting.ranked import Ranking

SHADERS = ("openpbr", "standard-surface", "gltf", "disney")
DENSE = (".brdf", ".binary")


def row(words: str) -> str:
    """One line of the table."""
    kind, colon, name = words.partition(":")
    file = Path(name if colon else words)
    reading = (("in_plane", True),) if file.suffix in DENSE else ()
    job = Job(reading=reading, kind=kind if colon else None, anyway=True, timing=False)
    found = case(file, job)
    ranked = answered(found, job).ranking
    cells = [_best_law(ranked)]
    for shader in SHADERS:
        block, _ = fitted_as(shader, ranked, found.measurement, found.kind, job.options)
        cells.append(f"{block['rms_ln']:.3f}{_setting(block['candidate'])}")
    return f"| `{file.name}` | {' | '.join(cells)} |"


def _best_law(ranked: Ranking) -> str:
    best = ranked.rows[0]
    return f"{best.rms_ln:.3f}, {best.fit.name}"


def _setting(candidate: str) -> str:
    _, bracket, setting = candidate.partition(" (")
    return f", {setting.rstrip(')')}" if bracket else ""


if __name__ == "__main__":
    print(f"| data | best law | {' | '.join(SHADERS)} |")
    print("|---|---|---|---|---|---|")
    for each in sys.argv[1:]:
        print(row(each), flush=True)
