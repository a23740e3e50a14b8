"""What `recommend` makes of measurements, alone or beside a description."""

from .. import printable
from ..errors import BrdfguideError, InputError
from ..opening import exists, is_plain
from ._described import Data
from ._fitting import expressions
from ._numbers import numbers_of
from ._options import print_json, progress, tell, working
from ._report import show_ranking
from ._scene import of_ranking
from ._streams import whisper
from ._surface import export_fitted


def with_measurements(answers, measured: list[Data], request) -> None:
    """Guidelines choose and start, the fit decides, disagreements are shown. `request` is a RecommendRequest.

    Of several measurements each is answered that can be, and the others are told.
    """
    from ..report.documents import recommendation
    from ..report.text import ranking
    from ..report.text.recommendation import measured_text, text

    advised, output = answers[0] if answers else None, request.output
    advised_document = recommendation.document(advised, output.timing, request.explain) if advised else None
    results, texts, failed = list[dict](), list[str](), list[BrdfguideError]()
    for each in measured:
        try:
            result, scene, stopped = _with_measurement(advised, advised_document, each, request)
        except BrdfguideError as error:
            failed.append(error)
            continue
        results.append(result)
        shown = printable.document(result)
        named = [printable.line(str(each.path))] if len(measured) > 1 else []
        ranked = ranking.ranking_text(shown, notes=not output.quiet, full=request.full)
        first, _, rest = ranked.partition("\n\n")  # the answer, and what it rests on
        texts.append("\n\n".join(filter(None, [*named, first, measured_text(shown), rest])) + scene)
        failed += [stopped] if stopped else []
    if results and output.json:
        several = {"schema": "brdfguide/recommend/1", "recommendations": results}
        print_json(several if len(measured) > 1 else results[0])
    elif results:
        if advised_document:
            texts.append(text(printable.document(advised_document), request.explain, request.full, measured=True))
        tell("\n\n".join(texts))
    failed.sort(key=lambda error: error.exit_status)
    for told in failed[:-1]:
        whisper(f"brdfguide: {told}")
    if failed:
        raise failed[-1]


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
    from ..report.documents.measured_recommendation import with_measurement
    from ..report.text.as_shader import as_shader_text

    names, output = expressions(request.models), request.output
    with working(f"reading {file.path.name}", output.quiet):
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
