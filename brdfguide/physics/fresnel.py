"""Smooth interfaces: Fresnel reflectance, F0 and the index, and what roughness takes from a mirror.

Everything is written over n - 1 and in sums of positive terms, so that an index next to 1, grazing light, a
near-perfect metal and an enormous k lose no digits and overflow nowhere.
"""

from functools import cache
from math import pi

import numpy as np

from ..errors import InputError

SMALL_INDEX = 0.1  # n and k both below: N² is lost in N² - 1
# Westin et al. 2004, Table 1, nominally at 550 nm: material -> (n, k, normal reflectance as printed)
TABLE_1 = {
    "water": (1.34, 0.0, 0.0211),
    "fused silica": (1.460, 0.0, 0.0350),
    "acrylic": (1.48, 0.0, 0.0375),
    "polyethylene": (1.490, 0.0, 0.0387),
    "window glass": (1.51, 0.0, 0.0413),  # the table gives a range, 1.51 to 1.54
    "window glass, high": (1.54, 0.0, 0.0452),
    "diamond": (2.4203, 0.0, 0.1724),
    "nickel": (1.80, 3.33, 0.6196),
    "chromium": (3.18, 4.41, 0.6555),
    "aluminum": (0.958, 6.69, 0.9211),
    "silver": (0.120, 3.45, 0.9635),
}


def fresnel(cos_d, n, k=0.0):
    """Unpolarised power reflectance of a smooth interface.

    q = √(N² - 1 + c²), N = n + ik, s² = 1 - c²
    F = |N² - 1|²/|q + c|⁴ · (|q|²c² + s⁴) / (|q|²c² + 2 c s² Re q + s⁴)

    The mean of |r_s|² and |r_p|², with r_s = (c - q)/(c + q), r_p = r_s (qc - s²)/(qc + s²).

    Takes  cos_d (...) in 0..1, n > 0, k (its sign is ignored); all broadcast.
    Gives  F (...) in 0..1; 0 where n = 1 and k = 0, 1 at grazing.    Raises nothing.
    """
    e2, total, share, all_of_it, _, _ = _interface(cos_d, n, k)
    total = total * total
    total *= all_of_it
    share *= e2
    if e2.all():
        share /= total
    else:  # no interface: 0 even at grazing, where the formula is 0/0
        share = np.divide(share, total, out=np.zeros_like(total), where=share > 0)
    return np.minimum(share, 1.0)


def one_minus_fresnel(cos_d, n, k=0.0):
    """What enters, 1 - F, without the subtraction: the absorptance of a metal, the transmittance at grazing.

    1 - F = 2 c Re q (2 P/|q + c|² + s²) / (P + 2 c s² Re q),    P = |q|²c² + s⁴

    Takes and raises the same as `fresnel`.    Gives  1 - F (...) in 0..1; 1 where n = 1 and k = 0.
    """
    e2, total, share, all_of_it, rise, s2 = _interface(cos_d, n, k)
    bare = (e2 == 0) | (total == 0)
    if not bare.any():
        return np.minimum(rise * (2 * share / total + s2) / all_of_it, 1.0)
    enters = rise * (2 * share / np.where(bare, 1.0, total) + s2) / np.where(bare, 1.0, all_of_it)
    return np.where(bare, 1.0, np.minimum(enters, 1.0))


def _interface(cos_d, n, k):
    """|N²-1|², |q+c|², P = |q|²c² + s⁴, P + 2 c s² Re q, 2 c Re q, s², in units of u² (1; (n+k)² if enormous)."""
    c, n, k = np.asanyarray(cos_d, float), np.asarray(n, float), np.abs(np.asarray(k, float))
    enormous = (n + k).max() > 1e38  # its squares may overflow
    u = n + k if enormous else 1.0
    n_u, k_u, minus, plus = n / u, k / u, (n - 1) / u, (n + 1) / u
    e2 = (minus * minus + k_u * k_u) * (plus * plus + k_u * k_u)
    c_u = c / u if enormous else c
    c2_u = c_u * c_u
    s2 = (1 - c) * (1 + c)
    x = c2_u + (minus * plus - k_u * k_u)  # q² = x + iy
    if k.any():
        small = (n < SMALL_INDEX) & (k < SMALL_INDEX)
        if np.any(small):  # N² would be lost beside the 1 that c² takes away
            x = np.where(small, (n - k) * (n + k) - s2, x)
        y = 2 * n_u * k_u
        q2 = np.sqrt(x * x + y * y)
        root = np.sqrt(0.5 * (q2 + np.abs(x)))
        rise = np.where(x < 0, np.divide(0.5 * y, root, out=np.zeros_like(root), where=root > 0), root)
    else:
        q2 = np.abs(x)
        rise = np.sqrt(np.maximum(x, 0.0))  # n < 1 beyond its critical angle: q is imaginary, F = 1
    rise *= c_u
    rise += rise
    total = q2 + c2_u
    total += rise
    share = q2 * (c * c)
    share += (s2 / u) ** 2 if enormous else s2 * s2
    return e2, total, share, share + rise * s2, rise, s2


