"""Values that a shell completes: names of models, materials, targets, documents, and the words that options take.

Nothing but the names is loaded, so that a key is answered at once.
"""

import os
from collections.abc import Callable, Iterable
from inspect import Signature

from .. import catalog

ASKED = "_BRDFGUIDE_COMPLETE"  # what the shells' scripts set
WORDS = {  # options of one meaning wherever they stand -> the words that they take
    "--kind": ("metal", "dielectric"),
    "--metric": ("ln", "cube-root", "relative", "cosine", "seen"),
    "--close": ("look", "none", "1%"),
    "--weights": ("auto", "stderr", "sampling", "none"),
    "--unit": ("deg", "rad", "gon", "mrad", "arcmin"),
    "--quantity": ("brdf", "brdf-cos", "brdf-cos-i", "reflectance-factor", "hdrf", "radf"),
    "--mirror-side": ("positive", "negative", "phi=180", "phi=0"),
    "--rotation-sense": ("ccw", "cw"),
    "--x": ("angle", "beta"),
    "--format": ("png", "svg", "pdf"),
    "--lobe": ("ggx", "beckmann"),
    "--as": ("openpbr", "standard-surface", "gltf", "disney"),
}
CONVERTED = ("zemax", "fred", "lighttools", "astm", "speos", "speos-anisotropic", "tracepro", "csv", "merl")


def wanted(known: list[str]) -> list[str]:
    """The commands that must be built for what a shell asks: the one that stands on its line, or all."""
    line = os.environ.get("COMP_WORDS") or os.environ.get("_TYPER_COMPLETE_ARGS") or ""
    words = line.split()
    return [words[1]] if len(words) > 1 and words[1] in known and not line.endswith(words[1]) else known


def offer(command: str, function: Callable) -> None:
    """Tells the parser which values the parameters of a command take."""
    for parameter in Signature.from_callable(function).parameters.values():
        for about in getattr(parameter.annotation, "__metadata__", ()):
            first = getattr(about, "default", None)  # where the parser keeps the first name that an option is given
            switches = [*([first] if isinstance(first, str) else []), *(getattr(about, "param_decls", None) or ())]
            names = _names(command, parameter.name, switches)
            if names is not None:
                about.autocompletion = _completion(names)


def _names(command: str, name: str, switches: Iterable[str]) -> Callable[[], Iterable[str]] | None:
    """What lists the values of an option or an argument; None where they are free."""
    for switch in switches:
        if switch in WORDS:
            return lambda: WORDS[switch]
        if switch in ("--models", "--model", "-m"):
            return models
        if switch == "--to":
            return (lambda: CONVERTED) if command == "convert" else targets
        if switch == "--export":
            return lambda: [f"{target}:" for target in targets()]
        if switch == "--scene":
            return scenes
    if switches:
        return None
    return ARGUMENTS.get((command, name))


def models() -> list[str]:
    return catalog.names("models")


def targets() -> list[str]:
    return catalog.names("exporters")


def materials() -> list[str]:
    from ..advice import library

    return library.library_names()


def surfaces() -> list[str]:
    """What compares and previews: a material or a model."""
    return [*materials(), *models()]


def scenes() -> list[str]:
    """The one that is built in, and those that lie here."""
    from glob import glob

    return ["default", *sorted(glob("*.yaml") + glob("scenes/*.yaml") + glob("examples/scenes/*.yaml"))]


def documents() -> list[str]:
    from importlib.resources import files

    folder = files(__package__.rpartition(".")[0]) / "schemas"
    return sorted(each.name.removesuffix(".json") for each in folder.iterdir())


ARGUMENTS = {
    ("models", "name"): models,
    ("evaluate", "words"): models,
    ("check", "model"): models,
    ("check", "models"): models,
    ("materials", "name"): materials,
    ("recommend", "inputs"): materials,
    ("export", "words"): materials,
    ("numbers", "surface"): surfaces,
    ("preview", "surface"): surfaces,
    ("compare", "surfaces"): surfaces,
    ("schema", "name"): documents,
}


def _completion(names: Callable[[], Iterable[str]]) -> Callable[[str], list[str]]:
    def complete(incomplete: str) -> list[str]:
        """Those that go on as begun, after the last + or comma of several."""
        last = max(incomplete.rfind("+"), incomplete.rfind(",")) + 1
        head, begun = incomplete[:last], incomplete[last:]
        return [head + each for each in names() if each.startswith(begun)]

    return complete


def codes_begun(incomplete: str) -> list[str]:
    """Codes of flags, for --explain."""
    from ..flags import FLAGS

    return [code for code in FLAGS if code.startswith(incomplete)]
