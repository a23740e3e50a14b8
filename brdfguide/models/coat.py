"""A clear coat over other laws: varnish, lacquer, the clear coat of a car. Written `coated:LAW` or `coated:LAW+LAW`.

    f(i, r) = T(θi) T(θr)/n² e^(-depth (1/cos θi' + 1/cos θr')) f_base(i', r')    sin θ' = sin θ/n,  T = 1 - F(θ; n)
    of a body besides    f_base + albedo² K/(π (1 - albedo K)),   K = 1 - (1 - F̄)/n²,   F̄ = 2 ∫ F c dc
    mirror reflectance   F(θi; n) e^-(4π sigma cos θi/λ)²

Everything after `coated:` lies under the coat, everything before it on top. The base's index is that of the substance
itself; inside it counts against n, at the wavelength λ/n. K is the share of a body's light that the coat sends down
again; it comes back as Lambert's law sends it, which is then exact: f_base/(1 - albedo K), and albedo 1 returns all
that entered. Nothing inside is ever near grazing, so a lobe hardly grows toward it, and it looks n times wider than it
lies: what metallic paints do. A lobe on top stands for a rough surface of the coat in the mirror's place and has the
coat's n. Light that a lobe's steep facets keep inside is lost; K takes no account of depth; no interference.

Source: Fresnel; Saunderson 1942; Weidlich and Wilkie 2007 with n² restored.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from itertools import product
from math import pi

import numpy as np

from ..errors import InputError
from ..physics import coat, fresnel
from ..physics.geometry import Geometry
from .facts import Facets, Formula
from .model import Derived, Model, Parameter

N = Parameter("n", 1.5, 1.0, 3.0, free=False, meaning="refractive index of the coat", starts=(1.33, 1.5, 1.7))
DEPTH = Parameter(
    "depth", 0.0, 0.0, 10.0, per_channel=True, free=False, meaning="absorption along the normal, one way, as ln 1/T"
)


def brdf(geom: Geometry, *, n, depth, sigma) -> np.ndarray:
    """The finite part of the coat's own surface: none."""
    of_all = (geom.shape, np.shape(geom.wavelength), np.shape(n), np.shape(depth), np.shape(sigma))
    return np.zeros(np.broadcast_shapes(*of_all))


def mirror(geom: Geometry, *, n, depth, sigma) -> np.ndarray:
    """Reflectance of the coat's smooth surface at theta_i, dimensionless."""
    return fresnel.davies(fresnel.fresnel(geom.cos_i, n), geom.cos_i, sigma, geom.wavelength)


def rough(geom: Geometry, *, n, depth) -> np.ndarray:
    """A coat whose surface is a lobe of its own: nothing here."""
    return np.zeros(np.broadcast_shapes(geom.shape, np.shape(n), np.shape(depth)))


MODEL = Model(
    __name__,
    brdf,
    roles=("mirror",),
    mirror=mirror,
    parameters=(
        N,
        DEPTH,
        Parameter(
            "sigma",
            0.0,
            0.0,
            1.0,
            unit="um",
            free=False,
            meaning="rms height of the coat's surface",
            starts=(0.02, 0.1),
        ),
    ),
    summary="a clear coat over the laws after it: coated:lambertian darkens, coated:flakes is metallic paint",
    source="Fresnel; Saunderson 1942; Weidlich and Wilkie 2007",
    family="coat",
    cannot="leaves out light that steep bumps keep inside; no films thin enough for rainbow colours",
    formula=Formula(
        "",
        (
            (
                "mirror",
                "ci, n, k, sigma_by_wavelength",
                "fresnel(ci, n, k) * exp(-sq(4.0 * PI * sigma_by_wavelength * ci))",
            ),
        ),
        mirror="mirror(ci, {n}, 0.0, {waves})",
        numbers=lambda *, sigma, wavelength, **_: {"waves": sigma / wavelength},
    ),
)
ROUGH = replace(MODEL, brdf=rough, mirror=None, parameters=(N, DEPTH), formula=Formula(""))
OF_COAT = {"coat_n": "n", "coat_depth": "depth"}  # parameters of a coated law -> the coat's


