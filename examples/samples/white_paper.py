"""Stand-in for the report's white paper (section 4.3): rough fibres with an interface over a body that scatters many
times.

Level L2: a random height field of large slope over part of the area, and a deep isotropically scattering body by
Chandrasekhar's H function; no reflectance model that is fitted later. Variant b: fibres over half the area; variant c:
over 45 %, and a tenth as smooth as the rough plastic; variant l: as b with an even (Lambertian) body instead.
"""

import numpy as np
from heightfield import gaussian, soft_tailed
from rough_plastic import rough_interface

ABOUT = (
    "white paper: height field of slope sd 0.44, n 1.5, over a multiply scattering body, single scattering albedo 0.985"
)
LEVEL = "L2"
VARIANTS = {"b": (0.50, 0.0), "c": (0.45, 0.10), "l": (0.50, 0.0)}
SLOPE_SD, W, SHARE = 0.44, 0.985, 0.88


def truth(thetas_i, thetas_r, variant="b", seed=20042, maps=12):
    """BRDF [1/sr] without noise, (theta_i, theta_r)."""
    rough, sheen = VARIANTS[variant]
    f = rough * rough_interface(thetas_i, thetas_r, gaussian, SLOPE_SD, seed, maps)[0]
    if sheen:
        f = f + sheen * rough_interface(thetas_i, thetas_r, soft_tailed, 0.228, seed + 1, maps)[0]
    ci, cr = np.cos(np.radians(thetas_i))[:, None], np.cos(np.radians(thetas_r))[None, :]
    body = SHARE * W / (4 * np.pi) * chandrasekhar(ci) * chandrasekhar(cr) / (ci + cr)
    return f + (np.full_like(body, 0.65 / np.pi) if variant == "l" else body)


def chandrasekhar(mu, w=W):
    """H(mu) of isotropic scattering: H = 1/(sqrt(1-w) + w/2 Int x H(x)/(mu+x) dx), iterated to rest."""
    x, weight = np.polynomial.legendre.leggauss(64)
    x, weight = 0.5 * (x + 1), 0.5 * weight
    h = np.ones_like(x)

    def solve(at):
        return 1 / (np.sqrt(1 - w) + w / 2 * np.sum(weight * x * h / (at[..., None] + x), axis=-1))

    for _ in range(1000):
        previous, h = h, solve(x)
        if np.max(np.abs(h - previous)) < 1e-12:
            break
    return solve(np.asarray(mu, float))
