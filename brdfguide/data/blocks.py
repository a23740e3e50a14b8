"""A measurement too large to be held: read block by block, as often as it is asked for; a sample stands for all of it.

Blocks("wall", lambda: map(make, range(1000)))        any function that gives Measurements, the same each time
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np

from ..errors import InputError
from ..finding import Finding
from ..physics.directions import gathered
from ..physics.geometry import Geometry
from ..records import dataclass
from .measurement import Measurement

SAMPLE = 100_000  # directions that are fitted; beyond 8,000 of them an answer's third digit stays
SEED = 0
STREAM = 0x5A3B1E  # sets the draw apart from whoever made data with the same seed


@dataclass(frozen=True, eq=False)
class Blocks:
    """Measurements of one surface, each a block of its directions; together all of them."""

    name: str
    read: Callable[[], Iterable[Measurement]]
    # (count, seed) -> so many of all directions, and how many there are; None: `read` is gone through
    draw: Callable[[int, int], tuple[Measurement, int]] | None = None

    def __iter__(self) -> Iterator[Measurement]:
        yield from self.read()

    def sample(self, count: int = SAMPLE, seed: int = SEED) -> Measurement:
        """`count` directions, each as likely as any other, with a note of that; the same for the same seed.

        Raises InputError where there is none.
        """
        found, size = self.draw(count, seed) if self.draw else drawn(self, count, seed)
        text = (
            f"{len(found.geom)} of {size} directions, drawn while the table was read (seed {seed}), are fitted; errors "
            f"in ln are over all"
        )
        numbers = (("directions", len(found.geom)), ("of", size), ("seed", seed))
        return replace(found, name=self.name).noting(Finding("subset", text, numbers=numbers))


class Reservoir:
    """Rows with the least keys of all that were offered: a sample without replacement, whatever their order.

    Two of them, made of different rows with different seeds, merge into that of all rows.
    """

    def __init__(self, count: int, seed: int = SEED):
        self.count, self.draw = count, np.random.default_rng((STREAM, seed))
        self.parts: list[Measurement] = []
        self.keys: list[np.ndarray] = []
        self.size, self.limit, self.held = 0, 1.0, 0

    def add(self, block: Measurement) -> None:
        """Offers the directions of a block."""
        keys = self.draw.random(len(block.geom))
        self.size += len(keys)
        kept = np.flatnonzero(keys < self.limit)
        if len(kept):
            self._take(block[kept], keys[kept])

    def merge(self, other: "Reservoir") -> None:
        """Takes in what another one has drawn of other rows."""
        self.size += other.size
        for part, keys in zip(other.parts, other.keys, strict=True):
            self._take(part, keys)

    def _take(self, part: Measurement, keys: np.ndarray) -> None:
        self.parts.append(part)
        self.keys.append(keys)
        self.held += len(keys)
        if self.held > 2 * self.count:
            self._shrink()

    def _shrink(self) -> None:
        """Only the rows of the least keys; from now on no others than such are taken."""
        keys = np.concatenate(self.keys)
        kept = np.sort(np.argsort(keys, kind="stable")[: self.count])
        whole = joined(self.parts)
        self.parts, self.keys = [whole[kept]], [keys[kept]]
        self.held, self.limit = len(kept), float(keys[kept].max()) if len(kept) == self.count else 1.0

    def sample(self) -> Measurement:
        """The rows. Raises InputError where none was offered."""
        if not self.parts:
            raise InputError("there is no direction in it")
        self._shrink()
        return self.parts[0]


def drawn(blocks: Iterable[Measurement], count: int, seed: int = SEED) -> tuple[Measurement, int]:
    """`count` of the directions of all blocks, and how many there are. Raises InputError where there is none."""
    reservoir = Reservoir(count, seed)
    for block in blocks:
        reservoir.add(block)
    return reservoir.sample(), reservoir.size


def joined(parts: list[Measurement]) -> Measurement:
    """One measurement of all rows, with the notes of the first. Raises InputError where their channels differ."""
    first = parts[0]
    if any(each.channels != first.channels for each in parts):
        raise InputError(f"{first.name}: its blocks do not have the same channels")
    if len(parts) == 1:
        return first
    directions = gathered([each.geom.directions for each in parts])
    stderr = None if first.stderr is None else np.concatenate([each.stderr for each in parts])
    brdf = np.concatenate([each.brdf for each in parts])
    return replace(first, geom=Geometry(directions, first.geom.wavelength), brdf=brdf, stderr=stderr)
