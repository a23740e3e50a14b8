"""Where described materials lie: the folder `materials/` of the source, or what an installation brought along."""

from functools import lru_cache
from pathlib import Path

from .errors import InputError, choices

SOURCE = Path(__file__).resolve().parent.parent / "materials"


@lru_cache(maxsize=1)
def _paths() -> dict[str, Path]:
    """Name -> file."""
    files = list(SOURCE.glob("*.yaml")) if SOURCE.is_dir() else []
    if not files:
        from importlib.metadata import PackageNotFoundError, distribution  # only an installation needs it

        try:
            listed = distribution("brdfguide").files or []
        except PackageNotFoundError:
            listed = []
        files = [Path(each.locate()) for each in listed if each.suffix == ".yaml" and each.parent.name == "materials"]
    return {file.stem: file for file in sorted(files)}


def names() -> list[str]:
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
