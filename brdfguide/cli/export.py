"""`brdfguide export INPUT --to TARGET -o FILE`: a fitted or named surface as a file that a renderer loads."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import ForceOption, JsonOption, QuietOption, command_line, note, output_file, print_json
from ._surface import MaxErrorOption

EXAMPLES = "Examples: brdfguide export fit.json --to mitsuba -o paint.xml --max-export-error 0.1 | brdfguide export porcelain --to rgl -o porcelain.bsdf"


def export(
    words: Annotated[list[str] | None, Argument(metavar="[INPUT] [NAME=VALUE]...", help="A fit's JSON, a material, or parameters for --model; R,G,B after = for colours.")] = None,
    to: Annotated[str | None, Option("--to", help="Target; without one: the list of targets.")] = None,
    output: Annotated[Path | None, Option("--output", "-o", callback=output_file, help="File to write; - is standard output.")] = None,
    model: Annotated[str | None, Option("--model", help="A model by name; with an input: which of its candidates.")] = None,
    channel: Annotated[str | None, Option("--channel", help="One channel alone, as grey.")] = None,
    data: Annotated[Path | None, Option("--data", help="Judge and refit over this file's directions.")] = None,
    name: Annotated[str | None, Option("--name", help="Name inside the file; left out: the file's.")] = None,
    max_export_error: MaxErrorOption = None,
    force: ForceOption = False,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Write a model for a renderer, and say what that costs: exact, refit or lossy, with its rms ln error."""
    from .. import exporters, outputs
    from ._surface import read_surface

    if to is None:
        targets = [exporters.get(each) for each in exporters.names()]
        rows = [(each.name, each.suffix, each.what) for each in targets]
        if json:
            print_json({"schema": "brdfguide/targets/1", "targets": [dict(zip(("target", "suffix", "what"), row)) for row in rows]})
        else:
            from ..report import table

            print(table.columns(("target", "suffix", "what"), rows))
        return
    exporters.get(to)
    if output is None:
        raise InputError(f"-o FILE is missing, such as -o {name or 'surface'}{exporters.get(to).suffix}")
    stem = "surface" if str(output) == "-" else output.stem
    surface = read_surface(words or [], model, channel, name or stem, command_line())
    geom = None
    if data is not None:
        from .. import formats

        geom = formats.read(data).geom
    made = exporters.export(to, surface, geom, most=max_export_error, stem=stem)
    if str(output) == "-":
        if made.beside or isinstance(made.content, bytes) or json:
            raise InputError(f"{to} with these options cannot go to standard output; name a file with -o")
        print(made.content, end="")
    else:
        files = {output: made.content} | {output.with_suffix(suffix): content for suffix, content in made.beside.items()}
        for path in files:
            if path.is_file() and not force:
                raise InputError(f"{path} exists; --force replaces it")
        for path, content in reversed(files.items()):
            outputs.write_whole(path, content)
    if json:
        print_json(exporters.document(made.statement, surface, [str(path) for path in files]))
    colour = () if surface.colour.named else (f"colour: {made.statement.colour}",)  # which tables, and the doubt where there are none
    for line in (made.statement.sentence(), *made.statement.notes, *colour):
        note(line, quiet)
