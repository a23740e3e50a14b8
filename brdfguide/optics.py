"""Smooth interfaces: Fresnel reflectance, F0 and the index, and what roughness takes from a mirror.

Reflectances are written over eps - 1, with the subtraction done by hand, so that an index next to 1,
grazing light and a near-perfect metal lose no digits.
"""

import numpy as np

from .errors import InputError


def fresnel(cos_d, n, k=0.0):
    """Unpolarised power reflectance of a smooth interface at the angle whose cosine is `cos_d`.

    e = n² - 1 - k² + 2ink,  q = √(e + c²)
    r_s = -e/(c+q)²,  r_p = e ((e+2)c² - 1)/b²,  b = (e+1)c + q,  F = (|r_s|² + |r_p|²)/2

    Takes  cos_d (...) in 0..1, n > 0, k >= 0 (its sign is ignored); all broadcast.
    Gives  F (...) in 0..1; 0 where n = 1 and k = 0, 1 at grazing.    Raises nothing.
    """
    c = np.asarray(cos_d, float)
    n, k = np.asarray(n, float), np.abs(np.asarray(k, float))
    if not np.any(k) and np.all(n > 1):
        return _dielectric(c, n)
    e = (n - 1) * (n + 1) - k * k + 2j * n * k
    with np.errstate(divide="ignore", invalid="ignore"):
        q = np.sqrt(e + c * c)
        r_s = e / (c + q) / (c + q)
        b = (e + 1) * c + q
        r_p = (e / b) * (((e + 2) * c * c - 1) / b)
    f = 0.5 * (_abs2(r_s) + _abs2(r_p))
    return np.minimum(np.where(e == 0, 0.0, f), 1.0)


def _dielectric(c, n):
    """The same in real arithmetic, for n > 1 and k = 0."""
    e = (n - 1) * (n + 1)
    c2 = c * c
    q = np.sqrt(e + c2)
    r_s = e / (c + q) ** 2
    r_p = e * ((e + 2) * c2 - 1) / ((e + 1) * c + q) ** 2
    return 0.5 * (r_s * r_s + r_p * r_p)


def _abs2(z):
    return z.real**2 + z.imag**2


def index_from_f0(f0):
    """Refractive index of a smooth dielectric.

    n = (1 + √F0) / (1 - √F0) = (1 + √F0)² / (1 - F0)             (Westin et al. 2004, Eq. 2)

    Takes  f0 (...), 0 <= f0 < 1.    Gives  n (...) >= 1.    Raises InputError outside.
    For a metal this is an equivalent real n, not its index.
    """
    f0 = np.asarray(f0, float)
    if not np.all((f0 >= 0) & (f0 < 1)):
        raise InputError(f"f0 = {np.ravel(f0)[0]:g}: a reflectance at normal incidence lies in 0 <= f0 < 1")
    return (1 + np.sqrt(f0)) ** 2 / (1 - f0)


def f0(n, k=0.0):
    """Reflectance at normal incidence, ((n-1)² + k²) / ((n+1)² + k²). Takes n > 0, k (...); gives F0 (...)."""
    n, k = np.asarray(n, float), np.asarray(k, float)
    return ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)
