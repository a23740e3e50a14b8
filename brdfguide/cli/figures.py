"""`brdfguide figures DIR`: the guide's figures, redrawn."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import QuietOption, note, progress

EXAMPLES = "Examples: brdfguide figures pictures | brdfguide figures pictures --only 4,5 --format pdf --data 5=my_plastic.csv"
EXAMPLE_FILES = Path(__file__).resolve().parents[2] / "examples"


def figures(
    folder: Annotated[Path, Argument(metavar="DIR", help="Where to put them; made if it is not there.")],
    only: Annotated[str | None, Option("--only", help="Some of 1, 2, 4, 5, 7, 9, 11, 13, 14.")] = None,
    data: Annotated[list[str] | None, Option("--data", help="Your own sample for Figure 4, 5, 7, 9 or 11: NUMBER=FILE; repeatable.")] = None,
    kind: Annotated[str, Option("--format", help="png, svg or pdf.")] = "png",
    quiet: QuietOption = False,
) -> None:
    """Redraw the guide's figures from this program and from samples, synthetic unless you give your own."""
    from .. import formats
    from ..outputs import picture_kind
    from ..report import figures as drawing
    from ..report import style

    picture_kind(f"figure.{kind}")
    numbers = [_number(word, drawing.TITLES) for word in only.split(",")] if only else list(drawing.TITLES)
    own = dict(_assignment(word, drawing.SAMPLES) for word in data or ())
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make {folder}: {error.strerror}") from None
    with progress(len(numbers), quiet) as tell:
        for number in numbers:
            measurement, origin = None, ""
            if number in drawing.SAMPLES:
                path = own.get(number, EXAMPLE_FILES / drawing.SAMPLES[number][0])
                if not path.exists() and number not in own:
                    raise InputError(f"the samples lie in examples/ of the source; without it give your own: --data {number}=FILE")
                measurement, origin = formats.read(path), _origin(path)
            out = folder / f"figure_{number:02d}.{kind}"
            style.save(drawing.draw(number, measurement, origin), out)
            tell(f"figure {number}")
            note(str(out), quiet)


def _number(word: str, known) -> int:
    try:
        if int(word) in known:
            return int(word)
    except ValueError:
        pass
    raise InputError(f"no Figure {word.strip()} here; there are {', '.join(map(str, known))}")


def _assignment(word: str, known) -> tuple[int, Path]:
    number, equals, file = word.partition("=")
    if not equals or not file:
        raise InputError(f"--data {word}: wanted NUMBER=FILE, such as 5=my_plastic.csv")
    return _number(number, known), Path(file)


def _origin(path: Path) -> str:
    """What the file says of itself in a line `# origin: ...`, and its name."""
    with open(path, encoding="utf-8", errors="replace") as lines:
        said = [line.partition("origin:")[2].strip() for line, _ in zip(lines, range(20)) if line.startswith("#") and "origin:" in line]
    return f"data: {path.name}" + (f", {said[0]}" if said else "")
