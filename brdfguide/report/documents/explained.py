"""What a code in an answer means: a flag's, or the name of a guideline's rule."""

import inspect

from ... import flags
from ...advice.guidelines import rules
from ...errors import choices

SCHEMA = "brdfguide/explain/1"


def explained(code: str) -> dict:
    """The entry of a flag or a rule; a subject behind the code, `at-bound:ggx.alpha`, may stand there or not.

    Raises InputError with the nearest ones for a code that is neither.
    """
    word = code.strip().partition(":")[0].partition(" ")[0]
    for title, section in flags.SECTIONS.items():
        if word in section:
            return {"schema": SCHEMA, "code": word, "is": "flag", "where": title, **_flag(section[word])}
    by_name = {rule.__name__: rule for rule in rules()}
    if word not in by_name:
        raise choices("flag or rule", code, [*flags.FLAGS, *by_name])
    return {"schema": SCHEMA, "code": word, "is": "rule", **rule_entry(by_name[word])}


def _flag(flag: flags.Flag) -> dict:
    return {
        "meaning": flag.meaning,
        "subject": flag.subject or None,
        "severities": {each: flags.SEVERITIES[each] for each in flag.severities},
        "overridden_by": flag.option or None,
        "does": None if flag.effect is flags.Effect.NONE else flag.effect.value,
    }


def rule_entry(rule) -> dict:
    """What a guideline says of itself."""
    return {"meaning": inspect.cleandoc(rule.__doc__), "section": rule.section}
