"""Options about many surfaces, shared by the commands that answer them."""

from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Annotated

from typer import Context, Option

from ..errors import InputError
from ..records import dataclass
from ._request import is_typed, refuse

PANEL = "Several files"
ONE = "one file is answered in one process; it is for several"


def _positive(value: float | None) -> float | None:
    if value is not None and not value > 0:
        raise InputError(f"--timeout, --memory: found {value:g}; wanted more than 0")
    return value


@dataclass(frozen=True, eq=False, kw_only=True)
class Many:
    """Which surfaces, who answers them, and what becomes of the answers."""

    files_from: Annotated[
        str | None,
        Option("--files-from", help="Names from this list, a line each; - for standard input.", rich_help_panel=PANEL),
    ] = None
    null: Annotated[
        bool, Option("--null", "-0", help="Names in the list end with a zero byte.", rich_help_panel=PANEL)
    ] = False
    include: Annotated[
        str | None,
        Option("--include", help="Of folders only such names: '*.csv,*.binary'.", rich_help_panel=PANEL),
    ] = None
    recurse: Annotated[bool, Option("--recurse", help="Folders inside folders too.", rich_help_panel=PANEL)] = False
    shard: Annotated[
        str | None,
        Option(
            "--shard", help="Only part I/N of the list, 0/N the first; auto in an array job.", rich_help_panel=PANEL
        ),
    ] = None
    jobs: Annotated[int, Option("--jobs", help="Processes for several files.", rich_help_panel=PANEL)] = 1
    scheduler: Annotated[
        str | None,
        Option("--scheduler", help="A dask cluster instead: tcp://HOST:PORT.", rich_help_panel=PANEL),
    ] = None
    out: Annotated[
        Path | None, Option("--out", help="Folder for an answer per file; run again to resume.", rich_help_panel=PANEL)
    ] = None
    timeout: Annotated[
        float | None, Option("--timeout", help="Seconds for a file.", callback=_positive, rich_help_panel=PANEL)
    ] = None
    memory: Annotated[
        float | None,
        Option("--memory", help="MB of data for a process.", callback=_positive, rich_help_panel=PANEL),
    ] = None
    retries: Annotated[
        int, Option("--retries", help="How often more, where its process died.", min=0, rich_help_panel=PANEL)
    ] = 1
    failed_again: Annotated[
        bool, Option("--failed-again", help="Try what failed before once more.", rich_help_panel=PANEL)
    ] = False
    events: Annotated[
        str | None,
        Option(
            "--events", help="A line of JSON for all that happens, in this file; - for stdout.", rich_help_panel=PANEL
        ),
    ] = None
    keep_going: Annotated[
        bool, Option("--keep-going", help="Status 0 if any file was answered.", rich_help_panel=PANEL)
    ] = False

    def is_many(self, words: list[str]) -> bool:
        """Whether there is a row for each, rather than one answer told in full."""
        return bool(self.out or self.shard) or self.scheduler is not None or self.is_several(words)

    def is_several(self, words: list[str]) -> bool:
        """Whether there may be more than one: a list, several names, a folder or a pattern."""
        from ..opening import is_folder

        return bool(self.files_from) or len(words) != 1 or is_folder(words[0]) or self._is_pattern(words[0])

    @staticmethod
    def _is_pattern(word: str) -> bool:
        from ..opening import exists

        return any(mark in word for mark in "*?[") and not exists(word)

    def is_typed(self, context: Context) -> bool:
        """Whether any option about many was given."""
        return any(is_typed(context, each.name) for each in fields(self))

    def refuse_for_one(self, context: Context) -> None:
        """Raises InputError for those that could do nothing for a single answer."""
        refuse(context, *(each.name for each in fields(self)), because=ONE)

    def labels(self, context: Context, words: list[str], is_ours: Callable[[Path], bool] | None = None) -> list[str]:
        """Every name that is meant, those of this shard alone; of folders what `is_ours`, or else what some format
        claims. Raises InputError for options that could do nothing."""
        from ..batch.listing import expanded, from_list
        from ..opening import is_folder
        from ._options import remark

        if self.files_from is None:
            refuse(context, "null", because="without --files-from there is no list")
            listed = []
        else:
            if self.files_from == "-" and "-" in words:
                raise InputError("standard input cannot be the list and a file of it")
            listed = from_list(self.files_from, self.null)
        folders = any(map(is_folder, (*words, *listed)))
        if not folders:
            refuse(context, "include", "recurse", because="they are of folders, and none is named")
        include = tuple(filter(None, (each.strip() for each in (self.include or "").split(","))))
        found = expanded([*words, *listed], include, self.recurse, is_ours or _is_readable)
        if not found.labels:
            raise InputError(f"{self.files_from or 'no file'}: found no name; wanted at least one")
        if found.passed_over:
            remark(f"note: {found.passed_over} files of the folders are of no format that can be read")
        return self.of_shard(found.labels)

    def of_shard(self, named: list) -> list:
        """Those names, or tasks by their labels, that are this shard's."""
        from ..batch.listing import shard_of

        if self.shard is None:
            return named
        shard = shard_of(self.shard)
        return [each for each in named if shard.has(getattr(each, "label", each))]

    def check(self, context: Context, labels: int) -> None:
        """Raises InputError for numbers and combinations that mean nothing."""
        if self.jobs < 1:
            raise InputError(f"--jobs {self.jobs}: wanted at least 1")
        if self.scheduler is not None and not self.scheduler:
            raise InputError("--scheduler: found nothing; wanted an address such as tcp://127.0.0.1:8786")
        if self.scheduler:
            because = "with --scheduler the cluster's own settings say so"
            refuse(context, "jobs", "timeout", "memory", "retries", because=because)
        elif self.jobs == 1 and self.timeout is None and self.memory is None:
            refuse(context, "retries", because="without --jobs, --timeout or --memory no process can die but ours")
        if self.memory is not None:
            from ..batch.process import check_limits

            check_limits()
        if self.out is None:
            refuse(context, "failed_again", because="without --out nothing is known of earlier runs")


def _is_readable(path: Path) -> bool:
    from ..data import formats

    return formats.is_readable(path)


def from_missing(source: str, base) -> list[str]:
    """The names in a list that have no answer in a database of them. Raises InputError where it cannot be read."""
    from ..batch.collected import answered_names, stored_name
    from ..batch.listing import from_list

    answered = answered_names(base)
    return [name for name in from_list(source, null=False) if stored_name(name) not in answered]
