"""The laws as a NumPy user would type them from the papers: half vectors from unit vectors, Fresnel in complex numbers.

What `benchmarks/models.py` measures ours against. Right to double precision only where the paper's form is.
"""

from math import factorial, pi

import numpy as np


def directions(theta_i, theta_r, phi):
    """Everything the laws below take, from angles in radians; phi = phi_r - phi_i."""
    i = np.stack([np.sin(theta_i), np.zeros_like(theta_i), np.cos(theta_i)])
    r = np.stack([np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)])
    h = i + r
    h = h / np.sqrt((h**2).sum(0))
    mirror = np.array([-1.0, -1.0, 1.0])[:, None] * i
    return {
        "theta_i": theta_i, "theta_r": theta_r, "phi": phi, "i": i, "r": r, "cos_i": i[2], "cos_r": r[2], "cos_h": h[2],
        "cos_d": (h * i).sum(0), "cos_m": (mirror * r).sum(0),
    }  # fmt: skip


def fresnel(c, n, k):
    eta = n + 1j * k
    q = np.sqrt(eta**2 - 1 + c**2)
    r_s, r_p = (c - q) / (c + q), (eta**2 * c - q) / (eta**2 * c + q)
    return (np.abs(r_s) ** 2 + np.abs(r_p) ** 2) / 2


def lambertian(d, albedo):
    return albedo / pi * np.ones_like(d["cos_i"])


def coupled(d, albedo):
    return 21 / (20 * pi) * albedo * (1 - (1 - d["cos_i"]) ** 5) * (1 - (1 - d["cos_r"]) ** 5)


def phong(d, ks, exponent):
    return ks * np.maximum(d["cos_m"], 0) ** exponent / d["cos_i"]


def phong_lewis(d, ks, exponent):
    return ks * (exponent + 2) / (2 * pi) * np.maximum(d["cos_m"], 0) ** exponent


def blinn(d, ks, exponent):
    return ks * (exponent + 2) * (exponent + 4) / (8 * pi * (2 ** (-exponent / 2) + exponent)) * d["cos_h"] ** exponent


def ward(d, rho_s, alpha):
    tan2 = np.tan(np.arccos(d["cos_h"])) ** 2
    return rho_s * np.exp(-tan2 / alpha**2) / (4 * pi * alpha**2 * np.sqrt(d["cos_i"] * d["cos_r"]))


def ward_duer(d, rho_s, alpha):
    tan2 = np.tan(np.arccos(d["cos_h"])) ** 2
    return rho_s * np.exp(-tan2 / alpha**2) / (4 * pi * alpha**2 * d["cos_i"] * d["cos_r"])


def ward_gmd(d, rho_s, alpha):
    h = d["i"] + d["r"]
    tan2 = (h[0] ** 2 + h[1] ** 2) / h[2] ** 2
    return rho_s * np.exp(-tan2 / alpha**2) / (pi * alpha**2) * (h**2).sum(0) / h[2] ** 4


def lafortune(d, ks, tilt, exponent):
    longest = max(np.cos(tilt), abs(np.sin(tilt)))
    c_xy, c_z = -np.sin(tilt) / longest, np.cos(tilt) / longest
    base = c_xy * (d["i"][0] * d["r"][0] + d["i"][1] * d["r"][1]) + c_z * d["cos_i"] * d["cos_r"]
    return ks * np.maximum(base, 0) ** exponent


def beckmann_d(d, alpha):
    tan2 = np.tan(np.arccos(d["cos_h"])) ** 2
    return np.exp(-tan2 / alpha**2) / (pi * alpha**2 * d["cos_h"] ** 4)


def cook_torrance(d, alpha, n, k, scale):
    g = np.minimum(1, np.minimum(2 * d["cos_h"] * d["cos_i"] / d["cos_d"], 2 * d["cos_h"] * d["cos_r"] / d["cos_d"]))
    return scale * fresnel(d["cos_d"], n, k) * beckmann_d(d, alpha) * g / (4 * d["cos_i"] * d["cos_r"])


def beckmann(d, alpha, n, k, scale):
    from scipy.special import erfc

    def hidden(theta):
        x = 1 / (alpha * np.tan(theta))
        return (np.exp(-(x**2)) / (x * np.sqrt(pi)) - erfc(x)) / 2

    g = 1 / (1 + hidden(d["theta_i"]) + hidden(d["theta_r"]))
    return scale * fresnel(d["cos_d"], n, k) * beckmann_d(d, alpha) * g / (4 * d["cos_i"] * d["cos_r"])


