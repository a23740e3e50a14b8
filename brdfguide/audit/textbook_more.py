"""More laws as their papers print them, in as many digits as asked: tails, polishes, shadows by integration, coats.

Written from the papers and with no shared step, as in `textbook`.
"""

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

import numpy as np
from mpmath import (
    acos,
    betainc,
    cos,
    cosh,
    erfc,
    exp,
    fabs,
    fdot,
    gamma,
    gammainc,
    lambertw,
    log,
    mp,
    mpf,
    pi,
    power,
    quad,
    sin,
    sinh,
    sqrt,
    tan,
    workdps,
)

from . import textbook, textbook_grain, textbook_shaders
from .textbook import WAVELENGTH, ExactDirections, poisson_sum, unpolarised

Law = Callable[..., Any]


def offset(p, sign=1):
    """|i_xy + sign r_xy|; what is left of the last digits in the mirror direction is 0."""
    found = sqrt((p.i[0] + sign * p.r[0]) ** 2 + (p.i[1] + sign * p.r[1]) ** 2)
    return found if found > mpf(10) ** (3 - mp.dps) else mpf(0)


def grooves(p):
    return min(mpf(1), 2 * p.cos_h * p.cos_i / p.cos_d, 2 * p.cos_h * p.cos_r / p.cos_d)


def abg(p, a, b, g):
    return a / (b + (power(offset(p), g) if g else 1))


def harvey_shack(p, b0, l, s):  # noqa: E741
    return b0 * power(1 + (offset(p) / l) ** 2, s / 2)


def abc(p, a, b, c, f0, wavelength=WAVELENGTH):
    two_dimensional = gamma((c + 1) / 2) / (2 * sqrt(pi) * gamma(c / 2)) * a * b
    spectrum = two_dimensional / power(1 + (b * offset(p) / wavelength) ** 2, (c + 1) / 2)
    return 16 * pi**2 / wavelength**4 * p.cos_i * p.cos_r * f0 * spectrum


def stam(p, sigma, slope, ratio, axis, f0, wavelength=WAVELENGTH):
    tau_x, tau_y = sigma / slope, ratio * sigma / slope
    v = [a + b for a, b in zip(p.i, p.r, strict=True)]
    v_x, v_y = v[0] * cos(axis) + v[1] * sin(axis), v[1] * cos(axis) - v[0] * sin(axis)
    g = (2 * pi * sigma * v[2] / wavelength) ** 2
    y = (pi / wavelength) ** 2 * ((tau_x * v_x) ** 2 + (tau_y * v_y) ** 2)
    cosine = sum(a * b for a, b in zip(p.i, p.r, strict=True))
    before = f0 * (1 + cosine) ** 2 * pi * tau_x * tau_y / (wavelength**2 * v[2] ** 2 * p.cos_i * p.cos_r)
    return before * poisson_sum(g, y)


def facets(p, density, hidden, n, k, scale):
    """F D/(4 cos θi cos θr (1 + Λi + Λr)), from P(t) of the slopes and the cos θ Λ of a polar angle."""
    hiding = hidden(p.theta_i) / p.cos_i + hidden(p.theta_r) / p.cos_r
    return scale * unpolarised(p.cos_d, n, k) * density(p.tan2_h) / (4 * p.cos_h**4 * p.cos_i * p.cos_r * (1 + hiding))


def student_t(p, alpha, g, n, k, scale):
    w = sqrt(g - 1) * alpha

    def hidden(theta):
        return hidden_by_student(theta, w, g, mp.prec)

    return facets(p, lambda t: power(1 + t / w**2, -g) / (pi * alpha**2), hidden, n, k, scale)


@lru_cache(maxsize=4096)
def hidden_by_student(theta, w, g, prec):
    """∫ (x - c) p(x) dx of Student's density along a line, by its mean beyond c and its share beyond c; to `prec`
    bits."""
    if theta == 0:
        return mpf(0)
    norm = gamma(g - mpf(1) / 2) / (sqrt(pi) * gamma(g - 1))
    z = 1 / (tan(theta) * w)
    x = 1 / (1 + z * z)
    mean = norm * power(x, g - mpf(3) / 2) / (2 * (g - mpf(3) / 2))
    beyond = betainc(g - 1, mpf(1) / 2, 0, x, regularized=True) / 2
    return w * sin(theta) * (mean - z * beyond)


def ggx_ms(p, alpha, n, k, scale):
    """GGX and what several facets send; its albedos by Gauss's rule over both angles, to ten digits for wide lobes."""
    e_i, e_r = (mpf(_albedo_of_facets(float(each), float(alpha))) for each in (p.theta_i, p.theta_r))
    mean_e, mean_f = mpf(_mean_albedo_of_facets(float(alpha))), _mean_reflected(n, k, mp.prec)
    colour = mean_f**2 * mean_e / (1 - mean_f * (1 - mean_e))
    between = (1 - e_i) * (1 - e_r) / (pi * (1 - mean_e))
    return textbook.ggx_lobe(p, alpha, n, k, 1) * scale + scale * colour * between


