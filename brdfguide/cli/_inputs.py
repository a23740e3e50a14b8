"""What `recommend` was given: descriptions, measurements, or both."""

from dataclasses import dataclass
from pathlib import Path

from .. import printable
from ..errors import InputError
from ..opening import exists, is_plain
from ._fitting import expressions
from ._numbers import numbers_of
from ._options import print_json, progress, tell
from ._report import show_ranking
from ._scene import of_ranking
from ._surface import export_fitted


@dataclass(frozen=True)
class Data:
    """A file of measured data, and the description that names it, if one does."""

    path: Path
    named_in: str = ""


def sort_inputs(inputs: list[str]):
    """Descriptions as read, and measurements, also those that a description names.

    All bad files are named at once.
    """
    from ..advice import library, material

    described, measured = [], []
    wrong: list[str] = []
    for each in inputs:
        is_file = each == "-" or each.endswith((".yaml", ".yml"))
        named = not is_file and ("." in Path(each).name or "/" in each or exists(each))
        if named or (is_file and _is_measurement(each)):
            measured.append(Data(Path(each)))
            continue
        try:
            made = material.read_material(each if is_file else library.path(each))
        except InputError as error:
            wrong += error.args
            continue
        described.append(made)
        measured += [Data(Path(each).parent / name, each) for name in made.measurements]
    if wrong:
        raise InputError(*wrong)
    if measured and len(described) > 1:
        raise InputError(
            f"{len(described)} descriptions with a measurement; give one description, so that it is clear whose "
            f"measurement it is"
        )
    return described, measured


def _is_measurement(path: str) -> bool:
    from ..data import formats  # takes longer than a described answer's rules

    return formats.is_described(path)


def with_measurements(answers, measured: list[Data], request) -> None:
    """Guidelines choose and start, the fit decides, disagreements are shown. `request` is a RecommendRequest."""
    from ..report.documents import recommendation
    from ..report.text import ranking
    from ..report.text.recommendation import measured_text, text

    advised, output = answers[0] if answers else None, request.output
    advised_document = recommendation.document(advised, output.timing, request.explain) if advised else None
    results, texts, failed = [], [], []
    for each in measured:
        result, scene, error = _with_measurement(advised, advised_document, each, request)
        results.append(result)
        shown = printable.document(result)
        texts.append(
            f"{measured_text(shown)}\n\n{ranking.ranking_text(shown, notes=not output.quiet, full=request.full)}{scene}"
        )
        failed.append(error)
    if output.json:
        print_json(results[0] if len(results) == 1 else {"schema": "brdfguide/recommend/1", "recommendations": results})
    else:
        head = [text(printable.document(advised_document), request.explain, request.full)] if advised_document else []
        tell("\n\n".join([*head, *texts]))
    for error in failed:
        if error:
            raise error


def _read(file: Data, job):
    """The Measurement in a file. Of one that a description names an error says the line's number and quotes nothing: a
    description comes from other people, and may name any file that we can read."""
    from ..fitting.job import read_for_fit

    if not file.named_in:
        return read_for_fit(file.path, job)
    where = f"{file.named_in}: its measurement {file.path}"
    if not exists(file.path):
        raise InputError(f"{where}: there is no such file")
    if not is_plain(file.path):
        raise InputError(f"{where} is no plain file; wanted one of measured data")
    try:
        return read_for_fit(file.path.absolute() if str(file.path) == "-" else file.path, job)
    except InputError as error:
        line = f", because of line {error.line}" if error.line else ""
        why = "`brdfguide inspect` with it says why"
        raise InputError(f"{where} cannot be read as measured data{line}; {why}") from None


def _with_measurement(advised, advised_document: dict | None, file: Data, request):
    """The document of one measurement beside the guidelines' advice, the text on its scene, and the error that stopped
    an export, if any."""
    from ..advice import eye_against_fit
    from ..advice import recommend as advisor
    from ..data import metal_or_dielectric
    from ..face.beyond import fitted_as
    from ..fitting.compare import compare
    from ..fitting.job import Job
    from ..models import candidates
    from ..report.documents import fit as document
    from ..report.documents.recommendation import with_measurement
    from ..report.text.as_shader import as_shader_text

    names, output = expressions(request.models), request.output
    data = _read(file, Job(anyway=request.anyway))
    judged = metal_or_dielectric.verdict(data)
    kind = (advised.material.kind if advised else None) or judged.known
    kind = kind if kind in candidates.KINDS else None  # a semiconductor gets both sorts
    composites = advisor.for_fit(advised, kind) if advised and names is None else candidates.of_kind(kind, names)
    with progress(3 * len(composites), output.quiet) as tell:
        ranked = compare(data, composites, progress=tell, grows=names is None, kind=kind)
    differ = eye_against_fit.disagreements(advised, judged, ranked, data) if advised else ()
    fitted = document.fit_document(ranked, data, timing=output.timing)
    scene = of_ranking(request.scene, ranked, data, fitted, output) if request.scene else ""
    best, fitted_as_shader = ranked.recommended.fit, {}
    if request.as_:
        as_block, fitted_as_shader[request.as_] = fitted_as(request.as_, ranked, data, kind)
        scene += "\n\n" + as_shader_text(printable.document({"as": as_block})["as"])
    result = with_measurement(advised_document, judged, differ, fitted)
    failed = export_fitted(request.exporting, best.surface, data, data.name, result, fitted_as_shader, output.quiet)
    result |= {"as": as_block} if request.as_ else {}
    scene += numbers_of([best.surface], request, result, data)
    show_ranking(request.pictures, result, ranked, data, file.path, quiet=output.quiet)
    return result, scene, failed
