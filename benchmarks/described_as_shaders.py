"""Every described material to every shader: which are refused, which are more than 0.1 off, and what is said of it.

    python benchmarks/described_as_shaders.py [openpbr gltf ...]

Exits 1 where one is refused, or off by more without a reason.
"""

import sys

from brdfguide.advice import library
from brdfguide.errors import NoAnswer
from brdfguide.exporters import coloured, held_best
from brdfguide.face.surfaces import every_described

TARGETS = ("openpbr", "standard-surface", "gltf")
FAR = 0.1  # rms ln


def told(target: str, name: str) -> tuple[float | None, str]:
    """rms ln and the reason that is said where it is large; None where it is refused."""
    try:
        surfaces = [coloured(each, name) for each in every_described(name)]
        _, made = held_best(target, surfaces)
    except NoAnswer as refused:
        return None, str(refused)
    return made.statement.rms_ln, "; ".join(made.statement.lost)


def main(targets) -> int:
    names, failed = library.library_names(), 0
    for target in targets:
        found = {name: told(target, name) for name in names}
        refused = [name for name, (error, _) in found.items() if error is None]
        far = {name: each for name, each in found.items() if each[0] is not None and each[0] > FAR}
        silent = [name for name, (_, why) in far.items() if not why]
        print(f"{target}: {len(names)} described, {len(refused)} refused, {len(far)} more than {FAR} off")
        for name, (error, why) in sorted(far.items(), key=lambda each: each[1][1]):
            print(f"  {name} {error:.3f}: {why or 'WITHOUT A REASON'}")
        for name in refused:
            print(f"  {name} refused: {found[name][1]}")
        failed += len(silent) + len(refused)
        sys.stdout.flush()
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or TARGETS))