@lru_cache(maxsize=4096)
def _albedo_of_facets(theta, alpha):
    nodes, weights = np.polynomial.legendre.leggauss(200)
    theta_r, phi = (nodes + 1)[:, None] * np.pi / 4, (nodes + 1) * np.pi / 2
    i = np.array([np.sin(theta), 0.0, np.cos(theta)])
    r = np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r) + 0 * phi
    tilt = ((i[0] + r[0]) ** 2 + r[1] ** 2) / (i[2] + r[2]) ** 2
    hidden = [(np.sqrt(1 + alpha**2 * np.tan(each) ** 2) - 1) / 2 for each in (theta, theta_r)]
    d = alpha**2 * (1 + tilt) ** 2 / (np.pi * (alpha**2 + tilt) ** 2)
    f = d / (4 * i[2] * r[2] * (1 + hidden[0] + hidden[1]))
    return np.pi**2 / 4 * (weights @ (f * np.cos(theta_r) * np.sin(theta_r)) @ weights)


@lru_cache(maxsize=64)
def _mean_albedo_of_facets(alpha):
    cosines, of_cosines = np.polynomial.legendre.leggauss(60)
    roots = (cosines + 1) / 2
    pairs = zip(roots, of_cosines, strict=True)
    return float(sum(w * 2 * x**3 * _albedo_of_facets(float(np.arccos(x * x)), alpha) for x, w in pairs))


@lru_cache(maxsize=64)
def _mean_reflected(n, k, prec):
    """F̄; to `prec` bits."""
    return quad(lambda c: 2 * c * unpolarised(c, n, k), [0, mpf("0.01"), mpf("0.1"), 1])


def coated_body(p, albedo, coat_n):
    """A Lambertian body under a clear coat, by the integral of Fresnel's reflectance over its sharp rise as well."""
    through = (1 - unpolarised(p.cos_i, coat_n)) * (1 - unpolarised(p.cos_r, coat_n)) / coat_n**2
    return through * albedo / pi / (1 - albedo * sent_down(coat_n))


@lru_cache(maxsize=64)
def sent_down(coat_n):
    """K = 1 - (1 - F̄)/n² of a body's light that the coat sends down again."""
    edge = sqrt(2 * fabs(coat_n - 1))
    ends = [mpf(0), *sorted(min(edge * mpf(10) ** step, mpf(1) / 2) for step in (-2, -1, 0, 1, 2)), mpf(1)]
    with workdps(40):
        mean = quad(lambda c: 2 * c * unpolarised(c, coat_n), sorted(set(ends)))
    return 1 - (1 - mean) / coat_n**2


@lru_cache(maxsize=4096)
def refracted(p, n, prec):
    """The pair inside a smooth coat of index n: the same azimuths, sines over n; to `prec` bits."""

    def inside(w):
        return w[0] / n, w[1] / n, sqrt(1 - (w[0] ** 2 + w[1] ** 2) / n**2)

    return ExactDirections.from_vectors(inside(p.i), inside(p.r))


def coated(p, law, values, n, depth, wavelength=WAVELENGTH):
    """A law under a clear coat (Saunderson 1942; Weidlich and Wilkie 2007 with n² restored); a body's light comes back
    from below as often as the coat sends it down."""
    inside = refracted(p, n, mp.prec)
    own = {key: value / n if key in ("n", "k") else value for key, value in values.items()}
    f = evaluated(law, inside, own, wavelength / n)
    if law in BODIES:
        down, albedo = sent_down(n), own["albedo"]
        f += albedo**2 * down / (pi * (1 - albedo * down))
    for c in (p.cos_i, p.cos_r):
        f *= (1 - unpolarised(c, n)) / n
    return f * exp(-depth * (1 / inside.cos_i + 1 / inside.cos_r))


def evaluated(law, p, values, wavelength=WAVELENGTH):
    """One law [1/sr], by its name and the bare names of its parameters."""
    form = LAWS.get(law) or ROUGHER[law]
    return form(p, **values, wavelength=wavelength) if law in WAVES else form(p, **values)


def he_torrance(p, sigma, slope, n, k, scale, wavelength=WAVELENGTH):
    """He, Torrance, Sillion and Greenberg 1991 as the errata restore it, from angles; the sum by `poisson_sum`."""
    (s_i, k_i), (s_r, k_r) = (seen_of_heights(each, slope, mp.prec) for each in (p.theta_i, p.theta_r))
    left = heights_left(k_i + k_r, mp.prec)
    g = (2 * pi * sigma * left * p.v[2] / wavelength) ** 2
    x = (2 * pi * sigma / slope / wavelength) ** 2 * (p.v[0] ** 2 + p.v[1] ** 2)
    d = pi**2 * (sigma / slope) ** 2 / (4 * wavelength**2) * poisson_sum(g, x / 4)
    height = (sum(a * a for a in p.v) / p.v[2]) ** 2  # v² = 2 (1 + cos of the angle between)
    return scale * unpolarised(p.cos_d, n, k) * s_i * s_r / (p.cos_i * p.cos_r) * height * d / pi


