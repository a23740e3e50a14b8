"""The mirror side by the values: a matt surface that is brighter toward the light is not turned round."""

import numpy as np
import pytest

from brdfguide import fit, models
from brdfguide.data import conventions
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows

from .. import surfaces


def matt(tmp_path, spread: float, noise: float, step: float):
    """A table of clay in the plane of incidence, theta_r > 0 on the mirror side."""
    angles = np.meshgrid([10.0, 30.0, 45.0, 60.0, 75.0], np.arange(-80.0, 81.0, step))
    theta_i, theta_r = (each.T.ravel() for each in angles)
    values = {"oren-nayar.albedo": 0.5, "oren-nayar.spread": spread}
    brdf = Surface(models.get("oren-nayar"), values, ("550 nm",)).brdf(rows(in_plane(theta_i, theta_r)))[:, 0]
    brdf = brdf * np.exp(noise * np.random.default_rng(1).standard_normal(len(brdf)))
    path = tmp_path / "clay.csv"
    path.write_text(surfaces.table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, brdf))
    return path


@pytest.mark.parametrize("spread", [0.3, 0.45, 0.6])
@pytest.mark.parametrize(("noise", "step"), [(0.0, 4.0), (0.02, 10.0), (0.05, 4.0)])
def test_clay_is_brighter_toward_the_light_and_stays_as_it_was_read_seed_1(tmp_path, spread, noise, step):
    answer = fit(matt(tmp_path, spread, noise, step), ["oren-nayar", "lambertian+ggx", "lambertian+ward"])
    assert answer.recommended.name == "oren-nayar"
    assert answer.recommended.values["oren-nayar.spread"] == pytest.approx(spread, rel=0.1)
    (said,) = [each for each in answer.measurement.findings if each.code == "mirror-side"]
    assert said.severity == "warning" and "matt facets that shade each other" in said.text


@pytest.mark.parametrize("name", ["white paint", "rough gold", "black rubber", "egg-shell white", "bead-blasted steel"])
def test_a_lobe_however_rough_is_turned_round_all_the_same(name):
    theta_i, theta_r, values = surfaces.in_plane_run(name, seed=1)
    found = conventions.side_of(rows(in_plane(theta_i, -theta_r)), values[:, None])
    assert found.verdict == "turned"
