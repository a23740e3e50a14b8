"""A scan of a polished mirror: Harvey and Shack's law with the noise of a good scatterometer. Run it to write the file.

python examples/samples/polished_mirror.py > examples/polished_mirror.csv
"""

import numpy as np

import brdfguide

SURFACE = "abg abg.a=1.2e-5 abg.b=8e-6 abg.g=1.6"
NOISE, SEED = 0.03, 5
THETA_I = (5.0, 30.0)
OFFSETS = np.r_[-60:0:3.0, -0.6, -0.3, 0.3, 0.6, 3.0:60:3.0]  # from the mirror direction [deg]


def main() -> None:
    rng = np.random.default_rng(SEED)
    print(f"# origin: synthetic, {SURFACE} with {100 * NOISE:g} % noise, seed {SEED}; samples/polished_mirror.py")
    print("# wavelength_nm: 633")
    print("theta_i_deg,theta_r_deg,brdf,stderr")
    for theta_i in THETA_I:
        for theta_r in theta_i + OFFSETS[np.abs(theta_i + OFFSETS) < 85]:
            value = float(brdfguide.evaluate(SURFACE, theta_i, theta_r).item()) * (1 + NOISE * rng.standard_normal())
            print(f"{theta_i:g},{theta_r:g},{value:.5g},{NOISE * value:.3g}")


if __name__ == "__main__":
    main()
