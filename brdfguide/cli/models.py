"""`brdfguide models [NAME]`: the catalogue of laws, or one of them in full."""

from typing import Annotated

from typer import Argument

from ._options import JsonOption, print_json

EXAMPLES = "Examples: brdfguide models | brdfguide models ward"


def models(
    name: Annotated[str | None, Argument(help="A model; none: all of them.")] = None,
    json: JsonOption = False,
) -> None:
    """List the reflectance models, or show one: law, source, parameters, what it is good and bad at."""
    from .. import models as catalogue
    from ..report import table

    if name is None:
        terms = [catalogue.term(each) for each in catalogue.names()]
        document = {"schema": "brdfguide/models/1", "models": [{"name": t.name, "summary": t.summary, "source": t.source} for t in terms]}
        text = table.columns(("model", "what for"), [(t.name, t.summary) for t in terms])
    else:
        term = catalogue.term(name)
        document = {"schema": "brdfguide/models/1", "models": [table.model_entry(term)]}
        text = table.model_text(term)
    print_json(document) if json else print(text)
