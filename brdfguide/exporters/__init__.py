"""Fitted models as files that renderers load, one target per file, each with the error that it costs."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from .. import catalog, opening
from ..errors import InputError, NoAnswer
from ..files import taken, write_whole
from ..models.surface import Surface
from ..physics import seen
from ..physics.geometry import Geometry, rows
from . import _grained
from ._choice import GOOD, in_order_for
from ._nearest import with_the_nearest
from ._shown import off_the_measurement
from .exporter import ColouredSurface, Export, Exporter, Refused, Statement, coloured


def names() -> list[str]:
    """Every target, as typed by users."""
    return catalog.names("exporters")


def get(target: str) -> Exporter:
    """One target by its name. Raises InputError with the nearest names."""
    return catalog.load("exporters", target.strip().lower().replace("_", "-")).EXPORTER


def export(
    target: str,
    surface: ColouredSurface,
    geom: Geometry | None = None,
    *,
    most: float | None = None,
    stem: str = "surface",
) -> Export:
    """The file of a surface for a target.

    Raises NoAnswer where the target cannot express it or its error exceeds `most`.
    """
    exporter = get(target)
    _refuse_what_turns(surface, exporter)
    made = exporter.export(surface, geom, stem)
    _refuse_above(made.statement, most)
    return made


def _refuse_what_turns(surface: ColouredSurface, exporter: Exporter) -> None:
    """Raises Refused for a surface that looks different once it is turned in its plane, and a target that does not."""
    turning = _grained.terms_that_turn(surface)
    if not turning or exporter.averages or (exporter.grained and _grained.axis_of(surface) is not None):
        return
    why = turning[0].model.breaks["rotation"]
    changes = f"{turning[0].label} changes as the sample turns: {why}"
    if exporter.grained:
        raise NoAnswer(f"{changes}; it has more than one grain")
    raise Refused(exporter.name, f"{changes}, and its tables or numbers do not", exporter.turned)


def held_best(
    target: str,
    surfaces: Sequence[ColouredSurface],
    geom: Geometry | None = None,
    *,
    most: float | None = None,
    stem: str = "surface",
) -> tuple[ColouredSurface, Export]:
    """Of candidates for one surface, best first, the first that a target holds within GOOD, else the one that it holds
    best; with its file. A target of one lobe is tried with that lobe first. A coat's mirror is not given up for
    a better number.

    Raises what `export` raises for the first where none can be written.
    """
    found: list[tuple[ColouredSurface, Export]] = []
    refused: list[NoAnswer] = []
    for surface in in_order_for(surfaces, get(target).lobe):
        try:
            found.append((surface, export(target, surface, geom, stem=stem)))
        except NoAnswer as error:
            refused.append(error)
            continue
        if found[-1][1].statement.rms_ln <= GOOD:
            break
    if not found:
        first = refused[0]
        raise with_the_nearest(first, surfaces[0], geom, export) if isinstance(first, Refused) else first
    taken, made = min(found, key=lambda each: each[1].statement.rms_ln)
    if taken is not surfaces[0]:
        made = replace(made, statement=_for_the_target(made.statement, surfaces[0], taken))
    _refuse_above(made.statement, most)
    return taken, made


def _for_the_target(statement: Statement, first: ColouredSurface, taken: ColouredSurface) -> Statement:
    """With the sentence that another candidate than the recommended one is written."""
    why = f"written of {taken.model.name}, which {statement.target} holds, not of the recommended {first.model.name}"
    return replace(statement, notes=(*statement.notes, why))


def _refuse_above(statement: Statement, most: float | None) -> None:
    """Raises NoAnswer for too large an error: against the measurement, where there is one."""
    error = statement.rms_ln if statement.measured_rms_ln is None else statement.measured_rms_ln
    if most is not None and not error <= most:
        raise NoAnswer(f"{statement.sentence()}: more than --max-export-error {most:g}; nothing was written")


def parse_spec(spec: str) -> tuple[str, Path]:
    """Target and file of TARGET:FILE. Raises InputError for a spec without one of them, and for an unknown target."""
    target, colon, file = spec.partition(":")
    if not colon or not target or not file:
        raise InputError(f"'{spec}' is not TARGET:FILE, as in mitsuba:paint.xml; targets are: {', '.join(names())}")
    return get(target).name, Path(file)


def export_to(
    spec: str,
    surface: Surface | Sequence[Surface],
    geom=None,
    *,
    name="surface",
    command="",
    most=None,
    write=None,
    measured=None,
) -> tuple[Statement, dict]:
    """What `--export TARGET:FILE` does: writes FILE, and files that must lie beside it, through `write(path, content)`;
    of several candidates for one surface that which the target holds best. Gives the Statement, and it for programs.

    `measured` (samples, channels) [1/sr] at `geom`: then `most` bounds the error against it.
    Raises InputError for a spec without a target or a file; otherwise raises what `export` raises, with nothing
    written.
    """
    target, path = parse_spec(spec)
    several = [surface] if isinstance(surface, Surface) else surface
    shown = [coloured(each, name, command) for each in several]
    taken, made = held_best(target, shown, geom, most=most if measured is None else None, stem=path.stem)
    statement = made.statement
    if measured is not None:
        off = off_the_measurement(statement.shown, taken.colour.matrix, rows(geom), measured)
        statement = replace(statement, measured_rms_ln=off)
        _refuse_above(statement, most)
    files = files_of(made, path)
    for file, content in files.items():
        (write or write_whole)(file, content)
    return statement, statement_document(statement, taken, [str(each) for each in reversed(files)])


def files_of(made: Export, path: Path) -> dict[Path, str | bytes]:
    """Every file of an Export with its content, `path` itself last.

    Raises InputError where those beside it cannot be.
    """
    beside: dict[Path, str | bytes] = {path.with_name(name): content for name, content in made.beside.items()}
    if beside and opening.exists(path) and not taken(path):
        raise InputError(f"{path} is no plain file, and {', '.join(made.beside)} must lie beside it")
    if path in beside:
        raise InputError(f"{path} would hold what must lie beside it; call it {path.with_suffix('.rad').name}, say")
    return {**beside, path: made.content}


def statement_document(statement: Statement, surface: ColouredSurface, files: list[str]) -> dict:
    """A Statement for programs."""
    return {
        "schema": "brdfguide/export/1",
        "target": statement.target,
        "model": surface.model.name,
        "files": files,
        "status": statement.status,
        "rms_ln": statement.rms_ln,
        "measured_rms_ln": statement.measured_rms_ln,
        "seen": statement.seen,
        "seen_words": None if statement.seen is None else seen.band_words(statement.seen),
        "directions": statement.directions,
        "over": statement.over,
        "written": dict(statement.written),
        "lost": list(statement.lost),
        "notes": list(statement.notes),
        "colour": statement.colour,
    }
