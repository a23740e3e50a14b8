"""Shaders of production tools as their texts print them, in as many digits as asked; with no shared step, as in
`textbook`.

A lobe is F D G/(4 cos θi cos θr) of GGX's facets, D and G by the half vector and the directions in the frame of the
grain. A lobe of width 0 is a mirror and has no finite part.

Source: glTF 2.0, appendix B, with KHR_materials_anisotropy and _clearcoat; OpenPBR 1.1 and Standard Surface as
MaterialX 1.39 generates them (mx_microfacet_specular.glsl, mx_microfacet_sheen.glsl); Burley 2012 with the BRDF
Explorer's disney.brdf.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from mpmath import log, mp, mpf, pi, sqrt

from .textbook import unpolarised
from .textbook_grain import exponent_and_tilt, in_frame

HALF = mpf(1) / 2
# mx_ggx_dir_albedo_analytic: polynomials in x = N·V and y = alpha, terms 1, x, y, xy, x², y², x²y, xy², x²y²
DIR_ALBEDO = (
    ("0.1003 0.9345 1 1", "-0.6303 -2.323 -1.765 0.2281", "9.748 2.229 8.263 15.94"),
    ("-2.038 -3.748 11.53 -55.83", "29.34 1.424 28.96 13.08", "-8.245 -0.7684 -7.507 41.26"),
    ("-26.44 1.436 -36.11 54.9", "19.99 0.2913 15.86 300.2", "-5.448 0.6286 33.37 -285.1"),
)
# mx_imageworks_sheen_dir_albedo: the same of 1, x, y, xy, x², y², x = N·V, y the roughness
SHEEN_ALBEDO = ("13.67300 1", "-68.78018 61.57746", "799.08825 442.78211", "-905.00061 2597.49308",
                "60.28956 121.81241", "1086.96473 3045.55075")  # fmt: skip


def rises_to(c, low, high=1):
    """Schlick's curve, from `low` at the normal to `high` at grazing."""
    return low + (high - low) * (1 - c) ** 5


def blended(a, b, share):
    return a * (1 - share) + b * share


def at_normal(n):
    return ((n - 1) / (n + 1)) ** 2


def edged(c, base, edge):
    """F82: Schlick's curve, bent to `edge` times its height at 82 degrees."""
    there = mpf(1) / 7
    full = rises_to(there, base)
    return rises_to(c, base) - c * (1 - c) ** 6 * (full - edge * full) / (there * (1 - there) ** 6)


# --- facets ------------------------------------------------------------------------------------------


@lru_cache(maxsize=8192)
def of_facets(p, wide, narrow, axis, together, prec):
    """D G/(4 cos θi cos θr), heights correlated where `together`; 0 of a mirror. To `prec` bits, once for all that a
    shader colours."""
    if not wide or not narrow:
        return mpf(0)
    e, t = exponent_and_tilt(p, wide, narrow, axis)
    d = (1 + t) ** 2 / (pi * wide * narrow * (1 + e) ** 2)
    light, view = _roots(p, wide, narrow, axis)
    masking = 2 / (light + view) if together else 4 / ((1 + light) * (1 + view))
    return d * masking / (4 * p.cos_i * p.cos_r)


def _roots(p, wide, narrow, axis):
    """√(1 + α² tan² θ) of light and view, α in their azimuth."""
    _, *both = in_frame(p, axis)
    return [sqrt(1 + ((wide * w[0]) ** 2 + (narrow * w[1]) ** 2) / w[2] ** 2) for w in both]


@lru_cache(maxsize=8192)
def albedo_of_lobe(x, alpha, prec):
    """What a lobe sends of F0, and of F90, both within 0..1; to `prec` bits."""
    by_x = (mpf(1), x, x * x)
    powers = (1, x, alpha, x * alpha, by_x[2], alpha**2, by_x[2] * alpha, x * alpha**2, by_x[2] * alpha**2)
    rows = [[mpf(each) for each in row.split()] for three in DIR_ALBEDO for row in three]
    sums = [sum(each * row[place] for each, row in zip(powers, rows, strict=True)) for place in range(4)]
    return tuple(min(max(sums[place] / sums[place + 2], mpf(0)), mpf(1)) for place in (0, 1))


def again(p, alpha, f):
    """1 + F (1 - E)/E: light between facets as a factor (Turquin 2019)."""
    a, b = albedo_of_lobe(p.cos_r, alpha, mp.prec)
    return 1 + f * (1 - a - b) / (a + b)


