"""OpenPBR's surface, opaque: a clear coat over a dielectric body or a metal, with a grain.

    f = coat + (1 - C Ec) t (1 + C δ (Δ - 1)) mix(w F L + (1 - E) base_color/π, specular_weight F82 L, base_metalness)
    L = D G/(4 cos θi cos θr) (1 + F (1 - E)/E), GGX;   coat = C Fc Lc;   t = mix(1, coat_color, C)
    Δ = (1 - K)/(1 - base_color K), K = 1 - (1 - F0 of the coat)/coat_ior²,   δ = coat_darkening
    alpha across = r² √(2/(1 + (1 - a)²)), along = (1 - a) alpha across, a the anisotropy
    r⁴ = mix(specular_roughness⁴, min(1, specular_roughness⁴ + 2 coat_roughness⁴), in the fourth root by C)

F82 is Schlick's curve from base_color, specular_color of it at 82 degrees. The index under the coat is against the
coat's, and specular_weight scales its F0. E is the albedo of a lobe as MaterialX has it, at θr. The text leaves open
how light between facets comes back: MaterialX multiplies the lobe, others add a broad term (`readings`). A body is
Lambert's; no transmission, no fuzz, no thin film.

Source: OpenPBR 1.1 (Academy Software Foundation 2024) as MaterialX 1.39 generates it; the masking with both widths.
"""

from functools import partial
from math import pi

import numpy as np

