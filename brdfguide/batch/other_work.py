"""What else is done to each of many surfaces: described ones are advised on, files inspected, answers exported."""

from math import expm1
from pathlib import Path
from typing import Any, ClassVar

from .. import exporters
from ..advice import library, material
from ..advice import recommend as advisor
from ..data import examine, formats
from ..errors import InputError, NoAnswer
from ..face.surfaces import every_described
from ..files import folder as make_folder
from ..files import write_whole
from ..fitting import saved
from ..opening import Held, exists
from ..printable import off_words
from ..records import dataclass
from ..report.documents import inspection, recommendation
from ..report.documents.plain import plain
from .keys import canonical
from .products import Product
from .work import MadeAnswer


def _written_nowhere(product: Product, path: Path) -> None:
    raise InputError(f"{path}: nothing is written of it")


@dataclass(frozen=True, eq=False, kw_only=True)
class AdviceWork:
    """`recommend`: models for a described surface."""

    models: tuple[str, ...] | None = None
    anyway: bool = False
    explain: bool = False
    timing: bool = True
    products: ClassVar[tuple[Product, ...]] = ()
    schema: ClassVar[str] = "brdfguide/recommend/1"
    header: ClassVar[tuple[str, ...]] = ("recommended", "kind", "domain")
    right: ClassVar[tuple[int, ...]] = ()

    def asked(self) -> dict[str, Any]:
        return {"work": "recommend", **canonical(self)}

    def reads(self, file: Path | Held) -> list[Path]:
        name = str(file)
        if exists(file):
            return material.read_beside(file) if name.endswith((".yaml", ".yml")) else []
        return [Path(library.path(name))]

    def of(self, file: Path | Held) -> MadeAnswer:
        name = str(file)
        if not name.endswith((".yaml", ".yml")) and exists(file):
            raise InputError(f"{name}: is no description; `brdfguide fit` answers for many measurements")
        described = material.read_material(name if exists(file) else library.path(name))
        if described.measurements:
            words = "it names a measurement, and of many descriptions none is looked at; give it alone"
            raise InputError(f"{name}: {words}")
        answer = advisor.recommend(described, self.anyway, list(self.models) if self.models else None)
        if not answer.candidates:
            why = answer.reasons[0].says
            raise NoAnswer(f"{name}: outside the guide's domain: {why}; --anyway answers all the same")
        return MadeAnswer(plain(recommendation.document(answer, self.timing, self.explain)), _written_nowhere)

    def brief(self, document: dict) -> tuple[str, ...]:
        return document["candidates"][0]["model"], document["verdict"]["kind"], document["domain"]["status"]


@dataclass(frozen=True, eq=False, kw_only=True)
class InspectWork:
    """`inspect`: what a file of measured data is."""

    reading: tuple[tuple[str, Any], ...] = ()
    products: ClassVar[tuple[Product, ...]] = ()
    schema: ClassVar[str] = "brdfguide/inspect/1"
    header: ClassVar[tuple[str, ...]] = ("format", "directions", "channels", "findings")
    right: ClassVar[tuple[int, ...]] = (1, 2)

    def asked(self) -> dict[str, Any]:
        return {"work": "inspect", "reading": canonical(self.reading)}

    def reads(self, file: Path | Held) -> list[Path]:
        return formats.named_in(file)

    def of(self, file: Path | Held) -> MadeAnswer:
        measurement = formats.read(file, **dict(self.reading))
        found = examine.examine(measurement)
        document = inspection.document(measurement, found, examine.changes(measurement, found))
        return MadeAnswer(plain(document), _written_nowhere)

    def brief(self, document: dict) -> tuple[str, ...]:
        data = document["data"]
        doubts = [each["code"] for each in data["findings"] if each["severity"] != "note"]
        return data["format"], str(data["samples"]), str(len(data["channels"])), ",".join(doubts) or "-"


@dataclass(frozen=True, eq=False, kw_only=True)
class ExportWork:
    """`export`: a fit or a material as a file for a renderer."""

    target: str
    products: tuple[Product, ...]
    model: str | None = None
    most: float | None = None
    force: bool = False
    command: str = ""
    schema: ClassVar[str] = "brdfguide/export/1"
    header: ClassVar[tuple[str, ...]] = ("target", "written", "off")
    right: ClassVar[tuple[int, ...]] = (2,)

    def asked(self) -> dict[str, Any]:
        return {"work": "export", **canonical(self)}

    def reads(self, file: Path | Held) -> list[Path]:
        return []

    def of(self, file: Path | Held) -> MadeAnswer:
        name = str(file)
        surfaces = [saved.read_surface(name, self.model)] if name.endswith(".json") else every_described(name)
        shown = [exporters.coloured(each, Path(name).stem, self.command) for each in surfaces]
        taken, made = exporters.held_best(self.target, shown, None, most=self.most, stem=Path(name).stem)

        def write(product: Product, path: Path) -> None:
            """The file with those beside it. Raises InputError where one is there that may not be replaced."""
            if not path.parent.is_dir():
                make_folder(path.parent)
            for where, content in exporters.files_of(made, path).items():
                write_whole(where, content, force=self.force)

        return MadeAnswer(plain(exporters.statement_document(made.statement, taken, [])), write)

    def brief(self, document: dict) -> tuple[str, ...]:
        error = document["rms_ln"]
        return document["target"], document["status"], "-" if error is None else off_words(100 * expm1(error))