def kept_by_lobe(p, alpha, f, low, high=1):
    """The albedo of a lobe from F0 and F90, with light between facets by F."""
    a, b = albedo_of_lobe(p.cos_r, alpha, mp.prec)
    return (low * a + high * b) * again(p, alpha, f)


# --- glTF --------------------------------------------------------------------------------------------


def gltf(p, base_color, metallic, roughness, ior, specular, anisotropy_strength, axis, clearcoat, clearcoat_roughness):
    alpha = roughness**2
    along = blended(alpha, mpf(1), anisotropy_strength**2)
    lobe = of_facets(p, along, alpha, axis, anisotropy_strength > 0, mp.prec)
    f = _of_gltf(p.cos_d, base_color, metallic, ior, specular)
    base = (1 - f) * base_color * (1 - metallic) / pi + f * lobe
    if not clearcoat:
        return base
    coat = clearcoat * rises_to(p.cos_r, mpf(4) / 100)
    return blended(base, of_facets(p, clearcoat_roughness**2, clearcoat_roughness**2, axis, False, mp.prec), coat)


def _of_gltf(c, base_color, metallic, ior, specular):
    dielectric = specular * at_normal(ior)
    return rises_to(c, blended(dielectric, base_color, metallic), blended(specular, mpf(1), metallic))


def gltf_mirror(p, base_color, metallic, roughness, ior, specular, clearcoat, clearcoat_roughness, **_):
    coat = clearcoat * rises_to(p.cos_i, mpf(4) / 100)
    base = (1 - coat) * _of_gltf(p.cos_i, base_color, metallic, ior, specular)
    return (0 if clearcoat_roughness else coat) + (0 if roughness else base)


def gltf_node(
    p, base_color, metallic, roughness, ior, specular, anisotropy_strength, axis, clearcoat, clearcoat_roughness
):
    """MaterialX's node of the same numbers, gltf_pbr: light between facets multiplies the lobe, masking has one
    width."""
    narrow = roughness**2
    wide = blended(narrow, mpf(1), anisotropy_strength**2)
    alpha, f0 = sqrt(wide * narrow), specular * at_normal(ior)
    shape = mpf(0)
    if alpha:
        masked_by_both = of_facets(p, wide, narrow, axis, True, mp.prec) * sum(_roots(p, wide, narrow, axis))
        shape = masked_by_both / sum(_roots(p, alpha, alpha, axis))
    f = rises_to(p.cos_d, f0, specular)
    body = f * again(p, alpha, f) * shape + (1 - kept_by_lobe(p, alpha, f, f0, specular)) * base_color / pi
    f = rises_to(p.cos_d, base_color)
    base = blended(body, f * again(p, alpha, f) * shape, metallic)
    if not clearcoat:
        return base
    alpha, n = clearcoat_roughness**2, mpf(3) / 2
    f = unpolarised(p.cos_d, n)
    coat = f * again(p, alpha, f) * of_facets(p, alpha, alpha, axis, True, mp.prec)
    return clearcoat * coat + (1 - clearcoat * kept_by_lobe(p, alpha, f, at_normal(n))) * base


def gltf_node_mirror(p, base_color, metallic, roughness, ior, specular, clearcoat, clearcoat_roughness, **_):
    coat = clearcoat * unpolarised(p.cos_i, mpf(3) / 2)
    f0 = specular * at_normal(ior)
    base = (1 - coat) * blended(rises_to(p.cos_i, f0, specular), rises_to(p.cos_i, base_color), metallic)
    return (0 if clearcoat_roughness else coat) + (0 if roughness else base)


# --- OpenPBR -----------------------------------------------------------------------------------------


