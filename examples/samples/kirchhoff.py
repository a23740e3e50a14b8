"""Diffraction by a random surface whose correlation is not Gaussian: the Kirchhoff ensemble average by quadrature.

    f = F S ((1 + i.r)/(cos i + cos r))² / (lambda² cos i cos r) * 2 pi Int [exp(-g (1 - C(r))) - exp(-g)] J0(v r) r dr
    g = (2 pi sigma (cos i + cos r)/lambda)²,  v = (2 pi/lambda) |sin i - sin r|,  C(r) = exp(-(sqrt(r² + r0²) - r0)/l)

plus the mirror part F S exp(-g), spread over the receiver. The same physics as the He-Torrance model with other
statistics: it can say how that model stands up to a real surface, but favours it over the others. Lengths in um.
"""

import numpy as np
from heightfield import fresnel
from scipy.special import erf, j0


def soft_exponential(length, rounding):
    """Correlation that falls exponentially, rounded at the top so that slopes exist."""
    return lambda r: np.exp(-(np.sqrt(r**2 + rounding**2) - rounding) / length)


def reflected(thetas_i, thetas_r, *, sigma, correlation, radius, slope_sd, n, k, wavelength, half_angle_deg):
    """BRDF [1/sr] as a receiver of this half angle reads it, (theta_i, theta_r)."""
    step = 0.1 / (4 * np.pi / wavelength)
    r = np.arange(0.5, radius / step) * step
    fine = np.arange(-89.75, 89.8, 0.25)  # the receiver's blur needs more angles than are asked for
    f = np.empty((len(thetas_i), len(thetas_r)))
    for place, theta_i in enumerate(thetas_i):
        i, o = np.radians(theta_i), np.radians(fine)
        ci, co = np.cos(i), np.cos(o)
        g = (2 * np.pi * sigma * (ci + co) / wavelength) ** 2
        v = 2 * np.pi / wavelength * np.abs(np.sin(i) - np.sin(o))
        integral = np.array([_integral(r, step, correlation, *pair) for pair in zip(g, v, strict=True)])
        both = _shown(i, slope_sd) * _shown(o, slope_sd)
        lobe = (
            fresnel(np.cos((i + o) / 2), n, k)
            * both
            * ((1 + np.cos(i + o)) / (ci + co)) ** 2
            / (wavelength**2 * ci * co)
            * integral
        )
        mirror = fresnel(ci, n, k) * _shown(i, slope_sd) ** 2 * np.exp(-((4 * np.pi * sigma * ci / wavelength) ** 2))
        profile = np.exp(-(((thetas_r[:, None] - fine) / half_angle_deg) ** 2))
        spike = (
            mirror
            / (ci * np.pi * np.radians(half_angle_deg) ** 2)
            * np.exp(-(((thetas_r - theta_i) / half_angle_deg) ** 2))
        )
        f[place] = profile @ lobe / profile.sum(axis=1) + spike
    return f


def _integral(r, step, correlation, g, v):
    return 2 * np.pi * step * np.sum((np.exp(-g * (1 - correlation(r))) - np.exp(-g)) * j0(v * r) * r)


def _shown(theta, slope_sd):
    """Share of the surface neither hidden nor turned away (Smith 1967)."""
    t = np.tan(np.maximum(np.abs(theta), 1e-6)) * slope_sd * np.sqrt(2)
    hidden = 0.5 * (t / np.sqrt(np.pi) * np.exp(-1 / t**2) - (1 - erf(1 / t)))
    return 0.5 * (1 + erf(1 / t)) / (1 + hidden)
