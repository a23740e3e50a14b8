"""--plot and --report of the commands that answer: what they draw, shared."""

from pathlib import Path
from typing import Annotated

from typer import Option

from ..errors import InputError
from ._options import command_line, on_terminal, output_file, picture_file, print_json

PlotOption = Annotated[Path | None, Option("--plot", callback=picture_file, help="Draw the answer (png, svg or pdf).")]


def _page_file(path: Path | None) -> Path | None:
    if path is not None and path.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"{path}: a page is a .html")
    return output_file(path)


ReportOption = Annotated[Path | None, Option("--report", callback=_page_file, help="Write one page with everything (html).")]


def show_ranking(plot, report, document: dict, ranked, measurement, files) -> None:
    """Picture and page of a fit."""
    from ..report import page
    from ..report import plot as drawing

    if plot:
        drawing.fit(ranked, measurement, plot)
    if report:
        page.write(document, report, drawing.page_figures(ranked, measurement) + _looks(_drawn(ranked, measurement)), command_line(), files)


def show_answer(plot, report, document: dict, answer, files) -> None:
    """Picture and page of a description: what its candidates promise."""
    import numpy as np

    from ..report import page, style
    from ..report import plot as drawing

    lines, looks = [], []
    for each in answer.candidates[: drawing.MOST_LINES]:
        start = {**each.model.defaults(), **{key: np.array(value) if isinstance(value, tuple) else value for key, value in each.start.items()}}
        looks.append((each.model, start))
        grey = {key: float(np.mean(value)) for key, value in start.items()}
        lines.append(drawing.Line(each.model.name, each.model, grey, None))
    fig = drawing.promised(lines) if lines else None
    if plot and fig:
        style.save(fig, plot)
    if report:
        caption = "What the candidates promise in the plane of incidence at their start values, finite part only."
        figures = [(style.render(fig), caption)] + _looks(looks[:3]) if fig else []
        page.write(document, report, figures, command_line(), files)


def print_ranking(document: dict, ranked, measurement, more: str, json: bool, quiet: bool) -> None:
    """A fit on stdout: as JSON, in colour with a sketch on a terminal, as plain columns in a pipe; `more` comes below."""
    if json:
        print_json(document)
    elif on_terminal():
        from ..report import terminal

        terminal.show(document, _sketch(ranked, measurement), not quiet)
        print(more, end="\n" if more else "")
    else:
        from ..report import ranking

        print(ranking.ranking_text(document, notes=not quiet) + more)


def _sketch(ranked, measurement) -> str:
    """The recommended model against the data, in braille, as wide as the terminal."""
    from shutil import get_terminal_size

    from ..report import lines, sketch

    pick = next(line for line in lines.lines_of(ranked) if line.recommended)
    return sketch.lobes(pick, measurement, get_terminal_size().columns)


def _drawn(ranked, measurement) -> list:
    """The recommended model, and the worst of those that the figure shows, with the channels they were fitted to."""
    from ..report import plot as drawing

    lines = drawing.chosen(drawing.lines_of(ranked))
    pick = next((line for line in lines if line.recommended), lines[0])
    pair = [pick] + [line for line in lines[-1:] if line is not pick]
    return [(line.model, line.values, measurement.channels, measurement.geom.wavelength) for line in pair]


def _looks(surfaces) -> list[tuple[bytes, str]]:
    """A preview of each (model, values[, channels, wavelengths]), side by side."""
    from .. import preview
    from ..report import picture, style

    made = [_surface(*each) for each in surfaces]
    sheet = picture.sheet([(each.name, "") for each in made], [preview.render(each, 256) for each in made])
    how = f"The same light on each, a small sun and a sky with a horizon; {made[0].colour.how}."
    return [(style.render(sheet, "png"), how)]


def _surface(model, values, channels=None, wavelength=None):
    """In colour where the channels carry one, else in the channel nearest 550 nm as grey."""
    import numpy as np

    from ..errors import NoAnswer
    from ..exporters._base import Surface

    if channels is None:
        colours = max(np.size(value) for value in values.values()) == 3
        channels, wavelength = (("R", "G", "B"), np.array([0.61, 0.55, 0.46])) if colours else (("550 nm",), np.array([0.55]))
    wavelength = np.broadcast_to(wavelength, (len(channels),))
    surface = Surface(model, values, tuple(channels), wavelength, model.name)
    try:
        surface.colour  # noqa: B018
    except NoAnswer:
        place = int(np.argmin(np.abs(wavelength - 0.55)))
        one = {key: value[place] if np.size(value) > 1 else value for key, value in values.items()}
        return Surface(model, one, (channels[place],), wavelength[place : place + 1], model.name)
    return surface
