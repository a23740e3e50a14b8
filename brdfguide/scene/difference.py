"""How different a scene looks when parts of a model are left out, and what the remaining parts do to make up for it.

The parts are integrated over the pixels once each; ablations are sums of them. What remains is refitted before it is
judged: first its amplitudes, on the sums; where that nearly suffices, its shapes as well.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property

import numpy as np

from ..models.surface import Surface
from ..numerics import least_squares
from ..physics import display
from ..physics.display import colour_weights
from ..physics.geometry import in_plane
from ..records import dataclass
from .features import MIRROR, Ablation, Features
from .radiance import Quadrature

REFIT_PIXELS = 600  # enough for the few amplitudes that a refit moves
REPRODUCED = 1.5  # times the error of the first sample: how much worse a fresh sample may be
UNSEEN = 0.05  # JND, that a difference has to exceed to be of any interest
TURNS_DEG = tuple(range(0, 180, 15))  # under which a lobe with a grain is looked at
DARK = 1e-12  # of a perfect white: below this a reference pixel says nothing


@dataclass(frozen=True)
class Errors:
    """Difference of two pictures in just noticeable differences (ΔE_ITP in colour)."""

    mean: float
    p95: float
    worst: float  # of all pixels sampled
    visible: float  # of differences that fill at least one pixel of the picture
    codes: float  # difference in code values of the display where the worst is visible
    at_deg: tuple[float, float, float]  # theta_i, theta_r, phi where the worst is

    def within(self, tolerance, factor: float = 1.0) -> bool:
        return self.visible <= factor * tolerance.worst + 1e-9 and self.p95 <= factor * tolerance.p95 + 1e-9

    def reproduces(self, fresh: "Errors") -> bool:
        """Whether another sample of the same picture is no more than 1.5 times worse, or nothing that could be seen."""
        return all(
            new <= max(REPRODUCED * old, UNSEEN) for old, new in ((self.visible, fresh.visible), (self.p95, fresh.p95))
        )

    def or_worse(self, other: "Errors") -> "Errors":
        """Of two samples of one picture the one that differs more; no percentile below that of either."""
        worse = max(self, other, key=lambda each: each.visible)
        return replace(
            worse, mean=max(self.mean, other.mean), p95=max(self.p95, other.p95), worst=max(self.worst, other.worst)
        )


@dataclass(frozen=True, eq=False)
class Picture:
    """A model seen through a scene."""

    features: Features
    quadrature: Quadrature
    cache: dict = field(default_factory=dict, repr=False)

    @cached_property
    def colours(self) -> np.ndarray:
        return colour_weights(self.features.surface.wavelengths, self.channels, self.quadrature.scene.colour)

    @property
    def tolerance(self):
        return self.quadrature.scene.tolerance

    @property
    def channels(self) -> int:
        return len(self.features.surface.channels)

    def layer(self, term, variant) -> tuple[np.ndarray, np.ndarray]:
        """Radiance (pixels, channels) of one term in one variant: what follows its amplitude, and what does not."""
        key = term.label, variant
        if key not in self.cache:
            model, values = self.features.model(term, variant), self.features.surface.values_of(term)
            finite = self._finite(term, variant - {MIRROR})
            image = np.zeros_like(finite)
            if model.mirror is not None:
                image = self._mirrored(lambda geom: model.mirror(geom, **values))
            self.cache[key] = (finite + image, np.zeros_like(image)) if _follows(model, values) else (finite, image)
        return self.cache[key]

    def _finite(self, term, variant) -> np.ndarray:
        """Radiance (pixels, channels) of a term's law, without its mirror part."""
        key = term.label, variant, "finite"
        if key not in self.cache:
            model, values = self.features.model(term, variant), self.features.surface.values_of(term)
            self.cache[key] = self._lit(lambda geom: model(geom, **values))
        return self.cache[key]

    def _lit(self, brdf) -> np.ndarray:
        """Radiance (pixels, channels) of a finite law at the wavelengths of the channels."""
        radiance = self.quadrature.radiance(lambda geom: brdf(geom.at(self.features.surface.wavelengths)))
        return np.broadcast_to(radiance, (len(self.quadrature), self.channels))

    def _mirrored(self, mirror) -> np.ndarray:
        """The same of an ideal specular part."""
        radiance = self.quadrature.mirror_radiance(
            lambda geom: mirror(geom.at(self.features.surface.wavelengths).where_lit())
        )
        return np.broadcast_to(radiance, (len(self.quadrature), self.channels))

    @cached_property
    def reference(self) -> np.ndarray:
        """Radiance (pixels, channels) with nothing left out."""
        layers = [self.layer(term, frozenset()) for term in self.features.terms]
        return np.sum([follows + still for follows, still in layers], axis=0)

    @cached_property
    def weights(self) -> np.ndarray:
        """Share of each pixel, 0 where the reference is black."""
        bright = np.where(self.reference.max(axis=1) > DARK, self.quadrature.weights, 0.0)
        return bright / max(bright.sum(), 1e-300)

    # --- amplitudes ---------------------------------------------------------------------------------

    def refitted(self, ablation: Ablation) -> dict[str, np.ndarray]:
        """By label, factors (channels,) on the amplitudes that remain, of the least square of JND over the picture."""
        layers = [
            self.layer(term, ablation.variant(term.label)) for term in self.features.terms if ablation.keeps(term.label)
        ]
        fixed = sum(still for _, still in layers)
        moving, scaled, highest = [], [], []
        for term, (follows, _) in zip(self.features.pruned(ablation).terms, layers, strict=True):
            amplitude = term.model.amplitude
            value = None if amplitude is None else self.features.surface.values_of(term).get(amplitude)
            if amplitude is None or value is None or not np.any(value) or not follows.any():
                fixed = fixed + follows
                continue
            moving.append(term.label)
            scaled.append(follows)
            top = term.model.parameter(amplitude).high
            highest.append(np.broadcast_to(top / np.where(np.asarray(value) > 0, value, top), (self.channels,)))
        if not moving or not ablation.out:
            return {}
        factors = self._least(np.stack(scaled, axis=2), fixed, np.stack(highest, axis=1))
        return {label: factors[:, place] for place, label in enumerate(moving)}

    def _least(self, scaled, fixed, highest) -> np.ndarray:
        """Factors (channels, terms) on `scaled` (pixels, channels, terms) that come nearest to the reference."""
        screen = self.quadrature.scene.display
        some = slice(None, None, -(-len(self.quadrature) // REFIT_PIXELS))  # sampled in no order
        scaled, fixed = scaled[some], np.broadcast_to(fixed, self.reference.shape)[some]
        root, wanted = np.sqrt(self.weights[some])[:, None], screen.logarithm(self.reference[some])

        def residuals(_, factors, slopes):
            radiance = fixed + np.einsum("sct,ct->sc", scaled, factors)
            r = (screen.logarithm(radiance) - wanted) * root
            if not slopes:
                return r
            shown = screen.shown(radiance)
            rate = np.where(shown < screen.white, screen.exposure / ((shown + screen.floor) * screen.jnd), 0.0) * root
            return (
                r,
                np.zeros((r.shape[1], r.shape[0], 0)),
                np.ascontiguousarray(np.moveaxis(scaled * rate[:, :, None], 0, 1)),
            )

        return least_squares.minimise(
            residuals,
            np.zeros(0),
            np.ones(highest.shape),
            per_channel_low=0.0,
            per_channel_high=np.maximum(highest, 1.0),
            most=20,
            tolerance=1e-5,
        ).per_channel

    def surface(self, ablation: Ablation, factors: Mapping) -> Surface:
        """What `ablation` leaves, with its amplitudes multiplied."""
        model, values = self.features.pruned(ablation), {}
        for term in model.terms:
            for name, value in self.features.surface.values_of(term).items():
                if name == term.model.amplitude and term.label in factors:
                    value = np.asarray(value) * factors[term.label]
                    value = float(value[0]) if value.size == 1 else value
                values[term.key(name)] = value
        return replace(self.features.surface, model=model, values=values)

    # --- differences --------------------------------------------------------------------------------

    def ablation_errors(self, ablation: Ablation, factors: Mapping) -> Errors:
        """The difference that an ablation makes, its amplitudes multiplied by `factors`."""
        total = np.zeros_like(self.reference)
        for term in self.features.terms:
            if ablation.keeps(term.label):
                follows, still = self.layer(term, ablation.variant(term.label))
                total = total + follows * factors.get(term.label, 1.0) + still
        return self.errors(total)

    def radiance(self, surface: Surface) -> np.ndarray:
        """Radiance (pixels, channels) of any surface, evaluated as a whole."""
        radiance = self.quadrature.radiance(surface.brdf)
        return radiance + self.quadrature.mirror_radiance(surface.mirror) if surface.model.has_mirror else radiance

    @cached_property
    def shown_reference(self) -> np.ndarray:
        """The reference in the coordinates that differences are taken in, colours mixed."""
        return self.quadrature.scene.display.perceived(self.reference @ self.colours)

    def differences(self, radiance) -> np.ndarray:
        """JND (pixels,) from the reference, 0 where that is black."""
        perceived = self.quadrature.scene.display.perceived(radiance @ self.colours)
        return np.where(self.weights > 0, display.distance(self.shown_reference, perceived), 0.0)

    def errors(self, radiance) -> Errors:
        """The difference of a radiance (pixels, channels) from the reference."""
        q, j = self.quadrature, self.differences(radiance)
        order = np.argsort(j)
        below = np.cumsum(self.weights[order])  # share of the picture that differs by no more

        def pick(share):
            return int(order[min(np.searchsorted(below, share - 1e-12), len(j) - 1)])

        visible = pick(1 - 1 / q.scene.pixels)
        codes = q.scene.display.codes(self.reference[visible] @ self.colours, radiance[visible] @ self.colours)
        return Errors(
            float(self.weights @ j),
            float(j[pick(0.95)]),
            float(j.max()),
            float(j[visible]),
            float(codes),
            q.angles_deg(visible),
        )


def _follows(model, values) -> bool:
    """Whether the mirror part of a law is proportional to its amplitude, so that one factor serves both."""
    if model.mirror is None or model.amplitude is None or not np.any(values[model.amplitude]):
        return model.mirror is None
    geom = in_plane([[70.0]], [[70.0]])
    doubled = model.mirror(geom, **{**values, model.amplitude: 2 * np.asarray(values[model.amplitude])})
    return bool(np.allclose(doubled, 2 * model.mirror(geom, **values), rtol=1e-9))


def lobe_width(surface: Surface) -> float:
    """Half width at half height [rad] of the narrowest lobe about the mirror direction at 30°; at most 0.5. With a
    grain the least under several turns."""
    away = np.degrees(np.geomspace(1e-3, 0.5, 120))
    geom, widths = in_plane(30.0, 30.0 + np.concatenate([[0.0], away])[:, None]), []
    for turn in TURNS_DEG if surface.model.turns else TURNS_DEG[:1]:
        f = surface.brdf(geom.at_azimuth(turn)).mean(axis=1)
        narrow = np.flatnonzero(f - f[-1] < 0.5 * (f[0] - f[-1]))
        shows = f[0] > 1.2 * f[-1] and narrow.size
        widths.append(float(np.radians(away[max(narrow[0] - 1, 0)])) if shows else 0.5)
    return min(widths)
