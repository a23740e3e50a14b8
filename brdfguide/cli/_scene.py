"""`--scene`, shared by the commands that recommend a model: what the scene does not need is left out."""

from typing import Annotated

from typer import Option

from ._options import progress

STEPS = 5


def _scene(where: str | None):
    """A callback: the scene in a file, read before anything is computed for it."""
    if where is None:
        return None
    from .. import scene as scenes

    return scenes.DEFAULT if where == "default" else scenes.read_scene(where)


SceneOption = Annotated[str | None, Option("--scene", callback=_scene, help="A scene's YAML, or `default`: leave out what it does not need.")]


def prune(scene, model, values, *, timing: bool, data=None, quiet: bool = False):
    """The model without what the scene does not need."""
    from .. import pruning

    with progress(STEPS, quiet) as tell:
        return pruning.prune(model, values, scene, geom_of_data=data, progress=tell, timing=timing)


def of_ranking(scene, ranked, measurement, result: dict, timing: bool, quiet: bool) -> str:
    """The text about the recommended fit in a scene; `result` gets the same as `scene` and `left_out`."""
    from ..report import pruned

    best = ranked.recommended.fit
    found = prune(scene, best.model, best.values, timing=timing, data=measurement.geom, quiet=quiet)
    result |= {"scene": pruned.document(found, timing), "left_out": pruned.left_out(found, timing)}
    return "\n\n" + pruned.text(result["scene"], not quiet)


def of_answer(scene, answer, document: dict, timing: bool, quiet: bool) -> str:
    """The same about the first candidate of a recommendation."""
    if not answer.candidates:
        return ""
    from numpy import array

    from ..report import pruned

    pick = answer.candidates[0]
    values = {key: array(value) if isinstance(value, tuple) else value for key, value in pick.start.items()}
    document["scene"] = pruned.document(prune(scene, pick.model, values, timing=timing, quiet=quiet), timing)
    return "\n\n" + pruned.text(document["scene"], not quiet)
