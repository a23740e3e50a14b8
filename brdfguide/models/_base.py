"""What every file in this folder provides: one reflectance law with its parameters, limits and proofs.

A surface is a `Sum` of terms. Each term is linear in at most one parameter, its amplitude, so that amplitudes
are solved for and never searched for.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..errors import InputError, choices
from ..geometry import Geometry


@dataclass(frozen=True)
class Parameter:
    """One number of a law. Bounds are closed and lie where the law is defined."""

    name: str
    default: float
    low: float
    high: float
    unit: str = ""
    log: bool = False  # fitted as the logarithm of its distance from `origin`
    origin: float = 0.0  # 1 for a refractive index, since F0 follows n - 1
    linear: bool = False  # the amplitude: brdf is proportional to it
    per_channel: bool = False  # has a value for each wavelength or colour
    free: bool = True  # False: kept at its value unless the user frees it
    meaning: str = ""
    starts: tuple[float, ...] = ()  # values worth starting a fit from; empty: spread over the bounds
    given_low: float | None = None  # a value that is given, not fitted, may go down to here: n of a metal beside its k

    @property
    def least(self) -> float:
        """The lower bound of a value that is given."""
        return self.low if self.given_low is None else self.given_low

    @property
    def outside_unit(self) -> str:
        """Its unit where people read it: angles are degrees there."""
        return "deg" if self.unit == "rad" else self.unit

    def outside(self, value):
        """A value as people read it."""
        return np.degrees(value) if self.unit == "rad" else value

    def inside(self, value):
        """A value, or one for each channel, that people gave, as the law wants it. Raises InputError where the law does not hold."""
        low, high = self.outside(self.least), self.outside(self.high)
        for each in np.atleast_1d(value):
            if not low <= each <= high:
                raise InputError(f"{self.name} = {each:g} is outside {low:g}..{high:g} {self.outside_unit}".rstrip())
        return np.radians(value) if self.unit == "rad" else value


@dataclass(frozen=True)
class Derived:
    """A number that follows from the parameters and that people ask for, such as tau = sigma/slope."""

    name: str
    of: Callable[..., float]  # keyword arguments: the parameters
    unit: str = ""
    meaning: str = ""


@dataclass(frozen=True)
class Pin:
    """A value computed at 50 digits or printed in a paper, away from the defaults."""

    geom: Geometry
    values: Mapping[str, float]
    f: float
    source: str
    rtol: float = 1e-12


@dataclass(frozen=True)
class Extreme:
    """A place where naive code breaks; `f` where the right value is known."""

    why: str
    geom: Geometry
    values: Mapping[str, float] = field(default_factory=dict)
    f: float | None = None
    rtol: float = 1e-9


@dataclass(frozen=True, eq=False)
class Model:
    """One term: a law, its parameters and what is known about it. Calling it gives the BRDF [1/sr], 0 below the horizon."""

    module: str
    brdf: Callable[..., np.ndarray]
    parameters: tuple[Parameter, ...]
    roles: tuple[str, ...] = ("surface",)  # of: subsurface, surface, mirror
    summary: str = ""  # what it is good and bad at, in a sentence
    # gradient(geom, names, **values) -> {name: df/dname}; names it leaves out are differenced. By the amplitude, the law at 1, it is given for nothing
    gradient: Callable[..., dict[str, np.ndarray]] | None = None
    # mirror(geom, **values) -> reflectance of the ideal specular part at theta_i, dimensionless
    mirror: Callable[..., np.ndarray] | None = None
    derived: tuple[Derived, ...] = ()
    # features that a scene may not need, joined by "+" -> the law without them, same parameters; see parts
    without: Mapping[str, Callable[..., np.ndarray]] = field(default_factory=dict)
    pins: tuple[Pin, ...] = ()
    extremes: tuple[Extreme, ...] = ()
    breaks: Mapping[str, str] = field(default_factory=dict)  # law of the contract -> why this model breaks it
    source: str = ""

    @property
    def name(self) -> str:
        """As typed by users: the file's name with hyphens."""
        return self.module.rpartition(".")[2].replace("_", "-")

    @cached_property
    def amplitude(self) -> str | None:
        """The parameter that the law is linear in."""
        return next((p.name for p in self.parameters if p.linear), None)

    def parameter(self, name: str) -> Parameter:
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        raise choices(f"parameter of {self.name}", name, [p.name for p in self.parameters])

    def defaults(self) -> dict[str, float]:
        return {p.name: p.default for p in self.parameters}

    def __call__(self, geom: Geometry, **values) -> np.ndarray:
        """BRDF [1/sr] in the broadcast shape of `geom`, its wavelength and the values; parameters not given keep their defaults."""
        defaults = self.defaults()
        for name in values.keys() - defaults.keys():
            self.parameter(name)
        values = {**defaults, **values}
        if geom.all_lit:
            return self.brdf(geom, **values)
        return np.where(geom.lit, self.brdf(geom.where_lit(), **values), 0.0)


