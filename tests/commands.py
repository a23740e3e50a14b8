"""Every command that the documentation prints, in the order of its page, with what the page shows of its output.

A command stands in a block of the language `console` (a line that begins with `$ `, and below it what it prints on
standard output; `...` for what was left out) or `sh`, on an indented line, among the examples of a help, as the recipe
of another program (`make`, `snakemake`), or between backticks. Those of a page run in one folder, beside `examples/`
and what `furnished` makes there.
"""

import importlib.util
import re
import shutil
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from brdfguide.advice.wave_gloss import mirror_share

from . import transcripts
from .conftest import ROOT
from .photographs import charts

PIECE = re.compile(
    r"^```(?P<language>\w*)\n(?P<body>.*?)^```$|^    (?P<line>brdfguide [^\n]*)$|`(?P<inline>brdfguide [^`]+)`",
    re.S | re.M,
)
PROMPT = re.compile(r"^\$ ", re.M)
EXAMPLE = re.compile(r"^ +(brdfguide .*)$", re.M)
RECIPES = {"make": "Makefile", "python": "Snakefile"}  # language -> file; the block's first line says who runs it
STANDS_FOR = {  # a word in capitals, or what a text would fill in -> one that it may stand for
    "FOLDER": "made",
    "CODE": "discrepancy",
    "RULE": "usual_dielectric_index",
    "models NAME": "models ward",
    "check NAME": "check ward",
    "materials NAME": "materials porcelain",
    "preview NAME": "preview porcelain",
    "schema NAME": "schema fit",
    "SURFACE": "lambertian",
}
ALONE = ("albedo", "examples", "export", "materials", "models", "schema")  # commands that answer without a word more
NOT_RUN = {  # how it begins -> why
    "python3 -m venv": "the README's first command, which makes an environment from an index; its last part is run",
    "python3 tests/run.py": "the tests themselves",
    "sbatch": "wants a Slurm cluster",
    "snakemake": "wants Snakemake, which is 60 packages; its recipe is the shards that make runs",
}
RUN_AS = {  # as it stands -> as a shell of its own runs it here
    "brdfguide --install-completion": "HOME=$PWD bash -c 'brdfguide --install-completion; true'",
    "brdfguide fit --files-from list --out fits --shard auto/32": (
        "CUE_IFRAME=1 brdfguide fit --files-from list --out fits --shard auto/32"
    ),
}
WANTS = {  # a word of the command -> what not every machine has, and the tests of .ci/run do
    "--photo": "cv2",
    "--only 10": "mitsuba",
    "verify": "mpmath",
    "photographs": "cv2",
}


class Printed(NamedTuple):
    command: str
    shown: str | None  # what it prints on standard output; None where the page does not say


def commands(page: Path) -> list[Printed]:
    """As a shell takes them; what shows nothing, once, and in the reference only what no other page prints."""
    ran = _of_other_pages() if page.parent.name == "reference" else set()
    found: list[Printed] = []
    for each in _commands(page.read_text(encoding="utf-8")):
        if each.shown is not None or each.command not in ran:
            found.append(each)
            ran = ran | {each.command}
    return found


@cache
def _of_other_pages() -> set[str]:
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    return {each.command for page in pages for each in _commands(page.read_text(encoding="utf-8"))}


def _commands(text: str) -> Iterator[Printed]:
    for piece in PIECE.finditer(text):
        language, body = piece["language"], piece["body"]
        if language == "console":
            for part in PROMPT.split(body)[1:]:
                command, _, shown = part.partition("\n")
                yield Printed(command, shown.strip("\n"))
        elif language == "sh":
            for line in body.replace("\\\n", " ").splitlines():
                if "brdfguide" in line and not line.startswith("#"):
                    yield from _unshown(line)
        elif language in RECIPES and body.startswith("# ") and "brdfguide" in body:
            yield from _recipe(language, body)
        elif language == "text":
            for line in EXAMPLE.findall(body):
                yield from _unshown(line)
        elif body is None:
            yield from _unshown(re.sub(r"\s*\n\s*", " ", piece["line"] or piece["inline"]))


