"""`brdfguide models [NAME]`: the catalogue of laws, or one of them in full."""

from typing import Annotated

from typer import Argument

from ._options import JsonOption, answer

EXAMPLES = "Examples: brdfguide models | brdfguide models ward | brdfguide models coated:flakes"


def models(
    name: Annotated[str | None, Argument(help="A model; none: all of them.")] = None,
    json: JsonOption = False,
) -> None:
    """List the reflectance models, or show one: law, source, parameters, what it is good and bad at."""
    from .. import models as catalogue
    from ..report.documents.catalogue import model_entry
    from ..report.text.catalogue import model_text, models_text

    if name is None:
        terms = [*map(catalogue.term, catalogue.names()), catalogue.coat.MODEL]
        document = {
            "schema": "brdfguide/models/1",
            "models": [{"name": t.name, "summary": t.summary, "source": t.source} for t in terms],
        }
        text = models_text(document)
    else:
        entry = model_entry(catalogue.coat.MODEL if name == "coat" else catalogue.term(name))
        document = {"schema": "brdfguide/models/1", "models": [entry]}
        text = model_text(entry)
    answer(document, json, lambda _: text)
