"""Commands that the documentation names without showing what they print: in blocks of the language `sh`, and between
backticks. Those of a page run in one folder, in their order, beside `examples/` and what `furnished` makes there.
"""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

from .transcripts import BLOCK, PAGES

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
INLINE = re.compile(r"`(brdfguide [^`\n]+)`")
STANDS_FOR = {  # a word in capitals, or what a text would fill in -> one that it may stand for
    "FOLDER": "made",
    "CODE": "discrepancy",
    "RULE": "usual_dielectric_index",
    "NAME": "ward",
    "SURFACE": "lambertian",
}
NOT_RUN = {  # how it begins -> why
    "brdfguide --install-completion": "writes to the shell of whoever runs it; see tests/cli/test_complete.py",
    "python3 -m venv": "the README's first command, which makes an environment from an index; its last part is run",
    "python3 tests/run.py": "the tests themselves",
}
ELSEWHERE = {
    "farm.md": "many fits of many files; tests/batch/test_recipes.py runs its engines with one small model",
    "pictures.md": "its pictures stand on it: whoever draws them anew looks at them",
}


def commands(page: Path) -> list[str]:
    """Each once, as a shell takes it."""
    return list(dict.fromkeys(_commands(page.read_text())))


def _commands(text: str) -> Iterator[str]:
    for language, body in FENCE.findall(text):
        if language == "sh":
            for line in body.replace("\\\n", " ").splitlines():
                if "brdfguide" in line and not line.startswith("#"):
                    yield from _run(line.partition("  #")[0].strip())
    for command in INLINE.findall(FENCE.sub("", BLOCK.sub("", text))):
        yield from _run(command)


def _run(line: str) -> Iterator[str]:
    """The command with its stand-ins; the name of a command alone is asked for its help."""
    if any(line.startswith(begin) for begin in NOT_RUN):
        if "&& .venv/bin/brdfguide" in line:
            yield "brdfguide" + line.partition("&& .venv/bin/brdfguide")[2]
        return
    for word, other in STANDS_FOR.items():
        line = re.sub(rf"(?<!\w){re.escape(word)}(?!\w)", other, line)
    yield f"{line} --help" if re.fullmatch(r"brdfguide [a-z]+", line) else line


def furnished(folder: Path, examples: Path) -> None:
    """What a reader of the pages has: a description of their own."""
    shutil.copy(examples / "mug.yaml", folder / "my_surface.yaml")


NAMED = [page for page in PAGES if page.parent.name != "reference" and page.name not in ELSEWHERE and commands(page)]
