"""A folder is a registry: its files are the members, their names are what users type."""

from importlib import import_module
from pathlib import Path

from .errors import choices

HERE = Path(__file__).parent


def names(folder: str) -> list[str]:
    """Members of `folder`, as typed by users, without importing any of them."""
    files = (HERE / folder).glob("[!_]*.py")
    return sorted(file.stem.replace("_", "-") for file in files)


def load(folder: str, name: str):
    """The module of member `name`. Raises InputError with the nearest names."""
    if name not in names(folder):
        raise choices(folder.removesuffix("s"), name, names(folder))
    return import_module(f".{folder}.{name.replace('-', '_')}", __package__)
