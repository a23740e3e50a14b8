"""A lobe that is Phong's is not taken for a BRDF times a cosine."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows

from .. import surfaces


@pytest.mark.parametrize("exponent", [5.0, 20.0, 80.0])
def test_a_phong_surface_is_not_corrected_by_a_cosine_seed_0(exponent):
    theta_i, theta_r, _ = surfaces.in_plane_run("rough gold", 0)
    geom = rows(in_plane(theta_i, theta_r))
    brdf = Surface(models.get("phong"), {"phong.ks": 0.3, "phong.exponent": exponent}, ("550 nm",)).brdf(geom)
    brdf = brdf * np.exp(0.01 * np.random.default_rng(0).standard_normal(brdf.shape))
    found = examine.examine(Measurement(geom, brdf, ("550 nm",)))
    assert not any(each.undo for each in found)


def test_a_brdf_times_a_cosine_still_is_seed_0():
    theta_i, theta_r, values = surfaces.in_plane_run("rough gold", 0)
    geom = rows(in_plane(theta_i, theta_r))
    found = examine.examine(Measurement(geom, values[:, None] * geom.cos_r, ("550 nm",)))
    assert "brdf-cos" in [each.undo for each in found]


@pytest.mark.parametrize("half", [3.0, 5.0])
def test_one_scan_about_the_mirror_direction_has_no_exchanged_values(half):
    """Near grazing a partner a few degrees off, on the same scan, was taken for an exchange: its slope for a cosine."""
    theta_r = np.arange(78.0 - half, 78.0 + half + 0.01, 0.25)
    geom = rows(in_plane(np.full_like(theta_r, 78.0), theta_r))
    metal = {"he-torrance.sigma": 0.2, "he-torrance.slope": 0.1, "he-torrance.n": 1.0, "he-torrance.k": 4.0}
    brdf = Surface(models.get("he-torrance"), metal, ("550 nm",)).brdf(geom)
    found = examine.examine(Measurement(geom, brdf, ("550 nm",)))
    assert not any(each.undo or each.code in ("reciprocal", "not-reciprocal") for each in found)
