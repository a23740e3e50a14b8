"""`brdfguide bench [DATA]`: what every model costs on this machine, and error against run time on a measurement."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._data import read_examined
from ._fitting import ModelsOption, expressions
from ._options import JsonOption, QuietOption, picture_file, print_json, progress

EXAMPLES = "Examples: brdfguide bench -m ggx,he-torrance | brdfguide bench examples/rough_plastic.csv --plot front.svg"


def bench(
    data: Annotated[Path | None, Argument(help="Measured data to be wrong about; none: time alone.")] = None,
    models: ModelsOption = None,
    plot: Annotated[Path | None, Option("--plot", callback=picture_file, help="Draw error against run time (png, svg or pdf).")] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Nanoseconds per sample at 1, a thousand and a million samples; with DATA also the error of each fitted model."""
    from .. import bench as timing
    from .. import models as catalogue
    from ..report import timing as report

    if plot is not None and data is None:
        raise InputError("--plot draws error against run time: give the measured data too")
    chosen, ranked = expressions(models), None
    if data is None:
        surfaces = {name: (catalogue.get(name), {}) for name in chosen or catalogue.names()}
        surfaces = {name: (surface, surface.defaults()) for name, (surface, _) in surfaces.items()}
    else:
        from ..candidates import of_kind
        from ..compare import compare

        candidates = of_kind(None, chosen)
        with progress(3 * len(candidates), quiet) as tell:
            ranked = compare(read_examined(data), candidates, progress=tell)
        surfaces = {row.fit.name: (row.fit.model, {key: value[0] if getattr(value, "ndim", 0) else value for key, value in row.fit.values.items()}) for row in ranked.rows}
    laws = {name: (lambda geom, s=surface, v=values: s(geom, v)) for name, (surface, values) in surfaces.items()}
    with progress(len(timing.SIZES), quiet) as tell:
        found = timing.times(laws, tell=tell)
    errors = {row.fit.name: row.rms_ln for row in ranked.rows} if ranked else None
    result = report.document(timing.machine(), found, {name: timing.operations(law) for name, law in laws.items()}, errors, str(data) if data else None)
    if plot is not None:
        from ..report import plot as drawing

        drawing.write_cost(drawing.timed_lines(ranked, result), plot)
    print_json(result) if json else print(report.text(result))
