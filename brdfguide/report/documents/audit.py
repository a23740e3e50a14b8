"""The stability audit as a document."""

from .findings import finding


def document(results, findings=()) -> dict:
    """The JSON of `brdfguide check`."""
    entries: dict[str, list] = {}
    for each in results:
        entry = {
            "law": each.check,
            "cases": each.cases,
            "worst_error": each.worst,
            "allowed": each.allowed,
            "at": each.at,
            "verdict": each.verdict,
        }
        entries.setdefault(each.model, []).append({**entry, **({"reason": each.reason} if each.reason else {})})
    result = {
        "schema": "brdfguide/check/1",
        "models": [{"model": name, "checks": checks} for name, checks in entries.items()],
    }
    if findings:
        result["findings"] = [{"consequence": "", "numbers": {}} | finding(each) for each in findings]
    return result
