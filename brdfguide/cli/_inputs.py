"""What `recommend` was given: descriptions, measurements, or both."""

from pathlib import Path

from ..errors import InputError
from ._options import print_json, progress
from ._report import show_ranking
from ._scene import of_ranking


def sort_inputs(inputs: list[str]):
    """Descriptions as read, and paths of measurements, also those that a description names. All bad files are named at once."""
    from .. import material, shelf

    described, measured, wrong = [], [], []
    for each in inputs:
        is_file = each == "-" or each.endswith((".yaml", ".yml"))
        if not is_file and (Path(each).is_file() or "." in Path(each).name or "/" in each):
            measured.append(Path(each))
            continue
        try:
            made = material.read_material(each if is_file else shelf.path(each))
        except InputError as error:
            wrong.append(str(error))
            continue
        described.append(made)
        measured += [Path(each).parent / name for name in made.measurements]
    if wrong:
        raise InputError("\n".join(wrong))
    if measured and len(described) > 1:
        raise InputError(f"{len(described)} descriptions with a measurement; give one description, so that it is clear whose measurement it is")
    return described, measured


def with_measurements(answers, measured, names, scene, pictures, anyway, explain, no_timing, json, quiet, export=lambda fit, data: None) -> None:
    """Guidelines choose and start, the fit decides, disagreements are shown; `export(fit, data)` gives the error that stopped it, if any."""
    from .. import agreement, candidates, verdict
    from .. import recommend as advisor
    from ..compare import compare
    from ..report import advice, document, measured_advice
    from ..report import ranking as page
    from ._data import read_examined

    told = answers[0] if answers else None
    results, pruned, failed = [], [], []
    for path in measured:
        data = read_examined(path, anyway=anyway)
        judged = verdict.verdict(data)
        kind = (told.material.kind if told else None) or judged.known
        kind = kind if kind in candidates.KINDS else None  # a semiconductor gets both sorts
        sums = advisor.for_fit(told, kind) if told and names is None else candidates.of_kind(kind, names)
        with progress(3 * len(sums), quiet) as tell:
            ranked = compare(data, sums, progress=tell)
        differ = agreement.disagreements(told, judged, ranked, data) if told else ()
        fitted = document.fit_document(ranked, data, timing=not no_timing)
        pruned.append(of_ranking(scene, ranked, data, fitted, not no_timing, quiet) if scene else "")
        failed.append(export(ranked.recommended.fit, data))
        results.append(measured_advice.document(told, judged, differ, fitted, not no_timing))
        if any(pictures):
            show_ranking(*pictures, results[-1], ranked, data, [path])
    if json:
        print_json(results[0] if len(results) == 1 else {"schema": "brdfguide/recommend/1", "recommendations": results})
    else:
        if told:
            print(advice.text(told, explain, not no_timing), end="\n\n")
        print("\n\n".join(f"{measured_advice.text(each)}\n\n{page.ranking_text(each, notes=not quiet)}{scene}" for each, scene in zip(results, pruned)))
    for error in failed:
        if error:
            raise error
