"""What every file in this folder provides: one reflectance law with its parameters, limits and proofs.

A surface's model is a `Composite` of terms. Each term is linear in at most one parameter, its amplitude, so that
amplitudes are solved for and never searched for.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import field
from functools import cached_property, partial

import numpy as np

from ..errors import InputError, choices
from ..physics.geometry import WAVELENGTH_UM, Geometry, in_plane
from ..records import dataclass
from .facts import Candidacy, Facets, Formula, Grain, Setting


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
    period: float | None = None  # values so far apart are the same: an axis comes back after half a turn
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
        """A value, or one for each channel, that people gave, as the law wants it.

        Raises InputError where the law does not hold.
        """
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


def at(
    theta_i_deg: float, theta_r_deg: float, wavelength: float = WAVELENGTH_UM, *, phi_i: float = 0.0, phi_r=None
) -> Callable[[], Geometry]:
    """A pair of directions, formed when it is asked for: whoever loads a law mostly does not ask.

    In the plane of incidence as `in_plane` has it, or with azimuths [deg].
    """
    if phi_r is None:
        return partial(in_plane, theta_i_deg, theta_r_deg, wavelength)
    return partial(Geometry.from_degrees, theta_i_deg, phi_i, theta_r_deg, phi_r, wavelength)


@dataclass(frozen=True)
class Pin:
    """A value computed at 50 digits or printed in a paper, away from the defaults."""

    where: Callable[[], Geometry]
    values: Mapping[str, float]
    f: float
    source: str
    rtol: float = 1e-12

    @cached_property
    def geom(self) -> Geometry:
        return self.where()


@dataclass(frozen=True)
class Extreme:
    """A place where naive code breaks; `f` where the right value is known."""

    why: str
    where: Callable[[], Geometry]
    values: Mapping[str, float] = field(default_factory=dict)
    f: float | None = None
    rtol: float = 1e-9

    @cached_property
    def geom(self) -> Geometry:
        return self.where()


@dataclass(frozen=True, eq=False)
class Model:
    """One term: a law, its parameters and what is known about it.

    Calling it gives the BRDF [1/sr], 0 below the horizon.
    """

    module: str
    brdf: Callable[..., np.ndarray]
    parameters: tuple[Parameter, ...]
    roles: tuple[str, ...] = ("surface",)  # of: subsurface, surface, mirror
    summary: str = ""  # what it is good and bad at, in a sentence
    # gradient(geom, names, **values) -> {name: df/dname}; names it leaves out are differenced. By the amplitude, the
    # law at 1, it is given for nothing
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
    family: str = ""  # what it is one of: Phong, Ward, facets; figures draw the best of each of the report's
    about_mirror: bool = False  # its lobe is formed about the mirror direction, not about the half vector
    cannot: str = ""  # what it leaves out, in a sentence for whoever is advised to take it
    aliases: tuple[str, ...] = ()  # other names that users type
    candidacy: Candidacy | None = None  # where the default ranking tries it; None: only where it is named
    # from_facets(facets) -> start values; None: those parameters that Facets has by the same name
    from_facets: Callable[[Facets], Mapping] | None = None
    # beyond_facets(**values) -> what one lobe of facets, which most renderers have, cannot hold of it; "": nothing
    beyond_facets: Callable[..., str] | None = None
    # words behind its name in brackets -> what they hold and free
    settings: Mapping[str, Setting] = field(default_factory=dict)
    # other published readings of the same text, in words -> the law as they have it, same parameters
    readings: Mapping[str, Callable[..., np.ndarray]] = field(default_factory=dict)
    formula: Formula | None = None  # for shaders; None: they refuse it
    grain: Grain | None = None  # which of its parameters shape a grain; None: it has none, or is searched as it is
    base: "Model | None" = None  # the law that this one puts a coat over

    @property
    def name(self) -> str:
        """As typed by users: the file's name with hyphens."""
        name = self.module.rpartition(".")[2].replace("_", "-")
        return f"coated:{name}" if self.base else name

    @cached_property
    def amplitude(self) -> str | None:
        """The parameter that the law is linear in."""
        return next((p.name for p in self.parameters if p.linear), None)

    @property
    def is_body(self) -> bool:
        """Whether its light comes from below the surface alone."""
        return self.roles == ("subsurface",)

    @property
    def is_mirror(self) -> bool:
        """Whether it is an ideal mirror and nothing else."""
        return self.roles == ("mirror",)

    @property
    def is_coat(self) -> bool:
        """Whether it is a coat's own part, with what the laws under it share."""
        return self.family == "coat"

    @property
    def is_lobe(self) -> bool:
        """Whether it may be what the surface itself reflects, in a lobe of finite width."""
        return "surface" in self.roles

    @property
    def returns_light(self) -> bool:
        """Whether its lobe points back to the light."""
        return self.family == "retro-reflection"

    @property
    def has_index(self) -> bool:
        """Whether Fresnel's factor is in it: on a metal by n and k, on a dielectric by n alone."""
        return {"n", "k"} <= {p.name for p in self.parameters}

    @property
    def turns(self) -> bool:
        """Whether it changes as the surface is turned in its plane."""
        return "rotation" in self.breaks

    def started(self, facets: Facets) -> dict:
        """Start values for a described surface; parameters that the description says nothing of are left out."""
        if self.from_facets is not None:
            return dict(self.from_facets(facets))
        given = {p.name: getattr(facets, p.name, None) for p in self.parameters}
        return {name: value for name, value in given.items() if value is not None}

    def parameter(self, name: str) -> Parameter:
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        raise choices(f"parameter of {self.name}", name, [p.name for p in self.parameters])

    @cached_property
    def _defaults(self) -> dict[str, float]:
        return {p.name: p.default for p in self.parameters}

    def defaults(self) -> dict[str, float]:
        return self._defaults.copy()

    def __call__(self, geom: Geometry, **values) -> np.ndarray:
        """BRDF [1/sr] in the broadcast shape of `geom`, its wavelength and the values; parameters not given keep their
        defaults."""
        for name in values.keys() - self._defaults.keys():
            self.parameter(name)
        values = {**self._defaults, **values}
        if geom.all_lit:
            return self.brdf(geom, **values)
        return np.where(geom.lit, self.brdf(geom.where_lit(), **values), 0.0)


