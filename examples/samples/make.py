"""Make the noise-free tables of the synthetic stand-ins, one CSV for each surface and variant.

python examples/samples/make.py rough_plastic a > examples/samples/truth/rough_plastic_a.csv
"""

import sys
from importlib import import_module

import numpy as np

THETAS_I = np.array([10.0, 30, 45, 60, 75, 80])
THETAS_R = np.arange(-85.0, 85.5, 1.0)


def main(surface, variant):
    module = import_module(surface)
    thetas_i = getattr(module, "THETAS_I", THETAS_I)
    thetas_r = getattr(module, "THETAS_R", THETAS_R)
    f = module.truth(thetas_i, thetas_r, variant)
    print(f"# sample: {module.ABOUT}, variant {variant}")
    print(f"# origin: synthetic, level {module.LEVEL}; not a measurement of any real surface")
    print(f"# generator: examples/samples/{surface}.py {variant}; in plane, theta_r > 0 on the mirror side")
    print(f"# wavelength_nm: {getattr(module, 'WAVELENGTH_NM', 550)}")
    print("theta_i_deg,theta_r_deg,brdf")
    for theta_i, row in zip(thetas_i, f, strict=True):
        for theta_r, value in zip(thetas_r, row, strict=True):
            print(f"{theta_i:g},{theta_r:g},{value:.6g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