def ggx(d, alpha, n, k, scale):
    def hidden(theta):
        return (np.sqrt(1 + alpha**2 * np.tan(theta) ** 2) - 1) / 2

    tan2 = np.tan(np.arccos(d["cos_h"])) ** 2
    distribution = alpha**2 / (pi * d["cos_h"] ** 4 * (alpha**2 + tan2) ** 2)
    g = 1 / (1 + hidden(d["theta_i"]) + hidden(d["theta_r"]))
    return scale * fresnel(d["cos_d"], n, k) * distribution * g / (4 * d["cos_i"] * d["cos_r"])


def oren_nayar(d, albedo, spread):
    a, b = np.maximum(d["theta_i"], d["theta_r"]), np.minimum(d["theta_i"], d["theta_r"])
    s2, c = spread**2, np.cos(d["phi"])
    c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    c2 = 0.45 * s2 / (s2 + 0.09) * (np.sin(a) - np.where(c >= 0, 0, (2 * b / pi) ** 3))
    c3 = 0.125 * s2 / (s2 + 0.09) * (4 * a * b / pi**2) ** 2
    once = albedo / pi * (c1 + c * c2 * np.tan(b) + (1 - np.abs(c)) * c3 * np.tan((a + b) / 2))
    return once + 0.17 * albedo**2 / pi * s2 / (s2 + 0.13) * (1 - c * (2 * b / pi) ** 2)


def eon(d, albedo, roughness):
    r, c1, c2 = roughness, 1 / 2 - 2 / (3 * pi), 2 / 3 - 28 / (15 * pi)
    s = d["i"][0] * d["r"][0] + d["i"][1] * d["r"][1]
    t = np.where(s > 0, np.maximum(d["cos_i"], d["cos_r"]), 1.0)
    a = 1 / (1 + c1 * r)

    def kept(theta):
        g = np.sin(theta) * (theta - np.sin(theta) * np.cos(theta)) + 2 / 3 * (
            np.tan(theta) * (1 - np.sin(theta) ** 3) - np.sin(theta)
        )
        return a * (1 + r * g / pi)

    mean = a * (1 + c2 * r)
    again = albedo**2 * mean / (1 - albedo * (1 - mean))
    return albedo / pi * a * (1 + r * s / t) + again / pi * (1 - kept(d["theta_i"])) * (1 - kept(d["theta_r"])) / (
        1 - mean
    )


def he_torrance(d, sigma, slope, n, k, scale, wavelength=0.55, terms=150):
    """The sum term by term, as many as the default roughness needs; erfc and Lambert's W from SciPy."""
    from scipy.special import erfc, lambertw

    tau, x, y, z = sigma / slope, *(d["i"] + d["r"])
    cot_i, cot_r = 1 / np.tan(d["theta_i"]), 1 / np.tan(d["theta_r"])
    nu_i, nu_r = tau * cot_i / (2 * sigma), tau * cot_r / (2 * sigma)
    k_sum = np.tan(d["theta_i"]) * erfc(nu_i) + np.tan(d["theta_r"]) * erfc(nu_r)
    rough = sigma / np.sqrt(1 + lambertw(k_sum**2 / (8 * pi)).real)
    g = (2 * pi * rough / wavelength * z) ** 2
    q = (2 * pi / wavelength) ** 2 * (x**2 + y**2) * tau**2 / 4
    total = sum(g**m * np.exp(-g - q / m) / (factorial(m) * m) for m in range(1, terms + 1))

    def visible_share(nu):
        h = erfc(-nu) / 2
        return h / (h + np.exp(-(nu**2)) / (2 * np.sqrt(pi) * nu))

    factor = (
        ((x**2 + y**2 + z**2) / z) ** 2 * visible_share(nu_i) * visible_share(nu_r) / (d["cos_i"] * d["cos_r"] * pi)
    )
    return scale * fresnel(d["cos_d"], n, k) * factor * pi**2 * tau**2 / (4 * wavelength**2) * total


LAWS = {
    name.replace("_", "-"): model
    for name, model in list(globals().items())
    if callable(model) and name not in ("directions", "fresnel", "beckmann_d", "factorial")
}
