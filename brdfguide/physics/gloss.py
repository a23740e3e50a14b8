"""Glossmeter readings: from a lobe to gloss units at 20, 60 and 85 degrees, and back to a roughness.

    G = 100 Φ/Φ_standard,   Φ = ∫ f cos θr dω over the receptor, averaged over the lamp's image, + mirror part

The receptor is a rectangle about the mirror direction; the standard is polished black glass of n = 1.567
(ISO 2813:2014, ASTM D523). Metals read far above 100 and lie outside the standards.

For a Gaussian lobe the receptor's share has a closed form, good at 20° and 60° while the lobe is wider than the lamp
(`closed_form`); the answers here are integrated.
"""

from functools import lru_cache
from math import cos, erf, exp, log, radians

import numpy as np

from ..records import dataclass
from . import microfacet
from .fresnel import fresnel
from .geometry import Geometry, rows

ANGLES = (20, 60, 85)
RECEPTOR_DEG = {20: (1.80, 3.60), 60: (4.40, 11.70), 85: (4.00, 6.00)}  # in the plane of incidence, across it; ISO 2813
LAMP_DEG = (0.75, 2.5)  # image of the lamp at the receptor, in the plane and across; ISO 2813
STANDARD_N = 1.567  # black glass, 587.6 nm
DIFFUSE = {20: 1.20, 60: 2.49, 85: 0.03}  # units that a Lambertian body of albedo 1 adds; integrated, see the tests
LOBES = {"beckmann": microfacet.beckmann_shape, "ggx": microfacet.ggx_shape}
LOW = 0.002  # alpha that a reading is turned into, at least
HIGH = 1.0  # and at most
STEPS = 48  # of the table between
QUICK = 2, 11  # nodes over the lamp and the receptor, good to 1 unit
# two instruments agree within 1 unit or 1.5 % of the reading; ASTM D523's reproducibility, rounded
REPEATS = (1.0, 0.015)


@lru_cache(maxsize=8)
def black_glass(angle: int) -> float:
    """Fresnel reflectance of the black glass at the instrument's angle."""
    return float(fresnel(cos(radians(angle)), STANDARD_N))


def units(f, angle: int, mirror: float = 0.0, quick: bool = False):
    """Gloss units of a BRDF `f(geom)` [1/sr] whose ideal specular reflectance at `angle` is `mirror`.

    Takes  f giving (samples, channels).    Gives  (channels,); `quick` is good to 1 unit.
    Lobes narrower than about 0.02° need `mirror` instead.
    """
    geom, weight = receptor_directions(angle, *QUICK) if quick else receptor_directions(angle)
    return 100 / black_glass(angle) * (np.sum(weight * f(geom), axis=0) + mirror)


def facet_units(angle: int, alpha: float, n: float, lobe: str = "beckmann") -> float:
    """Gloss units of a rough dielectric without subsurface light; exact at n = 1.5, else F is scaled at the mirror."""
    return mirror_units(angle, n) * (share(angle, alpha, lobe) if alpha else 1.0)


def mirror_units(angle: int, n: float) -> float:
    """What a smooth surface of index n reads."""
    return 100 * float(fresnel(cos(radians(angle)), n)) / black_glass(angle)


@lru_cache(maxsize=4096)
def share(angle: int, alpha: float, lobe: str) -> float:
    """How much of a smooth surface's mirror light still reaches the receptor once it is rough: 1 at alpha = 0."""
    geom, weight = receptor_directions(angle)
    f = LOBES[lobe](geom, alpha) * fresnel(geom.cos_d, 1.5)
    return float(np.sum(weight * f)) / float(fresnel(cos(radians(angle)), 1.5))


def closed_form(angle: int, alpha: float, n: float) -> float:
    """Gloss units of a Gaussian lobe from a point lamp, H and V the receptor's full angles.

    Within 0.3 units at 60°, and at 20° from alpha = 0.05; narrower lobes are blurred by the lamp (5 units at 0.01), and
    at 85° facets hide each other (3 units at 0.2).

    G = 100 F/F_standard erf(H/(4 alpha)) erf(V/(4 alpha cos θ))
    """
    across = cos(radians(angle))
    high, wide = (radians(size) for size in RECEPTOR_DEG[angle])
    return (
        100
        * float(fresnel(across, n))
        / black_glass(angle)
        * erf(high / (4 * alpha))
        * erf(wide / (4 * alpha * across))
    )


