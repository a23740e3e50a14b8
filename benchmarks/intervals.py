"""Whether stated intervals hold the truth: random surfaces, readings with their usual errors, intervals of 95 %.

`python benchmarks/intervals.py [SURFACES] [SEED]`: slopes about 0.1, heights of 0.05 to 2 µm whose mirror image emerges
below 86 degrees. Each line is one way to observe them; the last column is the share of intervals that hold the truth.
"""

import sys
from math import exp, log
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np

from brdfguide.advice import wave_gloss
from brdfguide.advice.evidence import Evidence, Observation
from brdfguide.advice.inference import infer
from brdfguide.physics import emergence, gloss
from brdfguide.physics.fresnel import fresnel

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 200
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 7


def surfaces(rng: np.random.Generator):
    """(sigma [µm], slope, angle of emergence [°]) as described above."""
    left = COUNT
    while left:
        sigma, slope = exp(rng.uniform(log(0.05), log(2.0))), exp(rng.normal(log(0.1), log(3.0)))
        angle = emergence.emergence_angle(sigma, sigma / slope) if 0.001 < slope < 1 else None
        if angle and angle < 86:
            left -= 1
            yield sigma, slope, angle


def seen(angle: float, rng) -> Observation:
    return Observation("emergence_angle_deg", "emergence", min(angle + rng.normal(0, 2), 89.9), 2.0)


def length(sigma: float, slope: float, rng) -> Observation:
    return Observation("stylus.tau_um", "tau", log(sigma / slope) + rng.normal(0, 0.2), 0.2)


def height(sigma: float, rng) -> Observation:
    return Observation("stylus.sigma_um", "sigma", log(sigma) + rng.normal(0, 0.1), 0.1)


def glosses(sigma: float, slope: float, n: float, rng) -> tuple[Observation, ...]:
    found = []
    for angle in (60, 85):
        smooth = 100 * float(fresnel(np.cos(np.radians(angle)), n)) / gloss.black_glass(angle)
        value = smooth * float(wave_gloss.wave_share(angle, sigma, slope))
        doubt = gloss.tolerance(value)
        found.append(Observation(f"gloss.{angle}", "gloss", max(value + rng.normal(0, doubt), 0.0), doubt, angle))
    return tuple(found)


WAYS = {
    "mirror image alone": lambda sigma, slope, angle, rng: (seen(angle, rng),),
    "mirror image, length": lambda sigma, slope, angle, rng: (seen(angle, rng), length(sigma, slope, rng)),
    "mirror image, height": lambda sigma, slope, angle, rng: (seen(angle, rng), height(sigma, rng)),
    "gloss at 60 and 85": lambda sigma, slope, angle, rng: glosses(
        sigma, slope, exp(log(0.5) + rng.normal(0, 0.12)) + 1, rng
    ),
    "gloss and mirror image": lambda sigma, slope, angle, rng: (
        *glosses(sigma, slope, exp(log(0.5) + rng.normal(0, 0.12)) + 1, rng),
        seen(angle, rng),
    ),
}


def main() -> None:
    print(f"{COUNT} surfaces, seed {SEED}; share of intervals of 95 % that hold the truth")
    for way, observe in WAYS.items():
        rng = np.random.default_rng(SEED)
        held = {"sigma": 0, "slope": 0, "tau": 0}
        for sigma, slope, angle in surfaces(rng):
            found = infer(Evidence(observe(sigma, slope, angle, rng)))
            law = next(each for each in found.laws if each.name == "he-torrance")
            for name, truth in (("sigma", sigma), ("slope", slope), ("tau", sigma / slope)):
                number = law.numbers[name]
                held[name] += (number.low or 0.0) <= truth <= (number.high or np.inf)
        print(f"{way:24} " + "  ".join(f"{name} {count / COUNT:.1%}" for name, count in held.items()), flush=True)


if __name__ == "__main__":
    main()
