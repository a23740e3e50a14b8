"""A document's digest: whether any of its digits was changed since it was printed."""

import json
from hashlib import sha256

from .plain import plain

KEY = "digest"


def with_digest(document: dict) -> dict:
    """The document in plain types, with the SHA-256 of all the rest of it."""
    told = plain(document)
    return {**told, KEY: _digest_of(told)}


def digest_holds(document: dict) -> bool | None:
    """Whether the document is as it was printed; None where it has no digest. Spaces and line ends do not count."""
    return document[KEY] == _digest_of(document) if KEY in document else None


def _digest_of(document: dict) -> str:
    rest = {key: value for key, value in document.items() if key != KEY}
    return sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()
