"""What GGX facets lose between each other, as the series in brdfguide/physics/facet_albedo.py: fits and prints them.

    python benchmarks/facet_albedo.py

The loss 1 - E of a lobe with F = 1 is integrated over the hemisphere on Chebyshev nodes of width and angle, and fitted
by least squares. Takes a minute; prints the largest error on a grid in between.
"""

import numpy as np
from numpy.polynomial import chebyshev

from brdfguide.physics import microfacet
from brdfguide.physics.facet_albedo import NARROWEST, WIDEST, angle_share, width_share
from brdfguide.physics.hemisphere import hemisphere_directions

DEGREES = (14, 18)  # in the share of the width, in that of the angle
GRID, BETWEEN = (18, 30), (15, 23)
DIGITS = 7


def lost(mu: float, alpha: float) -> float:
    """1 - E, to 1e-9."""
    geom, weights = hemisphere_directions(float(90 - np.degrees(np.arcsin(mu))))
    return 1 - float(weights @ microfacet.ggx_shape(geom, alpha)[:, 0])


def nodes(count: int) -> np.ndarray:
    return (1 + np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2


def grid(widths: int, angles: int):
    """Width, cosine and 1 - E on nodes of both shares."""
    steps = np.linspace(np.log(NARROWEST), np.log(WIDEST), 20001)
    alpha = np.exp(np.interp(nodes(widths), width_share(np.exp(steps)), steps))
    alpha, share = np.repeat(alpha, angles), np.tile(nodes(angles), widths)
    mu = np.minimum(alpha * np.sinh(share**2 * np.arcsinh(1 / alpha)), 1.0)
    return alpha, mu, np.array([lost(m, a) for m, a in zip(mu.tolist(), alpha.tolist(), strict=True)])


def columns(alpha, mu):
    share = angle_share(mu, alpha)
    by_width = chebyshev.chebvander(2 * width_share(alpha) - 1, DEGREES[0])
    by_angle = chebyshev.chebvander(2 * share - 1, DEGREES[1]) * share[:, None]
    return (by_width[:, :, None] * by_angle[:, None, :]).reshape(len(mu), -1)


def main() -> None:
    alpha, mu, loss = grid(*GRID)
    found = np.round(np.linalg.lstsq(columns(alpha, mu), loss, rcond=None)[0], DIGITS)
    for row in found.reshape(DEGREES[0] + 1, -1):
        for start in range(0, len(row), 10):
            print("    " + " ".join(f"{each:.{DIGITS}f}" for each in row[start : start + 10]))
    alpha, mu, loss = grid(*BETWEEN)
    print(f"# largest error of 1 - E {np.abs(columns(alpha, mu) @ found - loss).max():.1e}")


if __name__ == "__main__":
    main()
