"""MaterialX: a gltf_pbr, glTF's numbers in MaterialX's own nodes, with a grain where the surface has one.

    f = coat + (1 - C Ec)(mix(F L + (1 - E) base_color/π, F L, metallic)),   L = D G/(4 cos θi cos θr) (1 + F (1 - E)/E)
    F Schlick's, from base_color or specular ((ior - 1)/(ior + 1))²;   alpha along the grain = roughness²,
    across = alpha + (1 - alpha) anisotropy_strength²,   G and E at the root of their product

The node is none of glTF's appendix B: light between facets multiplies the lobe, G has one width, heights are
correlated. `anisotropy_rotation` turns the tangent counter-clockwise, as glTF has it: the node negates it for
`rotate3d`, which turns clockwise. Its way around is the node's own and not roughness_anisotropy's.

Source: MaterialX 1.39.5, gltf_pbr.mtlx and mx_generalized_schlick_bsdf.
"""

from dataclasses import replace
from math import pi

import numpy as np

from ..models import term
from ..physics import fresnel, grain, microfacet
from ..physics.geometry import Geometry
from ..physics.shader_optics import albedo_terms, compensation, directional_albedo, schlick
from ._gltf import NODE as GLTF
from ._materialx import colour3, float_value, materialx_document, shader
from ._node_words import node_statement
from .exporter import ColouredSurface, Export, Exporter

COAT_INDEX = 1.5
SPELT = {"axis": "anisotropy_rotation"}


def node_brdf(
    geom: Geometry,
    *,
    base_color,
    metallic,
    roughness,
    ior,
    specular,
    anisotropy_strength,
    axis,
    clearcoat,
    clearcoat_roughness,
) -> np.ndarray:
    """BRDF [1/sr] of the node, in the shape of `geom`."""
    narrow = np.square(roughness)
    wide = narrow + (1 - narrow) * np.square(anisotropy_strength)
    f0 = specular * fresnel.f0(ior)
    lobe, left = _facets(geom, schlick(geom.cos_d, f0, specular), (f0, specular), (wide, narrow), axis)
    body = lobe + left * base_color / pi
    metal, _ = _facets(geom, schlick(geom.cos_d, base_color), (base_color, 1.0), (wide, narrow), axis)
    base = body + (metal - body) * metallic
    alpha = np.square(clearcoat_roughness)
    f = fresnel.fresnel(geom.cos_d, COAT_INDEX)
    lobe, left = _facets(geom, f, (fresnel.f0(COAT_INDEX), 1.0), (alpha, alpha), axis)
    return clearcoat * lobe + (1 + (left - 1) * clearcoat) * base


def _facets(geom: Geometry, f, ends, alphas, axis):
    """A lobe, 0 where it is a mirror, and what it leaves of the light; `ends` are F0 and F90."""
    alpha = np.sqrt(np.multiply(*alphas))
    smooth = np.equal(alpha, 0)
    wide, narrow, one = (np.where(smooth, 1.0, each) for each in (*alphas, alpha))
    masked = microfacet.ggx_shape(geom, one) / microfacet.ggx(geom, one)
    terms = albedo_terms(geom.cos_r, alpha)
    more = compensation(terms, f)
    lobe = np.where(smooth, 0.0, f * more * masked * grain.grained_density(geom, wide, narrow, axis))
    return lobe, 1 - directional_albedo(terms, *ends) * more


def node_mirror(
    geom: Geometry, *, base_color, metallic, roughness, ior, specular, clearcoat, clearcoat_roughness, **_
) -> np.ndarray:
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    coat = clearcoat * fresnel.fresnel(geom.cos_i, COAT_INDEX)
    f0 = specular * fresnel.f0(ior)
    bare, metal = schlick(geom.cos_i, f0, specular), schlick(geom.cos_i, base_color)
    base = (1 - coat) * (bare + (metal - bare) * metallic)
    return np.where(np.equal(clearcoat_roughness, 0), coat, 0.0) + np.where(np.equal(roughness, 0), base, 0.0)


LAW = replace(term("gltf"), module=__name__, brdf=node_brdf, mirror=node_mirror, pins=(), extremes=())
NODE = replace(GLTF, law=LAW, masked_alike=True)
ALWAYS = ("metallic", "roughness")  # the node's own defaults are another surface


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    choice, statement = node_statement(NODE, "gltf-pbr", surface, geom)
    inputs = {}
    for p in LAW.parameters:
        value = choice.values[p.name]
        name = SPELT.get(p.name, p.name)
        if p.name == "base_color":
            inputs[name] = colour3(value, 0.0, 1.0, name)
        elif np.any(np.ravel(value) != p.default) or p.name in ALWAYS:
            inputs[name] = float_value(value, p.least, p.high, name)
    return Export(materialx_document(surface, statement, shader(surface, "gltf_pbr", inputs)), statement)


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX gltf_pbr: glTF's numbers in MaterialX's nodes", export, grained=True)
