"""Every real file is read without options, with the right mirror side, quantity, units and channels."""

import numpy as np
import pytest

from brdfguide.data import formats


def codes(measurement):
    return {finding.code for finding in measurement.findings}


@pytest.mark.parametrize("name", ["garnet_red", "cayman"])
def test_cornell_files_have_31_channels_and_mirror_their_light_at_180_degrees(data, name):
    measurement = formats.read(data / "cornell" / f"{name}.brdf")
    assert measurement.brdf.shape == (1439, 31)
    assert measurement.channels[0] == "400nm" and measurement.geom.wavelength[-1] == pytest.approx(0.7)
    assert sorted(measurement.theta_i_groups) == [10, 20, 30, 40, 50, 60, 70, 80]
    near = measurement.geom.mirror_distance2[:, 0] < np.radians(15) ** 2
    assert np.nanmedian(measurement.brdf[near]) > 3 * np.nanmedian(measurement.brdf[~near])
    assert "zeros-missing" in codes(measurement)


@pytest.mark.parametrize(
    "name", ["aluminium_anodised", "copper", "lacquer_smooth", "stainless_brushed", "steel_sandblasted"]
)
def test_infrared_scans_lie_on_the_mirror_side(data, name):
    measurement = formats.read(data / "mwir" / f"{name}.csv")
    assert measurement.in_plane and measurement.brdf.shape == (866, 1)
    assert np.all(measurement.geom.signed_theta_r_deg > 0)
    assert measurement.geom.wavelength[0] == pytest.approx(3.85)  # the middle of 2-5.7 um


def test_negative_incidence_puts_the_mirror_at_phi_0(data):
    measurement = formats.read(data / "nist" / "PTFE.data.csv")
    assert measurement.channels == ("351nm", "532nm", "633nm", "1064nm")
    assert measurement.brdf.shape == (1824, 4)
    rows = measurement.theta_i_groups[75.0]
    forward = measurement.geom.dot_xy[rows, 0] < 0
    assert np.nanmax(measurement.brdf[rows[forward]]) > 1.5 * np.nanmax(measurement.brdf[rows[~forward]])
    assert {"negative-theta-i", "columns-ignored"} <= codes(measurement)


@pytest.mark.parametrize(("name", "incidences"), [("aluminum", 7), ("chassis", 4)])
def test_satellite_files_call_the_zenith_phi(data, name, incidences):
    measurement = formats.read(data / "starlink" / f"{name}_brdf.csv")
    assert len(measurement.theta_i_groups) == incidences and measurement.in_plane
    assert "phi-is-zenith" in codes(measurement)
    for theta_i, rows in measurement.theta_i_groups.items():
        if theta_i > 8:
            peak = rows[np.nanargmax(measurement.brdf[rows, 0])]
            assert measurement.geom.signed_theta_r_deg[peak, 0] == pytest.approx(theta_i, abs=1.5)
    assert ("floor" in codes(measurement)) == (name == "chassis")
