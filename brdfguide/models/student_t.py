"""Facets whose slopes follow Student's t-distribution, with their own Smith masking and Fresnel: a tail of any length.

    f = F D/(4 cos θi cos θr (1 + Λi + Λr))
    D = (1 + t)² (1 + t/w²)^-g/(π alpha²),   w² = (g - 1) alpha²,   t = tan²δ, δ from normal to half vector
    cos θ Λ = w sin θ N q^(g - 3/2) J(s),   s = cos θ/ρ, q = (w sin θ/ρ)², ρ² = cos²θ + w² sin²θ
    J(s) = ∫ x (1 + 2 s x + x²)^(½ - g) dx from 0 on,   1/N = 2 ∫ (1 + x²)^(½ - g) dx from 0 on

g = 2 is `ggx`, g to infinity `beckmann`, between them every shape, and below 2 longer tails than GGX's: the shape is a
number with an error, not a choice of names. At g = 3/2 the mean slope is infinite and everything is hidden, so g lies
above. J is kept as a Chebyshev series for each g.

Source: Ribardière, Bringier, Meneveaux and Simonot 2017, "STD: Student's t-distribution of slopes for microfacet based
BSDFs"; the integral of the masking in this form is ours.
"""

from functools import lru_cache
from math import pi

import numpy as np

from ..formed import formed
from ..numerics import chebyshev
from ..physics import fresnel
from ..physics.geometry import Directions, Geometry
from ..records import dataclass
from ._microfacet import INDEX, gradient_by, reduced
from .facts import Candidacy, Formula, coefficients, polynomial
from .model import Extreme, Model, Parameter, Pin, at

OCTAVE_NODES = 16  # along the logarithm of g - 3/2
NODES = 40  # of the Chebyshev series: 31 hold J to 1e-14 at g = 1000, 10 at g = 2
STEP = 0.1  # of the trapezoidal rule
WIDE_STEP = 0.15  # the same to 3e-15 where p is small
WIDE_UP_TO = 5.0  # this p
FEW = 2048  # directions, of which those of light and detector are looked up together
DEGREE = 14  # of the polynomial that shaders have for it: 5e-7


def distribution(geom: Geometry, alpha, g) -> np.ndarray:
    """D, facets per solid angle [1/sr]; its projection integrates to 1."""
    return (geom.sec2_h / alpha) ** 2 / pi * np.exp(-g * np.log1p(geom.tan2_h / ((g - 1) * alpha * alpha)))


def shape(geom: Geometry, alpha, g) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    width = np.sqrt(g - 1) * alpha
    (hidden_i,), (hidden_r,) = _hidden_both(geom, width, g)
    return distribution(geom, alpha, g) / (4 * (geom.cos_cos + geom.cos_r * hidden_i + geom.cos_i * hidden_r))


def _hidden_both(geom: Geometry, width, g, derivatives: bool = False):
    """`_hidden` of light and detector; of few directions in one call, which costs as much as the numbers in it."""
    joined = geom.formed(_joined)
    if joined is None or any(np.ndim(each) and np.shape(each)[-1] > 1 for each in (width, g)):
        return tuple(
            _hidden(cos, sin, width, g, derivatives)
            for cos, sin in ((geom.cos_i, geom.sin_i), (geom.cos_r, geom.sin_r))
        )
    cos, sin = joined
    found, count = _hidden(cos, sin, width, g, derivatives), cos.shape[-1] // 2
    return tuple(tuple(each[..., part] for each in found) for part in (slice(count), slice(count, None)))


@formed
def _joined(to: Directions) -> tuple[np.ndarray, np.ndarray] | None:
    """cos θ and sin θ of the light and behind them those of the detector; None of many directions, or of one."""
    if np.ndim(to.cos_i) == 0 or not 1 < np.shape(to.cos_i)[-1] <= FEW or np.shape(to.cos_i) != np.shape(to.cos_r):
        return None
    return np.concatenate((to.cos_i, to.cos_r), axis=-1), np.concatenate((to.sin_i, to.sin_r), axis=-1)


def _hidden(cos, sin, width, g, derivatives: bool = False):
    """cos θ Λ; with `derivatives` also those by the width w and by g, at fixed w."""
    across = width * sin
    rho = np.sqrt(cos * cos + across * across)
    j, *by_p = chebyshev.by_value(_table, cos / rho, 2 if derivatives else 1, g)
    ln_q = 2 * np.log(np.where(across > 0, across, 1.0) / rho)
    before = np.where(across > 0, sin * np.exp((g - 1.5) * ln_q), 0.0)
    hidden = width * before * j
    if not derivatives:
        return (hidden,)
    mean = np.reshape([_mean(each) for each in np.ravel(g).tolist()], np.shape(g))
    return hidden, before * mean, hidden * ln_q + width * before * by_p[0]


