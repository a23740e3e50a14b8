"""What a scene may leave out of a model: whole terms, and features within a term.

A term with features a and b can be kept in the variants {}, {a}, {b}, {a, b}, named for what is left out of it, or be
left out as a whole. An `Ablation` takes one variant of each term kept, and is a sum in its own right, with the same
parameters.
"""

from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np

from ..models.model import Composite, Model, Term, spelt
from ..models.surface import Surface
from ..physics.geometry import Geometry, in_plane

WHOLE = ""  # in place of a feature: the term itself
MIRROR = "mirror"  # the ideal specular part of a term
WAVELENGTH = "wavelength"  # that a term's shape changes with it


@dataclass(frozen=True, order=True)
class Feature:
    """Something that can be left out: a feature of the term called `label`, or the term."""

    label: str
    name: str = WHOLE

    def __str__(self) -> str:
        return f"{self.label}.{self.name}" if self.name else self.label


@dataclass(frozen=True)
class Ablation:
    """A model with some parts left out."""

    out: frozenset[Feature]

    def keeps(self, label: str) -> bool:
        return Feature(label) not in self.out

    def variant(self, label: str) -> frozenset[str]:
        """The features left out of a term that is kept."""
        return frozenset(feature.name for feature in self.out if feature.label == label and feature.name)

    def without(self, feature: Feature) -> "Ablation":
        """The same with one more part left out; a term takes its features with it."""
        return Ablation(frozenset(p for p in self.out if feature.name or p.label != feature.label) | {feature})

    def restoring(self, feature: Feature) -> "Ablation":
        return Ablation(self.out - {feature})

    def __str__(self) -> str:
        return ", ".join(map(str, sorted(self.out))) or "nothing"


NOTHING = Ablation(frozenset())


@dataclass(frozen=True, eq=False)
class Features:
    """A surface taken apart."""

    surface: Surface

    @property
    def terms(self) -> tuple[Term, ...]:
        return self.surface.model.terms

    def of(self, term: Term) -> tuple[str, ...]:
        """What may be left out within a term: what its law declares, its mirror, its change with wavelength."""
        names = [name for name in term.model.without if "+" not in name]
        if term.model.mirror is not None and not term.model.is_mirror:
            names.append(MIRROR)
        if len(self.surface.channels) > 1 and self._coloured(term):
            names.append(WAVELENGTH)
        return tuple(names)

    def _coloured(self, term: Term) -> bool:
        """Whether the shape of a term, not only its amplitude, differs between the channels."""
        values = self.surface.values_of(term)
        if term.model.amplitude:
            values[term.model.amplitude] = 1.0
        values = {name: np.asarray(value, float) for name, value in values.items()}
        f = term.model(in_plane([[45.0]], [[38.0]], self.surface.wavelength), **values)
        return bool(np.ptp(f) > 1e-9 * f.max())

    def variants(self, term: Term) -> tuple[frozenset[str], ...]:
        """How a term can be kept, least left out first; only combinations that the law provides."""
        names = self.of(term)
        every = (frozenset(some) for count in range(len(names) + 1) for some in combinations(names, count))
        return tuple(variant for variant in every if _variant_brdf(term.model, variant) is not None)

    def all(self) -> tuple[Feature, ...]:
        """Everything that may be left out, term by term."""
        return tuple(Feature(term.label, name) for term in self.terms for name in (WHOLE, *self.of(term)))

    def ablations(self, settled: frozenset[Feature] = frozenset()) -> list[Ablation]:
        """Every ablation that keeps at least one term, and none of the `settled` features where the laws allow that."""
        ablations: list[frozenset[Feature]] = [frozenset()]
        for term in self.terms:
            gone = frozenset(feature.name for feature in settled if feature.label == term.label)
            variants = self.variants(term)
            kept = [
                frozenset(Feature(term.label, name) for name in variant)
                for variant in variants
                if gone <= variant or gone not in variants
            ]
            ablations = [
                ablation | more for ablation in ablations for more in (*kept, frozenset({Feature(term.label)}))
            ]
        nothing_left = frozenset(Feature(term.label) for term in self.terms)
        return [Ablation(out) for out in ablations if not nothing_left <= out]

    def provided(self, ablation: Ablation) -> bool:
        """Whether every term kept has a law for what is left out of it."""
        kept = [term for term in self.terms if ablation.keeps(term.label)]
        return bool(kept) and all(_variant_brdf(term.model, ablation.variant(term.label)) is not None for term in kept)

    def model(self, term: Term, variant: frozenset[str]) -> Model:
        """The law of one term without the features in `variant`; its parameters are the same.

        A body that is quadratic in its albedo becomes proportional to it with the first feature that it loses.
        """
        brdf, parameters = _variant_brdf(term.model, variant), term.model.parameters
        mirror = None if MIRROR in variant else term.model.mirror
        if variant & term.model.without.keys() and term.model.amplitude is None:
            parameters = tuple(replace(p, linear=p.name == "albedo") for p in parameters)
        model = replace(
            term.model,
            brdf=brdf,
            mirror=mirror,
            parameters=parameters,
            gradient=None if variant else term.model.gradient,
            formula=None if variant else term.model.formula,
            without={},
        )
        if WAVELENGTH not in variant:
            return model
        one = partial(self._at_one_wavelength, amplitude=model.amplitude)
        # a mirror part is proportional to the amplitude, if there is one
        return replace(model, brdf=one(brdf), mirror=mirror and one(mirror))

    def _at_one_wavelength(self, brdf, amplitude: str | None):
        """`brdf` at the mean wavelength and with the mean of each shape parameter; its amplitude keeps its channels."""
        mean = float(np.mean(self.surface.wavelength))

        def single(geom: Geometry, **values):
            height, unit = 1.0, {}
            if amplitude is not None:
                height, unit = values.pop(amplitude, 1.0), {amplitude: 1.0}
            return height * brdf(geom.at(mean), **{name: np.mean(value) for name, value in values.items()}, **unit)

        return single

    def pruned(self, ablation: Ablation) -> Composite:
        """What is left of the sum."""
        terms = tuple(
            replace(t, model=self.model(t, ablation.variant(t.label))) for t in self.terms if ablation.keeps(t.label)
        )
        kept = {key for term in terms for key in term.keys.values()}

        def of_kept(values):
            return {key: value for key, value in values.items() if key in kept}

        whole = self.surface.model
        return Composite(
            spelt(terms),
            terms,
            of_kept(whole.fixed),
            tuple(key for key in whole.free if key in kept),
            of_kept(whole.start),
        )


def _variant_brdf(model: Model, variant: frozenset[str]):
    """The law of `model` without some features, or None if it has none."""
    wanted = variant - {MIRROR, WAVELENGTH}
    if not wanted:
        return model.brdf
    return next((brdf for name, brdf in model.without.items() if frozenset(name.split("+")) == wanted), None)
