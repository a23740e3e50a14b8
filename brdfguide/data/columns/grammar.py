"""What a column's name says: its role, quantity, unit, wavelength or colour, and the part of a doubt.

`facts.py` takes out of a name what is a unit, a number with a meaning, a quantity or a scale; what is left over must be
accounted for to the last word by one rule of the vocabulary, or the column has no role.
"""

from dataclasses import replace
from functools import lru_cache
from itertools import permutations

from .facts import Column, facts
from .inverse_units import INVERSE_UNITS
from .tokens import Token
from .vocabulary import (
    ANGLE_UNIT_OF,
    ANGLE_UNITS,
    LENGTH_UNITS,
    NEVER_ALONE,
    RULES,
    SCATTERED,
    WEAK_RULES,
    NameRule,
    senses_of,
)

MOST_WORDS = 10  # of a name, beside its numbers and units; rules account for no more
HARMLESS = frozenset("/-:;,=@#|<>~'\"?&!$\\")  # signs that say nothing where they are left over


@lru_cache(maxsize=1024)
def understood(name: str, place: int = 0, colours: bool = True) -> Column:
    """What a column's name says by itself; with `colours`, a last or first r, g, b, x, y or z is one."""
    column, left = facts(name, colours)
    column = replace(column, place=place)
    if role := _difference(left):
        return replace(column, role=role)
    words = [token.text for token in left if token.text not in HARMLESS]
    senses = [senses_of(word) for word in words]
    if len(words) > MOST_WORDS:
        return replace(column, why="its name has too many words")
    if any("elevation" in each for each in senses):
        column = replace(column, form="elevation")
    if any("doubt" in each for each in senses):
        proportional, expanded = (any(sense in each for each in senses) for sense in ("proportional", "expanded"))
        column = replace(column, proportional=proportional, expanded=expanded)
    named = column.quantity is not None or column.vague or bool(column.channel or column.bare or column.per_sr)
    rule = _rule_of_a_doubt(senses) if named else _rule_of_all(words)
    if rule:
        return _in_its_unit(replace(column, role=rule.role, form=rule.form or column.form))
    if column.per_sr and words and SCATTERED.issuperset(words):
        return replace(column, role="value", vague=True)
    valued = any("value" in each for each in senses)
    if column.bare and words and not (valued or column.quantity or column.vague):
        return replace(column, why=f"'{words[0][:30]} {column.bare[:12]}' is not understood")  # the seventh data set
    plain = not column.per_sr and not senses and "reflectance" in column.name.lower()
    if column.vague and column.scale == "%" and plain:
        return replace(column, role="value", vague=False, quantity="reflectance-factor")  # of a white standard
    if all(each & {"filler", "value"} for each in senses) and (named or valued or column.at is not None):
        return replace(column, role="value", vague=column.quantity is None and (column.vague or valued))
    if not named and (rule := _weak_rule(words, senses)):
        return _in_its_unit(replace(column, role=rule.role, weak=True))
    return replace(column, why=_why(words, senses, column.unit))


def _in_its_unit(column: Column) -> Column:
    """The column, unless its unit is none that its role can have."""
    of_length = column.unit in LENGTH_UNITS
    if column.role == "wavenumber" and column.form:  # a frequency or an energy may be of anything
        wrong = column.unit not in INVERSE_UNITS
    elif column.role in ("wavelength", "wavenumber", "stderr"):
        wrong = column.role == "wavelength" and (column.unit in ANGLE_UNITS or column.unit in INVERSE_UNITS)
        wrong = wrong or column.role == "wavenumber" and (column.unit in ANGLE_UNITS or of_length)
    else:
        wrong = of_length or column.unit in INVERSE_UNITS
    what = "a photon's frequency or energy" if column.form == "in its unit" else column.role
    why = f"{column.unit} is no unit of {what}" if column.unit else f"without a unit of {what}"
    return replace(column, role=None, weak=False, why=why) if wrong else column


def _difference(left: list[Token]) -> str | None:
    """`theta_s - theta_i` and `beta - beta_0` count from the mirror direction."""
    for sign in [place for place, token in enumerate(left) if token.text == "-"]:
        first, second = ([token.text for token in side if token.is_word] for side in (left[:sign], left[sign + 1 :]))
        if not first or not second or len(first) + len(second) > MOST_WORDS:
            continue
        of_detector, of_light = _rule_of_all(first), _rule_of_all(second)
        roles = of_detector.role if of_detector else " ".join(first), of_light.role if of_light else ""
        plain = not (of_detector and of_detector.form or of_light and of_light.form)
        if roles == ("theta_r", "theta_i") and plain:
            return "from_mirror"
        if roles in (("beta", "beta_i"), ("beta_r", "beta_i")):
            return "beta_from_mirror"
    return None


def _rule_of_a_doubt(senses) -> NameRule | None:
    return next((rule for rule in RULES if rule.role == "stderr" and _accounts(rule, senses)), None)


def _rule_of_all(words) -> NameRule | None:
    """The first rule that accounts for all words; for those of a cosine or sine of an angle too."""
    if len(words) == 1 and words[0] in NEVER_ALONE:
        return None
    senses = [senses_of(word) for word in words]
    if found := next((rule for rule in RULES if _accounts(rule, senses)), None):
        return found
    for function, form in (("cosine", "cos"), ("sine", "sin")):
        rest = [each for each in senses if function not in each]
        if len(rest) != len(senses) - 1:
            continue
        found = next((rule for rule in RULES if rule.role in ("theta_i", "theta_r") and _accounts(rule, rest)), None)
        if found and not found.form:
            return replace(found, form=form)
    return None


def _weak_rule(words, senses) -> NameRule | None:
    if len(words) == 1 and words[0] in NEVER_ALONE:
        return None
    return next((rule for rule in WEAK_RULES if _accounts(rule, senses)), None)


def _accounts(rule: NameRule, senses) -> bool:
    """Whether each need has a word of its own and every other word may stand there."""
    needs = [frozenset(need.split("/")) for need in rule.needs]
    may = frozenset(rule.may)
    for places in permutations(range(len(senses)), len(needs)):
        if not all(senses[place] & need for place, need in zip(places, needs, strict=True)):
            continue
        if all(each & may for place, each in enumerate(senses) if place not in places):
            return True
    return False


def _why(words, senses, column_unit: str | None) -> str:
    """Why a name has no role, in a few words."""
    if not words:
        return "its name says nothing"
    strange = [word for word, each in zip(words, senses, strict=True) if not each]
    if strange and column_unit and strange[0] in ANGLE_UNIT_OF:
        return f"its name says two units, {ANGLE_UNIT_OF[strange[0]]} and {column_unit}"
    if strange:
        return f"'{strange[0][:30]}' is not understood"
    if any("doubt" in each for each in senses):
        return "the doubt of something that takes none"
    return f"'{' '.join(words)[:40]}' is not understood"