@lru_cache(maxsize=16384)
def heights_left(k, prec):
    """Of the rms height what the pair of directions sees, from K of both; to `prec` bits."""
    return 1 / sqrt(1 + lambertw(k**2 / (8 * pi)).real)


@lru_cache(maxsize=4096)
def seen_of_heights(theta, slope, prec):
    """S and K = tan θ erfc(ν) of a Gaussian surface, ν = cot θ/(2 slope); to `prec` bits."""
    if theta == 0 or 1 / tan(theta) > 60 * slope:  # erfc(30) is 1e-393
        return mpf(1), mpf(0)
    nu = 1 / (2 * slope * tan(theta))
    h = erfc(-nu) / 2
    return h / (h + exp(-nu * nu) / (2 * sqrt(pi) * nu)), tan(theta) * erfc(nu)


def he_mirror(p, sigma, slope, n, k, scale, wavelength=WAVELENGTH):
    """Reflectance that He and Torrance leave to the mirror direction at θi."""
    s, k_i = seen_of_heights(p.theta_i, slope, mp.prec)
    left = heights_left(2 * k_i, mp.prec)
    g = (4 * pi * sigma * left * p.cos_i / wavelength) ** 2
    return scale * unpolarised(p.cos_i, n, k) * exp(-g) * s**2


def smooth_mirror(p, n, k, sigma, wavelength=WAVELENGTH):
    """Reflectance of a smooth interface of rms height sigma at θi (Davies 1954)."""
    return unpolarised(p.cos_i, n, k) * exp(-((4 * pi * sigma * p.cos_i / wavelength) ** 2))


def ggx_aniso(p, alpha_x, alpha_y, axis, n, k, scale):
    def turned(w):
        return w[0] * cos(axis) + w[1] * sin(axis), w[1] * cos(axis) - w[0] * sin(axis), w[2]

    def hidden(w):
        x, y, z = turned(w)
        return (sqrt(1 + ((alpha_x * x) ** 2 + (alpha_y * y) ** 2) / z**2) - 1) / 2

    h = turned(p.h)
    d = 1 / (pi * alpha_x * alpha_y * ((h[0] / alpha_x) ** 2 + (h[1] / alpha_y) ** 2 + h[2] ** 2) ** 2)
    return scale * unpolarised(p.cos_d, n, k) * d / (4 * p.cos_i * p.cos_r * (1 + hidden(p.i) + hidden(p.r)))


def flakes(p, flake, tilt):
    return flake * textbook.ggx_lobe(p, tilt, 1, mpf(10) ** 40, 1)  # F of a perfect conductor is 1


def sheen(p, rho, spread):
    """Estevez and Kulla's distribution over the masking of Neubelt and Pettineo."""
    power = 1 / spread
    fibres = (2 + power) * sqrt(1 - p.cos_h**2) ** power / (2 * pi)
    return rho * fibres / (4 * (p.cos_i + p.cos_r - p.cos_i * p.cos_r))


def retro(p, rho, alpha):
    """GGX's lobe of the light's mirror image."""
    turned = ExactDirections.from_vectors((-p.i[0], -p.i[1], p.i[2]), p.r)
    return rho * textbook.ggx_lobe(turned, alpha, 1, mpf(10) ** 40, 1)


def flakes_beckmann(p, flake, tilt):
    return flake * textbook.beckmann_lobe(p, tilt, 1, mpf(10) ** 40, 1)


@lru_cache(maxsize=4096)
def rises(theta, prec):
    """Nodes t and weights, for ∫ P(t) of the mean rise of slopes √t over a line of slope cot θ, over size and azimuth;
    to `prec` bits. The size runs along cot θ + exp(½π sinh u), whose double exponential ends hold seventeen digits of a
    density that falls with a power (Takahasi and Mori 1974)."""
    c, found = 1 / tan(theta), []
    for place in range(-64, 80):
        u = mpf(place) / 20
        beyond = exp(pi / 2 * sinh(u))
        r = c + beyond
        rise = 2 * (sqrt(beyond * (r + c)) - c * acos(c / r))
        found.append((r * r, sin(theta) * rise * r * beyond * pi / 2 * cosh(u) / 20))
    return found


def hidden_by(slopes, theta, prec):
    """cos θ Λ of slopes with the density P(t); to `prec` bits."""
    return fdot((slopes(t), weight) for t, weight in rises(theta, prec)) if theta else mpf(0)


