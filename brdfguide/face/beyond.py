"""What a fit is asked beyond its ranking, as blocks of its document: the same for one file and for one of many."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from ..records import dataclass
from .answers import FitAnswer

if TYPE_CHECKING:
    from ..data.measurement import Measurement
    from ..fitting.fit import FitOptions
    from ..fitting.job import Job
    from ..fitting.ranked import Ranking
    from ..models.surface import Surface
    from ..scene.scene import Scene

Tell = Callable[[str], None]
Bar = Callable[[int], AbstractContextManager[Tell]]  # steps -> a function that names each as it begins
SCENE_STEPS = 5
BASELINE_STEPS = 5


def no_bar(steps: int) -> AbstractContextManager[Tell]:
    """Names no step."""
    return nullcontext(lambda what: None)


@dataclass(frozen=True, eq=False, kw_only=True)
class Beyond:
    """Blocks that a fit's document has only where they are asked for."""

    scene: "Scene | None" = None
    explain: bool = False
    next_: bool = False
    baselines: bool = False
    basis_from: Path | None = None
    shader: str | None = None
    numbers: bool = False  # what to type into other programs
    asked_for_numbers: bool = True  # and not only shown because people read the answer


def add_beyond(
    asked: Beyond, answer: FitAnswer, file: Path, job: "Job", kind: str | None, bar: Bar = no_bar
) -> "dict[str, Surface]":
    """Adds what is asked to the answer's document; gives the shader's best surface by its name, where one was asked.

    Takes  kind, metal or dielectric as the candidates were chosen by.    Raises InputError where `basis_from` holds too
    few tables, NoAnswer where the shader does not converge.
    """
    from ..report.documents import fit as document
    from ..report.documents.digest import with_digest

    ranked, measurement, result = answer.ranking, answer.measurement, answer.document
    before = result.copy()
    if asked.scene is not None:
        result |= scene_blocks(asked.scene, ranked, measurement, job.timing, bar)
    if asked.explain:
        result["grown"] = document.grown_block(ranked, explain=True)
    if asked.next_:
        result["next"] = _next(ranked, measurement)
    if asked.baselines:
        from .basis_tables import baselines_of

        with bar(BASELINE_STEPS) as tell:
            result["baselines"] = baselines_of(measurement, file, asked.basis_from, job.timing, tell)
    if asked.numbers and (asked.asked_for_numbers or not answer.no_answer):
        found = numbers_to_type([answer.surface], measurement, asked=asked.asked_for_numbers)
        result |= {"numbers": found} if found else {}
    surfaces = {}
    if asked.shader is not None:
        result["as"], surfaces[asked.shader] = fitted_as(asked.shader, ranked, measurement, kind, job.options)
    if any(value is not before.get(key) for key, value in result.items()):
        result |= with_digest(result)
    return surfaces


def scene_blocks(
    scene: "Scene", ranked: "Ranking", measurement: "Measurement", timing: bool, bar: Bar = no_bar
) -> dict:
    """The recommended fit in a scene, `scene`, and what this does not need of it, `left_out`."""
    from ..report.documents import pruned
    from ..scene import prune as pruning

    surface = ranked.recommended.fit.surface
    with bar(SCENE_STEPS) as tell:
        found = pruning.prune(surface, scene, geom_of_data=measurement.geom, progress=tell, timing=timing)
    return {"scene": pruned.document(found, timing), "left_out": pruned.left_out(found, timing)}


def numbers_to_type(
    surfaces: "Sequence[Surface]", measurement: "Measurement | None" = None, *, asked: bool = True
) -> list[dict]:
    """What to type into other programs, of candidates for one surface, best first; with the errors against the
    measurement where there is one. None where nobody asked and the surface is not one to look at: its channels carry no
    colour, or it reflects nothing.    Raises NoAnswer for such a surface where they are asked for.
    """
    from ..errors import NoAnswer
    from ..exporters.cards import cards
    from ..physics.colour import in_the_visible
    from ..report.documents.numbers import numbers_block

    if not asked and not in_the_visible(surfaces[0].wavelength):
        return []
    measured = None if measurement is None else (measurement.geom, measurement.brdf)
    try:
        return numbers_block(cards(surfaces, measured=measured))
    except NoAnswer:
        if asked:
            raise
        return []


def fitted_as(
    name: str, ranked: "Ranking", measurement: "Measurement", kind: str | None, options: "FitOptions | None" = None
) -> "tuple[dict, Surface]":
    """What `--as` asks for: the document's block and the shader's best surface."""
    from ..fitting.as_shader import as_shader, read_otherwise, shader_law
    from ..fitting.fit import FitOptions
    from ..report.documents.as_shader import as_shader_block

    found = as_shader(measurement, shader_law(name), options or FitOptions(), kind=kind)
    best = found.recommended.fit
    return as_shader_block(name, found, ranked, read_otherwise(best, measurement)), best.surface


def _next(ranked: "Ranking", measurement: "Measurement") -> dict:
    """What to measure next; of photographs, which picture to take."""
    from ..fitting.next_measurement import propose
    from ..fitting.next_picture import propose_picture
    from ..flags import Effect
    from ..report.documents import fit as document

    if any(each.effect is Effect.PHOTOGRAPHED for each in measurement.findings):
        return document.next_picture_block(propose_picture(ranked, measurement))
    return document.next_block(propose(ranked, measurement))
