"""Scans of one sample under several turns, joined; what cannot be of one sample is refused."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide.data import examine, formats
from brdfguide.data.joined import read_turned, turn_angles
from brdfguide.data.lobe_ellipse import lobe_ellipse
from brdfguide.errors import InputError

from .test_rotation import scans


def file_of(folder, name, turn, factor=1.0, scan=None):
    """A scan in the plane of incidence as laboratories write it: without an azimuth."""
    here = scans("ggx-aniso", [turn], seed=int(turn) + 1, alpha_x=0.3, alpha_y=0.1, axis=np.radians(20.0))
    geom = here.geom
    columns = [geom.theta_i_deg, geom.signed_theta_r_deg, factor * here.brdf]
    lines = [",".join(f"{float(each):.9g}" for each in row) for row in np.hstack(columns)]
    path = folder / name
    path.write_text("theta_i,theta_r,brdf\n" + "\n".join(lines) + "\n")
    return path


@pytest.fixture
def pair(tmp_path):
    return file_of(tmp_path, "one.csv", 20.0), file_of(tmp_path, "other.csv", 110.0)


def test_two_scans_are_one_measurement_that_shows_its_grain(pair):
    found = read_turned(pair, (0.0, 90.0))
    assert len(found.geom) == sum(len(formats.read(each).geom) for each in pair)
    np.testing.assert_array_equal(np.unique(found.geom.phi_i_deg), [-90.0, 0.0])
    assert {"scans-joined", "axis-assumed"} <= {each.code for each in found.findings}
    assert lobe_ellipse(found).ratio == pytest.approx(3.0, rel=0.12)
    assert "grain" in {each.code for each in examine.examine(found)}


def test_the_sense_of_the_turn_is_the_users(pair):
    clockwise = read_turned(pair, (0.0, 90.0), rotation_sense="cw")
    np.testing.assert_array_equal(np.unique(clockwise.geom.phi_i_deg), [0.0, 90.0])


def test_scans_that_a_column_tells_apart_are_joined_as_well(pair, tmp_path):
    rows = [each.read_text().split("\n", 1)[1] for each in pair]
    lines = [f"{name},{line}" for name, part in zip("ab", rows, strict=True) for line in part.split()]
    path = tmp_path / "both.csv"
    path.write_text("scan,theta_i,theta_r,brdf\n" + "\n".join(lines) + "\n")
    one, other = read_turned([path], (0.0, 90.0)), read_turned(pair, (0.0, 90.0))
    np.testing.assert_array_equal(one.brdf, other.brdf)
    np.testing.assert_array_equal(one.geom.phi_i_deg, other.geom.phi_i_deg)


def test_scans_of_another_scale_are_refused(tmp_path):
    files = file_of(tmp_path, "one.csv", 20.0), file_of(tmp_path, "other.csv", 110.0, factor=1.3)
    with pytest.raises(InputError, match="the scans are 1.3. times the first one's; .* --anyway joins them"):
        read_turned(files, (0.0, 90.0))
    assert len(read_turned(files, (0.0, 90.0), anyway=True).geom)


def test_a_scan_with_azimuths_of_its_own_is_refused(tmp_path):
    path = tmp_path / "turned.csv"
    path.write_text("phi_i,theta_i,theta_r,brdf\n" + "".join(f"{phi},30,{t},1\n" for phi in (0, 40) for t in range(9)))
    with pytest.raises(InputError, match="--turned has no effect: its light has azimuths of its own"):
        read_turned([path, path], (0.0, 90.0), anyway=True)


@pytest.mark.parametrize("text", ["0", "0,0", "0,x", "", "0,500"])
def test_angles_that_say_nothing_are_refused(text):
    with pytest.raises(InputError, match="wanted the angle of each scan in degrees, such as 0,90"):
        turn_angles(text)


def test_an_angle_is_wanted_for_each(pair):
    with pytest.raises(InputError, match="found 2 scans for 3 angles; wanted an angle for each"):
        read_turned(pair, (0.0, 45.0, 90.0))


def test_channels_must_be_alike(pair, monkeypatch):
    both = [formats.read(each) for each in pair]
    both[1] = replace(both[1], channels=("G",))
    monkeypatch.setattr(formats, "read", lambda file, **_: both[pair.index(file)])
    with pytest.raises(InputError, match="joins scans of like channels; found G, wanted brdf"):
        read_turned(pair, (0.0, 90.0))
