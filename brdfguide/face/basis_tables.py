"""General representations of one file's data, and the tables of other surfaces that a basis is made of."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from ..data.measurement import Measurement


def baselines_of(
    measurement: "Measurement", file: Path, folder: Path | None, timing: bool, tell: Callable[[str], None]
) -> list[dict]:
    """Every row, as the document holds it. Raises InputError where the folder is none, or holds too few tables."""
    from ..fitting.baselines import baselines
    from ..report.documents.baselines import baselines_block

    if folder is not None and not folder.is_dir():
        raise InputError(f"{folder}: found no folder; wanted one with tables of other surfaces, such as MERL's")
    others = None if folder is None else _tables(folder, file)
    return baselines_block(baselines(measurement, tell, others), timing=timing)


def _tables(folder: Path, own: Path) -> "Iterator[Measurement]":
    """The measurements in a folder, the data's own left out; what is no measurement is passed over."""
    from ..data import formats

    for path in sorted(folder.iterdir()):
        if not path.is_file() or path.name.partition(".")[0] == own.name.partition(".")[0]:
            continue
        try:
            yield formats.read(path)
        except InputError:
            continue
