"""The table behind brdfguide/advice/wave_gloss.py: a glossmeter's share of He and Torrance's lobe, by integration.

`python benchmarks/wave_gloss.py` writes it (half a minute); `--check` compares what is read between its entries with
integration at 60 random surfaces and prints the largest difference in gloss units.
"""

import sys
from math import cos, radians
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np

from brdfguide.advice import wave_gloss
from brdfguide.physics import gloss
from brdfguide.physics.fresnel import fresnel


def write() -> None:
    sigmas, slopes = wave_gloss.axes()
    table = np.empty((len(gloss.ANGLES), len(sigmas), len(slopes)))
    for angle, values in zip(gloss.ANGLES, table, strict=True):
        for column, slope in enumerate(slopes):
            values[:, column] = np.log(np.maximum(wave_gloss.integrated_lobe(angle, sigmas, slope), 1e-30))
    np.save(Path(wave_gloss.__file__).with_suffix(".npy"), table.astype(np.float32))


def check(draws: int = 60, seed: int = 1) -> None:
    rng = np.random.default_rng(seed)
    for angle in gloss.ANGLES:
        smooth = 100 * float(fresnel(cos(radians(angle)), wave_gloss.N)) / gloss.black_glass(angle)
        worst = 0.0
        for _ in range(draws):
            sigma, slope = np.exp(rng.uniform(np.log([0.005, 0.005]), np.log([20.0, 0.8])))
            exact = wave_gloss.integrated_lobe(angle, [sigma], slope, 18)[0]
            read = wave_gloss.wave_share(angle, sigma, slope) - wave_gloss.mirror_share(angle, sigma, slope)
            worst = max(worst, smooth * abs(float(read) - exact))
        print(f"{angle} degrees: {worst:.3f} units at most, {draws} surfaces, seed {seed}")


if __name__ == "__main__":
    check() if "--check" in sys.argv else write()