@lru_cache
def over(base: Model) -> Model:
    """The law with a coat over it; its parameters, and `coat_n` and `coat_depth`."""
    if base.name == "coupled":
        raise InputError("coupled is a body under a coat already; coated:lambertian is the physical one")
    darkens = base.is_body and "albedo" in base.defaults()
    coated = _Coated(base, base.brdf, darkens)
    of_base = tuple(_parameter(p, darkens) for p in base.parameters)
    of_coat = (replace(N, name="coat_n"), replace(DEPTH, name="coat_depth"))
    return Model(
        base.module,
        coated.brdf,
        parameters=of_base + of_coat,
        roles=base.roles,
        summary=f"{base.summary}; under a clear coat",
        gradient=coated.gradient,
        mirror=_Coated(base, base.mirror, darkens).mirror if base.mirror else None,
        derived=(*base.derived, *((SEEN,) if darkens else ())),
        without=_reduced(base, darkens),
        breaks=base.breaks,
        source=f"{base.source}; {MODEL.source}",
        family=base.family,
        cannot=base.cannot,
        from_facets=_inside_facets(base, darkens),
        formula=_formula(base, darkens),
        base=base,
    )


SEEN = Derived(
    "seen_albedo",
    lambda *, albedo, coat_n, **_: coat.seen_albedo(albedo, coat_n),
    meaning="share of light that the body sends back through the coat at normal incidence",
)


def _parameter(p: Parameter, darkens: bool) -> Parameter:
    """A parameter of the base as it is under a coat: an index there stands off the coat's, at which a lobe vanishes."""
    if p.name == "n":
        return replace(p, default=4.0, low=N.default + 0.02, starts=(2.0, 4.0, 20.0))
    return replace(p, linear=p.linear and not darkens)


class _Coated:
    """A base's functions with a coat over them."""

    def __init__(self, base: Model, brdf: Callable[..., np.ndarray], darkens: bool, gate: bool = True):
        self.base, self.of_base, self.darkens, self.gate = base, brdf, darkens, gate

    def brdf(self, geom: Geometry, *, coat_n, coat_depth, **values) -> np.ndarray:
        """BRDF [1/sr], in the shape of `geom`."""
        inside, inner = coat.under(geom, coat_n)
        below = self.of_base(inner, **self._against(values, coat_n))
        if self.darkens:
            below = below + _again(values["albedo"], coat.returned(coat_n))[0]
        return self._before(inside, coat_n, coat_depth) * below

    def _before(self, inside: coat.Inside, n, depth):
        """What lets light in and out again."""
        gate = inside.gate if self.gate else ((1 - fresnel.f0(n)) / n) ** 2
        return gate * np.exp(-depth * inside.path) if np.any(depth) else gate + 0.0 * depth

    def _against(self, values, n):
        """The base's values with its index against the coat's."""
        return values | {name: values[name] / n for name in ("n", "k") if self.base.has_index}

    def gradient(self, geom: Geometry, names, *, coat_n, coat_depth, **values) -> dict[str, np.ndarray]:
        """Of the base's parameters, through its own derivatives; df/ddepth = -f (1/cos θi' + 1/cos θr').

        By the coat's index it is left to differences, since every angle inside changes with it.
        """
        inside, inner = coat.under(geom, coat_n)
        against = self._against(values, coat_n)
        asked, amplitude = [name for name in names if name in values], self.base.amplitude
        slopes = dict(self.base.gradient(inner, asked, **against)) if self.base.gradient else {}
        if amplitude and amplitude not in slopes:
            slopes[amplitude] = self.of_base(inner, **against | {amplitude: 1.0})
        if self.base.has_index:
            slopes |= {name: slopes[name] / coat_n for name in ("n", "k") if name in slopes}
        if self.darkens:
            slopes["albedo"] = slopes["albedo"] + _again(values["albedo"], coat.returned(coat_n))[1]
        before = self._before(inside, coat_n, coat_depth)
        found = {name: before * slope for name, slope in slopes.items()}
        if "coat_depth" in names:
            found["coat_depth"] = -inside.path * self.brdf(geom, coat_n=coat_n, coat_depth=coat_depth, **values)
        return found

    def mirror(self, geom: Geometry, *, coat_n, coat_depth, **values) -> np.ndarray:
        """Reflectance of the base's mirror part through the coat, both ways; only θi counts."""
        _, inner = coat.under(geom, coat_n)
        through = fresnel.one_minus_fresnel(geom.cos_i, coat_n) ** 2 * np.exp(-2 * coat_depth / inner.cos_i)
        return through * self.of_base(inner, **self._against(values, coat_n))


