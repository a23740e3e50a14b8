"""Fitted models as files that renderers load, one target per file, each with the error that it costs."""

from pathlib import Path

from .. import catalog
from ..errors import InputError, NoAnswer
from ..geometry import Geometry
from ._base import Export, Exporter, Statement, Surface, check_values


def names() -> list[str]:
    """Every target, as typed by users."""
    return catalog.names("exporters")


def get(target: str) -> Exporter:
    """One target by its name. Raises InputError with the nearest names."""
    return catalog.load("exporters", target.strip().lower().replace("_", "-")).EXPORTER


def surface_of(saved, name: str = "surface", command: str = "", channel: str | None = None) -> Surface:
    """The Surface of anything with model, values, channels and wavelength; `channel` picks one of its channels.

    Raises InputError for values out of bounds or of the wrong length, and for a channel that is not there.
    """
    channels = tuple(saved.channels)
    values = check_values(saved.model, saved.values, len(channels))
    wavelength = saved.wavelength
    if channel is not None:
        if channel not in channels:
            raise InputError(f"no channel called '{channel}'; there are: {', '.join(channels)}")
        place = channels.index(channel)
        values = {key: value[place] if getattr(value, "size", 1) > 1 else value for key, value in values.items()}
        channels = (channel,)
        wavelength = wavelength[place : place + 1] if len(wavelength) > 1 else wavelength
    return Surface(saved.model, values, channels, wavelength, name, command)


def export(target: str, surface: Surface, geom: Geometry | None = None, *, most: float | None = None, stem: str = "surface") -> Export:
    """The file of a surface for a target. Raises NoAnswer where the target cannot express it or its error exceeds `most`."""
    made = get(target).export(surface, geom, stem)
    error = made.statement.rms_ln
    if most is not None and not error <= most:
        raise NoAnswer(f"{made.statement.sentence()}: more than --max-export-error {most:g}; nothing was written")
    return made


def parse_spec(spec: str) -> tuple[str, Path]:
    """Target and file of TARGET:FILE. Raises InputError for a spec without one of them, and for an unknown target."""
    target, colon, file = spec.partition(":")
    if not colon or not target or not file:
        raise InputError(f"'{spec}' is not TARGET:FILE, as in mitsuba:paint.xml; targets are: {', '.join(names())}")
    return get(target).name, Path(file)


def export_to(spec: str, sum, values, channels, wavelength, geom=None, *, name="surface", command="", most=None, write=None) -> Statement:  # noqa: A002
    """What `--export TARGET:FILE` does: writes FILE, and files that must lie beside it, through `write(path, content)`.

    Raises InputError for a spec without a target or a file; otherwise raises what `export` raises, with nothing written.
    """
    target, path = parse_spec(spec)
    surface = Surface(sum, check_values(sum, values, len(channels)), tuple(channels), wavelength, name, command)
    made = export(target, surface, geom, most=most, stem=path.stem)
    put = write or _write
    for suffix, content in made.beside.items():
        put(path.with_suffix(suffix), content)
    put(path, made.content)
    return made.statement


def _write(path: Path, content: str | bytes) -> None:
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def document(statement: Statement, surface: Surface, files: list[str]) -> dict:
    """A Statement for programs."""
    return {
        "schema": "brdfguide/export/1", "target": statement.target, "model": surface.model.name, "files": files,
        "status": statement.status, "rms_ln": statement.rms_ln, "directions": statement.directions, "over": statement.over,
        "written": dict(statement.written), "lost": list(statement.lost), "notes": list(statement.notes), "colour": statement.colour,
    }  # fmt: skip
