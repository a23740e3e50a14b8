"""The reference: pages made of the program's own tables, and a man page: `python -m brdfguide.cli._pages docs`."""

import io
import json
import sys
from contextlib import redirect_stdout
from importlib.resources import files
from pathlib import Path

from .. import __version__, catalog, models
from ..advice import library
from ..advice.guidelines import rules
from ..report.documents.catalogue import model_entry
from ..report.documents.explained import rule_entry
from ._app import build
from ._help import GROUPS, first_sentence
from ._reference_pictures import LAWS, MATERIALS, UNDRAWN, write_pictures

MADE = "This page is made of the program's own tables by `python -m brdfguide.cli._pages docs`; edit those."


def _page(title: str, *parts: str) -> str:
    return "\n\n".join([f"# {title}", MADE, *parts]) + "\n"


def _table(header: tuple[str, ...], rows) -> str:
    def line(cells):
        return "| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"

    return "\n".join([line(header), "|" + "---|" * len(header), *map(line, rows)])


MAN_WIDTH = 72  # columns of a text that `man` indents by seven


def _names() -> list[str]:
    """Commands in the order of the help."""
    listed = [name for names in GROUPS.values() for name in names]
    return listed + [name for name in catalog.names("cli") if name not in listed]


def _help_of(words: list[str], width: int = 80) -> str:
    out = io.StringIO()
    with redirect_stdout(out):
        app = build([words[0]] if len(words) > 1 else _names())
        app(words, prog_name="brdfguide", standalone_mode=False, terminal_width=width, max_content_width=width)
    return "\n".join(line.rstrip() for line in out.getvalue().rstrip().split("\n"))


def commands_page() -> str:
    """Every command's help."""
    parts = [f"## {name}\n\n```text\n{_help_of([name, '--help'])}\n```" for name in _names()]
    return _page("Commands", f"```text\n{_help_of(['--help'])}\n```", *parts)


def models_page() -> str:
    """Every law with its parameters."""
    parts = []
    for name in models.names():
        entry = model_entry(models.term(name))
        header = ("parameter", "default", "from", "to", "unit", "meaning")
        rows = [
            (f"`{p['name']}`", f"{p['default']:g}", f"{p['low']:g}", f"{p['high']:g}", p["unit"], p["meaning"])
            for p in entry["parameters"]
        ]
        said = [
            f"## {name}",
            entry["summary"][:1].upper() + entry["summary"][1:] + ".",
            *_picture(LAWS, name, f"{name} with its default parameters, at three incidences"),
            entry["law"],
            _table(header, rows),
        ]
        said += [f"Cannot: {entry['cannot']}."] if entry["cannot"] else []
        said += [f"Breaks {law}: {why}." for law, why in entry["breaks"].items()]
        parts.append("\n\n".join(said))
    return _page("Models", *parts)


def rules_page() -> str:
    """Every guideline with its section."""
    entries = [(rule.__name__, rule_entry(rule)) for rule in rules()]
    rows = [(f"`{name}`", each["section"], " ".join(each["meaning"].split())) for name, each in entries]
    about = (
        "In this order; none overrides what was observed. `brdfguide recommend porcelain --explain` says which spoke."
    )
    return _page("Rules", about, _table(("rule", "section of the guide", "what it says"), rows))


def formats_page() -> str:
    """Every format that is read, as its file says."""
    rows = [
        (f"`{name}`", first_sentence(catalog.load("data.formats", name).__doc__))
        for name in catalog.names("data.formats")
    ]
    about = "Told apart by content, not by suffix. The names of columns are in [columns](../columns.md)."
    return _page("Formats", about, _table(("format", "what it is"), rows))


def targets_page() -> str:
    """Every target of `export`."""
    from .. import exporters

    rows = [(f"`{each.name}`", f"`{each.suffix}`", each.what) for each in map(exporters.get, exporters.names())]
    return _page(
        "Targets of export",
        "What each costs is in [exports](../exports.md).",
        _table(("target", "suffix", "what"), rows),
    )


def materials_page() -> str:
    """Every described material."""
    import yaml

    rows = []
    for name in library.library_names():
        given = yaml.safe_load(library.path(name).read_text(encoding="utf-8"))
        said = ", ".join(key for key in given if key not in HEADS)
        rows.append(("".join(_picture(MATERIALS, name, name)), f"`{name}`", given.get("about", ""), said))
    about = (
        "`brdfguide materials NAME` shows one with the source of every number. A ball is drawn with the model that is "
        "recommended first, under the sky of `brdfguide preview NAME --env sky`; where only the finish is told and no "
        "colour, the body is black."
    )
    return _page("Materials", about, _table(("", "material", "what it is", "what is said of it"), rows))


def _picture(folder: str, name: str, words: str) -> list[str]:
    """The line that shows a picture of `_reference_pictures`; none for what has none."""
    return [f"![{words}](../pictures/{folder}/{name}.png)"] if name not in UNDRAWN else []


HEADS = ("name", "about", "sources")


def schemas_page() -> str:
    """Every document with its keys."""
    folder = files(__package__.rpartition(".")[0]) / "schemas"
    parts = [
        "`brdfguide schema NAME` prints a document's JSON Schema. Keys are added within a version, none is renamed."
    ]
    for file in sorted(folder.iterdir(), key=lambda each: each.name):
        schema = json.loads(file.read_text(encoding="utf-8"))
        rows = [
            (f"`{key}`", _types(entry), entry.get("description", ""))
            for key, entry in schema["properties"].items()
            if key != "schema"
        ]
        parts.append(f"## {schema['title']}\n\n{_table(('key', 'type', 'what'), rows)}")
    return _page("JSON documents", *parts)


def _types(entry: dict) -> str:
    kinds = entry.get("type", "object" if "$ref" in entry else "")
    return kinds if isinstance(kinds, str) else ", ".join(kinds)


def man_page() -> str:
    """brdfguide(1), of the same help."""
    lines = [
        f'.TH BRDFGUIDE 1 "" "brdfguide {__version__}" "User Commands"',
        ".SH NAME",
        "brdfguide \\- choose a reflectance model for a surface, and its parameters",
        ".SH SYNOPSIS",
        ".B brdfguide",
        ".I COMMAND",
        "[OPTIONS]",
    ]
    for name in _names():
        body = _help_of([name, "--help"], MAN_WIDTH).replace("\\", "\\\\").replace("-", "\\-").replace("'", "\\(aq")
        shown = "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in body.split("\n"))
        lines += [f".SH {name.upper()}", ".nf", shown, ".fi"]
    lines += [".SH EXIT STATUS", "0 answered, 1 no trustworthy answer, 2 bad usage or input, 130 interrupted."]
    return "\n".join(lines) + "\n"


NAMES = {  # path within docs/ -> what writes it
    "reference/commands.md": commands_page,
    "reference/models.md": models_page,
    "reference/rules.md": rules_page,
    "reference/formats.md": formats_page,
    "reference/targets.md": targets_page,
    "reference/materials.md": materials_page,
    "reference/schemas.md": schemas_page,
    "brdfguide.1": man_page,
}


def reference_page(name: str) -> str:
    """The text of a page by its path."""
    return NAMES[name]()


def write_reference(folder: Path) -> None:
    """Writes every page below a folder, and draws the pictures that are not there yet."""
    for name in NAMES:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(reference_page(name), encoding="utf-8")
    write_pictures(folder / "pictures", missing=True)


if __name__ == "__main__":
    write_reference(Path(sys.argv[1]))
