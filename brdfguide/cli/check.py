"""`brdfguide check [MODEL...]`: the stability audit of the models, or of a fitted one at its own parameters."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError, NoAnswer
from ._options import JsonOption, QuietOption, print_json, progress

EXAMPLES = "Examples: brdfguide check ward ggx | brdfguide check --fit fit.json"


def check(
    models: Annotated[list[str] | None, Argument(help="Models to audit; none: all of them.")] = None,
    fit: Annotated[Path | None, Option("--fit", help="Audit the surface in a fit's JSON at its own parameters.")] = None,
    model: Annotated[str | None, Option("--model", help="Which row of the fit; none: the recommended.")] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Try every law on every model where it is hard: reference values, energy, reciprocity, limits, derivatives.

    Ends with status 1 if a law fails that the model does not declare to break. All models take about half a minute.
    """
    from .. import models as catalogue
    from ..report import audit as report

    if fit is not None and models:
        raise InputError(f"either models or --fit, found {' '.join(models)} and {fit}")
    if fit is not None:
        from .. import audited, saved

        checks, findings = audited.audit(saved.read_fit(fit, model))
    else:
        from .. import check as auditing

        checks, findings, last = [], (), None
        with progress(len(models or catalogue.names()), quiet) as tell:
            for each in auditing.audit(models or ()):
                if each.model != last:
                    tell(last := each.model)
                checks.append(each)
    result = report.document(checks, findings)
    print_json(result) if json else print(report.text(result))
    failed = [f"{each.model} {each.law}" for each in checks if each.verdict == "fails"]
    if failed:
        raise NoAnswer(f"{len(failed)} undeclared failures: {', '.join(failed)}")