def _recipe(language: str, body: str) -> Iterator[Printed]:
    engine = body[2 : body.index("\n")]
    if not any(engine.startswith(begin) for begin in NOT_RUN) and shutil.which(engine.split()[0]):
        yield Printed(f"cat > {RECIPES[language]} <<'END'\n{body}END\n{engine}", None)


def _unshown(line: str) -> Iterator[Printed]:
    """The command with its stand-ins; the name of a command alone is asked for its help."""
    line = re.split(r"  +#", line)[0].strip()
    line = RUN_AS.get(line, line)
    if any(line.startswith(begin) for begin in NOT_RUN):
        if "&& .venv/bin/brdfguide" in line:
            yield Printed("brdfguide" + line.partition("&& .venv/bin/brdfguide")[2], None)
        return
    for word, module in WANTS.items():
        if word in line and importlib.util.find_spec(module) is None:
            return
    if "parallel" in line and shutil.which("parallel") is None:
        return
    for word, other in STANDS_FOR.items():
        line = re.sub(rf"(?<!\w){re.escape(word)}(?!\w)", other, line)
    name = re.fullmatch(r"brdfguide ([a-z]+)", line)
    yield Printed(f"{line} --help" if name and name[1] not in ALONE else line, None)


COPIED = {  # a file of a reader's own -> the example that stands for it
    "my_surface.yaml": "mug.yaml",
    "materials/cup.yaml": "mug.yaml",
    "materials/saucer.yaml": "mug.yaml",
    "scan.csv": "rough_plastic.csv",
    "run.csv": "rough_plastic.csv",
    "data.csv": "rough_plastic.csv",
    "measured.csv": "white_paper.csv",
    "my_plastic.csv": "rough_plastic.csv",
    "panel.csv": "metallic_paint.csv",
    "scene.yaml": "scenes/gallery_light.yaml",
}
GRAINED = "brdfguide evaluate ggx-aniso alpha_x=0.4 --theta-i 45 --theta-r -80:80:5 axis="
MADE = {  # a file that a command makes -> the command
    "fit.json": "brdfguide fit scan.csv -m lambertian+ggx,lambertian+phong --no-timing --json > fit.json",
    "scan_0.csv": f"{GRAINED}0 > scan_0.csv",
    "scan_90.csv": f"{GRAINED}90 > scan_90.csv",
    "gold-paint.binary": "brdfguide convert fit.json gold-paint.binary",
    "paint.brdf": "brdfguide convert scan.csv paint.brdf --to speos",
}


def furnished(page: Path, folder: Path, path: str) -> None:
    """What a reader of the page has: the examples, and those files of their own that the page names."""
    transcripts.run("brdfguide examples examples", folder, path)
    (folder / "docs/pictures").mkdir(parents=True)
    text = page.read_text(encoding="utf-8")
    for name, example in COPIED.items():
        if name.partition("/")[0] in text or name == "scan.csv":
            (folder / name).parent.mkdir(exist_ok=True)
            shutil.copy(folder / "examples" / example, folder / name)
    if "list.txt" in text:
        (folder / "list.txt").write_text("scan.csv\n")
    if "scans" in text:
        (folder / "scans").mkdir()
        for name in ("rough_plastic.csv", "white_paper.csv"):
            lines = (folder / "examples" / name).read_text().splitlines()
            head = next(at for at, line in enumerate(lines) if line[:1].isdigit())
            (folder / "scans" / name).write_text("\n".join([*lines[:head], *lines[head::4], ""]))
        (folder / "list").write_text("scans/rough_plastic.csv\nscans/white_paper.csv\n")
    if "table.csv" in text:
        dimmed = [f"{angle},{float(mirror_share(angle, 0.2, 0.1, 0.55)):.4f}" for angle in range(60, 90, 4)]
        (folder / "table.csv").write_text("\n".join(["theta_deg,G", *dimmed, ""]))
    if "desk.jpg" in text:
        desk = Image.fromarray(np.uint8(np.clip(charts.codes(charts.desk((0.5, 0.3, 0.1))), 0, 1) * 255 + 0.5))
        desk.resize((624, 416)).save(folder / "desk.jpg", quality=98)
    for name, command in MADE.items():
        if name in text:
            done = transcripts.run(command, folder, path)
            assert done.returncode == 0, done.stderr


PAGES = [page for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))] if commands(page)]
