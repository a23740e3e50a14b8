"""How many digits of an answer are the processor's: the same fits with all of its instructions, and with those alone
that every x86-64 processor has.

    python benchmarks/processors.py FILE...

NumPy is told to leave its vector instructions alone and OpenBLAS to take its kernels for a processor of 2008; all
numbers of both answers are compared, and all words.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

ROOT = Path(__file__).resolve().parent.parent
DISPATCHED = [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]
PLAIN = {"NPY_DISABLE_CPU_FEATURES": " ".join(DISPATCHED), "OPENBLAS_CORETYPE": "Nehalem"}


def answer(files: list[str], environment: dict[str, str], *words: str) -> list[dict]:
    """The documents of some files, computed in a new process."""
    run = [sys.executable, "-m", "brdfguide", "fit", *files, "--json", "--no-timing", "--quiet", *words]
    done = subprocess.run(run, cwd=ROOT, env={**os.environ, **environment}, stdout=subprocess.PIPE)
    if done.returncode > 1:  # 1: an answer that is not to be trusted
        raise SystemExit(done.returncode)
    found = json.loads(done.stdout)
    return [row["fit"] for row in found["rows"]] if "rows" in found else [found]


def apart(one, other, place: str = "") -> list[tuple[float, str]]:
    """(relative difference, where) of all numbers that are not the same to the last bit; infinite of what is no number.

    Digests are left out: of other digits they are others.
    """
    if isinstance(one, dict) and isinstance(other, dict):
        names = (one.keys() | other.keys()) - {"digest"}
        return [each for name in sorted(names) for each in apart(one.get(name), other.get(name), f"{place}/{name}")]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        pairs = zip(one, other, strict=True)
        return [each for number, pair in enumerate(pairs) for each in apart(*pair, f"{place}/{number}")]
    if isinstance(one, float) and isinstance(other, float):
        return [] if one == other else [(abs(one - other) / max(abs(one), abs(other)), place)]
    return [] if one == other else [(float("inf"), place)]


def main(files: list[str]) -> None:
    print(f"left out: {' '.join(DISPATCHED) or 'nothing'}, and OpenBLAS as on Nehalem")
    for file, one, other in zip(files, answer(files, {}), answer(files, PLAIN), strict=True):
        found = sorted(apart(one, other), reverse=True)
        worst = found[0] if found else (0.0, "nowhere")
        print(f"{file}: {len(found)} numbers differ, the most by {worst[0]:.1e} ({worst[1]})")


if __name__ == "__main__":
    main(sys.argv[1:])
