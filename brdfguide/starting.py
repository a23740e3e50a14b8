"""Start values: what a filled material means for the parameters of each law, and what each law cannot do.

Lobes of different laws are given one peak near the normal: F0/(4π alpha²), and widths by alpha = 2 sigma/tau,
n_half = 2/alpha² - 2, n_mirror = n_half/4.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import atan, pi, sqrt

import numpy as np

from . import optics
from .geometry import in_plane, rows
from .material import Material
from .models import Sum

FLAKE_ALPHA, FLAKE_SHARE = 0.2, 0.2  # silver metallic paint fitted by Ward's law: 0.185 and 0.225 (Ngan et al. 2005)
MIRROR_DEG = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0)  # where a Lafortune lobe is made to follow facets
COAT_N = 1.5  # the usual dielectric (Westin et al. 2004, section 5.1)
BARE_SIGMA_UM = 0.6  # g = 190 at 550 nm, where only the slope shows; for a He-Torrance lobe of unknown sigma
MIRROR_SIGMA_UM = 0.03  # for a high gloss of unknown sigma: 37 % of the mirror image is lost at normal incidence, none at grazing

CANNOT = {
    "phong": "not reciprocal, sends back more than it gets toward grazing; no Fresnel, no mirror image",
    "phong-lewis": "does not grow toward grazing at all; no Fresnel, no mirror image",
    "blinn": "does not grow toward grazing; no Fresnel, no mirror image",
    "ward": "one fixed growth toward grazing, whatever the index; no mirror image",
    "ward-gmd": "no Fresnel; no mirror image",
    "lafortune": "nothing bounds its energy; it only follows a measurement, so its start values are a shape, not a prediction",
    "cook-torrance": "no mirror image; angular masking",
    "beckmann": "no mirror image; no long tails",
    "ggx": "no mirror image; loses up to 10 % at large alpha",
    "he-torrance": "one interface, Gaussian heights; an isotropic average of anything turned; slow",
    "mirror": "no lobe: small lights show as points, and a slightly rough surface scatters",
    "oren-nayar": "no lobe toward the mirror direction",
    "lambertian": "no rise toward grazing",
}  # fmt: skip


@dataclass(frozen=True)
class Rise:
    """Growth from 10 to 75 degrees, the report's way to tell models apart: in the mirror direction, and of the greatest value."""

    at_mirror: float | None  # of the finite part; None where it has none
    greatest: float | None
    mirror_term: float | None  # of the ideal specular reflectance


def start_values(model: Sum, material: Material) -> dict:
    """Values for every parameter of the sum that a lobe, a body or a mirror of this material would begin with."""
    values = {}
    flakes = material.subsurface == "lobe"
    coat_over_metal = material.coat == "clear" and material.kind == "metal"
    for term in model.terms:
        if term.model.name == "mirror" and (flakes or coat_over_metal):
            own = {"n": (material.n or (COAT_N,)) if flakes else (COAT_N,), "k": (0.0,), "sigma": material.sigma or 0.0}
        elif flakes and "n" not in term.model.defaults():
            own = _lobe(FLAKE_ALPHA, material.albedo or (FLAKE_SHARE,), (1.0,) * len(MIRROR_DEG))
        else:
            own = _lobe(_width(material), reflectance(material), mirror_growth(material))
            own |= {"albedo": material.albedo or (0.18,), "spread": min(atan((material.alpha or 0.5) / sqrt(2)), 1.2)}
            own |= {"n": material.n or (1.5,), "k": material.k or (0.0,), "sigma": _sigma(term.model.name, material), "slope": material.slope or 0.075}
            if open_metal(model, material):
                own |= {"n": (3.18,), "k": (4.41,)}  # chromium, in the middle of the metals
        lobe = term.model.name
        if lobe == "lafortune":
            own = {"ks": own["lafortune_ks"], "tilt": own["tilt"], "exponent": own["mirror_exponent"]}
        elif lobe == "phong":
            own = {"ks": own["phong_ks"], "exponent": own["mirror_exponent"]}
        elif lobe == "phong-lewis":
            own = {"ks": own["rho_s"], "exponent": own["mirror_exponent"]}
        elif lobe == "blinn":
            own = {"ks": own["rho_s"], "exponent": own["half_exponent"]}
        for parameter in term.model.parameters:
            given = own.get(parameter.name)
            if given is not None:
                values[f"{term.label}.{parameter.name}"] = _within(parameter, given)
    return values