from ..physics import facet_albedo, fresnel, shader_optics
from ..physics.geometry import Geometry
from ..physics.shader_optics import albedo_terms, compensation, directional_albedo, lobe_shape
from ._grain import AXIS
from ._shader import METAL_WORD, coat_setting, grain_setting, in_shape_of, slider, starts
from .facts import Setting
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`; light between facets multiplies the lobe."""
    return in_shape_of(_layered(geom, _factor, **values), values)


def broad(geom: Geometry, **values) -> np.ndarray:
    """The same with light between facets as a diffuse term (Kulla and Conty 2017)."""
    return in_shape_of(_layered(geom, _added, **values), values)


def single(geom: Geometry, **values) -> np.ndarray:
    """The same without light between facets."""
    return in_shape_of(_layered(geom, _bare, **values), values)


def _layered(
    geom: Geometry,
    facets,
    *,
    base_color,
    base_metalness,
    specular_weight,
    specular_color,
    specular_roughness,
    specular_roughness_anisotropy,
    axis,
    specular_ior,
    coat_weight,
    coat_color,
    coat_roughness,
    coat_ior,
    coat_darkening,
):
    under = _roughened(specular_roughness, coat_roughness, coat_weight)
    alphas = widths(under, specular_roughness_anisotropy)
    body, metal = 0.0, 0.0  # what has no share is not evaluated
    if np.any(np.not_equal(base_metalness, 1)):
        index = _index(specular_ior, specular_weight, coat_ior, coat_weight)
        f = fresnel.fresnel(geom.cos_d, index)
        lobe, left = facets(geom, f, fresnel.f0(index), partial(fresnel.mean_fresnel, index), alphas, axis)
        body = specular_color * lobe + left * base_color / pi
    if np.any(base_metalness):
        f = shader_optics.f82(geom.cos_d, base_color, specular_color)
        mean = partial(shader_optics.mean_f82, base_color, specular_color)
        metal, _ = facets(geom, f, base_color, mean, alphas, axis)
    base = body + (specular_weight * metal - body) * base_metalness
    if not np.any(coat_weight):
        return base
    f0 = fresnel.f0(coat_ior)
    on_top = widths(coat_roughness, 0.0)
    f = fresnel.fresnel(geom.cos_d, coat_ior)
    lobe, left = facets(geom, f, f0, partial(fresnel.mean_fresnel, coat_ior), on_top, axis)
    darkened = _darkened(base_color * (1 + (specular_weight - 1) * base_metalness), coat_ior)
    through = 1 + (coat_color - 1) * coat_weight
    dims = 1 + (darkened - 1) * coat_weight * coat_darkening
    return coat_weight * lobe + (1 + (left - 1) * coat_weight) * through * dims * base


def _factor(geom: Geometry, f, f0, _mean, alphas, axis):
    """A lobe and what it leaves: light between facets as a factor."""
    alpha = np.sqrt(np.multiply(*alphas))
    terms = albedo_terms(geom.cos_r, alpha)
    more = compensation(terms, f)
    left = 1 - directional_albedo(terms, f0) * more
    return f * more * lobe_shape(geom, alphas, axis), left


def _bare(geom: Geometry, f, f0, _mean, alphas, axis):
    """A lobe and what it leaves: without light between facets."""
    alpha = np.sqrt(np.multiply(*alphas))
    return f * lobe_shape(geom, alphas, axis), 1 - directional_albedo(albedo_terms(geom.cos_r, alpha), f0)


def _added(geom: Geometry, f, f0, mean_reflectance, alphas, axis):
    """A lobe and what it leaves: light between facets as a diffuse term."""
    alpha = np.clip(np.sqrt(np.multiply(*alphas)), facet_albedo.NARROWEST, facet_albedo.WIDEST)
    lost = facet_albedo.mean_lost(alpha)
    lost_i, lost_r = facet_albedo.lost(geom.cos_i, alpha), facet_albedo.lost(geom.cos_r, alpha)
    mean = mean_reflectance()
    again = mean * mean * (1 - lost) / (1 - mean * lost)
    lobe = f * lobe_shape(geom, alphas, axis) + again * lost_i * lost_r / (pi * lost)
    return lobe, 1 - directional_albedo(albedo_terms(geom.cos_r, alpha), f0) - again * lost_r


def mirror(
    geom: Geometry,
    *,
    base_color,
    base_metalness,
    specular_weight,
    specular_color,
    specular_roughness,
    specular_ior,
    coat_weight,
    coat_color,
    coat_roughness,
    coat_ior,
    coat_darkening,
    **_,
) -> np.ndarray:
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    coat = coat_weight * fresnel.fresnel(geom.cos_i, coat_ior)
    index = _index(specular_ior, specular_weight, coat_ior, coat_weight)
    bare = specular_color * fresnel.fresnel(geom.cos_i, index)
    metal = specular_weight * shader_optics.f82(geom.cos_i, base_color, specular_color)
    base = bare + (metal - bare) * base_metalness
    darkened = _darkened(base_color * (1 + (specular_weight - 1) * base_metalness), coat_ior)
    dims = (1 + (coat_color - 1) * coat_weight) * (1 + (darkened - 1) * coat_weight * coat_darkening)
    smooth = np.equal(specular_roughness, 0) & (np.equal(coat_roughness, 0) | np.equal(coat_weight, 0))
    return np.where(np.equal(coat_roughness, 0), coat, 0.0) + np.where(smooth, (1 - coat) * dims * base, 0.0)


def widths(roughness, anisotropy):
    """alpha across and along the grain."""
    across = np.square(roughness) * np.sqrt(2 / (1 + np.square(1 - anisotropy)))
    return across, (1 - anisotropy) * across


def _roughened(roughness, coat_roughness, coat_weight):
    """What a rough coat makes of the roughness below it."""
    most = np.minimum(1.0, 2 * np.power(coat_roughness, 4) + np.power(roughness, 4)) ** 0.25
    return roughness + (most - roughness) * coat_weight


def _index(ior, weight, coat_ior, coat_weight):
    """The body's index against what lies over it, upside down below 1 so that nothing is totally reflected."""
    against = np.maximum(ior / coat_ior, coat_ior / ior)
    return shader_optics.index_of_weight(ior + (against - ior) * coat_weight, weight)


def _darkened(albedo, n):
    """Δ: what light that the coat sends down again leaves of a base."""
    kept = 1 - (1 - fresnel.f0(n)) / (n * n)
    return (1 - kept) / (1 - albedo * kept)


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    mirror=mirror,
    parameters=(
        slider("base_color", 0.5, per_channel=True, free=True, starts=(0.05, 0.3, 0.8), meaning="linear base colour"),
        slider("base_metalness", 0.0, meaning="0 or 1"),
        slider("specular_weight", 1.0, meaning="scales F0 of the body's surface, and a metal's lobe"),
        slider("specular_color", 1.0, per_channel=True, starts=(0.6, 1.0), meaning="a metal's edge at 82 degrees"),
        slider(
            "specular_roughness",
            0.3,
            low=0.04,
            given_low=0.0,
            free=True,
            log=True,
            starts=(0.1, 0.2, 0.35, 0.55, 0.85),
            meaning="√alpha; 0: a mirror",
        ),
        slider("specular_roughness_anisotropy", 0.0, high=0.99, meaning="0: no grain"),
        AXIS,
        Parameter("specular_ior", 1.5, 1.0001, 3.0, log=True, origin=1.0, given_low=1.0, starts=(1.2, 1.5, 2.2)),
        slider("coat_weight", 0.0, meaning="presence of the coat"),
        slider("coat_color", 1.0, per_channel=True, meaning="what the coat lets through"),
        slider("coat_roughness", 0.0, meaning="√alpha of the coat; 0: a mirror"),
        Parameter("coat_ior", 1.6, 1.0001, 3.0, free=False, given_low=1.0, meaning="index of the coat"),
        slider("coat_darkening", 1.0, meaning="1: light that the coat sends down again darkens the base"),
    ),
    settings={
        METAL_WORD: Setting({"base_metalness": 1.0, "specular_ior": 1.5}),
        **coat_setting({"coat_weight": 1.0}, ("coat_roughness",), {"coat_roughness": 0.1}),
        **grain_setting("specular_roughness_anisotropy"),
    },
    without={"multiple": single},
    readings={"light between facets as a broad term": broad},
    summary="OpenPBR's surface, as MaterialX generates it: its numbers fitted themselves",
    pins=(
        Pin(
            at(45, 50),
            {
                "base_color": 0.6,
                "specular_weight": 0.8,
                "specular_color": 0.9,
                "specular_roughness": 0.35,
                "specular_ior": 1.7,
                "coat_weight": 0.7,
                "coat_color": 0.8,
                "coat_roughness": 0.2,
            },
            f=1.2708706076767280931,
            source="50 digits",
        ),
        Pin(
            at(40, 47, phi_i=20, phi_r=195),
            {
                "base_color": 0.8,
                "base_metalness": 1.0,
                "specular_weight": 0.9,
                "specular_color": 0.7,
                "specular_roughness": 0.45,
                "specular_roughness_anisotropy": 0.6,
                "axis": 0.4,
            },
            f=2.597876638121167466,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"specular_roughness": 0.04}),
        Extreme(
            "a dark metal with a black edge, beside 82°",
            at(80, 80),
            {"base_color": 0.0, "base_metalness": 1.0, "specular_color": 0.0},
        ),
        Extreme("mirror coat off its peak", at(30, 31), {"coat_weight": 1.0}),
    ),
    breaks={
        "energy": "what a lobe leaves is a fit at θr, and light between facets a factor: 1.37 at grazing at worst",
        "positive": "F82 of a dark metal with a black edge dips below 0 beside 82°, as in MaterialX's nodes",
        "reciprocity": "what a lobe leaves is taken at θr alone",
        "rotation": "it has a grain, unless specular_roughness_anisotropy is 0",
    },
    source="OpenPBR 1.1; MaterialX 1.39",
    family="shader",
    cannot="no fuzz, transmission or thin film here; F of a metal without k",
    from_facets=starts("specular_roughness", "specular_ior", 3.0),
)
