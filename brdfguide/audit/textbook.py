"""The laws as textbooks print them, from angles in degrees, in as many digits as asked: what ours are compared with.

Written from the papers and with no shared step: half vectors from unit vectors, Fresnel from complex amplitudes. No
code of the models, of the fit or of the physics is called, so that a mistake there is not made here again. mpmath's
precision is the caller's: 50 digits stand for about 35 after the cancellations that double precision would not survive.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from mpmath import (
    acos,
    atan2,
    cos,
    erfc,
    exp,
    fabs,
    lambertw,
    log,
    loggamma,
    mp,
    mpc,
    mpf,
    pi,
    power,
    radians,
    sin,
    sqrt,
    tan,
)  # fmt: skip
from mpmath.libmp import to_fixed

WAVELENGTH = mpf(0.55)  # µm, as the double it is


class ExactDirections:
    """One pair of directions from degrees, taken exactly."""

    def __init__(self, theta_i, phi_i, theta_r, phi_r):
        (self.theta_i, self.phi_i, self.theta_r, self.phi_r) = (
            radians(mpf(float(a))) for a in (theta_i, phi_i, theta_r, phi_r)
        )
        self._form(_unit(self.theta_i, self.phi_i), _unit(self.theta_r, self.phi_r))

    @classmethod
    def from_vectors(cls, i, r) -> "ExactDirections":
        """The same from unit vectors toward the light and the detector."""
        pair = cls.__new__(cls)
        pair.theta_i, pair.theta_r = acos(i[2]), acos(r[2])
        pair.phi_i, pair.phi_r = atan2(i[1], i[0]), atan2(r[1], r[0])
        pair._form(tuple(i), tuple(r))
        return pair

    def _form(self, i, r):
        self.i, self.r = i, r
        self.cos_i, self.cos_r = i[2], r[2]
        self.v = [a + b for a, b in zip(i, r, strict=True)]
        length = sqrt(sum(a * a for a in self.v))
        self.h = [a / length for a in self.v]
        self.cos_h, self.cos_d = self.h[2], sum(a * b for a, b in zip(self.h, i, strict=True))
        self.cos_m = -i[0] * r[0] - i[1] * r[1] + i[2] * r[2]
        self.tan2_h = 1 / self.cos_h**2 - 1


def _unit(theta, phi):
    return (sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))


def unpolarised(cos_t, n, k=0):
    """Fresnel's reflectance; by real amplitudes where they are real."""
    return _unpolarised(cos_t if isinstance(cos_t, mpf) else mpf(cos_t), n, k, mp.prec)


@lru_cache(maxsize=16384)
def _unpolarised(c, n, k, prec):
    """To `prec` bits, once where only the shape of a lobe is another."""
    n = mpf(n) if not k and n >= 1 else mpc(n, abs(k))
    square = n * n
    q, within = sqrt(square - 1 + c * c), square * c
    r_s, r_p = (c - q) / (c + q), (within - q) / (within + q)
    if isinstance(r_s, mpf):
        return (r_s * r_s + r_p * r_p) / 2
    return (r_s.real**2 + r_s.imag**2 + r_p.real**2 + r_p.imag**2) / 2


def lambertian(p, albedo):
    return mpf(albedo) / pi


def phong(p, ks, exponent):
    return ks * power(p.cos_m, exponent) / p.cos_i if p.cos_m > 0 else mpf(0)


def phong_lewis(p, ks, exponent):
    return ks * (exponent + 2) / (2 * pi) * power(p.cos_m, exponent) if p.cos_m > 0 else mpf(0)


def blinn(p, ks, exponent):
    return (
        ks
        * (exponent + 2)
        * (exponent + 4)
        / (8 * pi * (exponent + power(2, -exponent / 2)))
        * power(p.cos_h, exponent)
    )


def ward(p, rho_s, alpha):
    return rho_s * exp(-p.tan2_h / alpha**2) / (4 * pi * alpha**2 * sqrt(p.cos_i * p.cos_r))


def ward_duer(p, rho_s, alpha):
    return rho_s * exp(-p.tan2_h / alpha**2) / (4 * pi * alpha**2 * p.cos_i * p.cos_r)


