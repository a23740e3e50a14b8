"""Made-up measurements of surfaces whose parameters are known: directions, random parameters, noise, gaps."""

import numpy as np

from brdfguide.data.measurement import Measurement
from brdfguide.fitting.layout import from_coordinate, to_coordinate
from brdfguide.models.surface import Surface
from brdfguide.physics.directions import gathered
from brdfguide.physics.geometry import Geometry, rows

WAVELENGTHS_UM = (0.45, 0.55, 0.65)


def scan(theta_i=(10, 25, 40, 55, 65, 75), step: float = 4.0) -> Geometry:
    """Scans in the plane of incidence, as a goniometer of the report's kind makes them."""
    theta_i, theta_r = (a.ravel() for a in np.meshgrid(theta_i, np.arange(-80.0, 80.1, step), indexing="ij"))
    return rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))


def hemisphere(count: int = 600, seed: int = 5, highest: float = 80.0) -> Geometry:
    """Directions scattered over both hemispheres, half of them within some 25° of the mirror direction."""
    random = np.random.default_rng(seed)
    theta_i, theta_r = random.uniform(0, highest, count), random.uniform(0, highest, count)
    phi = random.uniform(0, 360, count)
    near = np.arange(count) % 2 == 0
    theta_r = np.where(near, np.clip(theta_i + random.normal(0, 12, count), 0, highest), theta_r)
    phi = np.where(near, 180 + random.normal(0, 15, count), phi)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def joined(parts) -> Geometry:
    """The rows of several geometries, at the wavelengths of the first."""
    return Geometry(gathered([part.directions for part in parts]), parts[0].wavelength)


def surface(model, geom: Geometry, values, *, noise: float = 0.0, seed: int = 0, channels: int = 1) -> Measurement:
    """What an instrument with a relative error of `noise` and seven decades of range reports of a surface."""
    wavelength = np.asarray(WAVELENGTHS_UM[:channels] if channels <= 3 else np.linspace(0.4, 0.7, channels))
    geom = geom.at(wavelength)
    truth = np.broadcast_to(model(geom, values), (len(geom), channels))
    noisy = truth * np.exp(noise * np.random.default_rng(seed).standard_normal(truth.shape))
    noisy[truth < 1e-7 * truth.max()] = np.nan
    names = tuple(f"{1e3 * each:.0f} nm" for each in wavelength)
    return Measurement(geom, noisy, names, name="synthetic")


def fitted(model, values, data: Measurement) -> Surface:
    """The surface of these values in the channels of a measurement."""
    return Surface(model, values, data.channels, data.geom.wavelength)


def with_gaps(measurement: Measurement, seed: int) -> Measurement:
    """The same without one stretch of detector angles and a tenth of the rest, and with a few values missing."""
    random = np.random.default_rng(seed)
    angle = measurement.geom.signed_theta_r_deg[:, 0]
    hole = random.uniform(-60, 60)
    kept = (np.abs(angle - hole) > 8) & (random.uniform(size=len(angle)) > 0.1)
    left = measurement[kept]
    left.brdf[random.uniform(size=left.brdf.shape) < 0.01] = np.nan
    return left


def random_values(layout, random, inner: float = 0.1) -> dict:
    """Values of every free parameter: within the shapes that a fit starts from, or within bounds if they name none.

    The k of a metal with n = 1 is drawn from 1.5 to 10, F0 from 0.36 to 0.96.
    """
    values = layout.model.defaults()
    for key, parameter in layout.parameters.items():
        ends = (
            (min(parameter.starts), max(parameter.starts))
            if parameter.starts
            else (max(parameter.low, 0.02), min(parameter.high, 0.8))
        )
        ends = (1.5, 10.0) if parameter.name == "k" else ends
        low, high = (float(to_coordinate(parameter, np.asarray(end))) for end in ends)
        low, high = low + inner * (high - low), high - inner * (high - low)
        size = layout.channels if key in layout.per_channel else None
        drawn = from_coordinate(parameter, random.uniform(low, high, size))
        values[key] = drawn if size else float(drawn)
    return values