# Gauss and Legendre's nodes from 0 on and their weights, as `numpy.polynomial` has them: it takes as long to load as a
# fiftieth of the answer to a description
GAUSS_LEGENDRE = {
    2: (
        (0.5773502691896257,),
        (1.0,),
    ),
    4: (
        (
            0.33998104358485626,
            0.8611363115940526,
        ),
        (
            0.6521451548625464,
            0.34785484513745357,
        ),
    ),
    11: (
        (
            0.0,
            0.26954315595234496,
            0.5190961292068118,
            0.7301520055740494,
            0.8870625997680953,
            0.978228658146057,
        ),
        (
            0.2729250867779005,
            0.26280454451024654,
            0.23319376459199057,
            0.1862902109277343,
            0.12558036946490433,
            0.05566856711617393,
        ),
    ),
    14: (
        (
            0.10805494870734367,
            0.31911236892788974,
            0.5152486363581541,
            0.6872929048116855,
            0.827201315069765,
            0.9284348836635735,
            0.9862838086968124,
        ),
        (
            0.21526385346315793,
            0.20519846372129572,
            0.18553839747793788,
            0.15720316715819363,
            0.12151857068790331,
            0.08015808715975999,
            0.03511946033175175,
        ),
    ),
}


@lru_cache(maxsize=2 * len(ANGLES))
def receptor_directions(angle: int, lamp_nodes: int = 4, nodes: int = 14) -> tuple[Geometry, np.ndarray]:
    """Lamp and receptor directions, rows of one column, and their weights: cos θr dω, averaged over the lamp.

    From each point of the lamp the receptor is divided at that point's mirror direction, with nodes that crowd there,
    so that lobes of any width are integrated.
    """
    theta = radians(angle)
    lamp, receptor = [radians(size) / 2 for size in LAMP_DEG], [radians(size) / 2 for size in RECEPTOR_DEG[angle]]
    at, w = _gauss_legendre(lamp_nodes)
    light, detector, weight = [], [], []
    for a, wa in zip(at, w, strict=True):
        for b, wb in zip(at, w, strict=True):
            if b > 0:  # the other half is its mirror image
                x, wx = _crowded(-receptor[0], receptor[0], a * lamp[0], nodes)
                y, wy = _crowded(-receptor[1], receptor[1], -b * lamp[1], nodes)
                x, y = (each.ravel() for each in np.meshgrid(x, y, indexing="ij"))
                light.append(np.broadcast_to(_direction(theta + a * lamp[0], b * lamp[1], -1), (len(x), 3)))
                detector.append(np.stack(_direction(theta + x, y, 1), -1))
                weight.append(np.outer(wx, wy).ravel() * np.cos(y) * (wa * wb / 2))
    geom = rows(Geometry.from_vectors(np.concatenate(light), np.concatenate(detector)))
    return geom, np.concatenate(weight)[:, None] * np.maximum(geom.cos_r, 0.0)


