"""One shader's numbers as another's, in words."""

from ...printable import off_words


def conversion_text(document: dict) -> str:
    """For people: how far off, then the numbers."""
    look = "" if document["seen"] is None else f", seen {document['seen']:.1f} L*: {document['seen_words']}"
    head = f"{document['from']} as {document['to']}: {off_words(document['off_percent'])} off"
    words = [f"{name} {_value(document, name)}" for name in document["numbers"]]
    lines = [f"{head} (rms ln {document['rms_ln']:.2g}{look})", f"  {', '.join(words)}"]
    return "\n".join([*lines, *(f"  cannot: {each}" for each in document["cannot"])])


def _value(document: dict, name: str) -> str:
    value = document["numbers"][name]
    if not isinstance(value, list):
        return f"{value:.4g}"
    linear = " ".join(f"{part:.3g}" for part in value)
    return f"{document['hex'][name]} (linear {linear})" if name in document["hex"] else linear
