"""Metal, dielectric, or "cannot tell from this", from a measurement. Never half a metal, and only from what is
decisive.

Rise toward grazing alone is not: a mirror image that emerges from a rough metal rises as steeply as Fresnel's factor of
a plastic. What decides is how much comes back near the normal (a bare metal reflects 45 % or more, no dielectric's
surface more than 25 %), a body that is the same in all directions, and whether lobe and body have one colour.
"""

from functools import cached_property

import numpy as np

from ..records import dataclass
from .measurement import Measurement, row_median

CANNOT_TELL = "cannot tell from this"
# of the metals known to us titanium and tungsten come nearest to it (Westin et al. 2004, Figure 1: above 0.5)
LEAST_METAL = 0.45
MOST_DIELECTRIC = 0.25  # rutile; diamond has 0.17
MOST_TRUSTED = 1.5  # a lobe that seems to return more is not round, not resolved, or on a relative scale
STEEP_DEG = 60.0  # what counts as grazing
LOW_DEG = 35.0  # what counts as near the normal
LOBE_DEG = 25.0  # from the mirror direction, within which the lobe lies
BODY_DEG = 35.0  # from the mirror direction, beyond which the body is seen
DECIMALS = 9  # of these angles, so that rounding decides of no direction


@dataclass(frozen=True)
class Verdict:
    """`kind` is metal, dielectric or CANNOT_TELL; `evidence` says why in sentences, `numbers` what was measured."""

    kind: str
    evidence: tuple[str, ...]
    numbers: tuple[tuple[str, float], ...] = ()

    @property
    def known(self) -> str | None:
        """The kind, None where it cannot be told."""
        return None if self.kind == CANNOT_TELL else self.kind


def verdict(measurement: Measurement) -> Verdict:
    """The verdict on one measurement. Raises nothing: too little data is a CANNOT_TELL."""
    observed = _Observed(measurement)
    if not observed.low:
        return Verdict(CANNOT_TELL, (f"no light from within {LOW_DEG:g}° of the normal",))
    metal, dielectric = _metal(observed), _dielectric(observed)
    numbers = tuple((name, value) for name, value in observed.numbers() if np.isfinite(value))
    if metal and not dielectric:
        return Verdict("metal", tuple(metal), numbers)
    if dielectric and not metal:
        return Verdict("dielectric", tuple(dielectric), numbers)
    return Verdict(CANNOT_TELL, tuple(metal + dielectric) or (_undecided(observed),), numbers)


def _undecided(observed: "_Observed") -> str:
    said = "neither the level near the normal, nor the body, nor the colours decide"
    if not np.isfinite(observed.rise) or observed.rise < 3:
        return said
    return (
        f"{said}; the peak rises {observed.rise:.3g} times toward grazing, which Fresnel's factor of a dielectric and "
        f"a mirror image emerging from a metal both do"
    )


def _metal(observed: "_Observed") -> list[str]:
    if LEAST_METAL <= observed.lobe_reflectance <= MOST_TRUSTED and not observed.body_is_constant:
        return [
            (
                f"the lobe returns {observed.lobe_reflectance:.2f} of the light near the normal; no dielectric's "
                f"surface returns more than {MOST_DIELECTRIC}"
            )
        ]
    return []


def _dielectric(observed: "_Observed") -> list[str]:
    if observed.lobe_reflectance > MOST_DIELECTRIC:
        return []
    found = []
    if observed.body_colour >= 1.5 and observed.lobe_colour - 1 <= min(0.15 * (observed.body_colour - 1), 0.35):
        found.append(
            f"the body is coloured ({observed.body_colour:.2g} between channels), the lobe toward grazing is not "
            f"({observed.lobe_colour:.2g}): its light is the surface's"
        )
    if observed.body_is_constant and observed.is_flat:
        found.append(
            f"a body of reflectance {np.pi * observed.body[0]:.2f}, the same in all directions near the normal and "
            f"from all sides: light from below the surface"
        )
    elif observed.body_is_constant and observed.whole_reflectance <= MOST_DIELECTRIC:
        found.append(
            f"a body that does not change with the light's angle, and only {observed.whole_reflectance:.2f} returned "
            f"in all; a bare metal returns {LEAST_METAL} or more"
        )
    return found


