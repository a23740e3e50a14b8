"""Reflectances and albedos as production shaders compute them.

    Schlick     F0 + (F90 - F0)(1 - c)⁵
    F82         Schlick's, less a term that makes it `edge` times as high where c = 1/7, at 82 degrees
    artistic    Fresnel's with n and k made of the reflectance at normal incidence and an edge colour
    E           albedo of a GGX lobe as MaterialX has it, A F0 + B F90 with ratios of polynomials in cos θr, alpha
    factor      1 + F (1 - E)/E: light between facets as a factor of the lobe

Source: Schlick 1994; Kutz, Hasan and Edmondson 2021; Gulbrandsen 2014; Turquin 2019; MaterialX 1.39 for A and B.
"""

import numpy as np

from . import grain
from .geometry import Geometry

COS_82 = 1 / 7  # where F82 bends Schlick's curve

# coefficients of 1, x, y, xy, x², y², x²y, xy², x²y² with x = cos θr, y = alpha: numerators of A and B, denominators
ALBEDO_FIT = (
    (0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448),
    (0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286),
    (1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37),
    (1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1),
)


def schlick(cos_d, f0, f90=1.0):
    """Schlick's curve from F0 at the normal to F90 at grazing."""
    return f0 + (f90 - f0) * (1 - cos_d) ** 5


def f82(cos_d, f0, edge):
    """Schlick's curve bent so that it is `edge` times as high at 82 degrees."""
    bend = schlick(COS_82, f0) * (1 - edge) / (COS_82 * (1 - COS_82) ** 6)
    return schlick(cos_d, f0) - bend * cos_d * (1 - cos_d) ** 6


def mean_f82(f0, edge):
    """2 ∫ F c dc of that curve: (20 F0 + 1)/21 less a 126th of the bend."""
    bend = schlick(COS_82, f0) * (1 - edge) / (COS_82 * (1 - COS_82) ** 6)
    return (20 * f0 + 1) / 21 - bend / 126


def artistic_index(reflectivity, edge):
    """n and k of a reflectance at normal incidence and an edge colour, both 0..1 (Gulbrandsen 2014)."""
    r = np.clip(reflectivity, 0.0, 0.99)
    root = np.sqrt(r)
    n = edge * (1 - r) / (1 + r) + (1 - edge) * (1 + root) / (1 - root)
    k2 = np.maximum(((n + 1) ** 2 * r - (n - 1) ** 2) / (1 - r), 0.0)
    return n, np.sqrt(k2)


def index_of_weight(n, weight):
    """Index whose F0 is `weight` times that of n: OpenPBR's specular_weight. Takes  n >= 1, weight with F0 below 1."""
    root = np.sqrt(np.clip(weight * ((n - 1) / (n + 1)) ** 2, 0.0, 0.99999))
    return (1 + root) / (1 - root)


def albedo_terms(cos_r, alpha):
    """A and B of a GGX lobe seen from θr, each held to 0..1: its albedo is A F0 + B F90."""
    y = np.asarray(alpha, float)
    top_a, top_b, below_a, below_b = (
        (low + y * (by_y + y * by_y2)) + cos_r * ((by_x + y * (xy + y * xy2)) + cos_r * (by_x2 + y * (x2y + y * x2y2)))
        for low, by_x, by_y, xy, by_x2, by_y2, x2y, xy2, x2y2 in ALBEDO_FIT
    )
    return np.clip(top_a / below_a, 0, 1), np.clip(top_b / below_b, 0, 1)


def directional_albedo(terms, f0, f90=1.0):
    """E of a GGX lobe, A F0 + B F90, of its `albedo_terms`."""
    a, b = terms
    return f0 * a + f90 * b


def compensation(terms, reflectance):
    """What light between facets adds to a lobe of these `albedo_terms`, as a factor: 1 + F (1 - E)/E."""
    e = directional_albedo(terms, 1.0)
    return 1 + reflectance * ((1 - e) / e)


def lobe_shape(geom: Geometry, alphas, axis) -> np.ndarray:
    """`grain.grained_shape` of a pair of widths; 0 where one is 0 and the lobe is a mirror."""
    alpha_x, alpha_y = alphas
    mirror = np.multiply(alpha_x, alpha_y) == 0
    safe_x, safe_y = np.where(mirror, 1.0, alpha_x), np.where(mirror, 1.0, alpha_y)
    return np.where(mirror, 0.0, grain.grained_shape(geom, safe_x, safe_y, axis))
