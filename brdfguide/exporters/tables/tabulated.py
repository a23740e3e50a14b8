"""A dense table or a fitted model as a table in MERL's layout."""

import numpy as np

from ...data import formats
from ...data.formats import merl as container
from ...errors import InputError
from ...fitting import saved
from ...opening import held, open_for_reading
from ...physics.colour import SRGB_UM


def merl(path, model: str | None = None, *, average_phi_i: bool = False) -> tuple[bytes, list[str]]:
    """The bytes of a `.binary`, and what was taken for granted. `path` is a dense table or a fit's JSON.

    Raises InputError for scattered samples and for channels that are neither colours nor a spectrum.
    """
    path = held(path)
    if _is_fit(path):
        if average_phi_i:
            raise InputError(f"--average-phi-i has nothing to average: {path} is a fit")
        brdf, notes = _of_fit(path, model)
    else:
        if model:
            raise InputError(f"--model {model}: {path} is a measurement, not a fit")
        function, channels = formats.function(path, average_phi_i=average_phi_i)
        if list(channels) == ["R", "G", "B"]:
            brdf, notes = function, []
        else:
            um = np.array([float(name.removesuffix("nm")) / 1000 for name in channels])
            places, notes = _nearest(um)

            def brdf(geom):
                return function(geom)[:, places]

    return container.packed(container.table(brdf)), notes


def _is_fit(path) -> bool:
    with open_for_reading(path, str(path)) as file:
        head = file.read(4096)
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
        places, notes = _nearest(fit.wavelengths)
    if fit.model.has_mirror:
        notes.append("the ideal mirror part cannot stand in a table: left out")
    return fit.of_channels(places).brdf, notes


def _nearest(um):
    """The channels nearest to where linear sRGB has its coefficients. Raises InputError where they are far off."""
    places = [int(np.argmin(np.abs(um - each))) for each in SRGB_UM]
    if max(abs(um[place] - each) for place, each in zip(places, SRGB_UM, strict=True)) > 0.06:
        raise InputError(f"channels from {um.min() * 1000:g} to {um.max() * 1000:g} nm do not span red, green and blue")
    named = ", ".join(f"{um[place] * 1000:g} nm for {name}" for place, name in zip(places, "RGB", strict=True))
    return places, [f"a spectrum has no colours: taken {named}"]
