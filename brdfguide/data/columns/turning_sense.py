"""In which sense an azimuth or a rotation is counted, where words say so."""

from .tokens import Token
from .vocabulary import AGAINST, SENSES_OF_TURNING, senses_of

OF_TURNING = frozenset(["azimuth", "turn", "sample"])
BESIDE = frozenset(
    ["+", "-", ",", ":", "positive", "is", "seen", "viewed", "from", "above"]
)  # `positive cw, seen from above`


def taken_sense(left: list[Token]) -> tuple[str | None, list[Token]]:
    """`cw`, `ccw` or None, and the tokens without the words that say it.

    Only beside words of azimuths and turns: a laser may be cw, too.
    """
    place = next((place for place, token in enumerate(left) if token.text in SENSES_OF_TURNING), None)
    if place is None or not any(senses_of(token.text) & OF_TURNING for token in left):
        return None, left
    sense, start = SENSES_OF_TURNING[left[place].text], place
    while start and left[start - 1].text in AGAINST | BESIDE:
        start -= 1
    if any(token.text in AGAINST for token in left[start:place]):
        sense = "ccw"
    end = place + 1
    while end < len(left) and left[end].text in BESIDE:
        end += 1
    return sense, left[:start] + left[end:]
