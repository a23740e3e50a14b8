"""Stam's lobe of a rough conductor: Kirchhoff's diffraction with a constant reflectance, no shadows, two lengths.

    f = f0 (π τx τy/(4 λ²)) (|i + r|²/v_z)²/(cos θi cos θr) Σ_m g^m e^-g/(m! m) e^(-y/m),   v_z = cos θi + cos θr
    g = (2π σ v_z/λ)²,   y = (π/λ)² (τx² v_x² + τy² v_y²),   mirror reflectance = f0 exp(-(4π σ cos θi/λ)²)

v = i + r in the frame of `axis`, the azimuth across the grain, where slopes are steepest: τx = sigma/slope,
τy = ratio τx. With ratio 1 it is `he-torrance` without its shadows and with F held. For high-gloss metals, whose F
hardly varies (Westin et al. 2004, section 5.2); without shadows it sends out more than it receives toward grazing. Far
above the wavelength it is Beckmann's lobe of alpha = 2 slope. The heights are Gaussian, and so is their correlation.

Kajiya 1985 took the same integral over a given bumpy surface, by tables. Its statistical form is this law, as Stam
says, and its limit far above the wavelength is `beckmann-aniso`; there is no third law: `kajiya` names this one.

Source: Stam 1999, "Diffraction shaders", random surfaces; from the author's page and by identity with He-Torrance.
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._grain import AXIS, BY_RATIO, LENGTH_ACROSS, RATIO, SLOPE_ACROSS
from ._series_patches import ln_series
from ._shadows import height_factor
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, sigma, slope, ratio, axis, f0) -> np.ndarray:
    """Lobe [1/sr], without the mirror part, in the shape of `geom` and its wavelength."""
    g, y = _g_and_y(geom, sigma, slope, ratio, _across(geom, ratio, axis))
    return _before(geom, sigma, slope, ratio, f0) * np.exp(ln_series(g, y))


def _across(geom: Geometry, ratio, axis):
    """v along the grain; not asked for where there is no grain."""
    return 0.0 * axis if np.all(ratio == 1) else geom.offset_from(axis)[1]


def _before(geom: Geometry, sigma, slope, ratio, f0):
    """What multiplies the sum over orders."""
    return (pi / 4) * f0 * ratio * (sigma / slope / geom.wavelength) ** 2 * (height_factor(geom) / geom.cos_cos)


def _g_and_y(geom: Geometry, sigma, slope, ratio, across):
    """The arguments of the sum; y by the excess of the longer length, so that ratio 1 leaves no trace of the axis."""
    g = (2 * pi * sigma / geom.wavelength * geom.v_z) ** 2
    stretched = geom.vxy2 + (ratio * ratio - 1) * across * across
    return g, (pi * sigma / slope / geom.wavelength) ** 2 * stretched


def gradient(geom: Geometry, names, *, sigma, slope, ratio, axis, f0) -> dict[str, np.ndarray]:
    """d ln f by ln sigma, ln slope and ln ratio through g and y; dy/daxis = -2 (ratio² - 1) (π τx/λ)² v_x v_y."""
    along, across = geom.offset_from(axis)
    g, y = _g_and_y(geom, sigma, slope, ratio, across)
    ln_s, by_ln_g, by_y = ln_series(g, y, derivatives=True)
    shape = _before(geom, sigma, slope, ratio, 1.0) * np.exp(ln_s)
    lobe, by_tau = f0 * shape, 2 + 2 * y * by_y
    squared = 2 * (pi * sigma / slope / geom.wavelength) ** 2
    return {
        "f0": shape,
        "sigma": lobe * (by_tau + 2 * by_ln_g) / sigma,
        "slope": -lobe * by_tau / slope,
        "ratio": lobe * (1 / ratio + by_y * squared * ratio * across * across),
        "axis": -lobe * by_y * squared * (ratio * ratio - 1) * along * across,
    }


def mirror(geom: Geometry, *, sigma, slope, ratio, axis, f0) -> np.ndarray:
    """Reflectance left to the mirror direction at θi, dimensionless."""
    return f0 * np.exp(-((4 * pi * sigma / geom.wavelength * geom.cos_i) ** 2))


def rough(geom: Geometry, *, sigma, slope, ratio, axis, f0) -> np.ndarray:
    """The law far above the wavelength, e^(-y/g)/g for the sum: Beckmann's facets of alpha = 2 slope, unmasked."""
    g, y = _g_and_y(geom, sigma, slope, ratio, _across(geom, ratio, axis))
    return _before(geom, sigma, slope, ratio, f0) * np.exp(-y / g) / g


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("sigma", 0.1, 1e-3, 50.0, "um", log=True, meaning="rms height", starts=(0.02, 0.05, 0.2, 0.8)),
        SLOPE_ACROSS,
        RATIO,
        AXIS,
        Parameter("f0", 0.8, 0.0, 1.0, linear=True, per_channel=True, meaning="reflectance of the smooth surface"),
    ),
    gradient=gradient,
    mirror=mirror,
    without={"waves": rough},
    derived=(LENGTH_ACROSS,),
    pins=(
        Pin(
            at(45, 50, 0.55),
            {"sigma": 0.11, "slope": 0.08, "f0": 0.6},
            f=4.40086672987184918,
            source="the formulas above at 50 digits",
        ),
        Pin(
            at(60, 62, 0.45),
            {"sigma": 0.05, "slope": 0.05, "ratio": 3.0, "axis": 0.7, "f0": 0.9},
            f=12.9471556493484198,
            source="the same, smooth and grained",
        ),
        Pin(
            at(30, 30, 0.65),
            {"sigma": 5.0, "slope": 0.2, "ratio": 10.0, "axis": 2.5, "f0": 0.5},
            f=3.31620125065540886,
            source="the same, far rougher than the wavelength",
        ),
    ),
    extremes=(
        Extreme("0.01° from grazing", at(89.99, 89.99), {"sigma": 1.0}),
        Extreme("both at the normal", at(0, 0), {}),
        Extreme(
            "steepest and roughest, longest grain",
            at(89.99, -89.99),
            {"sigma": 50.0, "slope": 1.0, "ratio": 100.0},
        ),
        Extreme("far off the narrowest lobe", at(10, -80), {"sigma": 0.001, "slope": 0.001, "ratio": 100.0}),
    ),
    breaks={
        "energy": "no facet shadows another: more is sent than received toward grazing",
        "rotation": "it has a grain, unless ratio is 1",
    },
    summary="wave optics of high-gloss metals, brushed ones too: constant reflectance, no shadows, emerging mirror",
    source="Stam 1999",
    family="wave optics",
    aliases=("kajiya",),
    cannot="no shadows between bumps and one reflectance for all angles: too bright toward grazing",
    formula=Formula(
        "stam(ci, cr, q, {sigma_waves}, {tau_waves}, {f0})",
        (
            (
                "stam",
                "ci, cr, q, sigma, tau, f0",
                "0.25 * PI * tau * tau * f0 * sq(v2(ci, cr, q) / (ci + cr)) / (ci * cr)"
                " * series(sq(2.0 * PI * sigma * (ci + cr)), sq(PI * tau) * q)",
            ),
            ("stam_mirror", "ci, sigma, f0", "f0 * exp(-least(sq(4.0 * PI * sigma * ci), 85.0))"),
        ),
        mirror="stam_mirror(ci, {sigma_waves}, {f0})",
        numbers=lambda *, sigma, slope, wavelength, **_: {
            "sigma_waves": sigma / wavelength,
            "tau_waves": sigma / slope / wavelength,
        },
    ),
    candidacy=Candidacy(133, polished=True),
    grain=BY_RATIO,
    beyond_facets=lambda **_: "wave effects, the lobe's change of shape with angle and wavelength, become one shape",
)
