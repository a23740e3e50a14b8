"""Which term the best law lacks, from what it leaves: a lobe about the light, a coat, flakes, a cloth's sheen.

    share = (t · d)² / (t · t)(d · d),   d = ln(data/model),   t = g/model,   both less what the law's own parameters
                                                                              could have done (their tangents)

A term of shape g added in a small height changes ln f by a multiple of t; only brighter counts. Each kind of term is
tried in several widths. Neighbours err together: as many values count as are independent, and the kinds are weighed
against each other, and against none, by their likelihoods.

Source: the score test, Rao 1948, "Large sample tests of statistical hypotheses"; the kinds and bounds are ours.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from .. import models
from ..data.measurement import LARGEST, SMALLEST, Measurement
from ..models.extensions import extensions
from ..models.model import Composite
from ..models.surface import Surface
from ..physics.geometry import Geometry
from ..records import dataclass
from .cross_validation import thinned
from .diagnostics import standard_errors
from .fit import Fit
from .layout import layout_of
from .reading import reading, with_slopes

WIDTHS = (0.02, 0.04, 0.07, 0.12, 0.2, 0.33, 0.55)
SPREADS = (0.25, 0.4, 0.7)
NARROWER, WIDER = 0.6, 1.7  # times the lobe's width: of a second one, and of a haze
LEAST_SHARE = 0.1  # of what is left, below which no term is named
LEAST_CONFIDENCE = 0.6
TURNED_DEG = 5.0  # of the sample, from which a second axis would show
WORDS = {
    "retro": "a lobe about the light",
    "second lobe": "a narrower lobe about the mirror direction",
    "haze": "a wider haze about the mirror direction",
    "sheen": "a sheen toward grazing",
    "flakes": "flakes under a coat",
    "coat": "a coat that darkens the body toward grazing",
    "second axis": "another width along a second axis of the surface",
}


@dataclass(frozen=True)
class MissingTerm:
    """One kind of term, how much of what is left it would take away, and how sure that is."""

    kind: str
    share: float  # of the residuals' variance
    confidence: float  # 0 to 1, among the kinds and none
    beside: tuple[tuple[str, float], ...] = ()  # the others that come near, and their shares
    candidate: str | None = None  # the law with that term, as candidates grow; None: there is none

    @property
    def words(self) -> str:
        return WORDS[self.kind]


def missing_term(fit: Fit, measurement: Measurement) -> MissingTerm | None:
    """The term that a fitted law lacks most; None where what it leaves is noise, or like no term."""
    few = thinned(measurement)
    channel = few.brdf.shape[1] // 2
    known = few.clear[:, channel]
    if np.count_nonzero(known) < 24:
        return None
    few = few[known].of_channels([channel])
    surface = fit.surface.of_channels([_place(fit, measurement, channel)])
    model = np.maximum(reading(surface, few.instrument)[:, 0], SMALLEST)
    if model.min() < 1 / LARGEST:  # a law that is nowhere lacks everything
        return None
    left = few.ln[:, 0] - np.log(model)
    correlation, score = standard_errors.serial_correlation(left[:, None], standard_errors.orderings(few))
    turned = np.ptp(few.geom.phi_i_deg) >= TURNED_DEG  # then neighbours need not err together
    if standard_errors.discrepancy(left[:, None], correlation, score) is None and not turned:
        return None
    own = _tangents(surface, few, model)
    rest = left - own @ (own.T @ left)
    count = len(left) / standard_errors.serial_widening(correlation)
    shares: dict[str, float] = {}
    for kind, shape in _shapes(surface, few, model):
        bare = shape - own @ (own.T @ shape)
        size = float(bare @ bare)
        if size > 1e-8 * float(shape @ shape):
            along = float(bare @ rest)
            share = along**2 / (size * float(rest @ rest)) if along > 0 or kind == "second axis" else 0.0
            shares[kind] = max(shares.get(kind, 0.0), share)
    found = _named(shares, count)
    return None if found is None else replace(found, candidate=_grown_by(found.kind, fit))


def _grown_by(kind: str, fit: Fit) -> str | None:
    """The law that has such a term more, of those that candidates grow to where one does."""
    longer = (each.model for each in extensions(fit.model, fit.values))
    grows = next((each.name for each in longer if _has_more(kind, each, fit.model)), None)
    return grows if grows is not None else _typed(kind, fit.model)


def _typed(kind: str, model: Composite) -> str | None:
    """The law with a term that candidates do not grow by themselves: a cloth's sheen, a grain."""
    if kind == "sheen":
        return f"{model.name}+sheen"
    known = models.names()
    grained = "+".join(f"{word}-aniso" if f"{word}-aniso" in known else word for word in model.name.split("+"))
    return grained if kind == "second axis" and grained != model.name else None


def _has_more(kind: str, longer: Composite, model: Composite) -> bool:
    """Whether a sum has a term of this kind that another lacks."""
    has, had = ([(term.model.base or term.model).name for term in each.terms] for each in (longer, model))
    new = set(has) - set(had)
    if kind == "flakes":
        return any(name.startswith("flakes") for name in new)
    if kind == "coat":
        coated, before = (any(term.model.is_coat for term in each.terms) for each in (longer, model))
        return coated and not before and not any(name.startswith("flakes") for name in new)
    if kind == "second axis":
        turns, before = (any(term.model.turns for term in each.terms) for each in (longer, model))
        return turns and not before
    if kind in ("second lobe", "haze"):
        return not new and len(has) > len(had)
    return kind in new


