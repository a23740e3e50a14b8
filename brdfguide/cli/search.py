"""`brdfguide search DIR 'satin, kind=dielectric'`: surfaces among many answers, by words, numbers and looks."""

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from .. import printable
from ..errors import InputError
from ..records import dataclass
from ._options import JsonOption, QuietOption, picture_file, print_json, remark, working
from ._request import refuse
from ._scene import SceneOption
from ._streams import say

EXAMPLES = (
    "Examples: brdfguide search fits 'satin, kind=dielectric, albedo~0.18' | brdfguide search all.sqlite --like "
    "fit.json --sheet near.png"
)
MOST_ON_A_SHEET = 24
LOOKING = "comparing looks"


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchRequest:
    """Everything that `search` is asked."""

    context: Context
    where: Annotated[Path, Argument(metavar="DIR|FILE.sqlite", help="A folder of answers, or what `collect` made.")]
    query: Annotated[
        str | None,
        Argument(
            help="Words (satin, metal) and numbers (gloss60=10..30, albedo~0.18, file=*steel*), all of which hold."
        ),
    ] = None
    like: Annotated[
        str | None, Option("--like", help="Nearest in looks to this: a fit's JSON, a material, a model with values.")
    ] = None
    alike: Annotated[bool, Option("--alike", help="Groups of those that look the same, one standing for each.")] = False
    scene: SceneOption = None
    most: Annotated[int, Option("--most", "-n", min=1, help="How many are shown.")] = 20
    sheet: Annotated[
        Path | None, Option("--sheet", callback=picture_file, help="Draw those that are shown (png, svg or pdf).")
    ] = None
    json: JsonOption = False
    quiet: QuietOption = False


def search(request: SearchRequest) -> None:
    """Find surfaces among many answers: by words and numbers, by how they look, by what looks the same."""
    from ..batch import collected, conditions
    from ..batch.store import known_store
    from ..opening import is_folder

    context, scene = request.context, request.scene
    if request.like is None and not request.alike:
        refuse(context, "scene", because="it says for which directions looks count; give --like or --alike")
    if request.like is not None:
        refuse(context, "alike", because="--like orders by one surface, --alike groups them all")
    asked = conditions.conditions(request.query or "")
    with ExitStack() as stack:
        if is_folder(request.where):
            with working(f"collecting {request.where.name}", request.quiet):
                base, *_ = stack.enter_context(collected.collected(known_store(request.where)))
        else:
            base = stack.enter_context(collected.opened(request.where))
        more = [*(["doubt"] if request.alike else []), *(["surface"] if request.sheet else [])]
        rows = conditions.matching(base, asked, *more)
        total = base.execute("SELECT count(*) FROM name JOIN fit USING (key)").fetchone()[0]
        if request.alike:
            from ..batch import searching

            with working(LOOKING, request.quiet):
                looks = searching.all_looks(base, scene)  # type: ignore[arg-type]
                groups = _groups(rows, looks)
            _show_groups(request, rows, groups)
            return
        near = None
        if request.like is not None:
            from ..batch import searching
            from ..face.surfaces import named_surface

            with working(LOOKING, request.quiet):
                looks = searching.all_looks(base, scene)  # type: ignore[arg-type]
                near = searching.nearest(looks, named_surface(request.like))
    if near is not None:
        rows.sort(key=lambda row: near.distance.get(row["key"], float("inf")))
    _show(request, rows, near, total)


def _show(request: SearchRequest, rows: list[dict], near, total: int) -> None:
    """The first of the rows, as a table, as JSON, as pictures."""
    shown = rows[: request.most]
    found = [_entry(row, near) for row in shown]
    if request.json:
        tenth = None if near is None else near.tenth
        more = {"matching": len(rows), "files": total, "tenth_seen": tenth}
        print_json({"schema": "brdfguide/search/1", **more, "found": found})
    else:
        say(_table(found))
    remark(f"{len(rows)} of {total} files match, {len(shown)} shown", request.quiet)
    if near is not None and near.tenth is not None:
        remark(f"the tenth nearest of all lies {near.tenth:.1f} L* away", request.quiet)
    if request.sheet:
        notes = [f"{each['seen_from']:.1f} L* away" if near else "" for each in found]
        _draw(request.sheet, shown, notes, request.quiet)


def _entry(row: dict, near=None) -> dict:
    from ..batch.conditions import SHOWN

    return {name: row[name] for name in SHOWN} | ({} if near is None else {"seen_from": near.distance.get(row["key"])})


def _table(found: list[dict]) -> str:
    from ..printable import off_words_of
    from ..report.text.table import columns

    if not found:
        return "nothing matches"
    near = "seen_from" in found[0]
    lines = []
    for each in found:
        rms = each["rms_ln"]
        off = "-" if rms is None else off_words_of(rms)
        line = [_cell(each[name]) for name in ("file", "recommended", "gloss60", "albedo")]
        lines.append([*line, off, *([_cell(each["seen_from"])] if near else [])])
    header = ("file", "recommended", "gloss60", "albedo", "off", *(("L* away",) if near else ()))
    return columns(header, lines, right=tuple(range(2, len(header))))


def _cell(value) -> str:
    if value is None:
        return "-"
    return f"{value:.3g}" if isinstance(value, float) else printable.line(value)


def _groups(rows: list[dict], looks) -> list[list[str]]:
    """Files that look the same, a group each, the one that stands for it first."""
    from ..batch.searching import alike_groups

    by_key: dict[str, list[dict]] = {}
    for row in rows:
        by_key.setdefault(row["key"], []).append(row)
    groups = alike_groups(looks, {key: each[0]["doubt"] for key, each in by_key.items()})
    files = [[row["file"] for key in group for row in by_key.get(key, ())] for group in groups]
    files += [
        [row["file"] for row in each] for key, each in by_key.items() if not any(key in group for group in groups)
    ]
    return sorted(group for group in files if len(group) > 1)


def _show_groups(request: SearchRequest, rows: list[dict], found: list[list[str]]) -> None:
    """Those that look the same, a group each."""
    if request.json:
        print_json({"schema": "brdfguide/alike/1", "groups": [{"stands_for": g[0], "files": g} for g in found]})
    else:
        say(
            "\n".join(f"{printable.line(g[0])}: {', '.join(map(printable.line, g[1:]))}" for g in found) or "none alike"
        )
    alike, groups = sum(map(len, found)), f"{len(found)} group{'s' * (len(found) != 1)}"
    remark(f"{alike} of {len(rows)} files in {groups} that look the same; the first stands for each", request.quiet)
    if request.sheet:
        first = [next(row for row in rows if row["file"] == group[0]) for group in found[: request.most]]
        _draw(request.sheet, first, [f"stands for {len(group)}" for group in found], request.quiet)


def _draw(path: Path, rows: list[dict], notes: list[str], quiet: bool) -> None:
    """A contact sheet: a sphere for each, with its file, its model and a note."""
    from ..exporters import coloured
    from ..fitting import saved
    from ..report.figures import contact, style

    if len(rows) > MOST_ON_A_SHEET:
        raise InputError(f"--sheet draws up to {MOST_ON_A_SHEET} surfaces; --most {MOST_ON_A_SHEET} shows so many")
    if not rows:
        raise InputError("--sheet: nothing matches, and there is nothing to draw")
    surfaces = [coloured(saved.surface_in(row["surface"].encode(), row["file"]), row["file"]) for row in rows]
    captions = [(Path(row["file"]).stem, row["recommended"], note) for row, note in zip(rows, notes, strict=False)]
    with working(f"drawing {path.name}", quiet):
        style.save(contact.contact_sheet(surfaces, captions), path)
