"""Where described materials lie: the folder `materials/`."""

from functools import lru_cache
from pathlib import Path

from ..errors import InputError, choices
from ..shipped import shipped


@lru_cache(maxsize=1)
def _paths() -> dict[str, Path]:
    """Name -> file."""
    folder = shipped("materials")
    return {file.stem: file for file in sorted(folder.glob("*.yaml"))} if folder else {}


def library_names() -> list[str]:
    """Every described material, as typed by users."""
    return list(_paths())


def path(name: str) -> Path:
    """The file of a material by its name. Raises InputError with the nearest names."""
    known = _paths()
    plain = name.strip().lower().replace(" ", "-").replace("_", "-")
    if not known:
        raise InputError(f"no material called '{name}': this installation has no materials folder; give a file")
    if plain not in known:
        raise choices("material", name, known)
    return known[plain]
