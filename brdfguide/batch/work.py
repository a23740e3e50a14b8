"""What is done to each of many surfaces: the same as to one alone, and what a table says of it."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar, Protocol

from ..data import formats
from ..errors import InputError
from ..face.beyond import Beyond, add_beyond
from ..face.functions import answered
from ..fitting.job import Job, case
from ..opening import Held
from ..printable import off_words, off_words_of
from ..records import dataclass
from .keys import canonical
from .products import Product, make


@dataclass(frozen=True, eq=False)
class MadeAnswer:
    """An answer, and what makes its products: (product, path) writes one."""

    document: dict
    write: Callable[[Product, Path], None]


class Work(Protocol):
    """One thing that is done to many surfaces. Plain values, so that another process can have it."""

    @property
    def schema(self) -> str: ...  # of the documents
    @property
    def header(self) -> tuple[str, ...]: ...  # of `brief`
    @property
    def right(self) -> tuple[int, ...]: ...  # which columns of it are numbers
    @property
    def products(self) -> tuple[Product, ...]: ...

    def asked(self) -> dict[str, Any]:
        """All that the answer follows from beside the data, as JSON holds it."""

    def reads(self, file: Path | Held) -> list[Path]:
        """Files beside `file` whose bytes the answer follows from too."""

    def of(self, file: Path | Held) -> MadeAnswer:
        """Raises InputError, NoAnswer."""

    def brief(self, document: dict) -> tuple[str, ...]:
        """What a table says of an answer. Raises InputError or KeyError where it is damaged."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FitWork:
    """`fit`: the candidates fitted to a file of measured data."""

    job: Job
    beyond: Beyond = Beyond()
    products: tuple[Product, ...] = ()
    command: str = ""
    schema: ClassVar[str] = "brdfguide/fit/1"
    header: ClassVar[tuple[str, ...]] = ("recommended", "off", "seen L*", "held-out")
    right: ClassVar[tuple[int, ...]] = (1, 2, 3)

    def asked(self) -> dict[str, Any]:
        shader = {"basis_from": None if self.beyond.basis_from is None else str(self.beyond.basis_from)}
        return {"work": "fit", "job": canonical(self.job), "beyond": canonical(self.beyond) | shader}

    def reads(self, file: Path | Held) -> list[Path]:
        folder = self.beyond.basis_from
        tables = sorted(each for each in folder.iterdir() if each.is_file()) if folder and folder.is_dir() else []
        return [*formats.named_in(file), *tables]

    def of(self, file: Path | Held) -> MadeAnswer:
        found = case(file, self.job)
        answer = answered(found, self.job)
        path = Path(str(file))
        fitted = add_beyond(self.beyond, answer, path, self.job, found.kind)

        def write(product: Product, where: Path) -> None:
            make(product, where, answer, path, fitted, self.command)

        return MadeAnswer(answer.document, write)

    def brief(self, document: dict) -> tuple[str, ...]:
        if document["recommended"] not in {row["candidate"] for row in document["ranking"]}:
            raise InputError("the recommended row is missing")
        best = next(each for each in document["ranking"] if each["candidate"] == document["recommended"])
        held = best["held_out_rms_ln"]
        return (
            best["candidate"],
            off_words(best["off_percent"]),
            "-" if best["seen"] is None else f"{best['seen']:.1f}",
            "-" if held is None else off_words_of(held),
        )


def for_group(work: FitWork, column: str, value: str) -> FitWork:
    """The same of the rows alone that have a value in a column."""
    reading = dict(work.job.reading)
    picked = {**reading, "select": (*reading.get("select", ()), (column, value))}
    return replace(work, job=replace(work.job, reading=tuple(picked.items())))
