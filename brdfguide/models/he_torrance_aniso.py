"""He and Torrance's wave-optical lobe with two correlation lengths. Ours: no paper has it.

    f = F(θd) (S_i/cos θi)(S_r/cos θr)(|i + r|²/v_z)² (π τx τy/4λ²) Σ_m g^m e^-g/(m! m) e^(-y/m)
    y = (π/λ)² (τx² v_x² + τy² v_y²),   v = i + r in the frame of `axis`
    S and the effective roughness as in `he-torrance`, of light and view each at the slope of its own azimuth,
    slope_w = sigma √(cos²φw/τx² + sin²φw/τy²);   mirror reflectance = F(θi) e^-g S²

`axis` is the azimuth across the grain, where slopes are steepest: τx = sigma/slope, τy = ratio τx. With ratio 1 it is
`he-torrance`, without shadows and at constant F it is `stam`, far above the wavelength it is masked facets of
alpha = 2 slope and 2 slope/ratio. Brushed metal whose mirror image emerges; one height has one mirror in all azimuths.

Source: ours, after He, Torrance, Sillion and Greenberg 1991 and Stam 1999, joined so that both are its limits.
"""

from math import pi

import numpy as np

from ..physics import fresnel as optics
from ..physics.geometry import Geometry
from ._grain import AXIS, BY_RATIO, LENGTH_ACROSS, RATIO, SLOPE_ACROSS
from ._microfacet import INDEX
from ._series_patches import ln_series
from ._shadows import height_factor, kept_fresnel, ln_g_by_ln_slope, shadow_free, shadowing
from .facts import Candidacy
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, sigma, slope, ratio, axis, n, k, scale) -> np.ndarray:
    """Lobe [1/sr], without the mirror part, in the shape of `geom` and its wavelength."""
    factor, g, y = _parts(geom, sigma, slope, ratio, axis)
    return scale * kept_fresnel(geom, n, k) * factor * np.exp(ln_series(g, y))


def mirror(geom: Geometry, *, sigma, slope, ratio, axis, n, k, scale) -> np.ndarray:
    """Reflectance left to the mirror direction at θi, dimensionless."""
    shadow, spread = shadowing(geom.cos_i, geom.sin_i, _slope_at(geom.phi_i_deg, slope, ratio, axis))
    g = (4 * pi * sigma / geom.wavelength) ** 2 * (geom.cos_i * shadow_free(2 * spread)) ** 2
    return scale * optics.fresnel(geom.cos_i, n, k) * np.exp(-g) * (shadow * geom.cos_i) ** 2


def _slope_at(phi_deg, slope, ratio, axis):
    """sigma over the correlation length in the azimuth of a direction; to every digit `slope` where ratio is 1."""
    return slope * np.sqrt(1 - (1 - 1 / (ratio * ratio)) * np.sin(np.radians(phi_deg) - axis) ** 2)


def _parts(geom: Geometry, sigma, slope, ratio, axis):
    """What multiplies the sum beside Fresnel's factor, and its arguments g and y."""
    shadow_i, spread_i = shadowing(geom.cos_i, geom.sin_i, _slope_at(geom.phi_i_deg, slope, ratio, axis))
    shadow_r, spread_r = shadowing(geom.cos_r, geom.sin_r, _slope_at(geom.phi_r_deg, slope, ratio, axis))
    g = _g(geom, sigma, spread_i + spread_r)
    along, across = geom.offset_from(axis)
    y = _y(geom, sigma, slope, ratio, across)
    return _before(geom, sigma, slope, ratio, shadow_i * shadow_r), g, y


def _g(geom: Geometry, sigma, spread):
    return (2 * pi * sigma / geom.wavelength) ** 2 * (geom.v_z * shadow_free(spread)) ** 2


def _y(geom: Geometry, sigma, slope, ratio, across):
    """By the excess of the longer length, so that ratio 1 leaves no trace of the axis."""
    return (pi * sigma / slope / geom.wavelength) ** 2 * (geom.vxy2 + (ratio * ratio - 1) * across * across)


def _before(geom: Geometry, sigma, slope, ratio, shadow):
    return (pi / 4) * ratio * (sigma / slope / geom.wavelength) ** 2 * shadow * height_factor(geom)