def ward_gmd(p, rho_s, alpha):
    return rho_s * exp(-p.tan2_h / alpha**2) / (pi * alpha**2) * sum(a * a for a in p.v) / p.v[2] ** 4


def lafortune(p, ks, tilt, exponent):
    longest = max(cos(tilt), fabs(sin(tilt)))
    c_xy, c_z = -sin(tilt) / longest, cos(tilt) / longest
    base = c_xy * (p.i[0] * p.r[0] + p.i[1] * p.r[1]) + c_z * p.cos_i * p.cos_r
    return ks * power(base, exponent) if base > 0 else mpf(0)


def cook_torrance(p, alpha, n, k, scale):
    d = exp(-p.tan2_h / alpha**2) / (pi * alpha**2 * p.cos_h**4)
    g = min(mpf(1), 2 * p.cos_h * p.cos_i / p.cos_d, 2 * p.cos_h * p.cos_r / p.cos_d)
    return scale * unpolarised(p.cos_d, n, k) * d * g / (4 * p.cos_i * p.cos_r)


def beckmann_lobe(p, alpha, n, k, scale):
    d = exp(-p.tan2_h / alpha**2) / (pi * alpha**2 * p.cos_h**4)
    hiding = 1 + hidden_by_gauss(p.theta_i, alpha, mp.prec) + hidden_by_gauss(p.theta_r, alpha, mp.prec)
    return scale * unpolarised(p.cos_d, n, k) * d / (4 * p.cos_i * p.cos_r * hiding)


@lru_cache(maxsize=16384)
def hidden_by_gauss(theta, alpha, prec):
    """Λ of Gaussian slopes; to `prec` bits, once for each angle of a scan."""
    steep = alpha * tan(theta)
    if steep < mpf("0.001"):
        return mpf(0)  # less than exp(-1e6)
    x = 1 / steep
    return (exp(-x * x) / (x * sqrt(pi)) - erfc(x)) / 2


def ggx_lobe(p, alpha, n, k, scale):
    d = alpha**2 / (pi * p.cos_h**4 * (alpha**2 + p.tan2_h) ** 2)
    hiding = 1 + hidden_by_ggx(p.theta_i, alpha, mp.prec) + hidden_by_ggx(p.theta_r, alpha, mp.prec)
    return scale * unpolarised(p.cos_d, n, k) * d / (4 * p.cos_i * p.cos_r * hiding)


@lru_cache(maxsize=16384)
def hidden_by_ggx(theta, alpha, prec):
    """Λ of GGX's slopes; to `prec` bits, once for each angle of a scan."""
    return (sqrt(1 + (alpha * tan(theta)) ** 2) - 1) / 2


def oren_nayar(p, albedo, spread):
    a, b, s2 = max(p.theta_i, p.theta_r), min(p.theta_i, p.theta_r), spread**2
    c = cos(p.phi_r - p.phi_i)
    c1 = 1 - s2 / (2 * (s2 + mpf("0.33")))
    c2 = mpf("0.45") * s2 / (s2 + mpf("0.09")) * (sin(a) - (0 if c >= 0 else (2 * b / pi) ** 3))
    c3 = mpf("0.125") * s2 / (s2 + mpf("0.09")) * (4 * a * b / pi**2) ** 2
    once = albedo / pi * (c1 + c * c2 * tan(b) + (1 - fabs(c)) * c3 * tan((a + b) / 2))
    return once + mpf("0.17") * albedo**2 / pi * s2 / (s2 + mpf("0.13")) * (1 - c * (2 * b / pi) ** 2)


def lommel_seeliger(p, w):
    return w / (4 * pi * (p.cos_i + p.cos_r))


