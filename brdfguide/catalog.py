"""A folder is a registry: its files are the members, their names are what users type."""

from functools import cache, lru_cache
from importlib import import_module
from pathlib import Path

from .errors import choices

HERE = Path(__file__).parent
# What lives in a registry's folder and is no member: its contract, and what is built on all members alike.
NOT_MEMBERS = {
    "models": ("model", "coat", "facts", "surface", "looks", "visible_change", "candidates", "extensions", "cost"),
    "data.formats": ("format",),
    "advice.guidelines": ("guideline",),
    "exporters": ("exporter", "cards", "conversions", "live"),
}


def names(folder: str) -> list[str]:
    """Members of `folder`, such as "data.formats", as typed by users, without importing any of them."""
    return list(_members(folder))


@lru_cache
def _members(folder: str) -> tuple[str, ...]:
    files = HERE.joinpath(*folder.split(".")).glob("[!_]*.py")
    return tuple(sorted(file.stem.replace("_", "-") for file in files if file.stem not in NOT_MEMBERS.get(folder, ())))


@lru_cache
def saying(folder: str, word: str) -> tuple[str, ...]:
    """Members whose file has a word in it, without importing any; one whose text is not there may have it."""
    place = HERE.joinpath(*folder.split("."))
    return tuple(name for name in _members(folder) if _says(place / f"{_module_name(name)}.py", word))


def _says(file: Path, word: str) -> bool:
    try:
        return word.encode() in file.read_bytes()
    except OSError:
        return True


def _module_name(name: str) -> str:
    return name.replace("-", "_")


def load(folder: str, name: str):
    """The module of member `name`. Raises InputError with the nearest names."""
    if name not in _members(folder):
        raise choices(folder.rpartition(".")[2].removesuffix("s"), name, names(folder))
    return _imported(f".{folder}.{_module_name(name)}")


@cache
def _imported(name: str):
    """A module of the package; to ask the import system again costs as much as to open a file."""
    return import_module(name, __package__)
