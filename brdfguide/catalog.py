"""A folder is a registry: its files are the members, their names are what users type."""

from functools import lru_cache
from importlib import import_module
from pathlib import Path

from .errors import choices

HERE = Path(__file__).parent


def names(folder: str) -> list[str]:
    """Members of `folder`, as typed by users, without importing any of them."""
    return list(_members(folder))


@lru_cache
def _members(folder: str) -> tuple[str, ...]:
    files = (HERE / folder).glob("[!_]*.py")
    return tuple(sorted(file.stem.replace("_", "-") for file in files))


def load(folder: str, name: str):
    """The module of member `name`. Raises InputError with the nearest names."""
    if name not in _members(folder):
        raise choices(folder.removesuffix("s"), name, names(folder))
    return import_module(f".{folder}.{name.replace('-', '_')}", __package__)
