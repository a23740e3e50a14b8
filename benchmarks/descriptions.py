"""Whether advice contradicts itself: random descriptions drawn from the schema, and what must hold of every answer.

`python benchmarks/descriptions.py [COUNT] [SEED]` prints what failed. Of every description that is accepted:
no observation is both a reason and without effect; leaving out one that has no effect changes not a word; no sentence
says that something is contradicted by itself; each candidate has a reason of its own; a retro-reflector's lobe points
to the light; a colour that was not observed is grey.
"""

import json
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from brdfguide.advice import material
from brdfguide.errors import InputError
from tests.advice.coherence import faults
from tests.advice.test_any_description import drawn

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 200
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000


def main() -> None:
    answered, failed = 0, Counter()
    for seed in range(SEED, SEED + COUNT):
        try:
            made = material.parse_material(json.dumps(drawn(seed)))
        except InputError:
            continue
        answered += 1
        for each in faults(made):
            failed[each.partition(":")[2] or each] += 1
            print(f"seed {seed}: {each}", flush=True)
    print(f"{COUNT} descriptions from seed {SEED}: {answered} accepted, {sum(failed.values())} faults")


if __name__ == "__main__":
    main()
