"""`brdfguide schema NAME`: the JSON Schema of what a command prints with --json."""

from importlib.resources import files
from typing import Annotated

from typer import Argument

from ..errors import choices
from ._options import tell
from ._streams import write_out

EXAMPLES = "Examples: brdfguide schema fit > fit.schema.json | brdfguide schema"


def schema(
    name: Annotated[str | None, Argument(help="A document, such as fit; none: the list of them.")] = None,
) -> None:
    """Print the JSON Schema of a document that --json prints, or list the documents."""
    folder = files(__package__.rpartition(".")[0]) / "schemas"
    kept = {each.name.removesuffix(".json"): each for each in folder.iterdir()}
    if name is None:
        tell("\n".join(sorted(kept)))
        return
    word = name.removeprefix("brdfguide/").partition("/")[0]  # also as a document's own `schema` says it
    if word not in kept:
        raise choices("document", name, sorted(kept))
    write_out(kept[word].read_text(encoding="utf-8"))
