"""What `inspect` found, as SARIF 2.1.0 (OASIS 2020): the form that editors and hosts of code show beside a file."""

from ... import __version__
from ...flags import FLAGS

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
LEVELS = {"note": "note", "warning": "warning", "outside": "error", "error": "error"}  # severity -> level


def sarif_document(inspection: dict) -> dict:
    """An inspection's document as a log with one run: a rule for each code, a result for each finding."""
    found = [*inspection["data"]["findings"], *inspection["findings"]]
    codes = list(dict.fromkeys(_code(each) for each in found))
    rules = [{"id": code, "shortDescription": {"text": FLAGS[code].meaning}} for code in codes]
    driver = {"name": "brdfguide", "semanticVersion": __version__, "rules": rules}
    results = [_result(each, codes, inspection["data"]["file"]) for each in found]
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [{"tool": {"driver": driver}, "results": results}]}


def _code(finding: dict) -> str:
    return finding.get("flag", finding["code"])


def _result(finding: dict, codes: list[str], file: str) -> dict:
    text = finding["text"] + (f": {finding['consequence']}" if finding.get("consequence") else "")
    option = f" [{finding['option']}]" if finding.get("option") else ""
    return {
        "ruleId": _code(finding),
        "ruleIndex": codes.index(_code(finding)),
        "level": LEVELS[finding.get("severity", "note")],
        "message": {"text": text + option},
        "locations": [{"physicalLocation": {"artifactLocation": {"uri": file.replace("\\", "/")}}}],
    }
