"""A floor is told from a body whose lobe has died out, also where most values stand at it, and in numbers of few
digits."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import conventions
from brdfguide.data.measurement import Measurement
from tests.synthetic import scan

LOBES = {
    "beckmann": lambda width: {"beckmann.alpha": width, "beckmann.n": 1.5},
    "ggx": lambda width: {"ggx.alpha": width, "ggx.n": 1.5},
    "ward": lambda width: {"ward.alpha": width, "ward.rho_s": 0.04},
}


def run(lobe: str, width: float, step: float, albedo: float = 0.3) -> Measurement:
    geom = scan(theta_i=(10, 30, 50, 65), step=step)
    brdf = models.get(f"lambertian+{lobe}")(geom, {"lambertian.albedo": albedo} | LOBES[lobe](width))
    return Measurement(geom, np.array(np.broadcast_to(brdf, (len(geom), 1))), ("brdf",), name="made")


def written(measurement: Measurement, digits: int) -> Measurement:
    measurement.brdf[:, 0] = [float(f"{value:.{digits}g}") for value in measurement.brdf[:, 0]]
    return measurement


def floor_of(measurement: Measurement):
    found = [each for each in conventions.without_marks(measurement).findings if each.code == "floor"]
    return dict(found[0].numbers)["floor_per_sr"] if found else None


@pytest.mark.parametrize("digits", [2, 3, 4, 5, 7, 17])
@pytest.mark.parametrize("step", [0.5, 2, 5])
@pytest.mark.parametrize("width", [0.01, 0.05, 0.1, 0.15])
@pytest.mark.parametrize("lobe", LOBES)
def test_a_body_is_no_floor(lobe, width, step, digits):
    assert floor_of(written(run(lobe, width, step), digits)) is None


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize("width, step", [(0.05, 1), (0.1, 2), (0.2, 2), (0.4, 1)])
@pytest.mark.parametrize("share", [0.55, 0.7])
def test_a_floor_that_most_values_share_is_one(width, step, share, noise):
    measurement = run("ggx", width, step, albedo=0.05)
    measurement.brdf[:] *= np.exp(noise * np.random.default_rng(1).standard_normal(measurement.brdf.shape))
    low = float(np.quantile(measurement.brdf, share))
    measurement.brdf[:] = np.maximum(measurement.brdf, low)
    assert floor_of(written(measurement, 7)) == pytest.approx(low, rel=1e-6)
    assert np.mean(np.isnan(conventions.without_marks(measurement).brdf)) > 0.5
