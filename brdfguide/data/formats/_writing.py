"""What every writer of a format needs: one channel where a file holds one, numbers as text, and what the file says of
itself."""

import numpy as np

from ... import __version__
from ...errors import InputError
from ...printable import comment
from ..measurement import Measurement

TRISTIMULUS = ("X", "Y", "Z")


def only_channel(measurement: Measurement, what: str) -> float:
    """The wavelength [nm] of the one channel. Raises InputError where there are several."""
    if len(measurement.channels) > 1:
        names = ", ".join(measurement.channels[:6]) + (", ..." if len(measurement.channels) > 6 else "")
        text = f"{measurement.name}: a {what} file holds one channel, there are {len(measurement.channels)} ({names})"
        raise InputError(f"{text}; choose one with --wavelength NM")
    return wavelengths(measurement)[0]


def wavelengths(measurement: Measurement) -> list[float]:
    """Of each channel [nm], rounded as it is printed."""
    nm = np.broadcast_to(np.asarray(measurement.geom.wavelength, float) * 1000, (len(measurement.channels),))
    return [float(f"{each:.9g}") for each in nm]


def angle(degrees: float) -> str:
    """An angle [deg] as text, to a hundred-thousandth."""
    return f"{round(float(degrees), 5) + 0.0:.10g}"


def value(number: float) -> str:
    """A value [1/sr] as text, to nine digits; 0 where there is none, as these formats have it."""
    return f"{number:.9g}" if np.isfinite(number) else "0"


def about(measurement: Measurement, *more: str) -> list[str]:
    """Lines that say what the file is, for its comments."""
    return [
        _line(f"written by brdfguide {__version__} from {measurement.name or 'a surface'} ({measurement.format})"),
        "BRDF in 1/sr, reflection from the front side",
        *more,
    ]


def _line(text: str) -> str:
    """A line of a comment in ASCII, as programs of optics read it."""
    return comment(" ".join(text.split())).encode("ascii", "replace").decode()
