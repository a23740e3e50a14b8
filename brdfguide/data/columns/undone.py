"""What a name says was done to its numbers and is not undone: a root, a factor, a function that is not understood."""

from .facts import facts, spelt_out
from .vocabulary import word_set

FUNCTIONS = word_set(
    "sqrt root cbrt square squared tan tangent exp log log2 log10 ln lg inverse reciprocal arcsin arccos arctan asin "
    "acos atan pi od"
)
FACTOR = "a factor"  # which names write both for what was multiplied and for what is to be


def not_undone(name: str) -> str:
    """The function that is left over in a name, `FACTOR`, or nothing."""
    column, left = facts(name, colours=False)
    words = [token.text for token in left if token.text in FUNCTIONS]
    if words:
        return words[0]
    whole = spelt_out(name) if column.factor == 1 and not column.scale else []
    powers = [place for place, token in enumerate(whole) if token.is_power_of_ten]
    beside = {token.text for place in powers for token in whole[max(place - 1, 0) : place + 2]}
    if beside & {"*", "x", "times", "/"} or any(whole[place].text.startswith("1e") for place in powers):
        return FACTOR
    return "a power" if any(token.text == "^" for token in left) else ""
