"""A dense table or a fitted model as a table in MERL's layout."""

from pathlib import Path

import numpy as np

from . import formats, saved
from .errors import InputError
from .formats import merl as layout

NOMINAL_UM = {"R": 0.610, "G": 0.550, "B": 0.465}  # where a spectrum stands for a colour; as the readers have it


def merl(path, model: str | None = None, **options) -> tuple[bytes, list[str]]:
    """The bytes of a `.binary`, and what was taken for granted. `path` is a dense table or a fit's JSON.

    Raises InputError for scattered samples and for channels that are neither colours nor a spectrum.
    """
    if _is_fit(path):
        brdf, notes = _of_fit(path, model)
    else:
        if model:
            raise InputError(f"--model {model}: {path} is a measurement, not a fit")
        function, channels = formats.function(path, **options)
        if list(channels) == ["R", "G", "B"]:
            brdf, notes = function, []
        else:
            um = np.array([float(name.removesuffix("nm")) / 1000 for name in channels])
            places, notes = _nearest(um)
            brdf = lambda geom: function(geom)[:, places]  # noqa: E731
    return layout.written(brdf), notes


def _is_fit(path) -> bool:
    try:
        with Path(path).open("rb") as file:
            head = file.read(4096)
    except OSError:
        return False
    return head.lstrip().startswith(b"{") and b'"brdfguide/' in head


def _of_fit(path, model: str | None):
    """The fitted model as a function of geometry with three colours."""
    fit = saved.read_fit(path, model)
    notes = []
    count = len(fit.channels)
    if count == 1:
        places = [0, 0, 0]
        notes.append("one channel: the three colours are alike")
    elif list(fit.channels) == ["R", "G", "B"]:
        places = [0, 1, 2]
    else:
        places, notes = _nearest(np.asarray(fit.wavelength, float))
    if fit.model.has_mirror:
        notes.append("the ideal mirror part cannot stand in a table: left out")
    values = {key: np.asarray(value)[places] if np.ndim(value) else value for key, value in fit.values.items()}
    um = np.broadcast_to(np.asarray(fit.wavelength, float), count)[places]
    return (lambda geom: fit.model(geom.at(um), values)), notes


def _nearest(um):
    """The channels nearest to the nominal wavelengths of red, green and blue. Raises InputError where they are far off."""
    places = [int(np.argmin(np.abs(um - each))) for each in NOMINAL_UM.values()]
    if max(abs(um[place] - each) for place, each in zip(places, NOMINAL_UM.values())) > 0.06:
        raise InputError(f"channels from {um.min() * 1000:g} to {um.max() * 1000:g} nm do not span red, green and blue")
    named = ", ".join(f"{um[place] * 1000:g} nm for {name}" for place, name in zip(places, NOMINAL_UM))
    return places, [f"a spectrum has no colours: taken {named}"]
