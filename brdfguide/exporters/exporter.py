"""What every file in this folder provides: one target, what it can express, and the text or bytes it loads.

An exporter never writes a file and never claims more than it measured: each result carries a `Statement` with the
rms ln ratio between the target's own law, with the very numbers written, and the model, the metric of the rankings.
"""

from collections.abc import Callable, Mapping
from dataclasses import field
from functools import cached_property

import numpy as np

from .. import __version__
from ..errors import InputError, NoAnswer
from ..models.surface import Surface
from ..physics import colour
from ..physics.geometry import Geometry, rows
from ..printable import comment, off_words_of
from ..records import dataclass

GLINT = 0.01  # of the light: a mirror weaker than this up to 60 degrees may be left out, and is said to be
EXACT = 1e-4  # rms ln below which an export may call itself exact: float32 and printed digits are finer


@dataclass(frozen=True, eq=False)
class ColouredSurface(Surface):
    """A surface that is exported or drawn: in linear sRGB, with a name."""

    name: str = "surface"
    command: str = ""  # the command line that asked for it, for the file's comment

    @cached_property
    def colour(self) -> colour.Colour:
        return colour.to_srgb(self.channels, self.wavelength)

    @property
    def term_names(self) -> list[str]:
        """Names of the terms, sorted: what an exporter looks at to see what it can express."""
        return sorted(term.model.name for term in self.model.terms)

    def linear(self, value) -> np.ndarray:
        """A parameter that the BRDF is linear in, in linear sRGB; outside the gamut it stops at 0."""
        return np.maximum(self.colour.matrix @ np.broadcast_to(np.ravel(value), (len(self.channels),)), 0.0)

    def nonlinear(self, value) -> np.ndarray | None:
        """Any parameter by colour: as it is where all channels agree or are colours themselves, else None."""
        if np.ptp(value) == 0:
            return np.full(3, float(np.ravel(value)[0]))
        return None if self.colour.mixes else self.colour.matrix @ np.ravel(value)

    def spectral(self, geom: Geometry) -> np.ndarray:
        """Finite part of the BRDF [1/sr], (samples, channels)."""
        return self.brdf(rows(geom))

    def rgb(self, geom: Geometry) -> np.ndarray:
        """The same in linear sRGB, (samples, 3); negative where a colour lies outside the gamut."""
        return self.spectral(geom) @ self.colour.matrix.T

    def mirror_rgb(self, geom: Geometry) -> np.ndarray:
        """Reflectance of the ideal mirror at theta_i in linear sRGB, (samples, 3)."""
        return self.mirror(rows(geom)) @ self.colour.matrix.T

    @cached_property
    def mirror_most(self) -> tuple[float, float]:
        """The most that the ideal mirror reflects at theta_i up to 60 and up to 80 degrees."""
        if not self.model.has_mirror:
            return 0.0, 0.0
        theta = np.linspace(0.0, 80.0, 17)
        reflected = self.mirror_rgb(Geometry.from_degrees(theta, 0.0, theta, 180.0)).max(axis=1)
        return float(reflected[theta <= 60].max()), float(reflected.max())

    @property
    def has_mirror(self) -> bool:
        """Whether the mirror is part of how the surface looks, not only of its glint at grazing."""
        own_term = any(term.model.is_mirror for term in self.model.terms)
        return own_term and self.mirror_most[1] > 1e-6 or self.mirror_most[0] > GLINT


def status_of(rms_ln: float, lost=()) -> str:
    """exact, refit or lossy."""
    if lost:
        return "lossy"
    return "exact" if rms_ln <= EXACT else "refit"


@dataclass(frozen=True)
class Statement:
    """What an export costs, for people and for programs."""

    target: str
    status: str  # exact, refit or lossy
    rms_ln: float
    directions: int
    over: str  # which directions, in words
    written: Mapping = field(default_factory=dict)  # the numbers in the file
    lost: tuple[str, ...] = ()  # sentences: what the target cannot hold
    notes: tuple[str, ...] = ()  # sentences: what its user should know
    colour: str = ""
    seen: float | None = None  # S [L*] between the surface and what the file shows; None for a mirror alone
    # what the file shows in linear sRGB: (geometry) -> (samples, 3) [1/sr]
    shown: Callable[[Geometry], np.ndarray] | None = field(default=None, compare=False, repr=False)

    measured_rms_ln: float | None = None  # the same against the measurement; None where there is none

    def sentence(self) -> str:
        """One line for a person."""
        lost = "; ".join(self.lost)
        if self.measured_rms_ln is not None:
            lost = "; ".join([f"against the measurement {_off(self.measured_rms_ln)}", *self.lost])
        look = "" if self.seen is None else f", seen {self.seen:.1f} L*"
        said = f"{self.target}: {self.status}, {_off(self.rms_ln)}{look} over {self.over}"
        return f"{said}; {lost}" if lost else said


def _off(rms_ln: float) -> str:
    return f"{off_words_of(rms_ln)} off (rms ln {rms_ln:.2g})"


