"""`brdfguide examples [FOLDER]`: the small data, scenes and descriptions that the documentation uses."""

from pathlib import Path
from typing import Annotated

from typer import Argument

from ..errors import InputError
from ._options import ForceOption, QuietOption, remark, tell

EXAMPLES = "Examples: brdfguide examples examples | brdfguide examples"
KINDS = (".csv", ".yaml", ".jpg", ".sh", ".md")


def examples(
    folder: Annotated[Path | None, Argument(metavar="[FOLDER]", help="Where to write them; none: list them.")] = None,
    force: ForceOption = False,
    quiet: QuietOption = False,
) -> None:
    """Write the example data, scenes and photographs into a folder, or list them."""
    from ..files import folder as made
    from ..files import taken, write_whole
    from ..shipped import shipped

    source = shipped("examples")
    if source is None:
        raise InputError("this installation has no examples; they lie in examples/ of the source")
    names = [
        path.relative_to(source)
        for path in sorted(source.rglob("*"))
        if path.suffix in KINDS and "samples" not in path.relative_to(source).parts
    ]
    if folder is None:
        if force:
            raise InputError("--force: without a folder nothing is written")
        tell("\n".join(map(str, names)))
        return
    fresh = [name for name in names if not _holds(folder / name, source / name)]
    if there := [name for name in fresh if taken(folder / name) and not force]:
        raise InputError(f"{folder / there[0]} exists; --force replaces it")
    for name in fresh:
        made((folder / name).parent)
        write_whole(folder / name, (source / name).read_bytes())
    before = f"; {len(names) - len(fresh)} were there" if len(fresh) < len(names) else ""
    remark(f"wrote {len(fresh)} files to {folder}{before}", quiet)


def _holds(path: Path, source: Path) -> bool:
    """Whether the very file is there already."""
    return path.is_file() and path.read_bytes() == source.read_bytes()