def open_metal(model: Sum, material: Material) -> bool:
    """Whether this sum stands for the metal of a surface whose kind is open."""
    return material.kind not in ("metal", "dielectric") and material.n is None and len(model.terms) == 1 and material.appearance != "black"


def _width(material: Material) -> float:
    return material.alpha or (0.01 if material.finish == "mirror" else 0.15)


def reflectance(material: Material) -> tuple[float, ...]:
    """F0 by channel, from n and k."""
    if material.n is None:
        return material.f0 or (0.04,)
    return tuple(float(each) for each in np.atleast_1d(optics.f0(np.array(material.n), np.array(material.k or (0.0,)))))


def mirror_growth(material: Material) -> tuple[float, ...]:
    """What facets reflect at the mirror directions MIRROR_DEG over what they do at the normal: F/(F0 cos²), of the middle channel."""
    n, k = (material.n or (1.5,)), (material.k or (0.0,))
    n, k = n[len(n) // 2], k[len(k) // 2]
    return _facet_growth(n if k else max(n, 1.001), k)


@lru_cache(maxsize=256)
def _facet_growth(n: float, k: float) -> tuple[float, ...]:
    c = np.cos(np.radians(MIRROR_DEG))
    return tuple(float(each) for each in optics.fresnel(c, n, k) / float(optics.f0(n, k)) / c**2)


def _lobe(alpha: float, f0, growth: tuple[float, ...]) -> dict:
    """Widths and heights of one lobe in each law's own words."""
    half = max(2 / alpha**2 - 2, 0.4)
    mirror_exponent = max(half / 4, 0.3)
    tilt, height = _lafortune(growth, mirror_exponent)
    peak = tuple(each / (4 * pi * alpha**2) for each in f0)
    return {
        "alpha": alpha,
        "rho_s": tuple(min(each, 1.0) for each in f0),
        "phong_ks": peak,
        "lafortune_ks": tuple(each * height for each in peak),
        "half_exponent": half,
        "mirror_exponent": mirror_exponent,
        "tilt": tilt,
    }


@lru_cache(maxsize=256)
def _lafortune(growth: tuple[float, ...], exponent: float) -> tuple[float, float]:
    """(tilt, ks over the peak at the normal) of the one lobe whose mirror values follow `growth` best in ln."""
    c2 = np.cos(np.radians(MIRROR_DEG)) ** 2
    tilt = np.radians(np.linspace(45.0, 85.0, 161))[:, None]
    ln_lobe = exponent * np.log(1 - c2 + c2 / np.tan(tilt))
    miss = np.log(growth) - ln_lobe
    best = int(np.argmin(np.var(miss, axis=1)))
    return float(tilt[best, 0]), float(np.exp(miss[best].mean()))


def _sigma(name: str, material: Material) -> float:
    if material.sigma is not None:
        return material.sigma
    if name == "mirror":
        return 0.0
    return MIRROR_SIGMA_UM if material.finish in ("mirror", "high gloss") else BARE_SIGMA_UM


def _within(parameter, given):
    """Inside the bounds of the law; a tuple stays one value per channel."""
    clip = lambda value: float(min(max(value, parameter.least), parameter.high))  # noqa: E731
    if isinstance(given, tuple):
        given = tuple(clip(value) for value in given)
        return given if parameter.per_channel and len(set(given)) > 1 else given[len(given) // 2]
    return clip(given)


def rise(model: Sum, values: Mapping) -> Rise:
    """The growth of these values from 10 to 75 degrees, in the middle channel."""
    single = {key: value[len(value) // 2] if isinstance(value, tuple) else value for key, value in values.items()}
    scans = [model(_scan(angle), single)[:, 0] for angle in (10.0, 75.0)]
    at = [float(scan[angle]) for scan, angle in zip(scans, (10, 75))]
    top = [float(scan.max()) for scan in scans]
    spike = [float(model.mirror(_scan(angle), single)[0, 0]) for angle in (10.0, 75.0)] if model.has_mirror else [0.0, 0.0]
    ratio = lambda pair: pair[1] / pair[0] if pair[0] > 1e-12 else None  # noqa: E731
    return Rise(ratio(at), ratio(top), ratio(spike))


@lru_cache(maxsize=2)
def _scan(theta_i: float):
    """The mirror side of the plane of incidence, one value a degree."""
    return rows(in_plane(theta_i, np.arange(0.0, 90.0)))