def eon(p, albedo, roughness):
    r, c1, c2 = roughness, mpf(1) / 2 - 2 / (3 * pi), mpf(2) / 3 - 28 / (15 * pi)
    s = p.i[0] * p.r[0] + p.i[1] * p.r[1]
    t = max(p.cos_i, p.cos_r) if s > 0 else mpf(1)
    a = 1 / (1 + c1 * r)

    def kept(theta):
        g = sin(theta) * (theta - sin(theta) * cos(theta)) + mpf(2) / 3 * (
            tan(theta) * (1 - sin(theta) ** 3) - sin(theta)
        )
        return a * (1 + r * g / pi)

    mean = a * (1 + c2 * r)
    again = albedo**2 * mean / (1 - albedo * (1 - mean))
    more = again / pi * (1 - kept(p.theta_i)) * (1 - kept(p.theta_r)) / (1 - mean) if r > mpf(10) ** -30 else mpf(0)
    return albedo / pi * a * (1 + r * s / t) + more


def coupled(p, albedo):
    return albedo * 21 / (20 * pi) * (1 - (1 - p.cos_i) ** 5) * (1 - (1 - p.cos_r) ** 5)


def mirror(p, n, k, sigma):
    return mpf(0)


def poisson_sum(g, y):
    """Σ_m g^m e^-g/(m! m) e^(-y/m), from the sum at twelve digits of both and its slopes there.

    So that a step of a parameter forms no second sum: what is left out is of third order in 1e-12.
    """
    at_g, at_y = (f"{float(each):.11e}" for each in (g, y))
    (round_g, round_y), (total, by_g, by_y), (by_gg, by_gy, by_yy) = _summed(at_g, at_y, mp.prec)
    step_g, step_y = g - round_g, y - round_y
    curved = by_gg * step_g**2 / 2 + by_gy * step_g * step_y + by_yy * step_y**2 / 2
    return total + by_g * step_g + by_y * step_y + curved


@lru_cache(maxsize=65536)
def _summed(at_g: str, at_y: str, prec: int):
    """Where it is taken, the sum and its slopes, then its second derivatives, around its largest term until the terms
    are gone; to `prec` bits.

    Where the summand is wide every few-th term stands for all: for a Gaussian of width w in steps of w/1.9 to 1e-30.
    """
    g, y = mpf(at_g), mpf(at_y)
    u = lambertw(2 * y / g**2).real / 2
    peak = g * exp(u)
    step = max(1, int(sqrt(peak / (1 + 2 * u)) / mpf("1.9")))
    step = step if step >= 8 else 1  # a narrower one is skew
    top, ln_g, bits = max(1, int(peak)), log(g), prec + 20
    ln_top = top * ln_g - ln_orders(top, prec) - y / top
    orders = [0] * 5  # Σ t m^k for k from -2 to 2, in units of the largest term over 2^bits
    for toward in (step, -step):
        m = top if toward > 0 else top - step
        while m >= 1:
            term = to_fixed(exp(m * ln_g - ln_orders(m, prec) - y / m - ln_top)._mpf_, bits)
            once = term // m
            for place, each in enumerate((once // m, once, term, term * m, term * m * m)):
                orders[place] += each
            if term * 10 ** (mp.dps - 5) < orders[2]:
                break
            m += toward
    unit = step * exp(ln_top - g) / mpf(2) ** bits
    by_m2, by_m, total, with_m, with_m2 = (unit * each for each in orders)
    curved = with_m2 / g**2 - 2 * with_m / g + total - with_m / g**2
    return (g, y), (total, with_m / g - total, -by_m), (curved, by_m - total / g, by_m2)


@lru_cache(maxsize=65536)
def ln_orders(m, prec):
    """ln(m! m), to `prec` bits."""
    return loggamma(m + 1) + log(m)


LAWS: dict[str, Callable[..., Any]] = {
    "lambertian": lambertian,
    "phong": phong,
    "phong-lewis": phong_lewis,
    "blinn": blinn,
    "ward": ward,
    "ward-duer": ward_duer,
    "ward-gmd": ward_gmd,
    "lafortune": lafortune,
    "cook-torrance": cook_torrance,
    "beckmann": beckmann_lobe,
    "ggx": ggx_lobe,
    "oren-nayar": oren_nayar,
    "lommel-seeliger": lommel_seeliger,
    "eon": eon,
    "coupled": coupled,
    "mirror": mirror,
}
