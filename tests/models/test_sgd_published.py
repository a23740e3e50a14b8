"""The printed fits of Bagher et al. read as they are: their constant is the integral that we take for it."""

import json
import re

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models._shifted_gamma import norm
from brdfguide.physics.geometry import Geometry

LIST = r"(\[[^\]]*\]|\[\[[^\]]*\], \[[^\]]*\]\])"
NAMES = ("albedo", "alpha", "p", "eta", "K", "Lambda", "c", "k", "theta0")
LINE = re.compile(
    rf"^(\S+) = Aggregate\(Lambertian\(albedo = {LIST}\), Bagher\("
    + ", ".join(f"{name} = {LIST}" for name in NAMES)
    + r"\)\)$",
    re.M,
)


@pytest.fixture(scope="module")
def fits(data):
    """Material -> our values, and the printed K."""
    found = {}
    for match in LINE.finditer((data / "merl_fits" / "bagher_sgd.fit").read_text()):
        material, body, *lists = match[1], *(np.array(json.loads(text)) for text in match.groups()[1:])
        rho_s, alpha, p, (f0, f1), constant, lam, c, k, theta0 = lists
        lobe = {"rho_s": rho_s, "alpha": alpha, "p": p, "f0": f0, "f_normal": f0 - f1}
        lobe |= {"theta0": theta0, "c": c, "k": k, "lam": lam}
        found[material] = {"lambertian.albedo": body} | {f"sgd-published.{key}": v for key, v in lobe.items()}, constant
    assert len(found) == 50
    return found


def test_the_printed_constant_is_no_parameter(fits):
    for values, printed in fits.values():
        alpha = values["sgd-published.alpha"]
        ours = np.exp(alpha) / (alpha * norm(alpha, values["sgd-published.p"])[0])
        np.testing.assert_allclose(ours, printed, rtol=1e-5)


def test_every_printed_number_lies_within_our_bounds_and_has_a_value_at_every_angle(fits):
    surface = models.get("lambertian+sgd:published")
    theta, phi = np.meshgrid([0.0, 20.0, 45.0, 70.0, 85.0, 89.99], [0.0, 90.0, 179.9, 180.0])
    geom = Geometry.from_degrees(theta.reshape(-1, 1), 0.0, theta.reshape(-1, 1) * 0.98, phi.reshape(-1, 1))
    for material, (values, _) in fits.items():
        for key, value in values.items():
            parameter = surface.parameters[key]
            assert np.all((value >= parameter.low) & (value <= parameter.high * (1 + 1e-9))), (material, key)
        assert np.all(np.isfinite(surface(geom, values))) and np.all(surface(geom, values) >= 0), material