def openpbr(
    p, base_color, base_metalness, specular_weight, specular_color, specular_roughness, specular_roughness_anisotropy,
    axis, specular_ior, coat_weight, coat_color, coat_roughness, coat_ior, coat_darkening,
):  # fmt: skip
    under = sqrt(sqrt(min(mpf(1), specular_roughness**4 + 2 * coat_roughness**4)))
    wide, narrow = _across_and_along(blended(specular_roughness, under, coat_weight), specular_roughness_anisotropy)
    shape, alpha = of_facets(p, wide, narrow, axis, True, mp.prec), sqrt(wide * narrow)
    base = mpf(0)
    if base_metalness != 1:  # what has no share is not evaluated
        index = _against_its_coat(specular_ior, specular_weight, coat_ior, coat_weight)
        f = unpolarised(p.cos_d, index)
        kept = kept_by_lobe(p, alpha, f, at_normal(index))
        body = specular_color * f * again(p, alpha, f) * shape + (1 - kept) * base_color / pi
        base += (1 - base_metalness) * body
    if base_metalness:
        f = edged(p.cos_d, base_color, specular_color)
        base += base_metalness * specular_weight * f * again(p, alpha, f) * shape
    if not coat_weight:
        return base
    base *= _under_the_coat(
        base_color, base_metalness, specular_weight, coat_weight, coat_color, coat_ior, coat_darkening
    )
    alpha, _ = _across_and_along(coat_roughness, mpf(0))
    f = unpolarised(p.cos_d, coat_ior)
    coat = f * again(p, alpha, f) * of_facets(p, alpha, alpha, axis, True, mp.prec)
    return coat_weight * coat + (1 - coat_weight * kept_by_lobe(p, alpha, f, at_normal(coat_ior))) * base


def openpbr_mirror(
    p, base_color, base_metalness, specular_weight, specular_color, specular_roughness, specular_ior,
    coat_weight, coat_color, coat_roughness, coat_ior, coat_darkening, **_,
):  # fmt: skip
    coat = coat_weight * unpolarised(p.cos_i, coat_ior)
    index = _against_its_coat(specular_ior, specular_weight, coat_ior, coat_weight)
    bare = specular_color * unpolarised(p.cos_i, index)
    base = blended(bare, specular_weight * edged(p.cos_i, base_color, specular_color), base_metalness)
    base *= _under_the_coat(
        base_color, base_metalness, specular_weight, coat_weight, coat_color, coat_ior, coat_darkening
    )
    smooth = not specular_roughness and not (coat_roughness and coat_weight)
    return (0 if coat_roughness else coat) + (1 - coat) * (base if smooth else 0)


def _across_and_along(roughness, anisotropy):
    along = 1 - anisotropy
    across = roughness**2 * sqrt(2 / (1 + along**2))
    return across, along * across


def _against_its_coat(ior, weight, coat_ior, coat_weight):
    """The index whose F0 is `weight` times that against what lies over the body."""
    ratio = max(ior / coat_ior, coat_ior / ior)
    index = blended(ior, ratio, coat_weight)
    root = sqrt(min(weight * at_normal(index), mpf("0.99999")))
    return (1 + root) / (1 - root)


def _under_the_coat(base_color, base_metalness, specular_weight, coat_weight, coat_color, coat_ior, coat_darkening):
    """What the coat lets through, and what it darkens by sending light down again."""
    albedo = blended(base_color, specular_weight * base_color, base_metalness)
    down = 1 - (1 - at_normal(coat_ior)) / coat_ior**2
    darker = blended(mpf(1), (1 - down) / (1 - albedo * down), coat_weight * coat_darkening)
    return blended(mpf(1), coat_color, coat_weight) * darker


# --- Standard Surface --------------------------------------------------------------------------------


def standard_surface(
    p, base_color, metalness, specular, specular_color, specular_roughness, specular_anisotropy, axis, specular_ior,
    sheen, sheen_roughness, coat, coat_color, coat_roughness, coat_ior,
):  # fmt: skip
    aspect = sqrt(1 - min(specular_anisotropy, mpf("0.98")))
    wide, narrow = min(mpf(1), specular_roughness**2 / aspect), specular_roughness**2 * aspect
    shape, alpha = of_facets(p, wide, narrow, axis, True, mp.prec), sqrt(wide * narrow)
    base = mpf(0)
    if metalness != 1:  # what has no share is not evaluated
        f, below = unpolarised(p.cos_d, specular_ior), base_color / pi
        if sheen:
            below *= 1 - sheen * _of_fibres(p.cos_r, sheen_roughness)
            below += sheen * _fibres(p, sheen_roughness)
        left = 1 - specular * kept_by_lobe(p, alpha, f, at_normal(specular_ior))
        base += (1 - metalness) * (specular * specular_color * f * again(p, alpha, f) * shape + left * below)
    if metalness:
        f = _artistic(p.cos_d, base_color, specular * specular_color)
        base += metalness * f * again(p, alpha, f) * shape
    if not coat:
        return base
    alpha, f = coat_roughness**2, unpolarised(p.cos_d, coat_ior)
    top = coat * f * again(p, alpha, f) * of_facets(p, alpha, alpha, axis, True, mp.prec)
    left = 1 - coat * kept_by_lobe(p, alpha, f, at_normal(coat_ior))
    return top + left * blended(mpf(1), coat_color, coat) * base