def _again(albedo, k):
    """What a body sends of the light that the coat sent down again, as Lambert's law would, and its slope by albedo."""
    rest = 1 - albedo * k
    return albedo**2 * k / (pi * rest), albedo * k * (2 - albedo * k) / (pi * rest * rest)


def _reduced(base: Model, darkens: bool) -> dict[str, Callable[..., np.ndarray]]:
    """What a scene may not need of the base, of the coat, or of both.

    darkening   a body's light that comes back once more
    gate        T as it is at the normal: enough where neither light nor eye is low
    """
    variants = {"": base.brdf, **base.without}
    found = {}
    for (out, brdf), dark, gate in product(variants.items(), (True, False) if darkens else (False,), (True, False)):
        left = [*filter(None, [out]), *(["darkening"] if darkens and not dark else []), *([] if gate else ["gate"])]
        if left:
            found["+".join(left)] = _Coated(base, brdf, dark, gate).brdf
    return found


# T = 2 c q (1/(c + q)² + n²/(n² c + q)²), q = n cos θ'
GATE = (
    ("under", "c, n", "sqrt(n * n - sin2(c))"),
    ("enters2", "c, q, n", "2.0 * c * q * (1.0 / sq(c + q) + sq(n / (n * n * c + q)))"),
    ("enters", "c, n", "enters2(c, under(c, n), n)"),
    (
        "gate",
        "ci, cr, n, depth",
        "enters(ci, n) * enters(cr, n) / (n * n) * exp(-depth * n * (1.0 / under(ci, n) + 1.0 / under(cr, n)))",
    ),
)


def _formula(base: Model, darkens: bool) -> Formula | None:
    """The base's formula at refracted directions, behind the gate."""
    if base.formula is None:
        return None
    uncoated = base.formula

    def numbers(*, wavelength, coat_n, coat_depth, **values):
        against = values | {name: values[name] / coat_n for name in ("n", "k") if base.has_index}
        more = uncoated.numbers(wavelength=wavelength / coat_n, **against) if uncoated.numbers else {}
        again = _again(values["albedo"], coat.returned(coat_n))[0] if darkens else 0.0
        return against | dict(more) | {"again": again}

    def inside(text: str) -> str:
        text = re.sub(r"\b(ci|cr)\b", r"under(\1, {coat_n}) / {coat_n}", text)
        return re.sub(r"\b(q|p)\b", r"\1 / ({coat_n} * {coat_n})", text)

    return Formula(
        f"gate(ci, cr, {{coat_n}}, {{coat_depth}}) * ({{again}} + {inside(uncoated.brdf)})" if uncoated.brdf else "",
        (*uncoated.functions, *GATE),
        mirror=f"sq(enters(ci, {{coat_n}})) * exp(-2.0 * {{coat_depth}} * {{coat_n}} / under(ci, {{coat_n}}))"
        f" * ({inside(uncoated.mirror)})"
        if uncoated.mirror
        else "",
        numbers=numbers,
    )


def _inside_facets(base: Model, darkens: bool):
    """Start values: a lobe that looks so wide lies n times narrower, a body that looks so bright is brighter."""

    def started(facets: Facets) -> dict:
        albedo = facets.albedo
        if darkens and albedo is not None:
            albedo = tuple(min(float(coat.dry_albedo(each, N.default)), 1.0) for each in albedo)
        return base.started(replace(facets, alpha=facets.alpha / N.default, albedo=albedo))

    return started
