"""What the figures and the terminal draw of a ranking: which models, in which look, and which channel.

Loads no plotting library.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ... import printable
from ...data.measurement import Measurement
from ...fitting.reading import reading
from ...models.surface import Surface
from ...physics.aperture import Instrument, solid_angle_of
from ...physics.geometry import in_plane, rows
from ...records import dataclass
from .palette import Stroke, stroke

NOMINAL_UM = 0.55  # the wavelength the report shows
FAMILIES = ("wave optics", "Phong", "Ward", "Lafortune")  # the report's four, drawn beside the best
MOST_LINES = 5
SEEN_SPIKE = 1.05  # times the lobe beside it; on a log axis of some decades less is nothing to see
MIRROR_DEG = 1.0  # half angle of the receiver that a mirror image is drawn as seen by, where the data have none


@dataclass(frozen=True)
class Line:
    """A fitted surface as the figures need it."""

    name: str
    surface: Surface
    rms_ln: float | None
    ns: float | None = None
    on_front: bool = False
    recommended: bool = False
    image: bool = True  # False: its mirror part is left out, as it is of the data

    @property
    def stroke(self) -> Stroke:
        """Its colour, dashes and marker, the same in every picture."""
        terms = self.surface.model.terms
        law = next((term.model for term in terms if term.model.is_lobe), terms[0].model)
        return stroke((law.base or law).name.removeprefix("coated:"), self.name)

    @property
    def width(self) -> float:
        return 2.0 if self.recommended else 1.3

    @property
    def look(self) -> dict[str, Any]:
        """The same as matplotlib wants it of a curve."""
        return {"color": self.stroke.colour, "ls": self.stroke.dashes, "lw": self.width}

    @property
    def words(self) -> str:
        """What a legend calls it."""
        return f"{self.name}, recommended" if self.recommended else self.name

    @property
    def shows_image(self) -> bool:
        """Whether it has a mirror part, which a point cannot read."""
        return self.image and self.surface.model.has_mirror


def lines_of(ranking) -> list[Line]:
    """Every row of a Ranking, best first."""
    pick = getattr(ranking, "recommended", None)
    return [Line(r.fit.name, r.fit.surface, r.rms_ln, r.ns_per_sample, r.on_front, r is pick) for r in ranking.rows]


def shown_lines(lines: list[Line]) -> list[Line]:
    """The best, the recommended, and the best of the report's families: more lines than that cannot be told apart."""
    if len(lines) <= MOST_LINES:
        return list(lines)
    wanted = [lines[0].name] + [line.name for line in lines if line.recommended]
    for family in FAMILIES:
        wanted += [
            line.name for line in lines if any(term.model.family == family for term in line.surface.model.terms)
        ][:1]
    wanted = list(dict.fromkeys(wanted))[:MOST_LINES]
    return [line for line in lines if line.name in wanted]


def title_of(lines: list[Line], name: str | None) -> str:
    """The file of the measurement, and what was done."""
    file = printable.label(Path(name).name, 60) if name else ""
    done = f"{len(lines)} models fitted" if len(lines) > 1 else f"{lines[0].name} fitted"
    return f"{file}: {done}" if file else done


def nominal_channel(measurement: Measurement) -> int:
    """The channel nearest 550 nm among those with values."""
    wavelength = np.broadcast_to(measurement.geom.wavelength, (len(measurement.channels),))
    filled = measurement.usable.any(axis=0)
    return int(np.argmin(np.where(filled, np.abs(wavelength - NOMINAL_UM), np.inf)))


def curve(
    line: Line, channel: int, theta_i: float, theta_r, solid_angle: float | None = None, azimuth: float = 0.0
) -> np.ndarray:
    """What an instrument reads of it in the plane of incidence of light at an azimuth [deg], in one channel (samples,).

    Without an instrument's solid angle the mirror part is what a receiver of `MIRROR_DEG` would read.
    """
    surface, geom = line.surface.channel(channel), rows(in_plane(theta_i, theta_r).at_azimuth(azimuth))
    values = reading(surface, Instrument(geom, solid_angle))[:, 0]
    if solid_angle is None and line.shows_image:
        receiver = Instrument(geom, solid_angle_of(MIRROR_DEG))
        values = values + (surface.mirror(geom) * receiver.beam)[:, 0]
    return values


def has_spike(line: Line, channel: int, theta_i: float) -> bool:
    """Whether a mirror image stands out of its curve at an incidence."""
    if not line.shows_image:
        return False
    both = line, replace(line, image=False)
    with_it, without = (curve(each, channel, theta_i, np.array([theta_i]))[0] for each in both)
    return bool(with_it > SEEN_SPIKE * without)


def grid_of(theta_i, low, high):
    """Every half degree, and closer near the mirror direction where a narrow lobe would fall between."""
    steps = np.concatenate((np.geomspace(0.01, 2, 25), [0.999 * MIRROR_DEG, 1.001 * MIRROR_DEG]))
    fine = np.concatenate((theta_i - steps, [theta_i], theta_i + steps))
    grid = np.unique(np.concatenate((np.linspace(low, high, int(2 * (high - low)) + 1), fine)))
    return grid[(grid >= low) & (grid <= high)]


def without_zeros(values):
    """Zeros as NaN, so that a log axis leaves them out."""
    return np.where(values > 0, values, np.nan)
