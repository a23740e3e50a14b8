"""A ranking over |β - β0|, both axes logarithmic: what stray-light people read; power laws are straight lines."""

import numpy as np

from ...data.measurement import Measurement
from ...fitting.reading import reading
from ...physics.aperture import Instrument
from ...physics.geometry import in_plane, rows
from . import style
from .lines import Line, lines_of, nominal_channel, shown_lines, title_of, without_zeros

LEAST = 1e-4  # |β - β0|, where the mirror direction itself is drawn
CURVE = 200  # points of a curve


def plot_beta(ranking, measurement: Measurement, path, theme: str = style.LIGHT) -> None:
    """Draw data and models against |β - β0| into `path`, a .png, .svg or .pdf file."""
    channel = nominal_channel(measurement)
    lines = shown_lines(lines_of(ranking))
    with style.look():
        fig = style.figure(150, 150)
        top, strip = fig.subplots(2, 1, sharex=True, height_ratios=(3, 1))
        _data(top, measurement, channel)
        for line in lines:
            _model(top, strip, line, measurement, channel)
        strip.axhline(0, color=style.INK, lw=0.6)
        top.set_xscale("log")
        top.set_yscale("log")
        value = measurement.brdf[measurement.usable[:, channel], channel]
        top.set_ylim(value.min() / 2, value.max() * 2)
        strip.set_ylim(-1, 1)
        top.set_ylabel("BRDF [sr$^{-1}$]")
        strip.set_ylabel("ln(model/data)")
        strip.set_xlabel("|β - β0|, distance from the mirror direction in direction sines")
        top.grid(True)
        title = title_of(lines_of(ranking), measurement.name)
        fig.legend(loc="outside upper left", ncols=2, title=title, title_fontsize=9, alignment="left")
        style.save(fig, path, theme)


def beta_of(measurement: Measurement) -> np.ndarray:
    """|β - β0| (samples,), no less than what is drawn."""
    return np.maximum(np.sqrt(measurement.geom.vxy2[:, 0]), LEAST)


def _data(axis, measurement: Measurement, channel: int) -> None:
    for number, (theta_i, picked) in enumerate(measurement.incidences.items()):
        value = np.where(measurement.usable[picked, channel], measurement.brdf[picked, channel], np.nan)
        marker = style.MARKERS[number % 8]
        label = f"data, θi = {theta_i:g}°" if number < len(style.MARKERS) else None
        axis.plot(beta_of(measurement[picked]), value, marker, color=style.INK, ms=2.8, mew=0, alpha=0.7, label=label)


def _model(top, strip, line: Line, measurement: Measurement, channel: int) -> None:
    """A curve at the least incidence, forward as far as the horizon, and what is left of every value."""
    theta_i = min(measurement.incidences)
    x = np.geomspace(LEAST, 0.999 - np.sin(np.radians(theta_i)), CURVE)
    geom = rows(in_plane(theta_i, np.degrees(np.arcsin(np.sin(np.radians(theta_i)) + x))))
    surface = line.surface.channel(channel)
    curve = reading(surface, Instrument(geom, measurement.solid_angle))[:, 0]
    name = f"{line.name}  (rms ln {line.rms_ln:.3g})"
    name += ", recommended" if line.recommended else ""
    top.plot(x, without_zeros(curve), label=name, **line.look)
    value = np.where(measurement.usable[:, channel], measurement.brdf[:, channel], np.nan)
    left = np.log(without_zeros(reading(surface, measurement.instrument)[:, 0]) / value)
    strip.plot(beta_of(measurement), left, line.stroke.marker, color=line.stroke.colour, ms=2.2, mew=0, alpha=0.8)
