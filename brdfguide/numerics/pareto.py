"""What no other beats in two measures at once."""

from collections.abc import Sequence


def on_front(points: Sequence[tuple[float, float]]) -> list[bool]:
    """Which points no other point beats: none is as good or better in both measures, and better in one.

    Takes  pairs, such as (time, error), of which less is better.    Gives  a flag for each; equal points share theirs.
    """

    def beats(one, other):
        return one[0] <= other[0] and one[1] <= other[1] and one != other

    return [not any(beats(other, point) for other in points) for point in points]
