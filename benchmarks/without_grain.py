"""What surfaces without a grain pay for the laws that have one: the same commands by today's program and by a copy
whose laws with a grain are taken out, and by one in which none of a grain's geometry can be formed. Without numbers to
type: shaders have a grain, too. Stam's law stays in the first copy: with one length it is a candidate for polished
surfaces, so that polished_mirror.csv has a row less without it.

    python benchmarks/without_grain.py [FILE ...] [--turns 5]

Whether the outputs are the same bytes, and processor time in turns: the least of each, and their quotient. Without
files, those of examples/.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAWS = ("*_aniso.py", "cylinders.py", "ashikhmin_shirley.py")
FORMED = {"physics/directions.py": ("v_xy", "offset_from"), "data/lobe_ellipse.py": ("lobe_ellipse", "two_azimuths")}
NOTHING = {"physics/directions.py": 'raise RuntimeError("a grain")', "data/lobe_ellipse.py": "return None"}


def copy_without_grain(folder: Path, *, geometry: bool = True) -> Path:
    """A folder in which the program lies without laws that have a grain; without `geometry`, the tangential parts of
    directions raise and no lobe has an ellipse."""
    package = folder / "brdfguide"
    shutil.copytree(ROOT / "brdfguide", package, ignore=shutil.ignore_patterns("__pycache__"))
    for pattern in LAWS if geometry else (*LAWS, "stam.py"):
        for path in package.joinpath("models").glob(pattern):
            path.unlink()
    for name, functions in () if geometry else FORMED.items():
        text = package.joinpath(name).read_text()
        for each in functions:
            head, define, rest = text.partition(f"def {each}(")
            signature, colon, body = rest.partition(":\n")
            indent = " " * (len(body) - len(body.lstrip(" ")))
            text = f"{head}{define}{signature}{colon}{indent}{NOTHING[name]}\n{body}"
        package.joinpath(name).write_text(text)
    subprocess.run([sys.executable, "-m", "compileall", "-q", str(package)], check=True)
    return folder


def output(tree: Path, *words: str) -> tuple[str, float]:
    """What a command prints by the program in this folder, and the processor time [s] that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = os.environ | {"PYTHONPATH": str(tree), "PYTHONHASHSEED": "0"}
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", *words], capture_output=True, text=True, env=environment, cwd=tree
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return run.stdout + run.stderr, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", default=sorted(ROOT.joinpath("examples").glob("*.csv")))
    parser.add_argument("--turns", type=int, default=5)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as here:
        trees = {"today": ROOT}
        trees["no laws"] = copy_without_grain(Path(here, "laws"))
        trees["no geometry"] = copy_without_grain(Path(here, "geometry"), geometry=False)
        for path in asked.files:
            words = ("fit", str(Path(path).resolve()), "--no-timing", "--no-numbers")
            runs = [[output(tree, *words) for tree in trees.values()] for _ in range(asked.turns)]
            least = [min(each[place][1] for each in runs) for place in range(len(trees))]
            for place, name in enumerate(trees):
                same = "same bytes" if runs[0][place][0] == runs[0][0][0] else "other bytes"
                print(f"{Path(path).name:30} {name:12} {least[place]:6.3f} s  {least[place] / least[0]:.3f}  {same}")


if __name__ == "__main__":
    main()
