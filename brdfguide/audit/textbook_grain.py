"""Laws with a grain as their papers print them, in as many digits as asked; with no shared step, as in `textbook`."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from mpmath import acos, asin, atan2, cos, erf, erfc, exp, fabs, lambertw, mp, mpf, pi, quad, sin, sqrt

from .textbook import WAVELENGTH, poisson_sum, unpolarised


def in_frame(p, axis):
    """v, i and r in the frame of the axis."""
    v = [a + b for a, b in zip(p.i, p.r, strict=True)]
    c, s = cos(axis), sin(axis)
    return [(w[0] * c + w[1] * s, w[1] * c - w[0] * s, w[2]) for w in (v, p.i, p.r)]


def exponent_and_tilt(p, alpha_x, alpha_y, axis):
    """e, and |s|²."""
    v, _, _ = in_frame(p, axis)
    x, y = v[0] / v[2], v[1] / v[2]
    return (x / alpha_x) ** 2 + (y / alpha_y) ** 2, x * x + y * y


def ward_aniso(p, rho_s, alpha_x, alpha_y, axis):
    e, _ = exponent_and_tilt(p, alpha_x, alpha_y, axis)
    return rho_s * exp(-e) / (4 * pi * alpha_x * alpha_y * sqrt(p.cos_i * p.cos_r))


def ward_duer_aniso(p, rho_s, alpha_x, alpha_y, axis):
    e, _ = exponent_and_tilt(p, alpha_x, alpha_y, axis)
    return rho_s * exp(-e) / (4 * pi * alpha_x * alpha_y * p.cos_i * p.cos_r)


def ward_gmd_aniso(p, rho_s, alpha_x, alpha_y, axis):
    e, t = exponent_and_tilt(p, alpha_x, alpha_y, axis)
    return rho_s * exp(-e) * (1 + t) / (pi * alpha_x * alpha_y * (p.cos_i + p.cos_r) ** 2)


def beckmann_aniso(p, alpha_x, alpha_y, axis, n, k, scale):
    e, t = exponent_and_tilt(p, alpha_x, alpha_y, axis)
    density = (1 + t) ** 2 * exp(-e) / (pi * alpha_x * alpha_y)

    def hidden(w):
        steep = sqrt((alpha_x * w[0]) ** 2 + (alpha_y * w[1]) ** 2)
        x = w[2] / max(steep, w[2] / 1000)  # exp(-1e6) hides nothing
        return (exp(-x * x) / (x * sqrt(pi)) - erfc(x)) / 2

    _, i, r = in_frame(p, axis)
    return scale * unpolarised(p.cos_d, n, k) * density / (4 * p.cos_i * p.cos_r * (1 + hidden(i) + hidden(r)))


def ashikhmin_shirley(p, exponent_x, exponent_y, axis, r_s, r_d):
    v, _, _ = in_frame(p, axis)
    square = v[0] ** 2 + v[1] ** 2
    share = v[0] ** 2 / square if square else mpf(0)
    f = r_s + (1 - r_s) * (1 - p.cos_d) ** 5
    power = p.cos_h ** (exponent_x * share + exponent_y * (1 - share))
    lobe = sqrt((exponent_x + 1) * (exponent_y + 1)) / (8 * pi) * power * f / (p.cos_d * max(p.cos_i, p.cos_r))
    low = [1 - (1 - c / 2) ** 5 for c in (p.cos_i, p.cos_r)]
    return lobe + 28 * r_d / (23 * pi) * (1 - r_s) * low[0] * low[1]


def lafortune_aniso(p, ks, c_x, c_y, c_z, exponent, axis):
    _, i, r = in_frame(p, axis)
    base = c_x * i[0] * r[0] + c_y * i[1] * r[1] + c_z * i[2] * r[2]
    base /= max(fabs(c_x), fabs(c_y), fabs(c_z))
    return ks * base**exponent if base > 0 else mpf(0)


def he_torrance_aniso(p, sigma, slope, ratio, axis, n, k, scale, wavelength=WAVELENGTH):
    tau_x, tau_y = sigma / slope, ratio * sigma / slope
    v, i, r = in_frame(p, axis)
    (s_i, k_i), (s_r, k_r) = (heights_seen(w, sigma, tau_x, tau_y) for w in (i, r))
    rough = sigma / sqrt(1 + lambertw((k_i + k_r) ** 2 / (8 * pi)).real)
    g = (2 * pi * rough * v[2] / wavelength) ** 2
    y = (pi / wavelength) ** 2 * ((tau_x * v[0]) ** 2 + (tau_y * v[1]) ** 2)
    height = ((v[0] ** 2 + v[1] ** 2 + v[2] ** 2) / v[2]) ** 2
    before = unpolarised(p.cos_d, n, k) * s_i * s_r / (p.cos_i * p.cos_r) * height
    return scale * before * pi * tau_x * tau_y / (4 * wavelength**2) * poisson_sum(g, y)


def he_mirror_aniso(p, sigma, slope, ratio, axis, n, k, scale, wavelength=WAVELENGTH):
    """Reflectance left to the mirror direction at θi, where light and view lie in one azimuth."""
    _, i, _ = in_frame(p, axis)
    s, k_i = heights_seen(i, sigma, sigma / slope, ratio * sigma / slope)
    rough = sigma / sqrt(1 + lambertw(k_i**2 / (2 * pi)).real)
    return scale * unpolarised(p.cos_i, n, k) * exp(-((4 * pi * rough * p.cos_i / wavelength) ** 2)) * s**2


def heights_seen(w, sigma, tau_x, tau_y):
    """S and K of a direction in the frame of the axis: those of a Gaussian section in its azimuth, of length tau."""
    across = sqrt(w[0] ** 2 + w[1] ** 2)
    tau = across / sqrt((w[0] / tau_x) ** 2 + (w[1] / tau_y) ** 2) if across else tau_x
    return seen_in_section(across / w[2], 2 * sigma / tau, mp.prec)


@lru_cache(maxsize=65536)
def seen_in_section(tan, steepness, prec):
    """S and K = tan θ erfc(ν), ν = cot θ/(2 sigma/tau), to `prec` bits."""
    if tan * steepness * 30 < 1:  # erfc(30) is 1e-393
        return mpf(1), mpf(0)
    nu = 1 / (steepness * tan)
    half = (1 + erf(nu)) / 2
    return half / (half + exp(-nu * nu) / (2 * sqrt(pi) * nu)), tan * erfc(nu)


def stam_mirror(p, sigma, slope, ratio, axis, f0, wavelength=WAVELENGTH):
    """Reflectance that Stam leaves to the mirror direction at θi."""
    return f0 * exp(-((4 * pi * sigma * p.cos_i / wavelength) ** 2))


def cylinders(p, spacing, sink, albedo, ks, exponent, axis):
    v, i, r = in_frame(p, axis)
    sink = max(sink, sqrt(max(1 - spacing**2 / 4, mpf(0))))
    size = sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    low, high = -acos(sink), acos(sink)
    half = sqrt(1 - sink**2)
    near, far = half, spacing - half
    for q in (i, r):
        psi = atan2(q[0], q[2])
        low, high, a = max(low, psi - pi / 2), min(high, psi + pi / 2), fabs(psi)
        if sin(a) > sink:
            if spacing * cos(a) < 2:
                end = a + asin(spacing * cos(a) - 1)
                low, high = (low, min(high, end)) if psi > 0 else (max(low, -end), high)
            shade = (1 - sink * sin(a)) / cos(a)
            near, far = (near, min(far, spacing - shade)) if psi > 0 else (max(near, shade), far)

    def element(t):
        def to(q):
            return sin(t) * q[0] + cos(t) * q[2]

        return (albedo / pi + ks * (to(v) / size) ** exponent) * to(i) * to(r)

    peak = atan2(v[0], v[2])
    cuts = sorted({low, high, *(c for c in (peak - 0.3, peak, peak + 0.3) if low < c < high)})
    ridge = quad(element, cuts) if high > low else mpf(0)
    return (ridge + max(far - near, mpf(0)) * element(mpf(0))) / (spacing * p.cos_i * p.cos_r)


LAWS: dict[str, Callable[..., Any]] = {
    "ward-aniso": ward_aniso,
    "ward-duer-aniso": ward_duer_aniso,
    "ward-gmd-aniso": ward_gmd_aniso,
    "beckmann-aniso": beckmann_aniso,
    "lafortune-aniso": lafortune_aniso,
    "ashikhmin-shirley": ashikhmin_shirley,
}
# compared in a file of their own: a sum and an integral
ROUGHER: dict[str, Callable[..., Any]] = {"he-torrance-aniso": he_torrance_aniso, "cylinders": cylinders}