def fresnel_with_slopes(cos_d, n, k=0.0):
    """F, dF/dn and dF/dk, from dF = Re(g dq), dq = N dN/q.

    g = -2c conj(r_s)(1 + |t|²)/(c + q)² + 2 c s² |r_s|² conj(t)/(qc + s²)²,   t = (qc - s²)/(qc + s²),   F = |r_s|²(1 +
    |t|²)/2

    Takes  what `fresnel` takes, off n = 1 at grazing and off the critical angle of n < 1.    Gives  three arrays (...).
    """
    c, n, k = np.asanyarray(cos_d, float), np.asarray(n, float), np.abs(np.asarray(k, float))
    s2 = (1 - c) * (1 + c)
    if k.any() or (n < 1).any():
        index = n + 1j * k
        e = (n - 1) * (n + 1) - k * k + 2j * n * k
        q = np.sqrt(e + c * c)
        below, across = 1 / (c + q), 1 / (q * c + s2)
        r_s, t = -e * below * below, (q * c - s2) * across
        r2, both = _abs2(r_s), 1 + _abs2(t)
        g = 2 * c * (np.conj(r_s) * -both * below * below + r2 * np.conj(t) * s2 * across * across) * index / q
        return 0.5 * r2 * both, g.real, -g.imag
    e = (n - 1) * (n + 1)
    q = np.sqrt(c * c + e)
    below, qc = 1 / (q + c), q * c
    across = 1 / (qc + s2)
    t = (qc - s2) * across
    below *= below
    r_s, both = below * -e, t * t + 1
    f = r_s * r_s
    f *= both
    f *= 0.5
    across *= across  # g in place: t r_s s² across² - (1 + t²) below², times 2 c r_s
    across *= s2
    across *= t
    across *= r_s
    both *= below
    across -= both
    across *= r_s
    across *= 2 * c
    across *= n
    across /= q
    return f, across, np.zeros_like(across)


def mean_fresnel(n, k=0.0):
    """Reflectance of a smooth interface for light from everywhere, 2 ∫ F c dc.

    By nodes that crowd like double exponentials at both ends: to 1e-13 for every n > 1, to a thousandth for n < 1
    without k, where F has a corner.
    Takes  n > 0, k (...).    Gives  0..1 (...).
    """
    cosines, weights = _in_all_directions()
    n, k = (np.asarray(each, float)[..., None] for each in (n, k))
    return fresnel(cosines, n, k) @ weights


def mean_fresnel_with_slopes(n, k=0.0):
    """The same, and its derivatives by n and by k."""
    cosines, weights = _in_all_directions()
    n, k = np.broadcast_arrays(*(np.asarray(each, float)[..., None] for each in (n, k)))
    return tuple(each @ weights for each in fresnel_with_slopes(cosines, n, k))


@cache
def _in_all_directions():
    """Cosines, and weights that hold 2 c dc."""
    step = 1 / 32
    t = step * np.arange(-122, 98)
    cosines = 1 / (1 + np.exp(-pi * np.sinh(t)))
    return cosines, 2 * step * pi * np.cosh(t) * cosines * cosines / (1 + np.exp(pi * np.sinh(t)))


def _abs2(z):
    return z.real**2 + z.imag**2


def f0(n, k=0.0):
    """Reflectance at normal incidence, ((n-1)² + k²) / ((n+1)² + k²).

    Takes  n > 0, k (...).    Gives  F0 (...) in 0..1.    Raises nothing.
    """
    n, k = np.asarray(n, float), np.asarray(k, float)
    return ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)


def index_from_f0(f0):
    """Refractive index of a smooth dielectric.

    n = (1 + √F0) / (1 - √F0) = (1 + √F0)² / (1 - F0)             (Westin et al. 2004, Eq. 2)

    Takes  f0 (...), 0 <= f0 < 1.    Gives  n (...) >= 1.    Raises InputError outside.
    For a metal this is an equivalent real n, not its index.
    """
    f0 = _reflectance(f0)
    return (1 + np.sqrt(f0)) ** 2 / (1 - f0)


def index_minus_one(f0):
    """n - 1 of Eq. 2, 2√F0 (1 + √F0) / (1 - F0), which survives where n itself rounds to 1.

    Takes and raises the same as `index_from_f0`.    Gives  n - 1 (...) >= 0.
    """
    f0 = _reflectance(f0)
    root = np.sqrt(f0)
    return 2 * root * (1 + root) / (1 - f0)


def _reflectance(f0):
    f0 = np.asarray(f0, float)
    wrong = ~((f0 >= 0) & (f0 < 1))
    if np.any(wrong):
        raise InputError(f"f0 = {f0[wrong].flat[0]:g}: a reflectance at normal incidence lies in 0 <= f0 < 1")
    return f0


def davies(fresnel, cos_i, sigma, wavelength):
    """Specular reflectance left by a slightly rough surface.

    rho = F exp(-g),  g = (4π (sigma/wavelength) cos θi)²          (Westin et al. 2004, Eq. 1; Davies 1954)

    Takes  F (...), cos_i (...), sigma [µm], wavelength [µm]; all broadcast.
    Gives  rho (...) in 0..F. Underflows to 0 for sigma/wavelength above about 2.2 at normal incidence: see `davies_ln`.
    """
    return fresnel * np.exp(-davies_exponent(cos_i, sigma, wavelength))


def davies_exponent(cos_i, sigma, wavelength):
    """g of Eq. 1: the squared phase that the roughness gives the mirror reflection, dimensionless."""
    return (4 * pi * (sigma / wavelength) * cos_i) ** 2


def davies_ln(fresnel, cos_i, sigma, wavelength):
    """ln rho of Eq. 1, right where rho underflows. Takes F > 0 and otherwise what `davies` takes."""
    return np.log(fresnel) - davies_exponent(cos_i, sigma, wavelength)


def davies_scattered(fresnel, cos_i, sigma, wavelength):
    """What Eq. 1 takes from the mirror, F - rho = F (1 - exp(-g)), right where it is far below F."""
    return -fresnel * np.expm1(-davies_exponent(cos_i, sigma, wavelength))
