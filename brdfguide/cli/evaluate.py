"""`brdfguide evaluate MODEL`: values of a model at given directions."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError
from ._fitting import assignments
from ._options import JsonOption, print_json
from ._request import refuse
from ._streams import say

EXAMPLES = (
    "Examples: brdfguide evaluate ggx alpha=0.2 n=1.5 --theta-i 45 --theta-r -80:80:10 | brdfguide evaluate --fit "
    "fit.json --data data.csv"
)

MOST_DEG = 1e5  # no azimuth turns more often
MOST_DIRECTIONS = 10**7
SHORTEST_NM, LONGEST_NM = 100.0, 100_000.0  # as of measurements
DIRECTIONS = ("theta_i", "theta_r", "phi", "wavelength_nm")


def evaluate(
    context: Context,
    words: Annotated[list[str] | None, Argument(help="A model such as lambertian+ggx, then name=value pairs.")] = None,
    fit: Annotated[Path | None, Option("--fit", help="Model and values from a fit's JSON.")] = None,
    model: Annotated[str | None, Option("--model", help="Which row of the fit; none: the recommended.")] = None,
    data: Annotated[
        Path | None,
        Option("--data", help="At the directions and channels of this file, through the aperture of the fit."),
    ] = None,
    theta_i: Annotated[str, Option("--theta-i", help="Incidence [deg]: 45 or 10,45,75 or 0:80:5.")] = "0,45,75",
    theta_r: Annotated[str, Option("--theta-r", help="Reflection [deg]; negative: half a turn away.")] = "-85:85:5",
    phi: Annotated[str, Option("--phi", help="phi_r - phi_i [deg], 180 on the mirror side.")] = "180",
    wavelength_nm: Annotated[float, Option("--wavelength-nm", help="Wavelength [nm].")] = 550.0,
    json: JsonOption = False,
) -> None:
    """Values of a model [1/sr] at given directions, as CSV."""
    from ..fitting import saved
    from ..physics.aperture import Instrument
    from ..report.documents.values import document as rows_of
    from ..report.text.values import csv

    if (fit is None) == (not words):
        raise InputError("wanted a model such as `ggx alpha=0.2`, or --fit FILE.json, and not both")
    if fit is None:
        refuse(context, "model", because="it picks a row of the fit that --fit names; the model is named already")
    else:
        refuse(context, "wavelength_nm", because="the fit has its own wavelengths")
    if not SHORTEST_NM <= wavelength_nm <= LONGEST_NM:
        raise InputError(f"--wavelength-nm {wavelength_nm:g}: wanted {SHORTEST_NM:g} to {LONGEST_NM:g} nm")
    if data is not None:
        refuse(context, *DIRECTIONS, because="the directions and wavelengths are those of --data")
    if fit is None:
        surface, solid_angle = _named(words or [], wavelength_nm), None
    else:
        surface, solid_angle = saved.read_reading(fit, model)
    if data is not None:
        from ..data import formats

        measurement = formats.read(data)
        surface = surface.in_channels(measurement.channels, measurement.geom.wavelength, measurement.name)
        instrument = Instrument(measurement.geom, measurement.solid_angle or solid_angle)
    else:
        instrument = Instrument(_grid(theta_i, theta_r, phi))
    document = rows_of(surface, instrument)
    print_json(document) if json else say(csv(document), end="")


def _named(words: list[str], wavelength_nm: float):
    """A model with the values typed after it, as a Surface of one channel."""
    from .. import models
    from ..models.surface import Surface

    model = models.get(words[0])
    return Surface(model, model.qualified(assignments(words[1:], words[0])), wavelength=wavelength_nm * 1e-3)


def _grid(theta_i: str, theta_r: str, phi: str):
    """Every combination of the angles [deg] in three lists; phi is phi_r - phi_i, theta_r < 0 half a turn away."""
    import numpy as np

    from ..physics.geometry import rows, signed

    lists = [_angles(text, name) for text, name in ((theta_i, "--theta-i"), (theta_r, "--theta-r"), (phi, "--phi"))]
    if (count := np.prod([float(len(each)) for each in lists])) > MOST_DIRECTIONS:
        raise InputError(f"{count:g} directions; wanted at most {MOST_DIRECTIONS:g} at once")
    incidence, reflection, azimuth = np.meshgrid(*lists, indexing="ij")
    return rows(signed(incidence, reflection, azimuth))


def _angles(text: str, name: str):
    """`45`, `10,45,75` or `low:high:step`."""
    import numpy as np

    try:
        if ":" in text:
            low, high, step = (float(part) for part in text.split(":"))
            if not (0 < step < MOST_DEG and low <= high and (high - low) / step <= 100_000):
                raise ValueError
            angles = low + step * np.arange(int(np.floor((high - low) / step + 1e-9)) + 1)
        else:
            angles = np.array([float(part) for part in text.split(",")])
        if not np.all(np.abs(angles) < MOST_DEG):
            raise ValueError
        return angles
    except (ValueError, OverflowError):
        raise InputError(f"{name} {text}: wanted degrees such as 45, 10,45,75 or 0:80:5") from None
