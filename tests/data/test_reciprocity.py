"""Exchanged pairs: exact ones before near ones, and the power of the cosines that they tell."""

import numpy as np
import pytest

from brdfguide.data import reciprocity
from brdfguide.data.measurement import Measurement

from ..surfaces import SURFACES, geometry, value


def grid(step: float, shift: float = 0.0) -> Measurement:
    """A glossy surface over equal incidences and reflected angles; `shift` [deg] spoils their exact exchange."""
    theta_i, theta_r, phi = (
        each.ravel()
        for each in np.meshgrid(np.arange(step, 76, step), np.arange(step, 76, step) + shift, [90.0, 135.0, 180.0])
    )
    geom = geometry(theta_i, theta_r, phi)
    return Measurement(geom, value(geom, *SURFACES["satin plastic"]))


def weighted(measurement: Measurement, power_i: float, power_r: float) -> Measurement:
    geom = measurement.geom
    return Measurement(geom, measurement.brdf * geom.cos_i**power_i * geom.cos_r**power_r)


@pytest.mark.parametrize(("power_i", "power_r", "slope"), [(0, 0, 0.0), (1, 0, -1.0), (0, 1, 1.0), (1, 1, 0.0)])
def test_values_that_fall_exactly_as_a_cosine_are_found_to_do_so_exactly(power_i, power_r, slope):
    found = reciprocity.test(weighted(grid(7.5), power_i, power_r))
    assert found.power == pytest.approx(slope, abs=1e-9) and found.power_stderr == pytest.approx(0, abs=1e-9)


def test_pairs_that_are_only_near_are_taken_where_there_are_no_others():
    found = reciprocity.test(weighted(grid(7.5, shift=1.0), 1, 0))
    assert found.pairs >= 12 and found.power == pytest.approx(-1.0, abs=0.25)


def test_a_few_exact_pairs_without_a_lever_do_not_displace_the_others():
    spoilt = grid(7.5, shift=1.0)
    even = geometry(np.full(15, 30.0), np.full(15, 30.0), np.linspace(20, 160, 15))  # their own exchange
    both = np.concatenate([spoilt.brdf, value(even, *SURFACES["satin plastic"])])
    angles = [
        np.concatenate([getattr(g, n)[:, 0] for g in (spoilt.geom, even)])
        for n in ("theta_i_deg", "theta_r_deg", "phi_deg")
    ]
    assert reciprocity.test(Measurement(geometry(*angles), both)).pairs > 15
