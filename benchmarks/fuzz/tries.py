"""One case: what is made of it, what is done with it, and how it ended."""

import ast
import contextlib
import io
import os
import shutil
import traceback
import warnings
from pathlib import Path
from random import Random
from typing import NamedTuple

import documents
import readers

ANSWERED, REFUSED, TRACEBACK, WARNING, UNFIT = "answered", "refused", "traceback", "warning", "unfit"
LONGEST = 1300  # letters of a sentence, by the line
TEXTS = ("glsl", "osl", "usd", "pbrt", "mitsuba", "mitsuba-dict", "materialx", "radiance", "radiance-cal", "gltf")
FEW = 2000  # values that are also fitted, now and then
FITTED = {"extremes"}  # targets of which every case is


class Case(NamedTuple):
    """How one ended, and where it went wrong."""

    outcome: str
    detail: str = ""


class Unfit(Exception):
    """What came out could act on a terminal, or holds what is no number."""


class Refused(Exception):
    """A command that ended with another status than 0, and said why."""


TARGETS = [*readers.MAKERS, "fit-json", "description", "scene", "names", "options"]


def case(target: str, seed: int, index: int) -> Case:
    """Makes and tries one case in the current folder. The same three give the same case."""
    from brdfguide.errors import BrdfguideError

    draw = Random(f"{target}:{seed}:{index}")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            tried(target, draw, index)
        except Refused:
            return Case(REFUSED)
        except BrdfguideError as error:
            long = max(map(len, str(error).split("\n")))
            return Case(REFUSED) if long <= LONGEST and _prints(str(error)) else Case(UNFIT, f"a sentence of {long}")
        except Warning as error:
            return Case(WARNING, _where(error))
        except Unfit as error:
            return Case(UNFIT, str(error))
        except Exception as error:
            return Case(TRACEBACK, _where(error))
    return Case(ANSWERED)


def _where(error: BaseException) -> str:
    """The innermost line inside the package, and the error."""
    places = [
        f"{Path(frame.filename).name} line {frame.lineno}"
        for frame in traceback.extract_tb(error.__traceback__)
        if "brdfguide" in Path(frame.filename).parts
    ]
    return f"{type(error).__name__} in {places[-1] if places else 'the harness'}: {ascii(str(error))[:150]}"


def tried(target: str, draw: Random, index: int) -> None:
    if target in readers.MAKERS:
        _read(readers.MAKERS[target](draw), fit=target in FITTED or index % 5 == 0)
    elif target == "fit-json":
        _saved(documents.fit_json(draw))
    elif target == "description":
        _described(documents.description(draw))
    elif target == "scene":
        _scene(documents.scene(draw))
    elif target == "names":
        _named(documents.name(draw), draw)
    else:
        _asked(documents.command_line(draw))


def _prints(text: str) -> bool:
    return text.replace("\n", "").replace("\t", "").isprintable()


def _fit_to_be_shown(text: str) -> None:
    if not _prints(text):
        raise Unfit(f"signs that act: {ascii(text)[:200]}")


def _read(content: bytes | dict[str, bytes], fit: bool) -> None:
    """Read, examined, told in words, written as plain CSV; a few are fitted too."""
    from brdfguide import printable
    from brdfguide.data import examine, formats
    from brdfguide.data.formats import table
    from brdfguide.fitting.compare import compare
    from brdfguide.models import candidates
    from brdfguide.report.documents import fit as fit_document
    from brdfguide.report.documents import inspection
    from brdfguide.report.text.inspection import text
    from brdfguide.report.text.ranking import ranking_text

    path = _placed(content)
    measurement = formats.read(path)
    if measurement.brdf.shape != (len(measurement.geom), len(measurement.channels)):
        raise Unfit(f"shape {measurement.brdf.shape}")
    found = examine.examine(measurement)
    told = inspection.document(measurement, found, examine.changes(measurement, found))
    _fit_to_be_shown(text(printable.document(told)))
    if measurement.brdf.size <= 50 * FEW:
        written = "\n".join(table.written(measurement))
        if any(line[:1] in "-0123456789" and ("inf" in line or "nan" in line) for line in written.split("\n")):
            raise Unfit("inf or nan written")
    if fit and measurement.brdf.size <= FEW:
        prepared = examine.prepared(measurement, anyway=True)
        ranked = compare(prepared, candidates.of_kind(None, ("lambertian+ggx", "lambertian")))
        _fit_to_be_shown(ranking_text(printable.document(fit_document.fit_document(ranked, prepared))))


