"""`brdfguide prune-answers DIR`: what of a folder of answers no run will ask for again."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from .. import printable
from ..records import dataclass
from ._options import JsonOption, QuietOption, print_json, remark
from ._streams import say

EXAMPLES = "Examples: brdfguide prune-answers fits | brdfguide prune-answers fits --yes"


HEADER = ("why", "answer", "of")


@dataclass(frozen=True, eq=False, kw_only=True)
class PruneRequest:
    """Everything that `prune-answers` is asked."""

    folder: Annotated[Path, Argument(metavar="DIR", help="What `fit --out DIR` made; from the folder it was made in.")]
    yes: Annotated[bool, Option("--yes", help="Remove them; without it they are listed.")] = False
    json: JsonOption = False
    quiet: QuietOption = False


def prune_answers(request: PruneRequest) -> None:
    """List answers whose data, options or version are gone, and remove them with --yes."""
    from ..batch.stale_answers import remove, stale_answers
    from ..batch.store import known_store
    from ..report.text.table import columns

    store = known_store(request.folder)
    stale = stale_answers(store)
    if request.yes:
        remove(store, stale)
    size = sum(each.size for each in stale)
    if request.json:
        rows = [{"key": each.key, "why": each.why, "names": list(each.names), "bytes": each.size} for each in stale]
        print_json({"schema": "brdfguide/prune-answers/1", "removed": request.yes, "bytes": size, "stale": rows})
    elif stale:
        lines = [(each.why, each.key[:12], printable.sentence(", ".join(each.names)) or "-") for each in stale]
        say(columns(HEADER, lines))
    else:
        say("nothing is stale")
    if stale:
        done = "removed" if request.yes else "would go with --yes"
        remark(f"{len(stale)} answers, {size / 1e6:.2g} MB, {done}", request.quiet)
