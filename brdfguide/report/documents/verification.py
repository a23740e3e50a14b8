"""`brdfguide verify` as a document."""

from ...audit.verification import Verification
from .plain import plain


def verification_document(found: Verification, answer: str, data: str, digest: bool | None) -> dict:
    """What was derived, what differs, and what only the digest holds."""
    wrong = [
        {"place": each.place, "printed": each.found, "derived": each.right, "allowed": each.allowed}
        for each in found.wrong
    ]
    return plain(
        {
            "schema": "brdfguide/verify/1",
            "answer": answer,
            "data": data,
            "agrees": not wrong and digest is not False,
            "digest": {True: "intact", False: "changed", None: "absent"}[digest],
            "derived": len(found.derived),
            "starting_from": found.used,
            "not_derived": found.only_sealed,
            "differ": wrong,
            "rows_left_out": [{"candidate": name, "why": why} for name, why in found.left.items()],
        }
    )
