"""GGX facets with a grain: two widths, and the azimuth across the grain.

    f = F (1 + t)²/((1 + e)² 2π αx αy (cos θr R_i + cos θi R_r)),   t = |s|², s = (v_x, v_y)/v_z, v = i + r
    e = (s_x/αx)² + (s_y/αy)²,   R_w = √(αx² w_x² + αy² w_y² + w_z²)

x is along `axis`, across the grain, where slopes are steepest: a highlight on a flat sample is a streak along it. With
both widths alike it is `ggx`. Brushed and rolled metals, grained wood, satin. Of one scan in a plane of incidence only
the width in that plane is known, and the product of both from the height if F is; the axis is held unless it is freed.

Source: Trowbridge and Reitz 1975; Burley 2012 for two widths; Heitz 2014 for the masking.
"""

from math import pi

import numpy as np

from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ._grain import BY_WIDTHS, MEAN_AND_RATIO, TURNS, WIDTHS, widths_of, without_grain
from ._microfacet import INDEX, gradient_by
from .facts import Candidacy
from .model import Extreme, Model, Pin, at


def brdf(geom: Geometry, *, alpha_x, alpha_y, axis, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * grain.grained_shape(geom, alpha_x, alpha_y, axis)


def gradient(geom: Geometry, names, *, alpha_x, alpha_y, axis, n, k, scale) -> dict[str, np.ndarray]:
    """d ln f/dαx = (4 e_x/(1 + e) - 1)/αx - αx (cos θr i_x²/R_i + cos θi r_x²/R_r)/(cos θr R_i + cos θi R_r), as by αy;
    turning the axis carries x to y: ds_x = s_y, ds_y = -s_x."""
    v = geom.offset_from(axis)
    s_x, s_y = v[0] / geom.v_z, v[1] / geom.v_z
    (r_i, i_x, i_y), (r_r, r_x, r_y) = grain.roots(geom, alpha_x, alpha_y, axis)
    one_and_e = 1 + grain.tilt(geom, v, alpha_x, alpha_y)
    masking = geom.cos_r * r_i + geom.cos_i * r_r
    by_x = geom.cos_r * i_x * i_x / r_i + geom.cos_i * r_x * r_x / r_r
    by_y = geom.cos_r * i_y * i_y / r_i + geom.cos_i * r_y * r_y / r_r
    turned = geom.cos_r * i_x * i_y / r_i + geom.cos_i * r_x * r_y / r_r
    excess = (alpha_x - alpha_y) * (alpha_x + alpha_y)
    by = {
        "alpha_x": (4 * (s_x / alpha_x) ** 2 / one_and_e - 1) / alpha_x - alpha_x * by_x / masking,
        "alpha_y": (4 * (s_y / alpha_y) ** 2 / one_and_e - 1) / alpha_y - alpha_y * by_y / masking,
        "axis": excess * (4 * s_x * s_y / (one_and_e * (alpha_x * alpha_y) ** 2) - turned / masking),
    }
    facets = (geom.sec2_h / one_and_e) ** 2 / (2 * pi * alpha_x * alpha_y)
    return gradient_by(geom, names, facets / masking, by, n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        *WIDTHS,
        *INDEX,
    ),
    gradient=gradient,
    without=without_grain(brdf),
    derived=MEAN_AND_RATIO,
    summary="GGX with a grain: brushed and rolled metals, wood, satin, whose highlight turns with the sample",
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"alpha_x": 0.3, "alpha_y": 0.06, "axis": 0.4, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.1997775173093867,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha_x": 0.5, "alpha_y": 0.1, "axis": 1.1, "n": 0.958, "k": 6.69},
            f=1.63663405053175413,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha_x": 1e-4, "alpha_y": 1e-4}),
        Extreme("longest streak, across it", at(60, -60), {"alpha_x": 1e-4, "alpha_y": 1.5, "axis": 0.5 * pi}),
    ),
    breaks=TURNS,
    source="Trowbridge and Reitz 1975; Burley 2012; Heitz 2014",
    family="facets",
    cannot="shows no mirror image; where it is very rough (alpha near 1) up to 10 % of the light is missing",
    from_facets=lambda facets: {**widths_of(facets), "n": facets.n, "k": facets.k},
    candidacy=Candidacy(95, grained=True),
    grain=BY_WIDTHS,
)