def _place(fit: Fit, measurement: Measurement, channel: int) -> int:
    """The channel of the fit that `thinned` has at this place."""
    from_few = np.linspace(0, len(fit.surface.channels) - 1, min(len(fit.surface.channels), 4)).round().astype(int)
    return int(from_few[channel]) if len(fit.surface.channels) > 1 else 0


def _named(shares: dict[str, float], count: float) -> MissingTerm | None:
    if not shares:
        return None
    gains = {
        kind: -0.5 * count * np.log1p(-min(share, 1 - 1e-12)) - 0.5 * np.log(count) for kind, share in shares.items()
    }
    order = sorted(shares, key=lambda kind: -shares[kind])
    best, top = order[0], max(0.0, *gains.values())
    likely = {kind: np.exp(gain - top) for kind, gain in gains.items()}
    confidence = float(likely[best] / (sum(likely.values()) + np.exp(-top)))
    if shares[best] < LEAST_SHARE or confidence < LEAST_CONFIDENCE:
        return None
    beside = tuple((kind, shares[kind]) for kind in order[1:] if shares[kind] > 0.5 * shares[best])
    return MissingTerm(best, shares[best], confidence, beside)


def _tangents(surface: Surface, few: Measurement, model: np.ndarray) -> np.ndarray:
    """Orthonormal columns that span ∂ ln f/∂u and a constant, (samples, parameters + 1)."""
    layout = layout_of(surface.model, 1)
    _, slopes = with_slopes(layout, surface, few.instrument)
    columns = [slopes[key][:, 0] / model for key in (*layout.shared, *layout.per_channel)]
    finite = [column / max(float(np.linalg.norm(column)), 1e-300) for column in columns]
    basis, strength, _ = np.linalg.svd(np.stack([*finite, np.ones(len(model)) / np.sqrt(len(model))], 1), False)
    return basis[:, strength > 1e-6 * strength[0]]


def _shapes(surface: Surface, few: Measurement, model: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """(kind, t) of every term that may be missing, in several widths."""

    def of(expression: str, name: str, sizes: Sequence[float]) -> Iterator[np.ndarray]:
        """In each size; of all in one call, as if each were a channel."""
        law, values = _term(expression)
        if sizes:
            several, (key,) = np.array(sizes), law.qualified({name: sizes[0]})
            waves = np.repeat(few.geom.wavelength, len(sizes))
            alone = Surface(law, {**values, key: several}, tuple(map(str, sizes)), waves)
            yield from (reading(alone, few.instrument) / model[:, None]).T

    has = {term.model.name for term in surface.model.terms}
    width = _width(surface.model, surface)
    narrower = [] if width is None else [alpha for alpha in WIDTHS if alpha < NARROWER * width]
    wider = [] if width is None else [alpha for alpha in WIDTHS if alpha > WIDER * width]
    kinds = (
        ("retro", "retro", "alpha", () if "retro" in has else WIDTHS),
        ("flakes", "coated:flakes", "tilt", () if "flakes" in has else WIDTHS),
        ("second lobe", "ggx", "alpha", narrower),
        ("haze", "ggx", "alpha", wider),
        ("sheen", "sheen", "spread", () if "sheen" in has else SPREADS),
    )
    for kind, expression, name, sizes in kinds:
        for shape in of(expression, name, sizes):
            yield kind, shape
    if any(term.model.is_body for term in surface.model.terms):
        (coated,), (bare,) = of("coated:lambertian", "albedo", [0.5]), of("lambertian", "albedo", [0.5])
        yield "coat", coated - bare
    if width is not None and np.ptp(few.geom.phi_i_deg) >= TURNED_DEG:
        bodies = [surface.alone(term) for term in surface.model.terms if term.model.is_body]
        lobes = 1 - sum((reading(each, few.instrument)[:, 0] for each in bodies), np.zeros(len(model))) / model
        for shape in _second_axis(few.geom, width):
            yield "second axis", shape * lobes


@lru_cache(maxsize=8)  # of one file they are those of the next
def _term(expression: str) -> tuple[Composite, dict]:
    """A law with its own values."""
    sum_of = models.get(expression)
    return sum_of, sum_of.defaults()


def _width(model: Composite, surface: Surface) -> float | None:
    """Beckmann's alpha of the widest of its lobes that has a width."""
    found = []
    for term in model.terms:
        values = surface.values_of(term)
        if "alpha" in values:
            found.append(float(np.mean(values["alpha"])))
        elif "slope" in values:
            found.append(2 * float(np.mean(values["slope"])))
        elif "exponent" in values and not term.model.is_body:
            found.append(float(np.sqrt(2 / (np.mean(values["exponent"]) + 2))))
    return max(found, default=None)


def _second_axis(geom: Geometry, width: float) -> tuple[np.ndarray, np.ndarray]:
    """What facets wider along one axis change in ln, t/(w² + t) times cosine and sine of twice the half vector's
    azimuth, t = tan² of its tilt."""
    light, view = np.radians(geom.phi_i_deg), np.radians(geom.phi_i_deg + geom.phi_deg)
    x = geom.sin_i * np.cos(light) + geom.sin_r * np.cos(view)
    y = geom.sin_i * np.sin(light) + geom.sin_r * np.sin(view)
    down = (geom.cos_i + geom.cos_r) ** 2 * width**2 + x * x + y * y
    return ((x * x - y * y) / down)[:, 0], (2 * x * y / down)[:, 0]
