"""`--scene`, shared by the commands that recommend a model: what the scene does not need is left out."""

from typing import Annotated

from typer import Option

from .. import printable
from ._options import Output, progress


def _scene(where: str | None):
    """A callback: the scene in a file, read before anything is computed for it."""
    if where is None:
        return None
    from ..scene import scene as scenes

    return scenes.DEFAULT if where == "default" else scenes.read_scene(where)


SceneOption = Annotated[
    str | None,
    Option("--scene", callback=_scene, help="A scene's YAML, or `default`: leave out what it does not need."),
]


def of_ranking(scene, ranked, measurement, result: dict, output: Output) -> str:
    """The text about the recommended fit in a scene; `result` gets the same as `scene` and `left_out`."""
    from ..face.beyond import scene_blocks
    from ..report.text.pruned import text

    result |= scene_blocks(scene, ranked, measurement, output.timing, lambda steps: progress(steps, output.quiet))
    return "\n\n" + text(printable.document(result["scene"]), not output.quiet)


def of_answer(scene, answer, document: dict, output: Output) -> str:
    """The same about the first candidate of a recommendation."""
    if not answer.candidates:
        return ""
    from ..face.beyond import SCENE_STEPS
    from ..report.documents import pruned
    from ..report.text.pruned import text
    from ..scene import prune as pruning

    with progress(SCENE_STEPS, output.quiet) as tell:
        found = pruning.prune(answer.candidates[0].surface, scene, progress=tell, timing=output.timing)
    document["scene"] = pruned.document(found, output.timing)
    return "\n\n" + text(printable.document(document["scene"]), not output.quiet)
