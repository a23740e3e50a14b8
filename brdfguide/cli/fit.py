"""`brdfguide fit DATA`: fits the candidate models to a measurement and ranks them."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ._data import AnywayOption, ApertureOption, AveragePhiOption, ColumnsOption, InPlaneOption, MirrorSideOption, QuantityOption, ThetaMaxOption, UnitOption, WavelengthOption, read_examined, reading_options
from ._fitting import FixOption, KindOption, MetricOption, ModelsOption, PerChannelOption, RobustOption, StartOption, WeightsOption, expressions, fit_options
from ._options import JsonOption, NoTimingOption, QuietOption, output_file, progress
from ._report import PlotOption, ReportOption, print_ranking, show_ranking
from ._scene import SceneOption, of_ranking
from ._surface import ExportOption, MaxErrorOption, export_all

EXAMPLES = "Examples: brdfguide fit examples/rough_plastic.csv --plot fit.png | brdfguide fit *.csv --jobs 2 --out fits"

MANY = "Several files"


def fit(
    data: Annotated[list[Path], Argument(help="Measured data, any format that `inspect` reads; - for standard input. Several: a row each.")],
    models: ModelsOption = None,
    kind: KindOption = None,
    metric: MetricOption = "ln",
    weights: WeightsOption = "auto",
    robust: RobustOption = False,
    per_channel_shape: PerChannelOption = False,
    fix: FixOption = None,
    start: StartOption = None,
    wavelength: WavelengthOption = None,
    in_plane: InPlaneOption = False,
    theta_max: ThetaMaxOption = None,
    columns: ColumnsOption = None,
    unit: UnitOption = None,
    quantity: QuantityOption = None,
    mirror_side: MirrorSideOption = None,
    average_phi_i: AveragePhiOption = False,
    aperture_deg: ApertureOption = None,
    anyway: AnywayOption = False,
    scene: SceneOption = None,
    plot: PlotOption = None,
    report: ReportOption = None,
    residuals: Annotated[Path | None, Option("--residuals", callback=output_file, help="Write ln(model/data) of the recommended model as CSV.")] = None,
    next_: Annotated[bool, Option("--next", help="Name the directions where one more measurement would tell most.")] = False,
    jobs: Annotated[int, Option("--jobs", help="Processes for several files.", rich_help_panel=MANY)] = 1,
    out: Annotated[Path | None, Option("--out", help="Folder for an answer per file; run again to resume.", rich_help_panel=MANY)] = None,
    export: ExportOption = None,
    max_export_error: MaxErrorOption = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
    no_timing: NoTimingOption = False,
) -> None:
    """Fit the candidate models to DATA and rank them, best first."""
    from .. import candidates, verdict
    from ..compare import compare
    from ..report import document

    options = fit_options(metric, weights, robust, per_channel_shape, fix, start)
    names = expressions(models)
    reading = (columns, unit, quantity, mirror_side, wavelength, in_plane, theta_max, average_phi_i)
    if len(data) > 1 or out:
        from ..batch import Job
        from ._batch import fit_many

        fit_many(data, Job(options, kind, names, reading_options(*reading), anyway), out, jobs, json, quiet)
    measurement = read_examined(data[0], *reading, anyway=anyway, aperture_deg=aperture_deg)
    judged = verdict.verdict(measurement)
    sums = candidates.of_kind(kind or judged.known, names)
    with progress(3 * len(sums), quiet) as tell:
        ranked = compare(measurement, sums, options, tell)
    result = document.fit_document(ranked, measurement, judged, timing=not no_timing)
    in_scene = of_ranking(scene, ranked, measurement, result, not no_timing, quiet) if scene else ""
    if next_:
        from ..next_measurement import propose

        proposed = propose(ranked, measurement)
        result["next"], in_scene = document.next_block(proposed), f"{in_scene}\n\n{proposed.text}"
    if residuals:
        from ..outputs import write_whole

        write_whole(residuals, document.residuals_csv(ranked.recommended.fit, measurement))
    if plot or report:
        show_ranking(plot, report, result, ranked, measurement, data)
    best = ranked.recommended.fit
    failed = export_all(export, best.model, best.values, measurement.channels, measurement.geom.wavelength, measurement.geom, data[0].stem, max_export_error, quiet)
    print_ranking(result, ranked, measurement, in_scene, json, quiet)
    if failed:
        raise failed