class _Observed:
    """What the verdict looks at, each number once."""

    def __init__(self, measurement: Measurement):
        values = np.where(measurement.usable, measurement.brdf, np.nan)
        geom = measurement.geom
        self.values, self.rows = values, measurement.incidences
        from_mirror = np.degrees(2 * np.arcsin(np.minimum(np.sqrt(geom.mirror_distance2[:, 0]) / 2, 1.0)))
        self.from_mirror = np.round(from_mirror, DECIMALS)
        self.theta_r = geom.theta_r_deg[:, 0]
        self.grey = row_median(values)
        self.low = [theta for theta in self.rows if theta <= LOW_DEG and self._count(theta) >= 5]

    def numbers(self):
        return (
            ("lobe_reflectance", self.lobe_reflectance),
            ("whole_reflectance", self.whole_reflectance),
            ("body_colour", self.body_colour),
            ("lobe_colour", self.lobe_colour),
            ("rise", self.rise),
            ("body_spread", max(self.body) / min(self.body) if self.body else np.nan),
        )

    def _count(self, theta) -> int:
        return int(np.isfinite(self.grey[self.rows[theta]]).sum())

    def _at(self, theta, where):
        rows = self.rows[theta]
        return rows[where(rows) & np.isfinite(self.grey[rows])]

    @cached_property
    def body(self) -> list[float]:
        """Median BRDF far from the mirror direction and from grazing, for each incidence angle that has enough."""
        out = []
        for theta in self.rows:
            rows = self._at(theta, lambda r: (self.from_mirror[r] > BODY_DEG) & (self.theta_r[r] < 65))
            if len(rows) >= 4:
                out.append(float(np.median(self.grey[rows])))
        return out

    @cached_property
    def body_is_constant(self) -> bool:
        """Whether the body is as bright from every incidence angle, and bright enough to be one."""
        angles = [theta for theta in self.rows if self._count(theta) >= 5]
        spans = bool(angles) and min(angles) <= LOW_DEG and max(angles) >= STEEP_DEG
        return (
            spans and len(self.body) >= 3 and max(self.body) <= 1.3 * min(self.body) and np.pi * min(self.body) >= 0.05
        )

    @cached_property
    def is_flat(self) -> bool:
        """Whether light from near the normal comes back alike in all directions."""
        rows = self._at(self.low[0], lambda r: (self.from_mirror[r] > 20) & (self.theta_r[r] < 65))
        if len(rows) < 8:
            return False
        tenth, most = np.percentile(self.grey[rows], [10, 90])
        peak = np.nanmax(self.grey[self.rows[self.low[0]]])
        return bool(most <= 1.35 * tenth and peak <= 3 * np.median(self.grey[rows]))

    @cached_property
    def lobe_reflectance(self) -> float:
        """Share of light from near the normal that the lobe sends on, as if round; NaN where it is not resolved."""
        found = [each for each in self._lobes.values() if np.isfinite(each)]
        return float(np.median(found)) if found else np.nan

    @cached_property
    def whole_reflectance(self) -> float:
        """Share that comes back at all."""
        found = []
        for theta, lobe in self._lobes.items():
            beyond = self._at(theta, lambda r: self.from_mirror[r] > LOBE_DEG)
            if len(beyond) and np.isfinite(lobe):
                found.append(lobe + np.pi * np.mean(self.grey[beyond]))
        return float(np.median(found)) if found else np.nan

    @cached_property
    def _lobes(self) -> dict[float, float]:
        """The integral over the lobe of each low incidence."""
        return {theta: self._integral(theta, LOBE_DEG) for theta in self.low}

    def _integral(self, theta: float, radius: float) -> float:
        """∫ (f - least f) cos θr dω around the mirror direction from the mean profile f(d); NaN where it is too coarse
        for its peak."""
        rows = self._at(theta, lambda r: self.from_mirror[r] <= radius + 10)
        place, which = np.unique(np.round(self.from_mirror[rows], 1), return_inverse=True)
        if np.count_nonzero(place <= radius) < 3 or place[0] > 3:
            return np.nan
        profile = np.exp(np.bincount(which.ravel(), np.log(self.grey[rows])) / np.bincount(which.ravel()))
        inside = place <= radius
        d, f = place[inside], profile[inside]
        if np.any((np.diff(d) > 1.5) & (f[:-1] > 6 * f[1:])):
            return np.nan
        fine = np.linspace(0.0, np.radians(d[-1]), 2000)
        lobe = np.exp(np.interp(fine, np.radians(d), np.log(np.maximum(f - profile.min(), 1e-12))))
        return float(np.sum(lobe * 2 * np.pi * np.sin(fine)) * fine[1] * np.cos(np.radians(theta)))

    @cached_property
    def rise(self) -> float:
        """The greatest value within 5° of the mirror direction at the steepest incidence up to 80°, over that at the
        lowest; NaN without both."""
        peaks = [
            (theta, self._at(theta, lambda r: self.from_mirror[r] <= 5)) for theta in sorted(self.rows) if theta <= 80
        ]
        peaks = [(theta, float(np.max(self.grey[rows]))) for theta, rows in peaks if len(rows)]
        if len(peaks) < 2 or peaks[0][0] > LOW_DEG or peaks[-1][0] < STEEP_DEG:
            return np.nan
        return peaks[-1][1] / peaks[0][1]

    @cached_property
    def body_colour(self) -> float:
        """Largest over smallest channel of the body near the normal; 1 for one channel."""
        rows = np.concatenate(
            [self._at(theta, lambda r: (self.from_mirror[r] > BODY_DEG) & (self.theta_r[r] < 65)) for theta in self.low]
        )
        return _span(_channel_medians(self.values[rows])) if len(rows) >= 4 else 1.0

    @cached_property
    def lobe_colour(self) -> float:
        """The same of the lobe at the steepest incidence where it is ten times the body; infinite if there is none."""
        if self.values.shape[1] < 3:
            return np.inf
        for theta in sorted(self.rows, reverse=True):
            if theta < 50 or theta > 76:
                continue
            near = self._at(theta, lambda r: self.from_mirror[r] <= 8)
            far = self._at(theta, lambda r: (self.from_mirror[r] > BODY_DEG) & (self.theta_r[r] < 65))
            if len(near) and len(far) and np.max(self.grey[near]) > 10 * np.median(self.grey[far]):
                best = near[np.argsort(self.grey[near])[-3:]]
                return _span(_channel_medians(self.values[best]) - _channel_medians(self.values[far]))
        return np.inf


def _channel_medians(values: np.ndarray) -> np.ndarray:
    """Median over the rows that have a value; NaN where none has."""
    return row_median(values.T)


def _span(channels: np.ndarray) -> float:
    """Between the third largest and third smallest of many channels, so that noise at the ends does not count; largest
    and smallest of few."""
    known = np.sort(channels[np.isfinite(channels) & (channels > 0)])
    if len(known) < 2:
        return 1.0
    trim = 2 if len(known) >= 10 else 0
    return float(known[-1 - trim] / known[trim])