def _placed(content: bytes | dict[str, bytes]) -> Path:
    """A file with this content, or a folder with these files."""
    if isinstance(content, bytes):
        Path("case").write_bytes(content)
        return Path("case")
    shutil.rmtree("case.zarr", ignore_errors=True)
    for name, each in content.items():
        place = Path("case.zarr", name)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(each)
    return Path("case.zarr")


def _saved(content: bytes) -> None:
    """A surface, its export, and its audit's first values."""
    from brdfguide import exporters
    from brdfguide.fitting import saved

    Path("case.json").write_bytes(content)
    surface = exporters.coloured(saved.read_surface("case.json"), "x", "x")
    content_ = exporters.export("glsl", surface).content
    _fit_to_be_shown(str(content_))


def _described(content: bytes) -> None:
    """What the guidelines say, in words, and an export."""
    from brdfguide import exporters, printable
    from brdfguide.advice import material, recommend
    from brdfguide.report.documents import recommendation
    from brdfguide.report.text.recommendation import text

    Path("case.yaml").write_bytes(content)
    found = recommend.recommend(material.read_material("case.yaml"), True)
    _fit_to_be_shown(text(printable.document(recommendation.document(found, False, True)), True))
    if found.candidates:
        surface = exporters.coloured(found.candidates[0].surface, found.material.name, "x")
        _one_statement(str(exporters.export("mitsuba-dict", surface).content))


def _one_statement(text: str) -> None:
    _fit_to_be_shown(text)
    if len(ast.parse(text.encode(errors="replace")).body) != 1:
        raise Unfit("more than one statement in Python")


def _scene(content: bytes) -> None:
    from brdfguide.scene import scene

    Path("scene.yaml").write_bytes(content)
    scene.read_scene("scene.yaml")


def _named(name: str, draw: Random) -> None:
    """A surface of that name for every target of text; a file of that name inspected."""
    from brdfguide import exporters, models
    from brdfguide.models.surface import Surface

    values = {"lambertian.albedo": 0.3, "ggx.alpha": 0.2}
    plain = Surface(models.get("lambertian+ggx"), values, (name,), 0.55)
    for target in draw.sample(TEXTS, 3):
        made = exporters.export(target, exporters.coloured(plain, name, f"x {name}"), stem=name)
        for text in (made.content, *made.beside.values()):
            _fit_to_be_shown(str(text))
            str(text).encode()
        if target == "mitsuba-dict":
            _one_statement(str(made.content))
    file = documents.typed(name)[:60]
    if file.strip(".") and len(os.fsencode(file)) < 250:
        Path(file).write_text("theta_i,theta_r,brdf\n30,10,0.2\n30,20,0.3\n30,30,0.4\n30,40,0.3\n")
        try:
            command = draw.choice((["inspect"], ["fit", "-m", "lambertian"]))
            _asked([*command, "--", file] if file != "-" else ["inspect", "./-"])
        finally:
            Path(file).unlink()


def _asked(words: list[str]) -> None:
    """A command line, with what it prints; a sentence of our own mistake is one."""
    from brdfguide.cli import main

    out, err = io.StringIO(), io.StringIO()
    status: object = 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main(words)
        except SystemExit as end:
            status = end.code or 0
    _fit_to_be_shown(out.getvalue() + err.getvalue())
    if status not in (0, 1, 2):
        raise Unfit(f"status {status}: {words}"[:300])
    if "mistake of brdfguide" in err.getvalue():
        raise Unfit(f"{err.getvalue().partition('report it: ')[2][:200]} {ascii(words)[:300]}")
    if status == 2 and not err.getvalue().strip():
        raise Unfit(f"no sentence: {words}"[:300])
    if status:
        raise Refused


def furnished(folder: Path) -> None:
    """What command lines find in their folder."""
    rows = "".join(f"{i},{r},{0.1 + 0.01 * abs(i - r):.3f}\n" for i in (10, 40, 70) for r in range(-60, 71, 10))
    (folder / "a.csv").write_text(f"# wavelength_nm: 550\ntheta_i,theta_r,brdf\n{rows}")
    (folder / "m.yaml").write_text("kind: dielectric\nfinish: satin\ndiffuse_reflectance: 0.5\n")
    (folder / "fit.json").write_bytes(documents.fit_json(_First()))


class _First(Random):
    """Draws the first of everything, so that nothing is damaged."""

    def choice(self, seq):
        return seq[1] if tuple(seq) == documents.LAWS else seq[0]

    def random(self):
        return 0.99
