"""`brdfguide bench [DATA]`: what every model costs on this machine, and error against run time on a measurement."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError
from ._fitting import ModelsOption, expressions
from ._options import JsonOption, QuietOption, ThemeOption, answer, picture_file, progress
from ._request import refuse_theme

EXAMPLES = "Examples: brdfguide bench -m ggx,he-torrance | brdfguide bench examples/rough_plastic.csv --plot front.svg"


def bench(
    context: Context,
    data: Annotated[Path | None, Argument(help="Measured data to be wrong about; none: time alone.")] = None,
    models: ModelsOption = None,
    plot: Annotated[
        Path | None, Option("--plot", callback=picture_file, help="Draw error against run time (png, svg or pdf).")
    ] = None,
    theme: ThemeOption = "light",
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Nanoseconds per sample at 1, a thousand and a million samples; with DATA also the error of each fitted model."""
    from functools import partial

    from .. import models as catalogue
    from ..audit import bench as timing
    from ..models.surface import Surface
    from ..report.documents.timing import document
    from ..report.text.timing import text

    if plot is not None and data is None:
        raise InputError("--plot draws error against run time: give the measured data too")
    if plot is None:
        refuse_theme(context)
    names = expressions(models)
    if data is None:
        ranked = None
        surfaces = {name: Surface(catalogue.get(name), {}) for name in names or catalogue.names()}
    else:
        ranked = _ranked(data, names, quiet)
        surfaces = {row.fit.name: row.fit.surface.channel(0) for row in ranked.rows}
    evaluators = {name: partial(surface.model, values=surface.values) for name, surface in surfaces.items()}
    with progress(len(timing.SIZES), quiet) as tell:
        found = timing.timings(evaluators, tell=tell)
    errors = {row.fit.name: row.rms_ln for row in ranked.rows} if ranked else None
    result = document(
        timing.machine(),
        found,
        {name: timing.operations_per_sample(evaluator) for name, evaluator in evaluators.items()},
        errors,
        str(data) if data else None,
    )
    if plot is not None:
        from ..report.figures import cost as drawing
        from ..report.figures.lines import title_of

        lines = drawing.timed_lines(ranked, result)
        drawing.write_cost(lines, plot, max(row["n"] for row in result["rows"]), title_of(lines, str(data)), theme)
    answer(result, json, text)


def _ranked(data: Path, names: tuple[str, ...] | None, quiet: bool):
    """The models, or all candidates, fitted to the data and ranked."""
    from ..fitting.compare import compare
    from ..fitting.job import read_for_fit
    from ..models.candidates import of_kind

    candidates = of_kind(None, names)
    with progress(3 * len(candidates), quiet) as tell:
        return compare(read_for_fit(data), candidates, progress=tell)
