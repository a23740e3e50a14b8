"""A small net of half vector and difference vector: what a trained function of 631 numbers can hold.

    inputs  h = (sin θh, 0, cos θh) and d with its azimuth doubled, so that exchange of light and detector is nothing
    layers  21 and 21, leaky rectifiers; output ln f of one channel, standardised

Adam on batches of 1,024 with a step that fades as a cosine; the seed is fixed, and two machines may differ in the third
digit.

Source: Sztrajman, Rainer, Ritschel and Weyrich 2021, "Neural BRDF representation and importance sampling"; Kingma and
Ba 2015 for Adam.
"""

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass
from .smooth import around

LAYERS = (6, 21, 21, 1)
COUNT = sum(before * after + after for before, after in zip(LAYERS, LAYERS[1:], strict=False))
LEAK = 0.01
STEPS, BATCH, SPEED, DECAYS, SEED = 4000, 1024, 5e-3, (0.9, 0.99), 0


def inputs(geom: Geometry) -> np.ndarray:
    """(samples, 6) float32."""
    tan_h = np.sqrt(np.ravel(geom.tan2_h))
    cos_h = 1 / np.sqrt(1 + tan_h**2)
    cos_d = np.minimum(np.ravel(geom.cos_d), 1.0)
    sin_d, sin_h = np.sqrt(1 - cos_d**2), tan_h * cos_h
    size = (sin_h * sin_d) ** 2
    twice = np.where(size > 1e-12, around(geom, 2) / np.maximum(size, 1e-12), 1.0)  # cos 2 phi_d
    across = np.sqrt(np.maximum(1 - twice**2, 0.0))
    columns = [sin_h, np.zeros_like(cos_h), cos_h, sin_d * twice, sin_d * across, cos_d]
    return np.stack(columns, axis=1).astype(np.float32)


@dataclass(frozen=True, eq=False)
class Net:
    """Its weights and what its output is scaled by."""

    layers: list[tuple[np.ndarray, np.ndarray]]
    mean: float
    spread: float

    def __call__(self, geom: Geometry) -> np.ndarray:
        """BRDF [1/sr] of one channel, (samples, 1)."""
        return np.exp(self.mean + self.spread * _through(self.layers, inputs(geom))[-1].astype(float))


def fit_net(geom: Geometry, ln: np.ndarray) -> Net:
    """Trained on ln f (samples,), NaN where there is no value."""
    known = np.isfinite(ln)
    given, mean, spread = inputs(geom)[known], float(ln[known].mean()), float(max(ln[known].std(), 1e-6))
    wanted = ((ln[known] - mean) / spread).astype(np.float32)[:, None]
    random = np.random.default_rng(SEED)
    layers = [
        (
            (random.standard_normal((before, after)) * np.sqrt(2 / before)).astype(np.float32),
            np.zeros(after, np.float32),
        )
        for before, after in zip(LAYERS, LAYERS[1:], strict=False)
    ]
    moments = [(np.zeros_like(each), np.zeros_like(each)) for layer in layers for each in layer]
    for step in range(1, STEPS + 1):
        rows = random.integers(0, len(given), min(BATCH, len(given)))
        slopes = _slopes(layers, given[rows], wanted[rows])
        speed = 0.5 * SPEED * (1 + np.cos(np.pi * step / STEPS))
        _move([each for layer in layers for each in layer], slopes, moments, step, speed)
    return Net(layers, mean, spread)


def _through(layers, values) -> list[np.ndarray]:
    """What goes into each layer, and what comes out of the last."""
    found = [values]
    for place, (matrix, offset) in enumerate(layers):
        values = values @ matrix + offset
        values = values if place == len(layers) - 1 else np.maximum(values, LEAK * values)
        found.append(values)
    return found


def _slopes(layers, given, wanted) -> list[np.ndarray]:
    """Of half the mean squared error, by each matrix and offset."""
    values = _through(layers, given)
    error: np.ndarray = (values[-1] - wanted) / len(wanted)
    found: list[np.ndarray] = []
    for place in range(len(layers) - 1, -1, -1):
        found[:0] = [values[place].T @ error, error.sum(axis=0)]
        if place:
            error = (error @ layers[place][0].T) * np.where(values[place] > 0, 1.0, LEAK).astype(np.float32)
    return found


def _move(numbers, slopes, moments, step: int, speed: float) -> None:
    """Adam's step, in place."""
    first, second = DECAYS
    for number, slope, (mean, square) in zip(numbers, slopes, moments, strict=True):
        mean += (1 - first) * (slope - mean)
        square += (1 - second) * (slope * slope - square)
        number -= (speed * (mean / (1 - first**step)) / (np.sqrt(square / (1 - second**step)) + 1e-8)).astype(
            np.float32
        )