@dataclass(frozen=True)
class Term:
    """A model in its place in a sum; the label tells apart two lobes of one kind."""

    label: str
    model: Model
    shared: Mapping[str, str] = field(default_factory=dict)  # its parameters that are another term's -> their keys

    def key(self, name: str) -> str:
        """The key of one of its parameters, such as `ggx.alpha`."""
        return self.shared.get(name, f"{self.label}.{name}")

    @cached_property
    def height(self) -> str:
        """The key of the amplitude that a lobe has beside Fresnel's factor, which is held; "" where there is none."""
        held = self.model.amplitude and self.model.has_index and not self.model.parameter(self.model.amplitude).free
        return self.key(self.model.amplitude or "") if held else ""

    @cached_property
    def keys(self) -> dict[str, str]:
        """The keys of all its parameters by their bare names."""
        return {p.name: self.key(p.name) for p in self.model.parameters}


def counted(terms: Iterable[Term]) -> tuple[list[tuple[Model, int]], list[tuple[Model, int]]]:
    """Each law and how many lobes of it follow one another, of what is on top and of what a coat covers; the coat's own
    term apart. A lobe with an index of its own begins anew.
    """
    parts: tuple[list[tuple[Model, int]], list[tuple[Model, int]]] = ([], [])
    for term in terms:
        if term.model.is_coat:
            continue
        model, part = term.model.base or term.model, parts[term.model.base is not None]
        joins = bool(part) and part[-1][0] is model and ("k" in term.shared or not model.has_index)
        if joins:
            part[-1] = model, part[-1][1] + 1
        else:
            part.append((model, 1))
    return parts


