"""What `export` reads: a fit's or a recommendation's JSON, a described material, a model with parameters typed out."""

from typing import Annotated

from typer import Context, Option

from ..errors import BrdfguideError, InputError
from ..records import dataclass
from ._options import is_pattern
from ._request import refuse


def _checked_specs(specs: list[str] | None) -> list[str] | None:
    """The same, before any work is done.

    Raises InputError for an unknown target, a missing folder, and a file named twice.
    """
    if specs:
        from .. import exporters
        from ..files import writable

        files = [exporters.parse_spec(spec)[1] for spec in specs]
        for place, path in enumerate(files):
            if path in files[:place]:
                raise InputError(f"--export names {path} twice")
            if not is_pattern(path):
                writable(path)
    return specs


def _checked_error(most: float | None) -> float | None:
    if most is not None and not most >= 0:
        raise InputError(f"--max-export-error {most:g}: wanted an rms ln of 0 or more")
    return most


MaxErrorOption = Annotated[
    float | None, Option("--max-export-error", help="Write nothing whose rms ln exceeds this.", callback=_checked_error)
]


def _checked_shader(name: str | None) -> str | None:
    """The same, spelt as the shader is. Raises InputError for another word."""
    if name is None:
        return None
    from ..fitting.as_shader import shader_law

    return shader_law(name).name


AsOption = Annotated[
    str | None,
    Option(
        "--as",
        help="What this shader can do for the surface: openpbr, standard-surface, gltf or disney.",
        callback=_checked_shader,
    ),
]


@dataclass(frozen=True, eq=False, kw_only=True)
class Exporting:
    """Which files are written of the recommended model for programs that render."""

    export: Annotated[
        list[str] | None,
        Option(
            "--export",
            help="TARGET:FILE, such as mitsuba:paint.xml, of the recommended model; repeatable.",
            callback=_checked_specs,
        ),
    ] = None
    max_export_error: MaxErrorOption = None

    def check(self, context: Context) -> None:
        """Raises InputError for a bound on files that nobody asked for."""
        if not self.export:
            refuse(context, "max_export_error", because="without --export nothing is written that could exceed it")


def export_all(
    exporting: Exporting, surface, geom, name, quiet: bool, *, measured=None, fitted=None
) -> tuple[list[dict], BrdfguideError | None]:
    """Every `--export`: what was written, and the error that stopped it, to be raised once the answer is printed.

    Files that the user named are replaced, as pictures are.
    Takes  surface, one or several candidates for it; measured (samples, channels) [1/sr] at `geom`, if there is a
    measurement; fitted, target -> the surface fitted as that shader.
    """
    from .. import exporters
    from ..files import write_whole
    from ..report.documents.plain import plain
    from ._options import command_line, remark

    written: list[dict] = []
    try:
        for spec in exporting.export or ():
            target, _ = exporters.parse_spec(spec)
            statement, document = exporters.export_to(
                spec,
                (fitted or {}).get(target, surface),
                geom,
                name=name,
                command=command_line(),
                most=exporting.max_export_error,
                write=write_whole,
                measured=measured,
            )
            written.append(plain(document))
            for line in (statement.sentence(), *statement.notes):
                remark(line, quiet)
    except BrdfguideError as error:
        return written, error
    return written, None


def export_fitted(exporting: Exporting, surface, measurement, name: str, document: dict, fitted, quiet: bool):
    """Every `--export` of a fit, with its error against the measurement; adds what was written to the document. Gives
    the error that stopped it, or None.    Takes  fitted, target -> the surface fitted as that shader."""
    if not exporting.export:
        return None
    document["exports"], failed = export_all(
        exporting, surface, measurement.geom, name, quiet, measured=measurement.brdf, fitted=fitted
    )
    return failed


def surfaces_of(words: list[str], model: str | None, channel: str | None, name: str, command: str) -> list:
    """The ColouredSurfaces that the words and options mean: of a material every candidate, best first; else one.

    Raises InputError; NoAnswer for a material outside the guide's domain.
    """
    from .. import exporters
    from ..face.surfaces import described, every_described, named_surface, typed_out
    from ..fitting import saved

    inputs = [word for word in words if "=" not in word]
    given = [word for word in words if "=" in word]
    if len(inputs) > 1:
        raise InputError(f"one input at a time, found {' and '.join(inputs)}")
    if inputs:
        if given:
            raise InputError(f"{inputs[0]} has its parameters already; {given[0]} needs --model instead of an input")
        if inputs[0].endswith(".json"):
            surfaces = [saved.read_surface(inputs[0], model)]
        else:
            surfaces = [described(inputs[0], model)] if model else every_described(inputs[0])
    elif model is None and len(given) == 1 and " " in given[0]:
        surfaces = [named_surface(given[0])]
    elif model is None:
        found = f"; {given[0]} needs --model beside it" if given else ""
        raise InputError(
            f"what to export: a fit's JSON, a material's name or YAML, or --model with NAME=VALUE parameters{found}"
        )
    else:
        surfaces = [typed_out(model, given)]
    if channel is not None:
        surfaces = [_one_channel(each, channel) for each in surfaces]
    return [exporters.coloured(each, name, command) for each in surfaces]


def _one_channel(surface, channel: str):
    if channel not in surface.channels:
        raise InputError(f"no channel called '{channel}'; there are: {', '.join(surface.channels)}")
    return surface.channel(surface.channels.index(channel))
