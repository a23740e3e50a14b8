"""How often the intervals of a K-correlation fit hold the truth: sigma, correlation length and slope of made surfaces.

    python benchmarks/polish.py [draws]

Scans at three wavelengths and two incidences with 3 % noise; the detector's cone takes in the mirror beam near it, and
a dark level of a tenth of the dimmest value stays in. Drawn log-uniformly: sigma 0.3 to 3 nm, bend 10 to 100 um; slope
1.5 to 2.8. Prints how many of the 95 % intervals hold each number.
"""

import sys

import numpy as np

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.fitting.diagnostics.derived_error import ln_stderr
from brdfguide.fitting.fit import FitOptions, fit
from brdfguide.models import abc
from brdfguide.physics.aperture import Instrument, solid_angle_of
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.physics.height_spectrum import to_surface

WAVELENGTHS_UM = np.array([0.488, 0.6328, 1.064])
F0, NOISE, APERTURE_DEG, SIGMAS = 0.9, 0.03, 0.15, 1.96
MODEL = models.get("lambertian+abc+mirror")
HELD = {"abc.f0": F0, "mirror.sigma": 0.0}


def geometry() -> Geometry:
    """Incidence 5 and 45 degrees, both sides of the mirror direction from 0 to 0.05 to 70 degrees off."""
    off = np.concatenate(([0.05], np.geomspace(0.3, 8, 14), np.arange(10.0, 71.0, 5.0)))
    theta_i, theta_r = [], []
    for each in (5.0, 45.0):
        angles = np.concatenate((each + off, each - off))
        angles = angles[np.abs(angles) < 80]
        theta_i, theta_r = np.append(theta_i, np.full(len(angles), each)), np.append(theta_r, angles)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))
    return geom.at(WAVELENGTHS_UM)


def drawn(seed: int) -> tuple[dict, Measurement]:
    """Truth and scans of one surface."""
    random = np.random.default_rng(seed)
    sigma = np.exp(random.uniform(np.log(3e-4), np.log(3e-3)))
    b, c = np.exp(random.uniform(np.log(10), np.log(100))), random.uniform(1.5, 2.8)
    a = float(sigma**2 * b * (c - 1) / (2 * np.pi * to_surface(c)))
    geom, solid_angle = geometry(), solid_angle_of(APERTURE_DEG)
    instrument = Instrument(geom, solid_angle)
    lobe = sum(w * models.term("abc")(g.at(WAVELENGTHS_UM), a=a, b=b, c=c, f0=F0) for w, g in instrument.views)
    value = lobe + F0 * instrument.beam
    value = value + 0.1 * value.min(axis=0)  # a dark level, the same at every angle
    noisy = value * np.exp(NOISE * random.standard_normal(value.shape))
    names = tuple(f"{1000 * each:g} nm" for each in WAVELENGTHS_UM)
    return {"sigma": sigma, "b": b, "c": c}, Measurement(geom, noisy, names, solid_angle=solid_angle)


def held(seed: int) -> dict[str, bool] | None:
    """Which intervals hold the truth; None where the fit says that it knows nothing."""
    truth, data = drawn(seed)
    found = fit(MODEL, data, FitOptions(fixed=HELD, weights="none"))

    def sigma_of(values) -> float:
        return float(abc.height(values["abc.a"], values["abc.b"], values["abc.c"]))

    b, c = (float(found.values[f"abc.{name}"]) for name in "bc")
    error_b, error_c = (float(found.stderr[f"abc.{name}"]) for name in "bc")
    off = {
        "sigma": np.log(sigma_of(found.values) / truth["sigma"]) / ln_stderr(found, data, sigma_of),
        "b": np.log(b / truth["b"]) / (error_b / b),
        "c": (c - truth["c"]) / error_c,
    }
    return {name: bool(abs(each) < SIGMAS) for name, each in off.items()}


def main(draws: int) -> None:
    counts = {"sigma": 0, "b": 0, "c": 0}
    for seed in range(draws):
        for name, inside in held(seed).items():
            counts[name] += inside
    for name, words in (("sigma", "rms height"), ("b", "correlation length"), ("c", "slope of the spectrum")):
        print(f"{words}: {counts[name]} of {draws} intervals hold the truth ({100 * counts[name] / draws:.1f} %)")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)