@dataclass(frozen=True)
class Term:
    """A model in its place in a sum; the label tells apart two lobes of one kind."""

    label: str
    model: Model


@dataclass(frozen=True, eq=False)
class Sum:
    """Terms that add up to a surface, such as `lambertian+ward`. Values are keyed `ward.alpha`."""

    name: str
    terms: tuple[Term, ...]
    # fixed values that make this a candidate of its own, such as {"ggx.k": 0.0}; shown to users
    fixed: Mapping[str, float] = field(default_factory=dict)
    free: tuple[str, ...] = ()  # parameters that are fitted here though a law keeps them fixed by itself
    start: Mapping[str, float] = field(default_factory=dict)  # where a guideline would begin, in place of the defaults

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        return {f"{t.label}.{p.name}": p for t in self.terms for p in t.model.parameters}

    def defaults(self) -> dict[str, float]:
        return {**{key: p.default for key, p in self.parameters.items()}, **self.start, **self.fixed}

    def has(self, name: str) -> bool:
        """Whether `alpha` or `ggx.alpha` is one of its parameters."""
        return any(name in (key, key.rpartition(".")[2]) for key in self.parameters)

    def qualified(self, values: Mapping) -> dict:
        """What a user gave, as the laws want it: `alpha` as `ggx.alpha`, degrees as radians.

        A name without a term belongs to every term that has it. Raises InputError for others, and for a value where the law does not hold.
        """
        out = {}
        for name, value in values.items():
            keys = [key for key in self.parameters if name in (key, key.rpartition(".")[2])]
            if not keys:
                raise choices(f"parameter of {self.name}", name, list(self.parameters))
            out.update({key: self.parameters[key].inside(value) for key in keys})
        return out

    def of_term(self, term: Term, values: Mapping) -> dict:
        """The values of one term, under the bare names of its parameters."""
        prefix = term.label + "."
        return {key.removeprefix(prefix): value for key, value in values.items() if key.startswith(prefix)}

    def __call__(self, geom: Geometry, values: Mapping) -> np.ndarray:
        """BRDF [1/sr]; raises InputError for a key that is no parameter of any term."""
        for key in values:
            if key not in self.parameters:
                raise choices(f"parameter of {self.name}", key, list(self.parameters))
        values = {**self.start, **self.fixed, **values}
        total = 0.0
        for term in self.terms:
            total = total + term.model(geom, **self.of_term(term, values))
        return total

    def mirror(self, geom: Geometry, values: Mapping) -> np.ndarray:
        """Reflectance of the ideal specular parts at theta_i, dimensionless; 0 if no term has one."""
        values = {**self.start, **self.fixed, **values}
        total = np.zeros(geom.shape)
        for term in self.terms:
            if term.model.mirror is not None:
                total = total + term.model.mirror(geom, **{**term.model.defaults(), **self.of_term(term, values)})
        return total

    @property
    def has_mirror(self) -> bool:
        return any(term.model.mirror is not None for term in self.terms)

    @property
    def roles(self) -> set[str]:
        return {role for term in self.terms for role in term.model.roles}
