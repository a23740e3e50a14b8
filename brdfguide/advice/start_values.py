"""Start values: what a filled material means in terms of facets, from which each law takes its parameters.

Lobes of different laws are given one peak near the normal, F0/(4π alpha²), and one width (models/facts.py).
"""

from functools import lru_cache
from math import atan, sqrt, tan

import numpy as np

from ..models import Composite, Model
from ..models.facts import MIRROR_DEG, Facets
from ..models.surface import Surface
from ..physics import coat, fresnel
from ..physics.geometry import Geometry, in_plane, rows
from ..records import dataclass
from .material import Material

# silver metallic paint fitted by Ward's law: 0.185 and 0.225 (Ngan et al. 2005)
FLAKE_ALPHA = 0.2
FLAKE_SHARE = 0.2  # rho_s
COAT_N = 1.5  # the usual dielectric (Westin et al. 2004, section 5.1)
BARE_SIGMA_UM = 0.6  # g = 190 at 550 nm, where only the slope shows; for a He-Torrance lobe of unknown sigma
GRAIN = 4.0  # width across a grain over that along it: brushed metals have 2 to 10 (ours)
# White sheeting of glass beads sends 70 cd/lx/m² back at 0.2° (ASTM D4956, type I), 1/sr here: a share of 0.3 in a lobe
# of that height at the light is this wide
RETRO_SHARE = 0.3
RETRO_ALPHA = 0.0185
WATER_N = 1.33
GROWTH_DEG = (10, 75)  # of the light, between which growth is told
STEEP_SLOPE = 0.3  # sigma/tau from which bumps strain the theory (Westin et al. 2004, section 5.2)
# for a high gloss of unknown sigma: 37 % of the mirror image is lost at normal incidence, none at grazing
MIRROR_SIGMA_UM = 0.03


@dataclass(frozen=True)
class Rise:
    """Growth from 10 to 75 degrees, the report's way to tell models apart: at the mirror, and of the greatest value."""

    at_mirror: float | None  # of the finite part; None where it has none
    greatest: float | None
    mirror_term: float | None  # of the ideal specular reflectance


def start_values(model: Composite, material: Material) -> dict:
    """Values for the parameters of the sum that a lobe, a body or a mirror of this material would begin with."""
    values = {}
    for term in model.terms:
        given = term.model.started(_facets(model, term.model, material))
        if "n" in term.shared and term.shared["n"].startswith("coat."):  # the coat's own rough surface
            given = {**given, "n": _clear(material), "k": (0.0,)}
        for parameter in term.model.parameters:
            if parameter.name in given:
                values[term.key(parameter.name)] = _within(parameter, given[parameter.name])
        if term.model.turns and {"alpha_x", "alpha_y"} <= given.keys():
            for name, factor in _of_both_widths(material).items():
                values[term.key(name)] = _within(term.model.parameter(name), values[term.key(name)] * factor)
            across = 0.0 if material.grain_deg is None else (material.grain_deg + 90.0) % 180.0
            values[term.key("axis")] = float(np.radians(across))
        if material.wet and (term.model.is_coat or term.model.is_mirror and material.kind != "metal"):
            values[term.key("n")] = WATER_N
        if material.wet and term.model.is_body and material.albedo and material.kind != "metal":
            under = term.model.base is not None
            albedo = material.albedo if under else tuple(float(coat.seen_albedo(a, WATER_N)) for a in material.albedo)
            values[term.key("albedo")] = _within(term.model.parameter("albedo"), albedo)  # it is given dry
    return values


def _of_both_widths(material: Material) -> dict[str, float]:
    """What the widths across and along a grain are of the facets' one: of a streak whose own width was seen that is the
    short one, else the mean of both."""
    ratio = material.highlight_aspect or GRAIN
    if material.highlight_width is not None and material.highlight_aspect is not None:
        return {"alpha_x": ratio, "alpha_y": 1.0}
    return {"alpha_x": ratio**0.5, "alpha_y": ratio**-0.5}


def _facets(model: Composite, of_term: Model, material: Material) -> Facets:
    """What one term of the sum stands for in this material."""
    flakes = material.subsurface == "lobe"
    own = material.inference.numbers_of(of_term.name) if material.inference else {}
    if of_term.returns_light and material.retroreflective:
        return Facets(RETRO_ALPHA, (RETRO_SHARE,))
    if of_term.is_mirror and (flakes or material.coat == "clear" and material.kind == "metal"):
        n = _clear(material) if flakes else (COAT_N,)
        return Facets(_width(material), n=n, sigma=material.sigma or 0.0)
    if flakes and not of_term.has_index:
        return Facets(_flake_alpha(material), material.albedo or (FLAKE_SHARE,), albedo=None)
    n, k = (material.n or (1.5,)), (material.k or (0.0,))
    if "n" in own and material.filled_by.get("n") == "roughness_of_all_readings":
        n = (own["n"],)
    if of_term.is_coat:
        n, k = _clear(material), (0.0,)
    if open_metal(model, material):
        n, k = (3.18,), (4.41,)  # chromium, in the middle of the metals
    return Facets(
        alpha=own.get("alpha") or _width(material),
        f0=f0_of(material),
        growth=mirror_growth(material),
        n=n,
        k=k,
        sigma=own.get("sigma") or _sigma(of_term, material),
        slope=own.get("slope") or material.slope or 0.075,
        albedo=material.albedo or (0.18,),
        spread=_spread(material),
    )


