"""Gaussian (Beckmann) facets with a grain: two widths, Smith masking in each azimuth, and Fresnel.

    f = F D/(4 cos θi cos θr (1 + Λi + Λr)),   D = (1 + t)² exp(-e)/(π αx αy),   t = |s|², s = (v_x, v_y)/v_z
    e = (s_x/αx)² + (s_y/αy)²,   Λ as of `beckmann` at alpha tan θ = √(αx² w_x² + αy² w_y²)/w_z

x is along `axis`, across the grain, where slopes are steepest; v = i + r. The geometrical limit of `stam` and of
Kajiya's integral, alpha = 2 sigma/tau along each axis: a brushed or rolled sheet much rougher than the wavelength. What
it loses to light that meets two facets depends on the azimuth. With both widths alike it is `beckmann`.

Source: Beckmann and Spizzichino 1963; Smith 1967; Heitz 2014 for two widths and correlated heights.
"""

from math import pi

import numpy as np

from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ._grain import (
    BY_WIDTHS,
    MEAN_AND_RATIO,
    TURNS,
    WIDTHS,
    ln_gaussian_slopes,
    widths_of,
    without_grain,
)
from ._microfacet import INDEX, gradient_by, reduced
from .facts import Candidacy
from .model import Extreme, Model, Pin, at


def brdf(geom: Geometry, *, alpha_x, alpha_y, axis, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * grain.grained_gaussian_shape(geom, alpha_x, alpha_y, axis)


def gradient(geom: Geometry, names, *, alpha_x, alpha_y, axis, n, k, scale) -> dict[str, np.ndarray]:
    """Of the Gaussian of slopes and of the masking under it; df/dn, df/dk and df/dscale."""
    of_slopes = ln_gaussian_slopes(geom, alpha_x, alpha_y, axis)
    of_masking = grain.ln_gaussian_masking_slopes(geom, alpha_x, alpha_y, axis)
    by = {name: of_slopes[name] - of_masking[name] for name in of_slopes}
    shape = grain.grained_gaussian_shape(geom, alpha_x, alpha_y, axis)
    return gradient_by(geom, names, shape, by, n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(*WIDTHS, *INDEX),
    gradient=gradient,
    without={**reduced(grain.grained_gaussian_shape, grain.grained_gaussian), **without_grain(brdf)},
    derived=MEAN_AND_RATIO,
    summary="Gaussian facets with a grain, Smith masking, Fresnel: brushed sheet of one roughness scale",
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"alpha_x": 0.3, "alpha_y": 0.06, "axis": 0.4, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.30431264624129455,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha_x": 0.5, "alpha_y": 0.1, "axis": 1.1, "n": 0.958, "k": 6.69},
            f=2.79058141685975528,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha_x": 1e-4, "alpha_y": 1e-4}),
        Extreme("longest streak, across it", at(60, -60), {"alpha_x": 1e-4, "alpha_y": 1.5, "axis": 0.5 * pi}),
        Extreme("at the normal, where no azimuth is steeper", at(0, 0), {"alpha_x": 1.5}),
    ),
    breaks=TURNS,
    source="Beckmann and Spizzichino 1963; Smith 1967; Heitz 2014",
    family="facets",
    cannot="shows no mirror image, and no faint glow far around the highlight",
    from_facets=lambda facets: {**widths_of(facets), "n": facets.n, "k": facets.k},
    candidacy=Candidacy(85, grained=True),
    grain=BY_WIDTHS,
)
