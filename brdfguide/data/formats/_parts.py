"""A table whose format gives it in parts: a sample of all is drawn while they are read, and each is read like it."""

from collections.abc import Callable, Iterator

from ...errors import InputError, NothingLeft
from ..blocks import Blocks, drawn
from ..measurement import Measurement
from .format import beyond_arithmetic

DECIDES = ("--unit", "--quantity", "--mirror-side", "--columns", "--rotation-sense")  # what settles how rows are read


def in_parts(
    name: str, parts: Callable[[], Iterator[Measurement]], selected: Callable[[Measurement], Measurement]
) -> Blocks:
    """The parts as Blocks. `selected` gives what options leave of a measurement; of the sample as of each part.

    Raises InputError, while they are read, where a part would be read otherwise than the rest, since its values alone
    do not say what they mean.
    """
    settled: list[frozenset[str]] = []

    def read() -> Iterator[Measurement]:
        given = parts()
        while True:
            with beyond_arithmetic():
                part = next(given, None)
            if part is None:
                return
            yield part

    def draw(count: int, seed: int) -> tuple[Measurement, int]:
        sample, size = drawn(read(), count, seed)
        found = selected(sample)
        settled[:] = [decisions(found)]
        return found, size

    def every() -> Iterator[Measurement]:
        for place, part in enumerate(read(), 1):
            try:
                found = selected(part)
            except NothingLeft:
                continue
            check_alike(name, f"part {place}", found, settled)
            yield found

    return Blocks(name, every, draw)


def check_alike(name: str, where: str, found: Measurement, settled: list[frozenset[str]]) -> None:
    """Raises InputError where a part was read otherwise than the sample."""
    if settled and decisions(found) != settled[0]:
        texts = "; ".join(each.text for each in found.findings if each.option in DECIDES)
        raise InputError(
            f"{name}: {where} it would be read otherwise than as a whole ({texts}); one of {', '.join(DECIDES)} "
            f"decides it"
        )


def decisions(found: Measurement) -> frozenset[str]:
    """What was decided by the values, since neither names nor options say it."""
    return frozenset(each.code for each in found.findings if each.option in DECIDES)
