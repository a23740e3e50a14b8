"""`brdfguide verify ANSWER.json [DATA]`: the numbers of an answer derived again, with no code of the fit."""

import json
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError, NoAnswer, choices
from ..records import dataclass
from ._options import JsonOption, QuietOption, answer, print_json, progress

EXAMPLES = "Examples: brdfguide verify fit.json | brdfguide verify fit.json run.csv --model lambertian+ggx --json"


@dataclass(frozen=True, eq=False, kw_only=True)
class VerifyRequest:
    """Everything that `verify` is asked."""

    answer_file: Annotated[Path, Argument(metavar="ANSWER.json", help="The output of `fit --json`.")]
    data: Annotated[
        Path | None, Argument(metavar="[DATA]", help="The data that it was fitted to; none: the file that it names.")
    ] = None
    model: Annotated[
        str | None, Option("--model", help="Only the row of this model; none: every row, and their differences.")
    ] = None
    json: JsonOption = False
    quiet: QuietOption = False


def verify(request: VerifyRequest) -> None:
    """Derive the numbers of a fit's JSON again, in 30 digits and with no code of the fit; a changed digit is found.

    The data are read as the answer says that they were. Ends with status 1 where a number differs. Needs the extra
    `verify`.
    """
    from ..report.documents.digest import digest_holds
    from ..report.documents.verification import verification_document
    from ..report.text.verification import verification_text
    from ._reread import reread, reread_whole

    try:
        from ..audit import verification
    except ImportError:
        raise InputError("verify needs the package mpmath: pip install 'brdfguide[verify]'") from None
    document = _answer(request.answer_file, request.model)
    file = request.data or _its_data(document["data"]["file"], request.answer_file)
    read, some = reread(file, document["data"], request.answer_file), verification.lacks_some(document)
    whole = reread_whole(file, document["data"], request.answer_file) if some else None
    data = verification.readings_of(read, document, whole)
    with progress(len(document["ranking"]), request.quiet) as tell:
        found = verification.verify(document, data, request.model, tell)
    result = verification_document(found, str(request.answer_file), str(file), digest_holds(document))
    print_json(result) if request.json else answer(result, False, verification_text)
    if not result["agrees"]:
        raise NoAnswer(f"{request.answer_file}: it does not hold")


def _its_data(name: str, answer_file: Path) -> Path:
    """The file that an answer names. Raises InputError for one of a folder, which is of every file of its content."""
    from ..batch.run import MISSING_FILE

    if name.startswith(MISSING_FILE):
        raise InputError(f"{answer_file}: of a folder of answers, it names no file; say which: verify ANSWER.json DATA")
    return Path(name)


def _answer(path: Path, model: str | None) -> dict:
    """The document as it stands. Raises InputError where it is no answer of `fit`, and for a row that it lacks."""
    from ..audit.answer_shape import PrintedFit
    from ..opening import content
    from ..typed_json import MOST_BYTES, Schema, parsed

    data = content(path, MOST_BYTES, str(path))
    parsed(data, Schema({"brdfguide/fit/1": PrintedFit}, "the output of `brdfguide fit --json`"), str(path))
    document = json.loads(data)
    rows = [name for row in document["ranking"] for name in (row["candidate"], row["model"])]
    if model is not None and model not in rows:
        raise choices("fitted model", model, list(dict.fromkeys(rows)))
    return document
