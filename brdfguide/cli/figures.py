"""`brdfguide figures DIR`: the guide's figures, redrawn."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ..opening import Held, held, open_for_reading
from ..shipped import shipped
from ._options import FigureThemeOption, QuietOption, progress, remark

EXAMPLES = (
    "Examples: brdfguide figures pictures | brdfguide figures pictures --only 4,5 --format pdf --data 5=my_plastic.csv"
    " | brdfguide figures pictures --only 10"
)
RENDERED = "they are path-traced by Mitsuba (pip install 'brdfguide[render]'), which takes minutes: --only "
LACKING = "this installation lacks the samples of the examples; "
HEAD_BYTES = 2**14  # of a file, where it says what it is


def figures(
    folder: Annotated[Path, Argument(metavar="DIR", help="Where to put them; made if it is not there.")],
    only: Annotated[
        str | None, Option("--only", help="Some of 1 to 14; else all but the rendered 3, 6, 8, 10, 12.")
    ] = None,
    data: Annotated[
        list[str] | None, Option("--data", help="Your own sample for Figure 3 to 9, 11 or 12: NUMBER=FILE; repeatable.")
    ] = None,
    kind: Annotated[str, Option("--format", help="png, svg or pdf.")] = "png",
    theme: FigureThemeOption = "light",
    quiet: QuietOption = False,
) -> None:
    """Redraw the guide's figures from this program and from samples, synthetic unless you give your own."""
    from .. import files
    from ..data import formats
    from ..report.figures import paper as drawing
    from ..report.figures import style
    from ..report.path_traced import renderings

    files.picture_kind(f"figure.{kind}")
    everything = sorted({**drawing.TITLES, **renderings.TITLES})
    numbers = [_number(word, everything) for word in only.split(",")] if only else list(drawing.TITLES)
    own = dict(_assignment(word, _needs()) for word in data or ())
    if unused := sorted(own.keys() - set(numbers)):
        raise InputError(f"--data {unused[0]}={own[unused[0]]}: Figure {unused[0]} is not among those of --only")
    files.folder(folder)
    missing = [number for number in numbers if number in _needs() and number not in own and not _sample(number)]
    if missing == numbers:
        raise InputError(LACKING + f"give your own: --data {missing[0]}=FILE")
    with progress(len(numbers), quiet) as tell:
        for number in numbers:
            if number in missing:
                continue
            tell(f"figure {number}")
            measurement, origin = None, ""
            if number in _needs():
                source = held(own.get(number) or _sample(number) or folder)
                measurement, origin = formats.read(source), _origin(source)
            out = folder / f"figure_{number:02d}.{kind}"
            style.save(_drawn(number, measurement, origin), out, theme)
            remark(str(out), quiet)
    if not only:
        which = ",".join(map(str, renderings.TITLES))
        remark(f"not made: {which.replace(',', ', ')}; {RENDERED}{which}", quiet)
    if missing:
        which = ", ".join(map(str, missing))
        remark(f"not made: {which}. {LACKING}give your own, such as --data {missing[0]}=FILE")


def _needs() -> dict[int, str]:
    """The sample in examples/ that a figure needs."""
    from ..report.figures import paper
    from ..report.path_traced import renderings

    return {**{number: needed[0] for number, needed in paper.SAMPLES.items()}, **renderings.NEEDS}


def _drawn(number: int, measurement, origin: str):
    """A figure of curves, or a rendered one. Raises InputError without Mitsuba."""
    from ..report.figures import paper
    from ..report.path_traced import renderings

    if number not in renderings.TITLES:
        return paper.plot_figure(number, measurement, origin)
    from ..report.figures.rendered import rendered_figure

    made = renderings.rendering(number, measurement)
    return rendered_figure(number, made, f"after Figure {number} of the guide; {origin or 'no sample'}")


def _sample(number: int) -> Path | None:
    """The sample that came with the program; None where it did not."""
    folder = shipped("examples")
    return None if folder is None else folder / _needs()[number]


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


def _origin(source: Path | Held) -> str:
    """What the file says of itself in a line `# origin: ...`, and its name."""
    with open_for_reading(source, str(source)) as stream:
        lines = stream.read(HEAD_BYTES).decode(errors="replace").splitlines()
    said = [line.partition("origin:")[2].strip() for line in lines[:20] if line.startswith("#") and "origin:" in line]
    return f"data: {Path(str(source)).name}" + (f", {said[0]}" if said else "")
