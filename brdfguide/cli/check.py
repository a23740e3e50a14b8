"""`brdfguide check [MODEL...]`: the stability audit of the models, or of a fitted one at its own parameters."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError, NoAnswer
from ..flags import Effect
from ._options import JsonOption, QuietOption, answer, progress
from ._request import refuse

EXAMPLES = "Examples: brdfguide check ward ggx | brdfguide check --fit fit.json --certify data.csv"


def check(
    context: Context,
    models: Annotated[list[str] | None, Argument(help="Models to audit; none: all of them.")] = None,
    fit: Annotated[
        Path | None, Option("--fit", help="Audit the surface in a fit's JSON at its own parameters.")
    ] = None,
    model: Annotated[str | None, Option("--model", help="Which row of the fit; none: the recommended.")] = None,
    certify: Annotated[
        Path | None,
        Option("--certify", help="The data that --fit was fitted to: does SciPy's least squares go on from there?"),
    ] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Try every law on every model where it is hard: reference values, energy, reciprocity, limits, derivatives.

    Ends with status 1 if a law fails that the model does not declare to break. All models take about half a minute.
    """
    from .. import models as catalogue
    from ..report.documents.audit import document
    from ..report.text.audit import text

    if fit is not None and models:
        raise InputError(f"either models or --fit, found {' '.join(models)} and {fit}")
    if fit is None:
        refuse(context, "model", because="it picks a row of the fit that --fit names; name models without it")
        refuse(context, "certify", because="it certifies the fit that --fit names")
    if fit is not None:
        from ..audit import fitted
        from ..fitting import saved

        checks, findings = fitted.audit_fitted(saved.read_fit(fit, model))
        if certify is not None:
            findings += (_certified(fit, model, certify),)
    else:
        from ..audit import audit as auditing

        checks, findings, last = [], (), None
        with progress(len(models or catalogue.names()), quiet) as tell:
            for each in auditing.audit(models or ()):
                if each.model != last:
                    tell(last := each.model)
                checks.append(each)
    result = document(checks, findings)
    answer(result, json, text)
    failed = [f"{each.model} {each.check}" for each in checks if each.verdict == "fails"]
    if failed:
        raise NoAnswer(f"{len(failed)} undeclared failures: {', '.join(failed)}")
    if any(each.effect is Effect.DENIES and each.severity == "warning" for each in findings):
        raise NoAnswer(f"{fit}: SciPy does not agree that this is a minimum")


def _certified(fit: Path, model: str | None, data: Path):
    """What SciPy says of a fit, as a Finding."""
    from ..audit.certify import certify
    from ..fitting import saved
    from ._reread import reread, told_of_data

    minimum = saved.read_minimum(fit, model)
    return certify(minimum, reread(data, told_of_data(fit), fit)).finding()
