"""`brdfguide evaluate MODEL`: values of a model at given directions."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._data import read
from ._fitting import assignments
from ._options import JsonOption, print_json

EXAMPLES = "Examples: brdfguide evaluate ggx alpha=0.2 n=1.5 --theta-i 45 --theta-r -80:80:10 | brdfguide evaluate --fit fit.json --data data.csv"


def evaluate(
    words: Annotated[list[str] | None, Argument(help="A model such as lambertian+ggx, then name=value pairs.")] = None,
    fit: Annotated[Path | None, Option("--fit", help="Model and values from a fit's JSON.")] = None,
    model: Annotated[str | None, Option("--model", help="Which row of the fit; none: the recommended.")] = None,
    data: Annotated[Path | None, Option("--data", help="At the directions and channels of this file.")] = None,
    theta_i: Annotated[str, Option("--theta-i", help="Incidence [deg]: 45 or 10,45,75 or 0:80:5.")] = "0,45,75",
    theta_r: Annotated[str, Option("--theta-r", help="Reflection [deg], positive on the mirror side.")] = "-85:85:5",
    phi: Annotated[str, Option("--phi", help="Azimuth away from the mirror plane [deg].")] = "0",
    wavelength_nm: Annotated[float, Option("--wavelength-nm", help="Wavelength [nm].")] = 550.0,
    json: JsonOption = False,
) -> None:
    """Values of a model [1/sr] at given directions, as CSV."""
    from .. import models, saved
    from ..report import values as report

    if (fit is None) == (not words):
        raise InputError("wanted a model such as `ggx alpha=0.2`, or --fit FILE.json, and not both")
    if fit is not None:
        answer = saved.read_fit(fit, model)
        surface, values, wavelength, channels = answer.model, answer.values, answer.wavelength, answer.channels
    else:
        surface = models.get(words[0])
        values, wavelength, channels = surface.qualified(assignments(words[1:], words[0])), wavelength_nm * 1e-3, ("brdf",)
    if data is not None:
        measurement = read(data)
        geom, channels = measurement.geom, measurement.channels
        report.check_channels(values, channels, str(data))
    else:
        geom = report.grid(theta_i, theta_r, phi, wavelength)
    document = report.document(surface, values, geom, channels)
    print_json(document) if json else print(report.csv(document), end="")