@lru_cache(maxsize=64)
def gtr_slopes(alpha, gamma, prec):
    """P(t); to `prec` bits."""
    c = (alpha**2 - 1) / log(alpha**2) if gamma == 1 else (gamma - 1) * (alpha**2 - 1) / (1 - alpha ** (2 - 2 * gamma))
    return lambda t: c / pi * power(1 + t, gamma - 2) / power(alpha**2 + t, gamma)


@lru_cache(maxsize=64)
def sgd_slopes(alpha, p, prec):
    """P(t); to `prec` bits."""
    constant = 1 / (alpha * gammainc(1 - p, alpha)) / pi

    def slopes(t):
        x = alpha + t / alpha
        return constant * exp(-x) * power(x, -p)

    return slopes


@lru_cache(maxsize=16384)
def hidden_by_slopes(slopes, first, second, theta, prec):
    """`hidden_by` of a density with two numbers, once for each angle."""
    return hidden_by(slopes(first, second, prec), theta, prec)


def facets_by(slopes, pair, first, second, n, k, scale):
    """`facets` of a density with two numbers."""
    hidden = partial(hidden_by_slopes, slopes, first, second, prec=mp.prec)
    return facets(pair, slopes(first, second, mp.prec), hidden, n, k, scale)


def gtr(p, alpha, gamma, n, k, scale):
    return facets_by(gtr_slopes, p, alpha, gamma, n, k, scale)


def sgd(pair, alpha, p, n, k, scale):
    return facets_by(sgd_slopes, pair, alpha, p, n, k, scale)


def sgd_published(pair, rho_s, alpha, p, f0, f_normal, theta0, c, k, lam):
    def visible(theta):
        beyond = max(mpf(0), theta - theta0)
        return min(max(1 + lam * (1 - exp(c * power(beyond, k))), mpf(0)), mpf(1))

    x = alpha + pair.tan2_h / alpha
    d = exp(-x) * power(x, -p) / (alpha * gammainc(1 - p, alpha) * pi * pair.cos_h**4)
    f = f0 - (f0 - f_normal) * pair.cos_d + (1 - f0) * (1 - pair.cos_d) ** 5
    return rho_s / pi * f * d * visible(pair.theta_i) * visible(pair.theta_r) / (pair.cos_i * pair.cos_r)


def low_smooth(p, a, b, c, n, k):
    return a * unpolarised(sqrt(1 - offset(p, -1) ** 2 / 4), n, k) * power(1 + b * offset(p) ** 2, -c)


def low_smooth_half(p, a, b, c, n, k):
    return a * unpolarised(p.cos_d, n, k) * power(1 + b * offset(p) ** 2, -c)


def low_facet(p, a, b, c, n, k):
    shape = power(1 + b * (1 - p.cos_h), -c)
    return a * unpolarised(p.cos_d, n, k) * grooves(p) / (pi * p.cos_i * p.cos_r) * shape


LAWS: dict[str, Law] = {
    **textbook.LAWS,
    **textbook_grain.LAWS,
    **textbook_shaders.LAWS,
    "abg": abg,
    "harvey-shack": harvey_shack,
    "abc": abc,
    "student-t": student_t,
    "ggx-aniso": ggx_aniso,
    "flakes": flakes,
    "retro": retro,
    "sheen": sheen,
    "flakes-beckmann": flakes_beckmann,
    "sgd-published": sgd_published,
    "low-smooth": low_smooth,
    "low-smooth-half": low_smooth_half,
    "low-facet": low_facet,
}


WAVES = {"he-torrance", "he-torrance-aniso", "abc", "stam"}  # which know the wavelength
BODIES = {"lambertian", "oren-nayar", "eon"}
MIRRORS: dict[str, Law] = {
    "he-torrance": he_mirror,
    "he-torrance-aniso": textbook_grain.he_mirror_aniso,
    "stam": textbook_grain.stam_mirror,
    "mirror": smooth_mirror,
    **textbook_shaders.MIRRORS,
}  # reflectance left to the mirror direction

# compared in files of their own: a sum and integrals that hold fewer than thirteen digits, or take their time
ROUGHER: dict[str, Law] = {
    **textbook_grain.ROUGHER,
    "he-torrance": he_torrance,
    "stam": stam,
    "gtr": gtr,
    "sgd": sgd,
    "ggx-ms": ggx_ms,
}


def exact_value(name, angles, values, **more):
    """The BRDF of law `name` at (theta_i, phi_i, theta_r, phi_r) [deg], its parameters taken as the doubles they
    are, at 50 digits.
    """
    with workdps(50):
        return (LAWS | ROUGHER)[name](
            ExactDirections(*angles), **{key: mpf(float(v)) for key, v in (values | more).items()}
        )
