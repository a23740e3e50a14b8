"""`brdfguide verify` in words."""

from .table import columns

SHOWN = 20  # numbers that differ


def verification_text(result: dict) -> str:
    """Whether it holds, then what differs, then what could not be derived."""
    return "\n\n".join(part for part in (_head(result), _differ(result["differ"]), _left(result)) if part)


def _head(result: dict) -> str:
    tried, wrong = result["derived"], len(result["differ"])
    agree = f"all {tried} agree" if not wrong else f"{wrong} of {tried} differ"
    derived = f"{tried} numbers derived again from {result['starting_from']} parameters and {result['data']}: {agree}"
    said = {
        "intact": "its digest is intact: no digit was changed since it was printed",
        "changed": "its digest does not belong to it: it was changed after it was printed",
        "absent": "it has no digest: what was not derived here may have been changed",
    }[result["digest"]]
    verdict = "holds" if result["agrees"] else "does not hold"
    return f"{result['answer']} {verdict}\n  {derived}\n  {said}"


def _differ(wrong: list[dict]) -> str:
    if not wrong:
        return ""
    lines = [(each["place"], _number(each["printed"]), _number(each["derived"])) for each in wrong[:SHOWN]]
    more = f"\nand {len(wrong) - SHOWN} more" if len(wrong) > SHOWN else ""
    return columns(("number", "printed", "derived"), lines, right=(1, 2)) + more


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.15g}"


def _left(result: dict) -> str:
    lines = [f"not derived: {each['candidate']}: {each['why']}" for each in result["rows_left_out"]]
    if result["not_derived"]:
        lines.append(
            f"{result['not_derived']} other numbers do not follow from the answer (how probable laws are, free factors "
            f"beside them, terms that they lack, what it took to find them): only the digest holds them"
        )
    return "\n".join(lines)