def _gauss_legendre(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes over -1..1, ascending, and weights."""
    if count not in GAUSS_LEGENDRE:
        return np.polynomial.legendre.leggauss(count)
    x, weights = map(np.array, GAUSS_LEGENDRE[count])
    below = slice(None, 0 if count % 2 else None, -1)  # an odd rule has its middle once
    return np.concatenate((-x[below], x)), np.concatenate((weights[below], weights))


def _direction(theta, across, side):
    """Unit vector at `theta` in the plane of incidence and `across` out of it; side -1 the lamp's, 1 the receptor's."""
    return side * np.sin(theta) * np.cos(across), np.sin(across), np.cos(theta) * np.cos(across)


def _crowded(low: float, high: float, centre: float, nodes: int, scale: float = 1e-3):
    """Gauss-Legendre nodes in u on both sides of `centre`, with x = centre ± scale sinh u."""
    at, w = _gauss_legendre(nodes)
    x, weights = [], []
    for end in (low, high):
        extent = np.arcsinh(abs(end - centre) / scale)
        u = (at + 1) / 2 * extent
        x.append(centre + np.sign(end - centre) * scale * np.sinh(u))
        weights.append(w * extent / 2 * scale * np.cosh(u))
    return np.concatenate(x), np.concatenate(weights)


@dataclass(frozen=True)
class Roughness:
    """What readings say: one width for all, what it predicts, and whether a lobe can give these readings at all."""

    alpha: float
    n: float
    lobe: str
    each: dict[int, float | None]  # the width that each reading alone would have; None: no width gives it
    predicted: dict[int, float]
    worst: float  # largest difference from a reading, in units of what two instruments differ by
    agrees: bool


def alpha_from(reading: float, angle: int, n: float, lobe: str = "beckmann", albedo: float = 0.0) -> float | None:
    """The width that one reading stands for; None where the reading lies outside what this index can give."""
    smooth = mirror_units(angle, n)
    aim = (reading - albedo * DIFFUSE[angle]) / smooth if smooth else -1.0
    if not quick_share(angle, HIGH, lobe) <= aim <= quick_share(angle, LOW, lobe):
        return None
    low, high = log(LOW), log(HIGH)
    while high - low > 1e-7:
        middle = (low + high) / 2
        low, high = (middle, high) if quick_share(angle, exp(middle), lobe) > aim else (low, middle)
    return exp((low + high) / 2)


def roughness_from(
    readings: dict[int, float], n: float | None = None, lobe: str = "beckmann", albedo: float = 0.0
) -> Roughness:
    """One width, and the index where it is not known and two or three readings tell it, from the readings together.

    Least squares of the differences in units of the instruments' reproducibility. `agrees` is False where no width
    gives all readings to within three of them, or only an index at the end of what was tried: then there is no single
    lobe, and nothing is averaged.
    """
    indices = [1.5 if n is None else n]
    if n is None and len(readings) > 1:
        indices = [1.30 + 0.02 * step for step in range(31)]
    alpha, index = _nearest(readings, indices, lobe, albedo)
    predicted = {angle: facet_units(angle, alpha, index, lobe) + albedo * DIFFUSE[angle] for angle in readings}
    worst = max(abs(predicted[angle] - reading) / tolerance(reading) for angle, reading in readings.items())
    each = {angle: alpha_from(reading, angle, index, lobe, albedo) for angle, reading in readings.items()}
    at_end = len(indices) > 1 and not indices[0] < index < indices[-1]
    return Roughness(alpha, index, lobe, each, predicted, worst, worst <= 3 and not at_end)


def tolerance(reading: float) -> float:
    return max(REPEATS[0], REPEATS[1] * reading)


@lru_cache(maxsize=len(ANGLES) * len(LOBES))
def _table(angle: int, lobe: str) -> np.ndarray:
    """ln share at STEPS + 1 widths, evenly spaced in ln alpha from LOW to HIGH."""
    return np.log([share(angle, float(alpha), lobe) for alpha in np.geomspace(LOW, HIGH, STEPS + 1)])


def quick_share(angle: int, alpha, lobe: str):
    """`share` of widths (...) by a cubic through four entries of the table; right to 1e-4 of its value."""
    table = _table(angle, lobe)
    x = np.log(alpha / LOW) / log(HIGH / LOW) * STEPS
    first = np.clip(np.asarray(x, int) - 1, 0, STEPS - 3)
    t = x - first
    a, b, c, d = (table[first + place] for place in range(4))
    return np.exp(
        -a * (t - 1) * (t - 2) * (t - 3) / 6
        + b * t * (t - 2) * (t - 3) / 2
        - c * t * (t - 1) * (t - 3) / 2
        + d * t * (t - 1) * (t - 2) / 6
    )


def _nearest(readings, indices, lobe, albedo) -> tuple[float, float]:
    """(alpha, n) of least squares: the best of a grid, then of two finer ones about it."""
    low, high = LOW, HIGH
    for _ in range(3):
        alphas = np.geomspace(low, high, 801)
        cost = np.zeros((len(indices), len(alphas)))
        for angle, reading in readings.items():
            smooth = np.array([[mirror_units(angle, n)] for n in indices])
            cost += (
                (smooth * quick_share(angle, alphas, lobe) + albedo * DIFFUSE[angle] - reading) / tolerance(reading)
            ) ** 2
        row, column = divmod(int(np.argmin(cost)), len(alphas))
        indices, low, high = [indices[row]], alphas[max(column - 2, 0)], alphas[min(column + 2, 800)]
    return float(alphas[column]), float(indices[0])
