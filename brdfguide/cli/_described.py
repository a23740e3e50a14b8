"""`recommend` of described surfaces: what is a description, and its answer where nothing else is asked.

One name or file with a few switches is answered without the full parser, whose start is a fifth of the work. Anything
else, and every error, is left to it; both ways end in the same functions, and a test compares them.
"""

import os
from pathlib import Path

from .. import printable
from ..errors import InputError
from ..opening import exists
from ..records import dataclass
from ._streams import say, whisper

SWITCHES = {"--json", "--no-timing", "--explain", "--full", "--quiet", "-q", "--anyway", "--no-numbers"}


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
        if not is_file and _is_path(each):
            measured.append(Data(Path(each)))
            continue
        try:
            made = material.read_material(each if is_file else library.path(each))
        except InputError as error:
            if is_file and _is_measurement(each):
                measured.append(Data(Path(each)))
            else:
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


def _is_path(word: str) -> bool:
    return "." in Path(word).name or "/" in word or exists(word)


def _is_measurement(path: str) -> bool:
    """Whether what is no description of a surface describes photographs of one."""
    from ..data import formats  # takes longer than a described answer's rules

    return formats.is_described(path)


def answered_description(words: list[str]) -> int | None:
    """Answers `recommend` of one description and gives the exit status; None: the full parser has to."""
    switches = {word for word in words if word.startswith("-")}
    names = [word for word in words if word not in switches]
    if len(names) != 1 or not switches <= SWITCHES or switches >= {"--json", "--full"}:
        return None
    named = names[0]
    if not (os.path.isfile(named) if named.endswith((".yaml", ".yml")) else not _is_path(named)):
        return None
    from ..advice import recommend as advisor
    from ..report.documents import recommendation

    try:
        described, measured = sort_inputs([named])
    except InputError:
        return None
    if measured:
        return None
    explain = "--explain" in switches
    answer = advisor.recommend(described[0], "--anyway" in switches)
    document = recommendation.document(answer, "--no-timing" not in switches, explain)
    if "--json" in switches:
        say(json_text(document))
    else:
        from ..report.text.folding import page
        from ..report.text.recommendation import text

        shown = text(printable.document(document), explain, "--full" in switches)
        surfaces = [] if "--no-numbers" in switches else [each.surface for each in answer.candidates]
        say(page(shown + numbers_in_words(surfaces, document)))
    return status_of_descriptions([answer])


def numbers_in_words(surfaces, document: dict, measurement=None, *, asked: bool = False) -> str:
    """Adds what to type into other programs to the document and gives it in words; nothing where nobody asked and there
    is none. `surfaces`: candidates for one, best first; none where there is no answer."""
    if not surfaces:
        return ""
    from ..face.beyond import numbers_to_type
    from ..report.text.numbers import card_text

    found = numbers_to_type(surfaces, measurement, asked=asked)
    document |= {"numbers": found} if found else {}
    return "\n\n" + card_text(printable.document(found)) if found else ""


def json_text(document: dict) -> str:
    """One JSON object; NaN and infinity are null, since JSON has neither."""
    import json

    from ..report.documents.plain import plain

    return json.dumps(plain(document), indent=2, allow_nan=False)


def status_of_descriptions(answers) -> int:
    """1 where one lies outside the guide's domain, which is said."""
    outside = [each for each in answers if not each.candidates]
    for each in outside:
        whisper(
            printable.sentence(
                f"brdfguide: {each.material.name or 'this surface'} is outside the guide's domain: "
                f"{each.reasons[0].says}; --anyway answers all the same"
            )
        )
    return 1 if outside else 0