@lru_cache(maxsize=256)
def _table(g: float):
    """N J and its derivative by g, as functions of s: a search asks for another g at every step, and octaves of g - 3/2
    know the series of all in them."""
    octave = int(np.floor(np.log2(g - 1.5)))
    cell = _octave(octave)
    return chebyshev.Stretched(cell.at(2 * (np.log2(g - 1.5) - octave) - 1), cell.variable)


@lru_cache(maxsize=32)
def _octave(octave: int) -> "_Octave":
    narrow = _narrow(1.5 + 2.0 ** (octave + 0.5))
    series = [_series(1.5 + 2.0 ** (octave + 0.5 * (t + 1)), narrow) for t in chebyshev.nodes(OCTAVE_NODES).tolist()]
    return _Octave(chebyshev.transform(OCTAVE_NODES) @ np.reshape(series, (OCTAVE_NODES, -1)), narrow)


@dataclass(frozen=True, eq=False)
class _Octave:
    """The tables of an octave of g - 3/2."""

    polynomials: np.ndarray  # of each Chebyshev coefficient, as Chebyshev's in t, -1..1 along the logarithm
    narrow: float

    def at(self, t: float) -> chebyshev.Series:
        known = np.cos(np.arange(OCTAVE_NODES) * np.arccos(np.clip(t, -1, 1))) @ self.polynomials
        return chebyshev.chopped(known.reshape(2, NODES))

    def variable(self, s):
        return 2 * (1 + self.narrow) * (s / (s + self.narrow)) - 1


def _series(g: float, narrow: float) -> np.ndarray:
    """Chebyshev coefficients of N J and of its derivative by g, (2, NODES), in s/(s + narrow) stretched to -1..1."""
    p, end = g - 0.5, 1 / (1 + narrow)
    norm, by_norm = (each[0] for each in _integrals(p, np.zeros(1))[:2])  # 1/2N
    share = 0.5 * end * (chebyshev.nodes(NODES) + 1)
    _, _, j, by_j = _integrals(p, narrow * share / (1 - share))
    return np.stack([j, by_j - j * by_norm / norm]) / (2 * norm) @ chebyshev.transform(NODES).T


def _narrow(g: float) -> float:
    """s/(s + narrow) is the variable in which J looks alike for every g."""
    return min(1.0, 1.5 / np.sqrt(g - 0.5))


@lru_cache(maxsize=256)
def _mean(g: float) -> float:
    """N/(2 (g - 3/2)): w times it is half the mean slope along a line."""
    return float(0.25 / (_integrals(g - 0.5, np.zeros(1))[0][0] * (g - 1.5)))


def _integrals(p: float, s: np.ndarray):
    """K, dK/dp, J and dJ/dp, K = ∫ (1 + 2 s x + x²)^-p dx, J the same with x dx, by even nodes of y, x ~ e^(y - e^-y).

    For p below 2, where J's tail is long, J = 1/(2 (p - 1)) - s K.
    """
    step = WIDE_STEP if p < WIDE_UP_TO else STEP
    y = np.arange(-3.9, 3 + 38 / min(2 * p - 1, 8.0), step)
    grown, scale = np.exp(y - np.exp(-y)), np.sqrt(p) + p * s
    x = grown / scale[:, None]
    ln_base = np.log1p(x * (2 * s[:, None] + x))
    falls = np.exp(-p * ln_base)
    falls_by_p = -falls * ln_base
    dx = grown * (1 + np.exp(-y)) * step  # of x times its scale, and x dx of its square
    k, by_k = falls @ dx / scale, falls_by_p @ dx / scale
    if p < 2:
        half = 0.5 / (p - 1)
        return k, by_k, half - s * k, -half / (p - 1) - s * by_k
    return k, by_k, falls @ (grown * dx) / scale**2, falls_by_p @ (grown * dx) / scale**2


