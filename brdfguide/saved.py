"""A fit's JSON read back: the model and its values, ready to be evaluated, exported, audited or drawn."""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from . import models
from .errors import InputError, choices, no_such_file
from .geometry import WAVELENGTH_UM
from .models import Sum

SCHEMAS = ("brdfguide/fit/1", "brdfguide/recommend/1")


@dataclass(frozen=True, eq=False)
class Saved:
    """One row of a saved ranking."""

    model: Sum
    values: dict  # floats, or (channels,) for those that each channel has
    channels: tuple[str, ...]
    wavelength: np.ndarray  # [µm], (channels,)
    document: dict


def read_fit(path, name: str | None = None) -> Saved:
    """The recommended row of a fit's JSON, or the one called `name`.

    Raises InputError where the file is not such a JSON, and where it has no row of that name.
    """
    path = Path(path)
    try:
        document = json.loads(path.read_text())
    except FileNotFoundError:
        raise no_such_file(path, str(path)) from None
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from None
    except ValueError as error:
        raise InputError(f"{path}: not JSON ({error}); wanted the output of `brdfguide fit --json`") from None
    if not isinstance(document, dict) or document.get("schema") not in SCHEMAS or not document.get("ranking"):
        found = document.get("schema") if isinstance(document, dict) else type(document).__name__
        raise InputError(f"{path}: schema {found!r} with a ranking; wanted {' or '.join(SCHEMAS)} as `brdfguide fit --json` writes it")
    rows = {row["candidate"]: row for row in document["ranking"]}
    rows.update({row["model"]: row for row in reversed(document["ranking"])})
    wanted = name or document["recommended"]
    if wanted not in rows:
        raise choices("fitted model", wanted, rows)
    try:
        return _row(rows[wanted], document)
    except (InputError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: the entry for {wanted} is damaged ({error})") from None


def _row(row: dict, document: dict) -> Saved:
    sum_ = models.get(row["model"])
    values = {}
    for key, entry in row["parameters"].items():
        if key in sum_.parameters:
            value = np.array(entry["value"], float) if isinstance(entry["value"], list) else float(entry["value"])
            values[key] = sum_.parameters[key].inside(value)
    data = document.get("data", {})
    channels = tuple(data.get("channels", ["brdf"]))
    wavelength = np.array(data.get("wavelength_nm", [WAVELENGTH_UM * 1e3]), float) * 1e-3
    free = tuple(key for key in row.get("freed", ()))
    return Saved(replace(sum_, free=free), values, channels, wavelength, document)
