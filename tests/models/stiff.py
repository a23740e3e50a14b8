"""Points where straightforward double precision fails, drawn at random by regime, and their values at 400 digits.

`python -m tests.models.stiff` prints brdfguide/audit/references.csv (seed 8, two of each regime).
"""

import csv
import io
from math import log10

import numpy as np
from mpmath import cos, exp, log, mp, mpf, pi, power, sin, sqrt

from brdfguide.audit import textbook, textbook_more
from brdfguide.audit.textbook import ExactDirections, unpolarised


def right(quantity, angles, p):
    """The value of `quantity` at 400 digits, its inputs taken as the doubles they are; ln quantities as logarithms."""
    with mp.workdps(400):
        pair, v = ExactDirections(*angles), {key: mpf(float(x)) for key, x in p.items()}
        return VALUES[quantity](pair, **v)


def _index_minus_one(pair, f0):
    return 2 * sqrt(f0) / (1 - sqrt(f0))


def _phase(pair, sigma, wavelength):
    return (4 * pi * sigma * cos(pair.theta_i) / wavelength) ** 2


def _lobe_base(pair, c_xy, c_z):
    return c_xy * (pair.i[0] * pair.r[0] + pair.i[1] * pair.r[1]) + c_z * pair.cos_i * pair.cos_r


def _lobe(pair, c_xy, c_z, exponent):
    base = _lobe_base(pair, c_xy, c_z)
    return power(base, exponent) if base > 0 else mpf(0)


def _qualitative(pair, albedo, spread):
    a, b, s2 = max(pair.theta_i, pair.theta_r), min(pair.theta_i, pair.theta_r), spread**2
    forward = max(mpf(0), cos(pair.phi_r - pair.phi_i)) * sin(a) * sin(b) / cos(b)
    return albedo / pi * (1 - s2 / (2 * (s2 + mpf("0.33"))) + mpf("0.45") * s2 / (s2 + mpf("0.09")) * forward)


VALUES = {
    "fresnel": lambda pair, n, k: unpolarised(pair.cos_i, n, k),
    "one_minus_fresnel": lambda pair, n, k: 1 - unpolarised(pair.cos_i, n, k),
    "index_from_f0": lambda pair, f0: 1 + _index_minus_one(pair, f0),
    "index_minus_one": _index_minus_one,
    "davies_scattered": lambda pair, sigma, wavelength: 1 - exp(-_phase(pair, sigma, wavelength)),
    "davies_ln": lambda pair, sigma, wavelength: -_phase(pair, sigma, wavelength),
    "phong": textbook.phong,
    "ward": textbook.ward,
    "ward_duer": textbook.ward_duer,
    "ward_gmd": textbook.ward_gmd,
    "lafortune_lobe": _lobe,
    "lafortune_lobe_ln": lambda pair, c_xy, c_z, exponent: exponent * log(_lobe_base(pair, c_xy, c_z)),
    "oren_nayar_qualitative": _qualitative,
    "oren_nayar": textbook.oren_nayar,
    "ggx_distribution": lambda pair, alpha: alpha**2 / (pi * pair.cos_h**4 * (alpha**2 + pair.tan2_h) ** 2),
    "beckmann_distribution": lambda pair, alpha: exp(-pair.tan2_h / alpha**2) / (pi * alpha**2 * pair.cos_h**4),
    "cook_torrance": lambda pair, n, k, alpha: textbook.cook_torrance(pair, alpha, n, k, 1),
    "beckmann": lambda pair, n, k, alpha: textbook.beckmann_lobe(pair, alpha, n, k, 1),
    "ggx": lambda pair, n, k, alpha: textbook.ggx_lobe(pair, alpha, n, k, 1),
    "abg": textbook_more.abg,
    "harvey_shack": textbook_more.harvey_shack,
    "abc": lambda pair, a, b, c: textbook_more.abc(pair, a, b, c, 1),
    "low_smooth": lambda pair, a, b, c, n: textbook_more.low_smooth(pair, a, b, c, n, 0),
    "low_facet": lambda pair, a, b, c, n: textbook_more.low_facet(pair, a, b, c, n, 0),
    "student_t": lambda pair, alpha, g: textbook_more.student_t(pair, alpha, g, mpf(3) / 2, 0, 1),
    "sgd_published": textbook_more.sgd_published,
    "coated_body": lambda pair, albedo, coat_n: textbook_more.coated_body(pair, albedo, coat_n),
}