def gradient(geom: Geometry, names, *, sigma, slope, ratio, axis, n, k, scale) -> dict[str, np.ndarray]:
    """Through g, y and the slopes of both azimuths: d ln slope_w by ln slope is 1, by ln ratio -q/ratio², by the axis
    (1 - 1/ratio²) cos φ sin φ/p, with p = cos²φ + sin²φ/ratio², q = sin²φ/p."""
    along, across = geom.offset_from(axis)
    both = [_ShadowSlopes(geom, side, slope, ratio, axis) for side in ("i", "r")]
    spread = both[0].spread + both[1].spread
    g, y = _g(geom, sigma, spread), _y(geom, sigma, slope, ratio, across)
    ln_s, by_ln_g, by_y = ln_series(g, y, derivatives=True)
    bare = _before(geom, sigma, slope, ratio, both[0].shadow * both[1].shadow) * np.exp(ln_s)
    f, *by_index = (
        optics.fresnel_with_slopes(geom.cos_d, n, k) if "n" in names or "k" in names else (kept_fresnel(geom, n, k),)
    )
    lobe, by_tau = bare * f, 2 + 2 * y * by_y
    squared = 2 * (pi * sigma / slope / geom.wavelength) ** 2

    def through(name: str):
        """d ln f by what changes the slopes of both azimuths."""
        in_shadow = sum(each.ln_shadow * each.ln_slope[name] for each in both)
        in_spread = sum(each.spread_slope * each.ln_slope[name] for each in both)
        return in_shadow + by_ln_g * ln_g_by_ln_slope(spread, in_spread)

    by_ratio = by_y * squared * ratio * across * across
    by_axis = -by_y * squared * (ratio * ratio - 1) * along * across
    return {
        "scale": lobe,
        "sigma": lobe * (by_tau + 2 * by_ln_g) * (scale / sigma),
        "slope": lobe * (through("slope") - by_tau) * (scale / slope),
        "ratio": lobe * scale * ((through("ratio") + 1) / ratio + by_ratio),
        "axis": lobe * scale * (through("axis") + by_axis),
        **{name: by * bare * scale for name, by in zip("nk", by_index, strict=False)},
    }


class _ShadowSlopes:
    """Shadow and spread of one direction, and d ln S and dK by ln of its slope, and ln of that by each parameter."""

    def __init__(self, geom: Geometry, side: str, slope, ratio, axis):
        turn = np.radians(getattr(geom, f"phi_{side}_deg")) - axis
        less = 1 - 1 / (ratio * ratio)
        sin, cos = np.sin(turn), np.cos(turn)
        share = 1 - less * sin * sin
        own = slope * np.sqrt(share)
        found = shadowing(getattr(geom, f"cos_{side}"), getattr(geom, f"sin_{side}"), own, True)
        self.shadow, self.spread, self.ln_shadow, self.spread_slope = found
        self.ln_slope = {
            "slope": 1.0,
            "ratio": -sin * sin / (share * ratio * ratio),
            "axis": less * sin * cos / share,
        }


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("sigma", 0.3, 1e-3, 50.0, "um", log=True, meaning="rms height", starts=(0.05, 0.2, 0.8)),
        SLOPE_ACROSS,
        RATIO,
        AXIS,
        *INDEX,
    ),
    gradient=gradient,
    mirror=mirror,
    derived=(LENGTH_ACROSS,),
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"sigma": 0.28, "slope": 0.16, "ratio": 3.0, "axis": 0.4, "n": 1.7},
            f=0.342250152878053478,
            source="the formulas above at 50 digits",
        ),
        Pin(
            at(75, 60, 0.45),
            {"sigma": 0.05, "slope": 0.1, "ratio": 6.0, "axis": 1.1, "n": 0.958, "k": 6.69},
            f=0.222656078725309735,
            source="the same, smooth and toward grazing",
            rtol=1e-11,
        ),
    ),
    extremes=(
        Extreme("0.01° from grazing", at(89.99, 89.99), {"sigma": 1.0, "ratio": 10.0}),
        Extreme("both at the normal", at(0, 0), {}),
        Extreme("steepest, roughest, longest grain", at(89.99, -89.99), {"sigma": 50.0, "slope": 1.0, "ratio": 100.0}),
        Extreme("far off the narrowest lobe", at(10, -80), {"sigma": 0.001, "slope": 0.001, "ratio": 100.0}),
    ),
    breaks={"rotation": "it has a grain, unless ratio is 1"},
    summary="wave optics of brushed surfaces: shadows, Fresnel and the emerging mirror, two lengths; ours, unpublished",
    source="ours, after He et al. 1991 and Stam 1999",
    family="wave optics",
    cannot="one surface without a coat, bumps of the common (Gaussian) kind; slow to evaluate; no paper has it",
    beyond_facets=lambda **_: "wave effects, the lobe's change of shape with angle and wavelength, become one shape",
    candidacy=Candidacy(105, grained=True),
    grain=BY_RATIO,
)