def brdf(geom: Geometry, *, alpha, g, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * shape(geom, alpha, g)


def gradient(geom: Geometry, names, *, alpha, g, n, k, scale) -> dict[str, np.ndarray]:
    """d ln D/dalpha = (2/alpha) (g u/(1 + u) - 1), d ln D/dg = g u/((g - 1)(1 + u)) - ln(1 + u), u = t/w²; and of the
    masking."""
    width = np.sqrt(g - 1) * alpha
    (hidden_i, by_width_i, by_g_i), (hidden_r, by_width_r, by_g_r) = _hidden_both(geom, width, g, True)
    masking = geom.cos_cos + geom.cos_r * hidden_i + geom.cos_i * hidden_r
    by_width = (geom.cos_r * by_width_i + geom.cos_i * by_width_r) / masking
    by_g = (geom.cos_r * by_g_i + geom.cos_i * by_g_r) / masking
    u = geom.tan2_h / (width * width)
    share = g * (u / (1 + u))
    by = {
        "alpha": (2 / alpha) * (share - 1) - by_width * (width / alpha),
        "g": share / (g - 1) - np.log1p(u) - by_width * (0.5 * width / (g - 1)) - by_g,
    }
    return gradient_by(geom, names, distribution(geom, alpha, g) / (4 * masking), by, n, k, scale)


def _numbers(*, alpha, g, **_) -> dict[str, float]:
    """What a shader needs besides: w, `narrow`, and N J as a polynomial in s/(s + narrow), stretched to -1..1."""
    narrow = _narrow(float(g))

    def masking(x):
        share = 0.5 * (x + 1) / (1 + narrow)
        return _table(float(g))(narrow * share / (1 - share), 1)[0]

    series = chebyshev.powers(masking, DEGREE)
    return {"w": np.sqrt(g - 1) * alpha, "narrow": narrow} | {f"c{i}": each for i, each in enumerate(series)}


def _masking_of(cos: str) -> str:
    """N J as a shader calls it."""
    return f"polynomial{DEGREE}(student_t_x({cos}, {{w}}, {{narrow}}), {coefficients(DEGREE)})"


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.2,
            1e-4,
            1.5,
            log=True,
            meaning="facet slope; as GGX's for g = 2 and Beckmann's for large g",
            starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8),
        ),
        Parameter(
            "g",
            2.0,
            1.55,
            1000.0,
            log=True,
            origin=1.5,
            meaning="shape: 2 is GGX, large is Beckmann, below 2 the tail is longer than GGX's",
            starts=(1.65, 2.0, 3.0, 8.0),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(shape, distribution),
    summary="tails of any length between Beckmann's and beyond GGX's, Fresnel, masking: one number more than ggx",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.12, "g": 3.3, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.669767029839602209,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha": 0.5, "g": 1.7, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=0.742920114411482501,
            source="50 digits",
        ),
        Pin(
            at(85, 88),
            {"alpha": 0.3, "g": 60.0, "n": 1.5, "k": 0.0, "scale": 1.0},
            f=57.9370564674998469,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("longest tail, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1.5, "g": 1.55}),
        Extreme("nearly Beckmann: underflows", at(10, -80), {"alpha": 1e-3, "g": 1000.0}, f=0.0),
        Extreme("at the normal, where tan is 0", at(0, 0), {"alpha": 1.5}),
    ),
    source="Ribardière, Bringier, Meneveaux and Simonot 2017",
    family="facets",
    cannot="shows no mirror image; where it is very rough (alpha near 1) up to 10 % of the light is missing",
    candidacy=Candidacy(
        95, bare=True, contains={"ggx": {"g": 2.0}, "beckmann": {"g": 30.0}}, adds="a tail of free length"
    ),
    formula=Formula(
        "{scale} * student_t(ci, cr, q, {alpha}, {g}, {w}, "
        + ", ".join(f"student_t_hides({c}, {{g}}, {{w}}, {_masking_of(c)})" for c in ("ci", "cr"))
        + ", {n}, {k})",
        (
            polynomial(DEGREE),
            ("student_t_x2", "s, narrow", "2.0 * (1.0 + narrow) * s / (s + narrow) - 1.0"),
            ("student_t_x", "c, w, narrow", "student_t_x2(c / sqrt(c * c + w * w * sin2(c)), narrow)"),
            (
                "student_t_ln_q",
                "c2, y",
                "choose(y - c2, ln1m(c2 / (c2 + y)), log(most(y / (c2 + y), 1.0e-37)))",
            ),
            (
                "student_t_hides",
                "c, g, w, j",
                "w * sqrt(sin2(c)) * exp((g - 1.5) * student_t_ln_q(c * c, w * w * sin2(c))) * j",
            ),
            (
                "student_t",
                "ci, cr, q, a, g, w, hi, hr, n, k",
                "fresnel(cosd(ci, cr, q), n, k) * exp(-g * ln1m(-tan2h(ci, cr, q) / (w * w)))"
                " / (4.0 * PI * a * a * sq(cos2h(ci, cr, q)) * (ci * cr + cr * hi + ci * hr))",
            ),
        ),
        numbers=_numbers,
    ),
)