class Draw:
    """Numbers of a regime, rounded to a few digits as a person would type them."""

    def __init__(self, rng):
        self.rng = rng

    def even(self, low, high):
        return float(f"{self.rng.uniform(low, high):.7g}")

    def log(self, low, high, digits=6):
        return float(f"{10 ** self.rng.uniform(log10(low), log10(high)):.{digits}g}")

    def near(self, base, low, high):
        """`base` plus a small number, which survives the rounding."""
        return base + self.log(low, high)

    def mirror(self, theta=None):
        theta = self.even(5, 80) if theta is None else theta
        return theta, 0.0, theta, 180.0

    def grazing(self, low=1e-12, high=1e-5):
        return self.mirror(90 - self.log(low, high))

    def beside(self, low, high):
        """Off the mirror direction, in the plane, by a small angle [deg]."""
        theta = self.even(5, 70)
        return theta, 0.0, theta + self.log(low, high), 180.0

    def behind(self):
        return self.even(50, 85), 0.0, self.even(50, 85), self.even(-40, 40)


REGIMES = (  # model, quantity, what goes wrong, draw of (angles, values)
    ("fresnel", "fresnel", "index near 1", lambda d: (d.mirror(), {"n": d.near(1, 1e-13, 1e-6), "k": 0.0})),
    (
        "fresnel",
        "fresnel",
        "index near 1, at grazing",
        lambda d: (d.grazing(), {"n": d.near(1, 1e-13, 1e-6), "k": 0.0}),
    ),
    ("fresnel", "fresnel", "n = 1 with a weak absorption", lambda d: (d.mirror(), {"n": 1.0, "k": d.log(1e-9, 1e-5)})),
    (
        "fresnel",
        "fresnel",
        "k whose square overflows",
        lambda d: (d.mirror(), {"n": d.even(1, 5), "k": d.log(1e80, 1e200)}),
    ),
    (
        "fresnel",
        "fresnel",
        "beyond the critical angle of n < 1",
        lambda d: (d.mirror(d.even(75, 89)), {"n": d.even(0.2, 0.9), "k": d.log(1e-9, 1e-3)}),
    ),
    ("fresnel", "fresnel", "a metal with n < 1", lambda d: (d.mirror(), {"n": d.even(0.05, 0.9), "k": d.even(1, 8)})),
    (
        "fresnel",
        "one_minus_fresnel",
        "absorptance of a near-perfect metal",
        lambda d: (d.mirror(), {"n": d.even(1, 5), "k": d.log(1e4, 1e9)}),
    ),
    (
        "fresnel",
        "one_minus_fresnel",
        "transmittance at grazing",
        lambda d: (d.grazing(), {"n": d.even(1.1, 3), "k": 0.0}),
    ),
    ("fresnel", "index_from_f0", "F0 next to 1", lambda d: (d.mirror(0.0), {"f0": 1 - d.log(1e-15, 1e-10)})),
    (
        "fresnel",
        "index_minus_one",
        "F0 so small that n rounds to 1",
        lambda d: (d.mirror(0.0), {"f0": d.log(1e-60, 1e-33)}),
    ),
    (
        "mirror",
        "davies_scattered",
        "very smooth",
        lambda d: (d.mirror(), {"sigma": d.log(1e-10, 1e-6), "wavelength": 0.55}),
    ),
    (
        "mirror",
        "davies_ln",
        "far rougher than the wavelength",
        lambda d: (d.mirror(), {"sigma": d.log(10, 1e4), "wavelength": 0.55}),
    ),
    ("phong", "phong", "huge exponent", lambda d: (d.beside(1e-9, 1e-7), {"ks": 0.3, "exponent": d.log(1e12, 1e14)})),
    ("phong", "phong", "behind the lobe", lambda d: (d.behind(), {"ks": 0.3, "exponent": d.even(2, 30)})),
    ("phong", "phong", "1/cos at grazing", lambda d: (d.grazing(), {"ks": 0.2, "exponent": d.even(5, 60)})),
    (
        "phong",
        "phong",
        "azimuths whose difference rounds",
        lambda d: _turned(d, {"ks": 0.2, "exponent": d.log(1e17, 1e18)}),
    ),
    ("ward", "ward", "tiny alpha", lambda d: (d.beside(1e-8, 1e-7), {"rho_s": 0.2, "alpha": d.log(1e-9, 1e-8)})),
    ("ward", "ward", "at grazing", lambda d: (d.grazing(), {"rho_s": 0.2, "alpha": d.even(0.1, 0.4)})),
    ("ward-duer", "ward_duer", "at grazing", lambda d: (d.grazing(), {"rho_s": 0.2, "alpha": d.even(0.1, 0.4)})),
    ("ward-gmd", "ward_gmd", "at grazing", lambda d: (d.grazing(), {"rho_s": 0.2, "alpha": d.even(0.1, 0.4)})),
    (
        "lafortune",
        "lafortune_lobe",
        "mirror lobe, huge exponent",
        lambda d: (d.beside(1e-9, 1e-7), {"c_xy": -1.0, "c_z": 1.0, "exponent": d.log(1e11, 1e13)}),
    ),
    (
        "lafortune",
        "lafortune_lobe",
        "negative base",
        lambda d: (d.behind(), {"c_xy": -d.even(0.7, 0.9), "c_z": d.even(0.01, 0.3), "exponent": d.even(2, 80)}),
    ),
    (
        "lafortune",
        "lafortune_lobe_ln",
        "base above 1 overflows",
        lambda d: (d.mirror(), {"c_xy": -d.even(1.05, 1.2), "c_z": d.even(1.05, 1.2), "exponent": d.log(1e5, 1e7)}),
    ),
    (
        "lafortune",
        "lafortune_lobe_ln",
        "base below 1 underflows",
        lambda d: (d.mirror(), {"c_xy": -d.even(0.5, 0.9), "c_z": d.even(0.4, 0.7), "exponent": d.log(1e4, 1e6)}),
    ),
    (
        "oren-nayar",
        "oren_nayar_qualitative",
        "at the normal, without an azimuth",
        lambda d: ((0.0, 0.0, d.even(5, 80), d.even(0, 360)), _rough(d)),
    ),
    (
        "oren-nayar",
        "oren_nayar_qualitative",
        "sines underflow",
        lambda d: ((d.log(1e-175, 1e-165), 0.0, d.log(1e-175, 1e-165), d.even(1, 80)), _rough(d)),
    ),
    (
        "oren-nayar",
        "oren_nayar_qualitative",
        "both at grazing",
        lambda d: ((90 - d.log(1e-10, 1e-6), 0.0, 90 - d.log(1e-5, 1e-3), d.even(1, 20)), _rough(d)),
    ),
    (
        "oren-nayar",
        "oren_nayar",
        "sines underflow",
        lambda d: ((d.log(1e-175, 1e-165), 0.0, d.log(1e-175, 1e-165), d.even(1, 80)), _rough(d)),
    ),
    (
        "oren-nayar",
        "oren_nayar",
        "both at grazing",
        lambda d: ((90 - d.log(1e-10, 1e-6), 0.0, 90 - d.log(1e-5, 1e-3), d.even(1, 170)), _rough(d)),
    ),
    ("ggx", "ggx_distribution", "tiny alpha on the peak", lambda d: (d.mirror(), {"alpha": d.log(1e-12, 1e-9)})),
    (
        "ggx",
        "ggx_distribution",
        "tiny alpha beside the peak",
        lambda d: (d.beside(1e-5, 1e-3), {"alpha": d.log(1e-6, 1e-4)}),
    ),
    (
        "beckmann",
        "beckmann_distribution",
        "tiny alpha beside the peak",
        lambda d: (d.beside(1e-7, 1e-6), {"alpha": d.log(1e-8, 1e-6)}),
    ),
    (
        "cook-torrance",
        "cook_torrance",
        "weak interface",
        lambda d: (d.mirror(), {"n": d.near(1, 1e-9, 1e-6), "k": 0.0, "alpha": d.even(0.1, 0.3)}),
    ),
    (
        "cook-torrance",
        "cook_torrance",
        "at grazing",
        lambda d: (d.grazing(), {"n": 1.5, "k": 0.0, "alpha": d.even(0.05, 0.3)}),
    ),
    ("beckmann", "beckmann", "at grazing", lambda d: (d.grazing(), {"n": 1.5, "k": 0.0, "alpha": d.even(0.05, 0.3)})),
    (
        "beckmann",
        "beckmann",
        "where the masking turns on",
        lambda d: (d.mirror(d.even(70, 88)), {"n": 1.5, "k": 0.0, "alpha": d.even(0.1, 1.4)}),
    ),
    ("ggx", "ggx", "at grazing", lambda d: (d.grazing(), {"n": 1.5, "k": 0.0, "alpha": d.even(0.05, 0.3)})),
    (
        "ggx",
        "ggx",
        "narrow and metallic",
        lambda d: (d.mirror(), {"n": d.even(0.1, 1), "k": d.even(3, 8), "alpha": d.log(1e-10, 1e-6)}),
    ),
    (
        "abg",
        "abg",
        "tiny shoulder beside the mirror",
        lambda d: (d.beside(1e-7, 1e-4), {"a": 0.01, "b": d.log(1e-12, 1e-9), "g": d.even(1, 3)}),
    ),
    (
        "harvey-shack",
        "harvey_shack",
        "tiny shoulder beside the mirror",
        lambda d: (d.beside(1e-7, 1e-4), {"b0": 1e4, "l": d.log(1e-6, 1e-4), "s": -d.even(1, 3)}),
    ),
    (
        "abc",
        "abc",
        "both at grazing",
        lambda d: (d.grazing(), {"a": 1e-4, "b": d.log(1, 1e5), "c": d.even(1.1, 4)}),
    ),
    (
        "low-smooth",
        "low_smooth",
        "at grazing, narrow",
        lambda d: (d.grazing(), {"a": 10.0, "b": d.log(1e6, 1e9), "c": d.even(0.5, 2), "n": d.even(1.3, 3)}),
    ),
    (
        "low-facet",
        "low_facet",
        "at grazing, narrow",
        lambda d: (d.grazing(), {"a": 10.0, "b": d.log(1e6, 1e9), "c": d.even(0.5, 2), "n": d.even(1.3, 3)}),
    ),
    (
        "student-t",
        "student_t",
        "at grazing",
        lambda d: (d.grazing(), {"alpha": d.even(0.05, 0.5), "g": d.even(1.6, 4)}),
    ),
    (
        "student-t",
        "student_t",
        "longest tail, where the mean slope nearly diverges",
        lambda d: (d.mirror(d.even(60, 89)), {"alpha": d.even(0.05, 0.5), "g": d.even(1.55, 1.6)}),
    ),
    (
        "student-t",
        "student_t",
        "nearly Gaussian",
        lambda d: (d.mirror(d.even(60, 89)), {"alpha": d.even(0.1, 1.0), "g": d.even(500, 1000)}),
    ),
    (
        "sgd-published",
        "sgd_published",
        "exponents of hundreds",
        lambda d: (
            d.beside(1e-3, 1),
            {
                "rho_s": 0.2,
                "alpha": d.log(1e-5, 1e-3),
                "p": d.even(0.1, 1.8),
                "f0": 0.9,
                "f_normal": d.even(0.1, 1),
                "theta0": 0.5,
                "c": d.log(1e-9, 1e-6),
                "k": d.even(100, 700),
                "lam": 2.5,
            },
        ),
    ),
    (
        "coated:lambertian",
        "coated_body",
        "what a coat lets through at grazing",
        lambda d: (d.grazing(), {"albedo": d.even(0.1, 1), "coat_n": d.even(1.1, 2)}),
    ),
    (
        "coated:lambertian",
        "coated_body",
        "a coat that hardly is one",
        lambda d: (d.mirror(), {"albedo": d.even(0.1, 1), "coat_n": d.near(1, 1e-9, 1e-5)}),
    ),
)


def _turned(d, values):
    theta, phi = d.even(5, 85), d.even(1, 60)
    return (theta, phi, theta, phi + 180.0), values


def _rough(d):
    return {"albedo": 0.6, "spread": d.even(0.1, 1.0)}


def draw(seed, of_each):
    """(model, quantity, angles, values, what goes wrong) of every regime."""
    d = Draw(np.random.default_rng(seed))
    for model, quantity, why, point in REGIMES:
        for _ in range(of_each):
            angles, values = point(d)
            yield model, quantity, angles, values, why


def table(seed=8, of_each=2) -> str:
    """The text of brdfguide/audit/references.csv."""
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\n").writerow
    angles = [f"{name}_deg" for name in ("theta_i", "phi_i", "theta_r", "phi_r")]
    write(["model", "quantity", *angles, "values", "right", "why"])
    for model, quantity, angles, values, why in draw(seed, of_each):
        value = mp.nstr(right(quantity, angles, values), 17)
        write([model, quantity, *angles, " ".join(f"{name}={number!r}" for name, number in values.items()), value, why])
    return out.getvalue()


if __name__ == "__main__":
    print(table(), end="")
