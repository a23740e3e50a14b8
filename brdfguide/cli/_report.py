"""--plot and --report of the commands that answer: what they draw, shared."""

from pathlib import Path
from typing import Annotated

from typer import Context, Option

from .. import printable
from ..errors import InputError, choices
from ..face.pictures import ANGLE, AXES
from ..records import dataclass
from ._options import (
    Output,
    ThemeOption,
    command_line,
    on_terminal,
    output_file,
    picture_file,
    print_json,
    remark,
    tell,
    working,
)
from ._request import refuse
from ._streams import say


def checked_axis(axis: str) -> str:
    """A callback. Raises InputError for another axis."""
    if axis not in AXES:
        raise choices("axis", axis, AXES)
    return axis


def _page_file(path: Path | None) -> Path | None:
    if path is not None and path.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"{path}: a page is a .html")
    return output_file(path)


@dataclass(frozen=True, eq=False, kw_only=True)
class Pictures:
    """What is drawn of an answer."""

    plot: Annotated[Path | None, Option("--plot", callback=picture_file, help="Draw the answer (png, svg or pdf).")] = (
        None
    )
    report: Annotated[
        Path | None, Option("--report", callback=_page_file, help="Write one page with everything (html).")
    ] = None

    explore: Annotated[
        bool, Option("--explore", help="In --report also sliders, the live error and the contours of emergence.")
    ] = False
    theme: ThemeOption = "light"

    def check(self, context: Context) -> None:
        """Raises InputError for a theme of no picture: a page has both."""
        if self.plot is None:
            refuse(context, "theme", because="without --plot nothing is drawn; a page follows its reader's choice")
        if self.report is None:
            refuse(context, "explore", because="it stands in the page of --report; `explore` writes one of its own")

    @property
    def wanted(self) -> bool:
        return bool(self.plot or self.report)

    def say_written(self, quiet: bool) -> None:
        """Which files there are now."""
        for path in filter(None, (self.plot, self.report)):
            remark(f"wrote {path}", quiet)


def show_ranking(
    pictures: Pictures, document: dict, ranked, measurement, file, axis: str = ANGLE, quiet: bool = False
) -> None:
    """Picture and page of a fit, those that are wanted; the picture over the reflection angle or as `axis` says."""
    if not pictures.wanted:
        return
    from ..face.pictures import draw_fit, write_page

    if pictures.plot:
        with working(f"drawing {pictures.plot.name}", quiet):
            draw_fit(pictures.plot, ranked, measurement, axis, pictures.theme)
    if pictures.report:
        with working(f"drawing {pictures.report.name}", quiet):
            write_page(pictures.report, document, ranked, measurement, file, command_line(), pictures.explore)
    pictures.say_written(quiet)


def show_answer(pictures: Pictures, document: dict, answer, files, quiet: bool = False) -> None:
    """Picture and page of a description, those that are wanted: what its candidates promise."""
    if not pictures.wanted:
        return
    from ..report import page
    from ..report.figures import promises, style

    name = str(document.get("name") or "")
    if pictures.plot and answer.candidates:
        style.save(promises.promised(answer.candidates, name=name), pictures.plot, pictures.theme)
    if pictures.report:
        from ..face.explorer import block_of_candidates

        with working(f"drawing {pictures.report.name}", quiet):
            figures = promises.promise_figures(answer.candidates, name)
            block = block_of_candidates(answer.candidates) if pictures.explore and answer.candidates else ""
            page.write(document, pictures.report, figures, command_line(), files, block)
    if answer.candidates or pictures.report:
        pictures.say_written(quiet)


def print_ranking(document: dict, ranked, measurement, more: str, output: Output, full: bool = False) -> None:
    """A fit on stdout: as JSON, in colour with a sketch on a terminal, in plain columns in a pipe; then `more`."""
    if output.json:
        from ..report.documents.digest import with_digest

        print_json(with_digest(document))
    elif on_terminal():
        from ..report.text import terminal

        with working("sketching", output.quiet):
            sketch = _sketch(ranked, measurement)
        text = terminal.coloured_text(printable.document(document), sketch=sketch, notes=not output.quiet, full=full)
        say(text, shown=True)
        tell(more.removeprefix("\n"), end="\n" if more else "")  # a line has ended already
    else:
        from ..report.text import ranking

        tell(ranking.ranking_text(printable.document(document), notes=not output.quiet, full=full) + more)


def _sketch(ranked, measurement) -> str:
    """The recommended model against the data, in braille, as wide as the terminal."""
    from ..report.figures import lines, sketch
    from ..report.text.folding import screen_width

    pick = next(line for line in lines.lines_of(ranked) if line.recommended)
    return sketch.sketch_lobes(pick, measurement, screen_width() or 80)
