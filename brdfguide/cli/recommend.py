"""`brdfguide recommend INPUT...`: a model with parameters for a described surface, a measured one, or both."""

from typing import Annotated

from typer import Argument, Exit, Option

from ..errors import InputError
from ._inputs import sort_inputs, with_measurements
from ._options import JsonOption, NoTimingOption, QuietOption, note, print_json
from ._report import PlotOption, ReportOption, show_answer
from ._scene import SceneOption, of_answer
from ._surface import ExportOption, MaxErrorOption, export_all, of_recommendation

EXAMPLES = "Examples: brdfguide recommend porcelain | brdfguide recommend my_surface.yaml scan.csv --explain"


def recommend(
    inputs: Annotated[list[str], Argument(metavar="INPUT...", help="A description (YAML, - for standard input, or a name of `brdfguide materials`), a measurement, or both.")],
    models: Annotated[str | None, Option("--models", "-m", help="Try these sums, such as ggx,lambertian+ward.")] = None,
    scene: SceneOption = None,
    plot: PlotOption = None,
    report: ReportOption = None,
    explain: Annotated[bool, Option("--explain", help="Every rule, also those that were silent.")] = False,
    anyway: Annotated[bool, Option("--anyway", help="Answer also outside the guide's domain.")] = False,
    export: ExportOption = None,
    max_export_error: MaxErrorOption = None,
    no_timing: NoTimingOption = False,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Recommend reflectance models with start values, and say why, how surely and what they cannot do."""
    from .. import recommend as advisor
    from ..report import advice

    names = [each.strip() for each in models.split(",")] if models else None
    described, measured = sort_inputs(inputs)
    if (plot or report) and max(len(described), len(measured)) > 1:
        raise InputError("--plot and --report show one answer; give one description, one measurement or one of each")
    answers = [advisor.recommend(each, anyway, names) for each in described]
    if measured:
        if export and len(measured) > 1:
            raise InputError(f"--export writes one surface, found {len(measured)} measurements")
        export_fit = lambda fit, data: export_all(  # noqa: E731
            export, fit.model, fit.values, data.channels, data.geom.wavelength, data.geom, data.name, max_export_error, quiet
        )
        with_measurements(answers, measured, names, scene, (plot, report), anyway, explain, no_timing, json, quiet, export_fit)
        return
    documents = [advice.document(each, not no_timing, explain) for each in answers]
    texts = [advice.text(each, explain, not no_timing) for each in answers]
    if scene:
        texts = [text + of_answer(scene, answer, document, not no_timing, quiet) for text, answer, document in zip(texts, answers, documents)]
    if plot or report:
        show_answer(plot, report, documents[0], answers[0], inputs)
    failed = _exported(export, answers, max_export_error, quiet)
    if json:
        print_json(documents[0] if len(documents) == 1 else {"schema": "brdfguide/recommend/1", "recommendations": documents})
    else:
        print("\n\n".join(texts))
    if failed:
        raise failed
    outside = [each for each in answers if not each.candidates]
    for each in outside:
        note(f"brdfguide: {each.material.name or 'this surface'} is outside the guide's domain: {each.reasons[0].says}; --anyway answers all the same", False)
    if outside:
        raise Exit(1)


def _exported(specs, answers, most, quiet):
    """What `--export` asks for, of the one description; the error that stopped it, if any."""
    if not specs or not answers or not answers[0].candidates:
        return None
    if len(answers) > 1:
        raise InputError(f"--export writes one surface, found {len(answers)} descriptions")
    saved = of_recommendation(answers[0])
    return export_all(specs, saved.model, saved.values, saved.channels, saved.wavelength, None, answers[0].material.name or "surface", most, quiet)