def _spread(material: Material) -> float:
    """Spread of the tilts of a body's facets [rad]: the highlight's, unless they are said to be steep."""
    least = atan(sqrt(2) * STEEP_SLOPE) if material.steep else 0.0
    return min(max(atan((material.alpha or 0.5) / sqrt(2)), least), 1.2)


def _clear(material: Material) -> tuple[float, ...]:
    """Index of a clear coat: the one that is told, unless it is a metal's."""
    told = material.n is not None and not any(material.k or ()) and min(material.n) >= 1
    return material.n if told and material.n else (COAT_N,)


def open_metal(model: Composite, material: Material) -> bool:
    """Whether this sum stands for the metal of a surface whose kind is open."""
    return (
        material.kind not in ("metal", "dielectric")
        and material.n is None
        and len(model.terms) == 1
        and material.appearance != "black"
    )


def _flake_alpha(material: Material) -> float:
    """alpha of the flakes' lobe as it is seen; under a coat of index n they lie n times narrower.

    GGX's half height lies at tan δ = alpha √(√2 - 1), the half vector's tilt being half the detector's way.
    """
    if material.flake_highlight_width is None:
        return FLAKE_ALPHA
    return tan(0.25 * material.flake_highlight_width) / sqrt(sqrt(2) - 1)


def _width(material: Material) -> float:
    return material.alpha or (0.01 if material.finish == "mirror" else 0.15)


def f0_of(material: Material) -> tuple[float, ...]:
    """F0 by channel, from n and k."""
    if material.n is None:
        return material.f0 or (0.04,)
    return tuple(
        float(each) for each in np.atleast_1d(fresnel.f0(np.array(material.n), np.array(material.k or (0.0,))))
    )


def mirror_growth(material: Material) -> tuple[float, ...]:
    """What facets reflect at the mirror directions MIRROR_DEG over the normal: F/(F0 cos²), of the middle channel."""
    indices, absorptions = material.n or (1.5,), material.k or (0.0,)
    n, k = indices[len(indices) // 2], absorptions[len(absorptions) // 2]
    return _facet_growth(n if k else max(n, 1.001), k)


@lru_cache(maxsize=256)
def _facet_growth(n: float, k: float) -> tuple[float, ...]:
    c = np.cos(np.radians(MIRROR_DEG))
    return tuple(float(each) for each in fresnel.fresnel(c, n, k) / float(fresnel.f0(n, k)) / c**2)


def _sigma(of_term: Model, material: Material) -> float:
    if material.sigma is not None:
        return material.sigma
    if not of_term.is_lobe:
        return 0.0
    return MIRROR_SIGMA_UM if material.finish in ("mirror", "high gloss") else BARE_SIGMA_UM


def _within(parameter, given):
    """Inside the bounds of the law; a tuple stays one value per channel."""

    def clip(value):
        return float(min(max(value, parameter.least), parameter.high))

    if isinstance(given, tuple):
        given = tuple(clip(value) for value in given)
        return given if parameter.per_channel and len(set(given)) > 1 else given[len(given) // 2]
    return clip(given)


def grazing_growth(surface: Surface) -> Rise:
    """The growth from 10 to 75 degrees, in the middle channel."""
    middle, geom = surface.middle, scans_of_growth()
    scans = np.reshape(middle.brdf(geom), (len(GROWTH_DEG), -1))
    at = [float(scan[angle]) for scan, angle in zip(scans, GROWTH_DEG, strict=True)]
    top = [float(scan.max()) for scan in scans]
    spike = [float(each) for each in middle.mirror(geom[:: scans.shape[1]])[:, 0]]

    def ratio(pair):
        return pair[1] / pair[0] if pair[0] > 1e-12 else None

    return Rise(ratio(at), ratio(top), ratio(spike))


@lru_cache(maxsize=1)
def scans_of_growth() -> Geometry:
    """The mirror side of the plane of incidence under each of GROWTH_DEG, one value a degree, below one another."""
    return rows(in_plane(np.repeat(GROWTH_DEG, 90), np.tile(np.arange(0.0, 90.0), len(GROWTH_DEG))))