def spelt(terms: Iterable[Term]) -> str:
    """The expression that users type for some terms: a law that follows itself counted, what a coat covers behind
    `coated:`.
    """
    top, below = (
        "+".join(model.name + (f":{count}" if count > 1 else "") for model, count in part) for part in counted(terms)
    )
    return "+".join(filter(None, [top, below and f"coated:{below}"]))


@dataclass(frozen=True, eq=False)
class Composite:
    """Terms that add up, such as `lambertian+ward`. Values are keyed `ward.alpha`."""

    name: str
    terms: tuple[Term, ...]
    # fixed values that make this a candidate of its own, such as {"ggx.k": 0.0}; shown to users
    fixed: Mapping[str, float] = field(default_factory=dict)
    free: tuple[str, ...] = ()  # parameters that are fitted here though a law keeps them fixed by itself
    start: Mapping[str, float] = field(default_factory=dict)  # where a guideline would begin, in place of the defaults

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        found: dict[str, Parameter] = {}
        for term in self.terms:
            for parameter in term.model.parameters:  # one that is shared is what the first of its terms says
                found.setdefault(term.key(parameter.name), parameter)
        return found

    @cached_property
    def _defaults(self) -> dict[str, float]:
        return {**{key: p.default for key, p in self.parameters.items()}, **self.start, **self.fixed}

    def defaults(self) -> dict[str, float]:
        return self._defaults.copy()

    def has(self, name: str) -> bool:
        """Whether `alpha` or `ggx.alpha` is one of its parameters."""
        return any(name in (key, key.rpartition(".")[2]) for key in self.parameters)

    def qualified(self, values: Mapping) -> dict:
        """What a user gave, as the laws want it: `alpha` as `ggx.alpha`, degrees as radians.

        A name without a term belongs to every term that has it. Raises InputError for others, and for a value where the
        law does not hold.
        """
        out = {}
        for name, value in values.items():
            keys = [key for key in self.parameters if name in (key, key.rpartition(".")[2])]
            if not keys:
                raise choices(f"parameter of {self.name}", name, list(self.parameters))
            out.update({key: self.parameters[key].inside(value) for key in keys})
        return out

    def term(self, label: str) -> Term:
        return next(term for term in self.terms if term.label == label)

    def of_term(self, term: Term, values: Mapping) -> dict:
        """The values of one term, under the bare names of its parameters."""
        return {name: values[key] for name, key in term.keys.items() if key in values}

    def __call__(self, geom: Geometry, values: Mapping) -> np.ndarray:
        """BRDF [1/sr]; raises InputError for a key that is no parameter of any term."""
        for key in values.keys() - self.parameters.keys():
            raise choices(f"parameter of {self.name}", key, list(self.parameters))
        values = {**self.start, **self.fixed, **values}
        return sum((term.model(geom, **self.of_term(term, values)) for term in self.terms), start=np.zeros(()))

    def mirror(self, geom: Geometry, values: Mapping) -> np.ndarray:
        """Reflectance of the ideal specular parts at theta_i, dimensionless; 0 if no term has one."""
        values, total = {**self.start, **self.fixed, **values}, np.zeros(geom.shape)
        for term in self.terms:
            if term.model.mirror is not None:
                total = total + term.model.mirror(geom, **{**term.model.defaults(), **self.of_term(term, values)})
        return total

    @property
    def turns(self) -> bool:
        """Whether it may change as the surface is turned in its plane."""
        return any(term.model.turns for term in self.terms)

    @property
    def has_mirror(self) -> bool:
        return any(term.model.mirror is not None for term in self.terms)

    @property
    def roles(self) -> set[str]:
        return {role for term in self.terms for role in term.model.roles}
