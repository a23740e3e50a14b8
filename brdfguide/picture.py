"""How different a scene looks when parts of a model are left out, and what the remaining parts do to make up for it.

The parts are integrated over the pixels once each; cuts are sums of them. What remains is refitted before it is judged:
first its amplitudes, on the sums; where that nearly suffices, its shapes as well.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from . import display, levenberg
from .display import colour_weights
from .geometry import in_plane
from .models._base import Sum
from .parts import MIRROR, Cut, Parts
from .quadrature import Quadrature

REFIT_PIXELS = 600  # enough for the few amplitudes that a refit moves
FORETOLD = 1.5  # times what was foretold: how much worse a fresh draw may be
UNSEEN = 0.05  # JND, that a difference has to exceed to be of any interest
DARK = 1e-12  # of a perfect white: below this a reference pixel says nothing


@dataclass(frozen=True)
class Errors:
    """Difference of two pictures in just noticeable differences (ΔE_ITP in colour)."""

    mean: float
    p95: float
    worst: float  # of all pixels drawn
    visible: float  # of differences that fill at least one pixel of the picture
    codes: float  # difference in code values of the display where the worst is visible
    at_deg: tuple[float, float, float]  # theta_i, theta_r, phi where the worst is

    def within(self, tolerance, factor: float = 1.0) -> bool:
        return self.visible <= factor * tolerance.worst + 1e-9 and self.p95 <= factor * tolerance.p95 + 1e-9

    def foretells(self, fresh: "Errors") -> bool:
        """Whether another draw of the same picture is no more than 1.5 times worse, or nothing that could be seen."""
        return all(new <= max(FORETOLD * old, UNSEEN) for old, new in ((self.visible, fresh.visible), (self.p95, fresh.p95)))

    def or_worse(self, other: "Errors") -> "Errors":
        """Of two draws of one picture the one that differs more; no percentile below that of either."""
        worse = max(self, other, key=lambda each: each.visible)
        return replace(worse, mean=max(self.mean, other.mean), p95=max(self.p95, other.p95), worst=max(self.worst, other.worst))


@dataclass(frozen=True, eq=False)
class Picture:
    """A model seen through a scene."""

    parts: Parts
    quadrature: Quadrature
    cache: dict = field(default_factory=dict, repr=False)

    @cached_property
    def colours(self) -> np.ndarray:
        return colour_weights(self.parts.wavelength, self.channels, self.quadrature.scene.colour)

    @property
    def tolerance(self):
        return self.quadrature.scene.tolerance

    @property
    def channels(self) -> int:
        return len(self.parts.wavelength)

    def layer(self, term, way) -> tuple[np.ndarray, np.ndarray]:
        """Radiance (pixels, channels) of one term kept one way: what follows its amplitude, and what does not."""
        key = term.label, way
        if key not in self.cache:
            model, values = self.parts.model(term, way), self.parts.of(term)
            finite = self._finite(term, way - {MIRROR})
            image = np.zeros_like(finite)
            if model.mirror is not None:
                image = self._over_channels(self.quadrature.mirror_radiance(lambda geom: model.mirror(geom.where_lit(), **values)))
            self.cache[key] = (finite + image, np.zeros_like(image)) if _follows(model, values) else (finite, image)
        return self.cache[key]

    def _finite(self, term, way) -> np.ndarray:
        """Radiance (pixels, channels) of a term's law, without its mirror part."""
        key = term.label, way, "finite"
        if key not in self.cache:
            model, values = self.parts.model(term, way), self.parts.of(term)
            self.cache[key] = self._over_channels(self.quadrature.radiance(lambda geom: model(geom, **values)))
        return self.cache[key]

    def _over_channels(self, radiance) -> np.ndarray:
        return np.broadcast_to(radiance, (len(self.quadrature), self.channels))

    @cached_property
    def reference(self) -> np.ndarray:
        """Radiance (pixels, channels) with nothing left out."""
        return sum(map(sum, (self.layer(term, frozenset()) for term in self.parts.sum.terms)))

    @cached_property
    def weights(self) -> np.ndarray:
        """Share of each pixel, 0 where the reference is black."""
        bright = np.where(self.reference.max(axis=1) > DARK, self.quadrature.weights, 0.0)
        return bright / max(bright.sum(), 1e-300)

    # --- amplitudes ---------------------------------------------------------------------------------

    def refitted(self, cut: Cut) -> dict[str, np.ndarray]:
        """By label, the factors (channels,) on the amplitudes that remain, for the least square of JND over the picture."""
        layers = [self.layer(term, cut.way(term.label)) for term in self.parts.sum.terms if cut.keeps(term.label)]
        fixed = sum(still for _, still in layers)
        moving, scaled, highest = [], [], []
        for term, (follows, still) in zip(self.parts.pruned(cut).terms, layers):
            value = self.parts.of(term).get(term.model.amplitude)
            if value is None or not np.any(value) or not follows.any():
                fixed = fixed + follows
                continue
            moving.append(term.label)
            scaled.append(follows)
            top = term.model.parameter(term.model.amplitude).high
            highest.append(np.broadcast_to(top / np.where(np.asarray(value) > 0, value, top), (self.channels,)))
        if not moving or not cut.out:
            return {}
        own = self._least(np.stack(scaled, axis=2), fixed, np.stack(highest, axis=1))
        return {label: own[:, place] for place, label in enumerate(moving)}

    def _least(self, scaled, fixed, highest) -> np.ndarray:
        """Factors (channels, terms) on `scaled` (pixels, channels, terms) that come nearest to the reference."""
        screen = self.quadrature.scene.display
        some = slice(None, None, -(-len(self.quadrature) // REFIT_PIXELS))  # drawn in no order
        scaled, fixed = scaled[some], np.broadcast_to(fixed, self.reference.shape)[some]
        root, wanted = np.sqrt(self.weights[some])[:, None], screen.logarithm(self.reference[some])

        def residuals(_, factors, slopes):
            radiance = fixed + np.einsum("sct,ct->sc", scaled, factors)
            r = (screen.logarithm(radiance) - wanted) * root
            if not slopes:
                return r
            shown = screen.shown(radiance)
            rate = np.where(shown < screen.white, screen.exposure / ((shown + screen.floor) * screen.jnd), 0.0) * root
            return r, np.zeros((r.shape[1], r.shape[0], 0)), np.ascontiguousarray(np.moveaxis(scaled * rate[:, :, None], 0, 1))

        return levenberg.minimise(residuals, np.zeros(0), np.ones(highest.shape), own_low=0.0, own_high=np.maximum(highest, 1.0), most=20, tolerance=1e-5).own

    def values(self, cut: Cut, factors: Mapping) -> dict:
        """The values of the sum that `cut` leaves, with its amplitudes multiplied."""
        values = {}
        for term in self.parts.pruned(cut).terms:
            for name, value in self.parts.of(term).items():
                if name == term.model.amplitude and term.label in factors:
                    value = np.asarray(value) * factors[term.label]
                    value = float(value[0]) if value.size == 1 else value
                values[f"{term.label}.{name}"] = value
        return values

    # --- differences --------------------------------------------------------------------------------

    def cut_errors(self, cut: Cut, factors: Mapping) -> Errors:
        """The difference that a cut makes, its amplitudes multiplied by `factors`."""
        total = np.zeros_like(self.reference)
        for term in self.parts.sum.terms:
            if cut.keeps(term.label):
                follows, still = self.layer(term, cut.way(term.label))
                total = total + follows * factors.get(term.label, 1.0) + still
        return self.errors(total)

    def radiance(self, sum_: Sum, values: Mapping) -> np.ndarray:
        """Radiance (pixels, channels) of any sum, evaluated as a whole."""
        radiance = self.quadrature.radiance(lambda geom: sum_(geom, values))
        if sum_.has_mirror:
            radiance = radiance + self.quadrature.mirror_radiance(lambda geom: sum_.mirror(geom.where_lit(), values))
        return self._over_channels(radiance)

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
        pick = lambda share: int(order[min(np.searchsorted(below, share - 1e-12), len(j) - 1)])  # noqa: E731
        visible = pick(1 - 1 / q.scene.pixels)
        codes = q.scene.display.codes(self.reference[visible] @ self.colours, radiance[visible] @ self.colours)
        return Errors(float(self.weights @ j), float(j[pick(0.95)]), float(j.max()), float(j[visible]), float(codes), q.angles_deg(visible))


def _follows(model, values) -> bool:
    """Whether the mirror part of a law is proportional to its amplitude, so that one factor serves both."""
    if model.mirror is None or model.amplitude is None or not np.any(values[model.amplitude]):
        return model.mirror is None
    geom = in_plane([[70.0]], [[70.0]])
    doubled = model.mirror(geom, **{**values, model.amplitude: 2 * np.asarray(values[model.amplitude])})
    return bool(np.allclose(doubled, 2 * model.mirror(geom, **values), rtol=1e-9))


def lobe_width(sum_: Sum, values: Mapping, wavelength) -> float:
    """Half width at half height [rad] of the narrowest lobe about the mirror direction, at 30° of incidence; at most 0.5."""
    away = np.degrees(np.geomspace(1e-3, 0.5, 120))
    geom = in_plane(30.0, 30.0 + np.concatenate([[0.0], away])[:, None], wavelength)
    f = np.broadcast_to(sum_(geom, values), (len(away) + 1, max(1, np.size(wavelength)))).mean(axis=1)
    narrow = np.flatnonzero(f - f[-1] < 0.5 * (f[0] - f[-1]))
    return float(np.radians(away[max(narrow[0] - 1, 0)])) if f[0] > 1.2 * f[-1] and narrow.size else 0.5