def standard_surface_mirror(
    p, base_color, metalness, specular, specular_color, specular_roughness, specular_ior, coat, coat_color,
    coat_roughness, coat_ior, **_,
):  # fmt: skip
    top = coat * unpolarised(p.cos_i, coat_ior)
    bare = specular * specular_color * unpolarised(p.cos_i, specular_ior)
    base = blended(bare, _artistic(p.cos_i, base_color, specular * specular_color), metalness)
    base *= (1 - top) * blended(mpf(1), coat_color, coat)
    return (0 if coat_roughness else top) + (0 if specular_roughness else base)


def _artistic(c, reflectivity, edge):
    """F of the index that a reflectance and an edge colour make (Gulbrandsen 2014)."""
    r = min(max(reflectivity, mpf(0)), mpf("0.99"))
    least, most = (1 - r) / (1 + r), (1 + sqrt(r)) / (1 - sqrt(r))
    n = blended(most, least, edge)
    return unpolarised(c, n, sqrt(max((r * (n + 1) ** 2 - (n - 1) ** 2) / (1 - r), mpf(0))))


def _fibres(p, roughness):
    power = 1 / max(roughness, mpf("0.005"))
    density = (2 + power) * sqrt(max(1 - p.cos_h**2, mpf(0))) ** power / (2 * pi)
    return density / (4 * (p.cos_i + p.cos_r - p.cos_i * p.cos_r))


def _of_fibres(x, y):
    """Their albedo."""
    powers = (1, x, y, x * y, x * x, y * y)
    above, below = (
        sum(mpf(row.split()[place]) * each for row, each in zip(SHEEN_ALBEDO, powers, strict=True)) for place in (0, 1)
    )
    return min(max(above / below, mpf(0)), mpf(1))


# --- Disney ------------------------------------------------------------------------------------------


def disney(
    p, base_color, metallic, subsurface, specular, roughness, specular_tint, anisotropic, axis, sheen, sheen_tint,
    clearcoat, clearcoat_gloss, tint,
):  # fmt: skip
    light, view, halfway = ((1 - c) ** 5 for c in (p.cos_i, p.cos_r, p.cos_d))
    rough = p.cos_d**2 * roughness
    lit = blended(mpf(1), HALF + 2 * rough, light) * blended(mpf(1), HALF + 2 * rough, view)
    flat = blended(mpf(1), rough, light) * blended(mpf(1), rough, view)
    flat = mpf(5) / 4 * (flat * (1 / (p.cos_i + p.cos_r) - HALF) + HALF)
    cloth = halfway * sheen * blended(mpf(1), tint, sheen_tint)
    body = (base_color / pi * blended(lit, flat, subsurface) + cloth) * (1 - metallic)
    f0 = blended(mpf(8) / 100 * specular * blended(mpf(1), tint, specular_tint), base_color, metallic)
    aspect = sqrt(1 - mpf(9) / 10 * anisotropic)
    wide, narrow = (max(mpf("0.001"), each) for each in (roughness**2 / aspect, roughness**2 * aspect))
    lobe = blended(f0, mpf(1), halfway) * of_facets(p, wide, narrow, axis, False, mp.prec)
    a2 = blended(mpf("0.1"), mpf("0.001"), clearcoat_gloss) ** 2
    d = (a2 - 1) / (pi * log(a2) * (1 + (a2 - 1) * p.cos_h**2))
    quarter = mpf(1) / 16
    masking = [1 / (c + sqrt(quarter + c * c - quarter * c * c)) for c in (p.cos_i, p.cos_r)]
    coat = mpf(1) / 4 * clearcoat * d * blended(mpf("0.04"), mpf(1), halfway) * masking[0] * masking[1]
    return body + lobe + coat


LAWS: dict[str, Callable[..., Any]] = {
    "gltf": gltf,
    "openpbr": openpbr,
    "standard-surface": standard_surface,
    "disney": disney,
}
MIRRORS: dict[str, Callable[..., Any]] = {
    "gltf": gltf_mirror,
    "openpbr": openpbr_mirror,
    "standard-surface": standard_surface_mirror,
}
