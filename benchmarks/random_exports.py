"""Random surfaces through every exporter: a file whose numbers lie in their ranges, or a sentence, and nothing else.

`python benchmarks/random_exports.py [COUNT] [FIRST_SEED]` draws a body, a lobe or both with every parameter anywhere
within its bounds, in one, three or seven channels, and stops at the first file or sentence that is not as it must be.
"""

import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.exporters.conftest import random_surface
from tests.exporters.test_contract import exported_everywhere

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 200
FIRST = int(sys.argv[2]) if len(sys.argv) > 2 else 0


def main() -> None:
    ended: Counter[str] = Counter()
    for seed in range(FIRST, FIRST + COUNT):
        print(f"\r{seed}", end="", file=sys.stderr, flush=True)
        try:
            ended += exported_everywhere(random_surface(seed))
        except AssertionError as failure:
            sys.exit(f"seed {seed}: {failure}")
    print(f"{COUNT} surfaces from seed {FIRST}:", ", ".join(f"{count} {how}" for how, count in sorted(ended.items())))


if __name__ == "__main__":
    main()
