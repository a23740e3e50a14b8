"""What is drawn and written of an answer, each into a file whose name follows from the surface's."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .. import exporters, printable
from ..errors import InputError, choices, would_be_lost
from ..face.pictures import ANGLE, draw_fit, write_page
from ..files import folder as make_folder
from ..files import picture_kind, write_whole
from ..records import dataclass
from ..report.documents.values import residuals
from ..report.text.values import residuals_csv
from .keys import drawing_engine

PLOT, REPORT, RESIDUALS, EXPORT = "plot", "report", "residuals", "export"
STEM, PARENT, ANSWER = "{stem}", "{parent}", "{answer}"
SUFFIXES = {PLOT: ".plot.png", REPORT: ".report.html", RESIDUALS: ".residuals.csv"}
FOLLOWS = "wanted {stem} in it, the surface's name, or every surface would have the same file"


@dataclass(frozen=True)
class Product:
    """One file of every answer."""

    kind: str
    pattern: str
    target: str = ""  # of an export
    axis: str = ANGLE  # of a plot
    theme: str = "light"
    most: float | None = None  # rms ln beyond which an export is not written

    @property
    def said(self) -> str:
        """What it follows from beside the answer."""
        return f"{self.kind} {self.target} {self.axis} {self.theme} {self.most} {drawing_engine()[:16]}"

    def place(self, label: str, answer: Path | None) -> Path:
        """Its file for one surface; `answer` is where the surface's own answer lies."""
        stem, parent = stem_of(label), Path(label).parent.name
        path = self.pattern.replace(STEM, stem).replace(PARENT, printable.stem(parent))
        return Path(path.replace(ANSWER, str(answer.with_suffix("")) if answer else ""))


def stem_of(label: str) -> str:
    """A surface's name as part of a file's: of `d/steel.csv [paint=2]` steel_paint=2."""
    file, bracket, group = label.partition(" [")
    name = Path(file).stem or Path(file).name
    return printable.stem(f"{name}_{group.removesuffix(']')}" if bracket else name, room=40).replace(" ", "_")


def path_for(path: Path | None, label: str) -> Path | None:
    """The path with a surface's name in its pattern, and the folder for it; one without a pattern as it is."""
    if path is None or not any(part in str(path) for part in (STEM, PARENT)):
        return path
    place = Product("", str(path)).place(label, None)
    _spare(place, _read(label))
    make_folder(place.parent)
    return place


def patterned(kind: str, pattern: Path | str, many: bool, option: str = "", **more) -> Product:
    """A product in a file of the user's, by an `option` that is called otherwise than its kind. Raises InputError for a
    name that is the same for every surface of many."""
    text = str(pattern)
    if many and not any(part in text for part in (STEM, PARENT)):
        raise InputError(f"{option or '--' + kind} {text}: {FOLLOWS}, such as {_with_stem(Path(text))}")
    if kind == PLOT:
        picture_kind(text)
    return Product(kind, text, **more)


def listed(words: str) -> list[Product]:
    """`json,report,plot,residuals,export:mitsuba` as products beside the answers. Raises InputError for other words."""
    found = []
    for word in filter(None, (each.strip() for each in words.split(","))):
        kind, colon, target = word.partition(":")
        if kind == EXPORT and colon:
            made = exporters.get(target)
            found.append(Product(EXPORT, f"{ANSWER}.{made.name}{made.suffix}", made.name))
        elif word in SUFFIXES:
            found.append(Product(word, f"{ANSWER}{SUFFIXES[word]}"))
        elif word != "json":  # the answer itself
            raise choices("product", word, ("json", *SUFFIXES, "export:TARGET"))
    return found


def check_apart(products: tuple[Product, ...], labels: list[str]) -> None:
    """Raises InputError where two surfaces, or two products, would have one file, or that of a measurement, before
    anything is computed."""
    read = set().union(*map(_read, labels)) if any(ANSWER not in each.pattern for each in products) else set()
    for product in products:
        if ANSWER in product.pattern:
            continue
        seen: dict[Path, str] = {}
        for label in labels:
            place = product.place(label, None)
            if place in seen:
                hint = "" if PARENT in product.pattern else "; {parent} stands for the folder's name"
                raise InputError(f"{seen[place]} and {label} would both write {place}{hint}")
            seen[place] = label
            _spare(place, read)
    patterns = [each.pattern for each in products]
    if twice := {each for each in patterns if patterns.count(each) > 1}:
        raise InputError(f"{sorted(twice)[0]} is named twice")


def _read(label: str) -> set[str]:
    """The surface's own file; of `steel.csv [paint=2]` steel.csv."""
    return {os.path.realpath(label.partition(" [")[0]), os.path.realpath(label)}


def _spare(place: Path, read: set[str]) -> None:
    """Raises InputError where a file is among those that are read, and would be lost."""
    if os.path.realpath(place) in read:
        raise would_be_lost(str(place))


def make(product: Product, path: Path, answer: Any, file: Path, fitted: dict, command: str) -> None:
    """Writes one of them. Raises InputError where it cannot be written, NoAnswer where a target cannot hold it.

    Takes  answer, a FitAnswer; fitted, target -> the surface fitted as that shader.
    """
    if not path.parent.is_dir():
        make_folder(path.parent)
    _MAKERS[product.kind](product, path, answer, file, fitted, command)


def _plot(product, path, answer, file, fitted, command) -> None:
    draw_fit(path, answer.ranking, answer.measurement, product.axis, product.theme)


def _report(product, path, answer, file, fitted, command) -> None:
    write_page(path, answer.document, answer.ranking, answer.measurement, file, command)


def _residuals(product, path, answer, file, fitted, command) -> None:
    write_whole(path, residuals_csv(residuals(answer.ranking.recommended.fit, answer.measurement)))


def _export(product, path, answer, file, fitted, command) -> None:
    measurement = answer.measurement
    exporters.export_to(
        f"{product.target}:{path}",
        fitted.get(product.target, answer.ranking.recommended.fit.surface),
        measurement.geom,
        name=Path(file).stem,
        command=command,
        most=product.most,
        measured=measurement.brdf,
    )


_MAKERS: dict[str, Callable[..., None]] = {PLOT: _plot, REPORT: _report, RESIDUALS: _residuals, EXPORT: _export}


def _with_stem(path: Path) -> Path:
    return path.with_name(f"{STEM}{path.suffix}")
