"""What a scene may leave out of a model: whole terms, and features within a term.

A term with features a and b can be kept in the ways {}, {a}, {b}, {a, b}, named for what is left out of it, or be left
out as a whole. A `Cut` takes one way for each term kept, and is a sum in its own right, with the same parameters.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np

from .geometry import Geometry, in_plane
from .models._base import Model, Sum, Term

WHOLE = ""  # in place of a feature: the term itself
MIRROR, WAVELENGTH = "mirror", "wavelength"


@dataclass(frozen=True, order=True)
class Part:
    """Something that can be left out: a feature of the term called `label`, or the term."""

    label: str
    feature: str = WHOLE

    def __str__(self) -> str:
        return f"{self.label}.{self.feature}" if self.feature else self.label


@dataclass(frozen=True)
class Cut:
    """A model with some parts left out."""

    out: frozenset[Part]

    def keeps(self, label: str) -> bool:
        return Part(label) not in self.out

    def way(self, label: str) -> frozenset[str]:
        """The features left out of a term that is kept."""
        return frozenset(part.feature for part in self.out if part.label == label and part.feature)

    def without(self, part: Part) -> "Cut":
        """The same with one more part left out; a term takes its features with it."""
        return Cut(frozenset(p for p in self.out if part.feature or p.label != part.label) | {part})

    def restoring(self, part: Part) -> "Cut":
        return Cut(self.out - {part})

    def __str__(self) -> str:
        return ", ".join(map(str, sorted(self.out))) or "nothing"


NOTHING = Cut(frozenset())


@dataclass(frozen=True, eq=False)
class Parts:
    """A sum with its values, taken apart."""

    sum: Sum
    values: Mapping
    wavelength: np.ndarray  # (channels,) [µm]

    def of(self, term: Term) -> dict:
        """Every value of one term."""
        given = {**self.sum.start, **self.sum.fixed, **self.values}
        return {**term.model.defaults(), **self.sum.of_term(term, given)}

    def features(self, term: Term) -> tuple[str, ...]:
        """What may be left out within a term: what its law declares, its mirror, its change with wavelength."""
        own = [feature for feature in term.model.without if "+" not in feature]
        if term.model.mirror is not None and "mirror" not in term.model.roles:
            own.append(MIRROR)
        if len(self.wavelength) > 1 and self._coloured(term):
            own.append(WAVELENGTH)
        return tuple(own)

    def _coloured(self, term: Term) -> bool:
        """Whether the shape of a term, not only its amplitude, differs between the channels."""
        values = self.of(term)
        if term.model.amplitude:
            values[term.model.amplitude] = 1.0
        values = {name: np.asarray(value, float) for name, value in values.items()}
        geom = in_plane([[45.0]], [[38.0]], self.wavelength)
        f = np.broadcast_to(term.model(geom, **values), (1, len(self.wavelength)))
        return bool(np.ptp(f) > 1e-9 * f.max())

    def ways(self, term: Term) -> tuple[frozenset[str], ...]:
        """How a term can be kept, least left out first; only combinations that the law provides."""
        features = self.features(term)
        every = (frozenset(some) for count in range(len(features) + 1) for some in combinations(features, count))
        return tuple(way for way in every if _law(term.model, way) is not None)

    def all(self) -> tuple[Part, ...]:
        """Everything that may be left out, term by term."""
        return tuple(Part(term.label, feature) for term in self.sum.terms for feature in (WHOLE, *self.features(term)))

    def cuts(self, settled: frozenset[Part] = frozenset()) -> list[Cut]:
        """Every cut that keeps at least one term, and none of the `settled` parts where the laws allow that."""
        cuts = [frozenset()]
        for term in self.sum.terms:
            gone = frozenset(part.feature for part in settled if part.label == term.label)
            ways = self.ways(term)
            kept = [frozenset(Part(term.label, feature) for feature in way) for way in ways if gone <= way or gone not in ways]
            cuts = [cut | more for cut in cuts for more in (*kept, frozenset({Part(term.label)}))]
        nothing_left = frozenset(Part(term.label) for term in self.sum.terms)
        return [Cut(out) for out in cuts if not nothing_left <= out]

    def provided(self, cut: Cut) -> bool:
        """Whether every term kept has a law for what is left out of it."""
        kept = [term for term in self.sum.terms if cut.keeps(term.label)]
        return bool(kept) and all(_law(term.model, cut.way(term.label)) is not None for term in kept)

    def model(self, term: Term, way: frozenset[str]) -> Model:
        """The law of one term without the features in `way`; its parameters are the same.

        A body that is quadratic in its albedo becomes proportional to it with the first feature that it loses.
        """
        law, mirror, parameters = _law(term.model, way), None if MIRROR in way else term.model.mirror, term.model.parameters
        if way & term.model.without.keys() and term.model.amplitude is None:
            parameters = tuple(replace(p, linear=p.name == "albedo") for p in parameters)
        model = replace(term.model, brdf=law, mirror=mirror, parameters=parameters, gradient=None if way else term.model.gradient, without={})
        if WAVELENGTH not in way:
            return model
        one = partial(self._at_one_wavelength, amplitude=model.amplitude)
        return replace(model, brdf=one(law), mirror=mirror and one(mirror))  # a mirror part is proportional to the amplitude, if there is one

    def _at_one_wavelength(self, law, amplitude: str | None):
        """`law` at the mean wavelength and with the mean of each shape parameter; its amplitude keeps its channels."""
        mean = float(np.mean(self.wavelength))

        def single(geom: Geometry, **values):
            own = values.pop(amplitude, 1.0)
            unit = {} if amplitude is None else {amplitude: 1.0}
            return own * law(geom.at(mean), **{name: np.mean(value) for name, value in values.items()}, **unit)

        return single

    def pruned(self, cut: Cut) -> Sum:
        """What is left of the sum."""
        terms = tuple(Term(t.label, self.model(t, cut.way(t.label))) for t in self.sum.terms if cut.keeps(t.label))
        kept = {f"{t.label}.{p.name}" for t in terms for p in t.model.parameters}
        own = lambda values: {key: value for key, value in values.items() if key in kept}  # noqa: E731
        name = "+".join(term.model.name for term in terms)
        return Sum(name, terms, own(self.sum.fixed), tuple(key for key in self.sum.free if key in kept), own(self.sum.start))


def _law(model: Model, way: frozenset[str]):
    """The law of `model` without some features, or None if it has none."""
    wanted = way - {MIRROR, WAVELENGTH}
    if not wanted:
        return model.brdf
    return next((law for name, law in model.without.items() if frozenset(name.split("+")) == wanted), None)
