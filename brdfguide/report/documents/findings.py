"""Findings as documents."""

from ... import flags
from ...finding import Finding
from ...printable import off_words


def finding(each: Finding) -> dict:
    """A doubt with its stable code; `flag` and `subject` are its two parts where it is about a parameter."""
    entry = {
        "code": each.printed,
        "flag": each.code if each.subject else "",
        "subject": each.subject,
        "severity": each.severity,
        "text": each.text,
        "consequence": each.consequence,
        "option": each.option,
    }
    return {key: value for key, value in entry.items() if value} | (
        {"numbers": dict(each.numbers)} if each.numbers else {}
    )


def remark_on(code: str, text: str) -> dict:
    """A note on a small sum. Raises ValueError for a code that `flags` does not list."""
    flags.require_listed(code, "note", "", "")
    return {"code": code, "text": text}


def codes(findings: list[dict]) -> list[str]:
    """The codes of findings without their subjects, each once, in their order; with its size where it is in percent."""
    return list(dict.fromkeys(_code(each) for each in findings))


def _code(each: dict) -> str:
    percent = each.get("numbers", {}).get("percent")
    return each.get("flag", each["code"]) + ("" if percent is None else f" {off_words(percent)}")
