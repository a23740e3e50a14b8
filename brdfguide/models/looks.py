"""How a surface looks on a sphere under lamps all around, and how far two of them lie apart in S (`physics.seen`)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..physics import seen
from ..physics.aperture import Instrument, solid_angle_of
from ..records import dataclass
from .surface import Surface

# of the lamp that a mirror shows where no detector is named: 2.7 degrees across. Ours, and such that the cells follow
# its rim to 1 %
LAMP_SR = solid_angle_of(1.35)
FINE = 96, 12, 12  # cells that follow the rim of any detector


@dataclass(frozen=True, eq=False)
class Looks:
    """Lightness [L*] of some surfaces on one sphere."""

    sphere: seen.Sphere
    lightness: tuple[np.ndarray, ...]  # of each (samples, colours)

    def apart(self, one: int, other: int) -> float:
        """S [L*] between two of them, by their places."""
        return seen.apart(self.lightness[one], self.lightness[other], self.sphere.weights)

    def from_first(self) -> list[float]:
        """S [L*] between each of them and the first."""
        return [self.apart(0, place) for place in range(len(self.lightness))]


def looks(surfaces: Sequence[Surface], solid_angle: float | None = None, coarse: bool = False) -> Looks:
    """Surfaces on one sphere, as points see them, mirrors under a lamp of 2.7 degrees; or as a detector of
    `solid_angle` [sr] reads them. `coarse` takes a tenth of the directions."""
    sphere = sphere_for(any(map(turns, surfaces)), solid_angle, coarse)
    instrument = Instrument(sphere.geom, solid_angle)
    return Looks(sphere, tuple(lightness_shown(surface, instrument) for surface in surfaces))


def sphere_for(turned: bool, solid_angle: float | None = None, coarse: bool = False) -> seen.Sphere:
    """The sphere for surfaces of which one changes as it is `turned`, or for a detector whose rim must be followed."""
    if turned:
        return seen.sphere(seen.TURNED, seen.TURNS)
    if solid_angle is not None:
        return seen.sphere(FINE)
    return seen.sphere(seen.COARSE if coarse else seen.CELLS)


def seen_difference(one: Surface, other: Surface, solid_angle: float | None = None) -> float:
    """S [L*] between two surfaces."""
    return looks((one, other), solid_angle).apart(0, 1)


def lightness_shown(surface: Surface, instrument: Instrument) -> np.ndarray:
    """Lightness [L*] (samples, colours) of a surface at the directions of an instrument."""
    return seen.lightness(instrument_reading(surface, instrument) @ mixture(surface), instrument.geom.cos_i)


def instrument_reading(surface: Surface, instrument: Instrument) -> np.ndarray:
    """The mean over the instrument's cone and the mirror beam that falls into it, (samples, channels) [1/sr]; of a
    point the value there, and the lamp's image."""
    total = np.sum([weight * surface.brdf(geom) for weight, geom in instrument.views], axis=0)
    if not surface.model.has_mirror:
        return total
    beam = replace(instrument, solid_angle=LAMP_SR).beam if instrument.solid_angle is None else instrument.beam
    return total + surface.mirror(instrument.geom) * beam


def mixture(surface: Surface) -> np.ndarray:
    """(channels, colours): what each of its channels adds to what is seen."""
    return seen.colours(surface.channels, surface.wavelengths)


def turns(surface: Surface) -> bool:
    """Whether it changes as it is turned in its plane."""
    return any(
        np.any(np.asarray(values["ratio"]) != 1) if "ratio" in values else term.model.turns
        for term, values in ((term, surface.values_of(term)) for term in surface.model.terms)
    )
