"""Folders that come with the program: at the top of the source, inside the package where it was installed."""

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def shipped(folder: str) -> Path | None:
    """The folder "materials" or "examples"; None where an installation lacks it."""
    if (beside := PACKAGE.parent / folder).is_dir() and (PACKAGE.parent / "pyproject.toml").is_file():
        return beside
    from importlib.resources import files  # only an installation needs it

    inside = Path(str(files(__package__) / folder))
    return inside if inside.is_dir() else None