@dataclass(frozen=True, repr=False)
class Export:
    """The file, files that must lie beside it (name -> content), and what they cost."""

    content: str | bytes
    statement: Statement
    beside: Mapping[str, str | bytes] = field(default_factory=dict)

    def __repr__(self) -> str:
        size = f"{len(self.content)} {'bytes' if isinstance(self.content, bytes) else 'letters'}"
        return "\n  ".join([self.statement.sentence(), *self.statement.notes, size, *map(str, self.beside)])


@dataclass(frozen=True)
class Exporter:
    """One target. `export` states exact, refit or lossy in its result, or raises `Refused`."""

    module: str
    suffix: str
    what: str  # one line for the catalogue
    # export(surface, geom, stem) -> Export; geom None: the standard directions; stem: name of the file without its
    # suffix
    export: Callable[..., Export]
    named: bool = True  # its file holds the surface's name
    grained: bool = False  # whether it holds one grain
    turned: str = "rgl"  # the nearest target that holds one, of a target that does not
    averages: bool = False  # whether a surface with a grain becomes its mean over all turns, which is said
    lobe: str = ""  # the law of models that its only lobe is, or is nearest to; "": it has several, or any

    @property
    def name(self) -> str:
        return self.module.rpartition(".")[2].replace("_", "-")


class Refused(NoAnswer):
    """A surface that the target cannot express; names the nearest target that can."""

    def __init__(self, target: str, why: str, nearest: str):
        super().__init__(f"{target} cannot express this surface: {why}; the nearest target that can is {nearest}")
        self.target, self.nearest = target, nearest


def refuse_mirror(surface: ColouredSurface, target: str, nearest: str = "rgl") -> tuple[str, ...]:
    """Refuses a surface with an ideal mirror for a target of finite values alone; a glint at grazing is a sentence."""
    if surface.has_mirror:
        why = (
            f"its ideal mirror reflects up to {surface.mirror_most[1]:.2g} of the light beside a finite part, and "
            f"the target holds one of the two"
        )
        raise Refused(target, why, nearest)
    return glint(surface)


def glint(surface: ColouredSurface) -> tuple[str, ...]:
    """The sentence for a mirror that is left out because it only shows beyond 60 degrees."""
    if surface.mirror_most[1] <= 1e-6:
        return ()
    return (
        (
            f"the mirror image that emerges beyond 60 deg, {surface.mirror_most[1]:.1g} of the light at 80 deg, is "
            f"left out"
        ),
    )


def comment_lines(surface: ColouredSurface, statement: Statement) -> list[str]:
    """The lines of a file's comment: who made it from what, and what it costs. No time of day, so that bytes repeat."""
    parameters = " ".join(f"{key}={_spelt(value)}" for key, value in sorted(surface.values.items()))
    lines = [
        f"brdfguide {__version__}",
        f"command: {surface.command}" if surface.command else "",
        f"surface: {surface.name}",
        f"model: {surface.model.name}",
        f"parameters: {parameters}",
        f"colour: {statement.colour or surface.colour.how}",
        statement.sentence(),
        *statement.notes,
    ]
    return [comment(line) for line in lines if line]


def xml_comment(lines: list[str]) -> str:
    """The same as an XML comment, in which two hyphens may not meet: an option --to is shown as - -to."""
    return "<!--\n" + "\n".join("  " + line.replace("--", "- -") for line in lines) + "\n-->"


def _spelt(value) -> str:
    return ",".join(f"{x:.6g}" for x in np.ravel(value))


def number(value, low: float, high: float, what: str) -> float:
    """`value` rounded to nine digits, within low..high.

    A number outside is our own mistake and never reaches a file.
    """
    value = float(value)
    rounded = float(f"{value:.9g}")
    if not low <= rounded <= high:  # also catches NaN
        raise NoAnswer(
            f"{what} = {value:g} is outside {low:g}..{high:g}, the range its reader documents; nothing was written"
        )
    return rounded


def numbers(values, low: float, high: float, what: str) -> list[float]:
    """Each of `values` as `number` gives it."""
    return [number(value, low, high, what) for value in np.ravel(values)]


def rgb_numbers(values, low: float, high: float, what: str) -> list[float]:
    """Three of them, from one or three."""
    return numbers(np.broadcast_to(np.ravel(values), (3,)), low, high, what)


def coloured(surface: Surface, name: str = "surface", command: str = "") -> ColouredSurface:
    """The same with a name, each value finite, within its bounds, and one or as many as channels. Raises InputError."""
    model, channels = surface.model, len(surface.channels)
    checked = {}
    for key, value in surface.values.items():
        if key not in model.parameters:
            raise InputError(f"{key} is no parameter of {model.name}; there are: {', '.join(model.parameters)}")
        parameter = model.parameters[key]
        array = np.asarray(value, float)
        if not np.all(np.isfinite(array)) or np.any(array < parameter.least) or np.any(array > parameter.high):
            raise InputError(f"{key} = {_spelt(array)} is outside {parameter.least:g}..{parameter.high:g}")
        if array.ndim and array.size not in (1, channels):
            raise InputError(f"{key} has {array.size} values for {channels} channels")
        checked[key] = array if array.ndim and array.size > 1 else float(np.ravel(array)[0])
    return ColouredSurface(model, checked, surface.channels, surface.wavelength, name, command)
