"""What each command may load. Seconds and instructions depend on the machine; the list of loaded modules does not."""

import ast
import subprocess
import sys
from functools import cache

import pytest

from brdfguide import catalog

from ..conftest import ROOT

HEAVY = ("numpy", "scipy", "yaml", "matplotlib")
LIGHT = (*HEAVY, "typer", "rich", "json", "dataclasses", "re", "typing", "pathlib")  # for a shell loop
SAMPLE = "examples/rough_plastic.csv"
# command line -> modules that it must not load; OUT is a folder to write in, FIT an answer
MAY_NOT_LOAD = {
    "--help": HEAVY,
    "--version": LIGHT,
    "roughness --angle 80": (*LIGHT, "brdfguide.printable", "brdfguide.report.text.folding"),
    "roughness --angle 80 --json": LIGHT,
    "roughness --help": HEAVY,
    "roughness --batch -": HEAVY,
    "inspect --help": HEAVY,
    f"inspect {SAMPLE}": ("scipy", "yaml", "matplotlib"),
    "convert --help": HEAVY,
    f"convert {SAMPLE} OUT/paint.csv": ("scipy", "yaml", "matplotlib"),
    "fit --help": HEAVY,
    f"fit {SAMPLE}": ("scipy", "yaml", "matplotlib", "multiprocessing"),
    f"fit {SAMPLE} --out OUT": ("scipy", "yaml", "matplotlib"),
    "collect --help": HEAVY,
    "collect OUT -o OUT/all.csv": ("scipy", "yaml", "matplotlib"),
    "search --help": HEAVY,
    "prune-answers --help": HEAVY,
    "prune-answers OUT": ("scipy", "yaml", "matplotlib"),
    "search OUT satin": HEAVY,
    "recommend --help": HEAVY,
    "recommend porcelain": ("scipy", "matplotlib", "rich", "typer", "brdfguide.data.formats"),
    "recommend porcelain --json": (
        "scipy",
        "matplotlib",
        "rich",
        "typer",
        "brdfguide.data.measurement",
        "numpy.polynomial",
        "numpy.ma",
    ),
    "recommend examples/mug.yaml --json": ("scipy", "matplotlib", "rich", "typer", "brdfguide.data.formats"),
    "recommend porcelain -m lambertian+ggx": ("scipy", "matplotlib", "rich"),
    f"recommend porcelain {SAMPLE} -m lambertian+ggx": ("scipy", "matplotlib"),
    "convert --from gltf --to openpbr roughness=0.4": ("scipy", "yaml", "matplotlib"),
    "evaluate lambertian+ggx": ("scipy", "yaml", "matplotlib"),
    "compare lambertian+ggx lambertian+ward": ("scipy", "yaml", "matplotlib"),
    f"compare {SAMPLE} lambertian+ggx": ("scipy", "yaml", "matplotlib"),
    "export": ("scipy", "yaml", "matplotlib"),
    "export porcelain --to mitsuba -o OUT/porcelain.xml": ("scipy", "matplotlib"),
    "preview porcelain --size 64 -o OUT/look.png": ("scipy", "matplotlib"),
    "explore lambertian+ggx -o OUT/e.html": ("scipy", "yaml", "matplotlib"),
    "figures OUT --only 1": ("scipy", "yaml"),
    "albedo --patch white": HEAVY,
    "materials porcelain": ("numpy", "scipy", "matplotlib"),
    "models": ("scipy", "yaml", "matplotlib"),
    "models ward": ("scipy", "yaml", "matplotlib"),
    "numbers lambertian+ggx": ("scipy", "matplotlib"),
    "index gold": ("scipy", "yaml", "matplotlib"),
    "gloss --at-60 80": ("scipy", "yaml", "matplotlib"),
    "scatter --ra 12nm": ("yaml", "matplotlib"),
    "scatter --help": HEAVY,
    "check lambertian": ("scipy", "yaml", "matplotlib"),
    "plan --budget 2 --theta-max 40": ("scipy", "yaml", "matplotlib"),
    "plan --help": HEAVY,
    "verify FIT": ("scipy", "yaml", "matplotlib"),
    "verify --help": (*HEAVY, "mpmath"),
    "schema fit": HEAVY,
    "examples": HEAVY,
    "bench -m lambertian": ("scipy", "yaml", "matplotlib"),
}
RUN = """
import sys
from brdfguide.cli import main
try:
    status = main()
except SystemExit as end:
    status = end.code
print("LOADED", status or 0, *sys.modules)
"""


@cache
def before_anything() -> set[str]:
    """What the interpreter itself loads at its start, an editable installation's hook included."""
    run = subprocess.run(
        [sys.executable, "-c", "import sys; print(*sys.modules)"], cwd=ROOT, capture_output=True, text=True
    )
    return set(run.stdout.split())


@pytest.mark.parametrize("line", MAY_NOT_LOAD)
def test_loads_only_what_it_uses(line, tmp_path):
    if "FIT" in line:
        made = [sys.executable, "-m", "brdfguide", "fit", SAMPLE, "-m", "lambertian", "--json"]
        (tmp_path / "fit.json").write_bytes(subprocess.run(made, cwd=ROOT, capture_output=True, check=False).stdout)
    (tmp_path / "brdfguide.json").write_text('{"schema": "brdfguide/answers/1"}')  # of a folder of answers
    words = line.replace("OUT", str(tmp_path)).replace("FIT", str(tmp_path / "fit.json")).split()
    run = subprocess.run(
        [sys.executable, "-c", RUN, *words], cwd=ROOT, capture_output=True, text=True, stdin=subprocess.DEVNULL
    )
    status, *loaded = run.stdout.rpartition("LOADED ")[2].split()
    assert status == "0", run.stderr
    assert not (set(loaded) - before_anything()) & set(MAY_NOT_LOAD[line])


def test_what_was_loaded_is_not_searched_for_rubbish_again_and_again():
    looked = "from brdfguide.cli import main\nimport gc\ntry:\n    main()\nfinally:\n    print(gc.get_stats())"
    words = [sys.executable, "-c", looked, "recommend", "porcelain", "--quiet"]
    out = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    assert sum(each["collections"] for each in ast.literal_eval(out.splitlines()[-1])) < 30  # 71 without


@pytest.mark.parametrize("command", catalog.names("cli"))
def test_every_command_has_a_row_that_runs_it(command):
    rows = [line.split()[1:] for line in MAY_NOT_LOAD if line.split()[0] == command]
    assert any("--help" not in words for words in rows), f"{command}: what may it not load?"


def test_the_deciding_commands_never_load_scipy():
    for command in ("roughness", "recommend", "inspect", "fit"):
        rows = [line for line in MAY_NOT_LOAD if line.split()[0] == command]
        assert rows and all("scipy" in MAY_NOT_LOAD[line] for line in rows), command
