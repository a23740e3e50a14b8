"""The dark level of an instrument, from exchanged values: found, taken out, and not found where there is none."""

import numpy as np
import pytest

from brdfguide.data import dark_level, examine, formats
from brdfguide.data.measurement import Measurement

from ..surfaces import SURFACES, dome_run, geometry

WITH_DIM_VALUES = ["rough gold", "bead-blasted steel", "black rubber"]


def with_dark_level(name: str, share: float, seed: int = 18) -> tuple[Measurement, np.ndarray, float]:
    """A run over the dome to which d/cos theta_i was added, d a `share` of the dimmest quarter; the truth, and d."""
    theta_i, theta_r, phi, f = dome_run(name, seed=seed)
    offset = share * float(np.quantile(f, 0.25))
    values = f + offset / np.cos(np.radians(theta_i))
    return Measurement(geometry(theta_i, theta_r, phi), np.where(values > 0, values, np.nan)[:, None]), f, offset


@pytest.mark.parametrize("name", WITH_DIM_VALUES)
@pytest.mark.parametrize("share", [0.3, -0.3])
def test_it_is_measured_to_a_tenth_where_a_lobe_stands_out(name, share):
    measurement, _, offset = with_dark_level(name, share)
    found = dark_level.dark_level_of(measurement)
    assert found.shows and found.offset[0] == pytest.approx(offset, rel=0.1)
    assert abs(found.offset[0] - offset) < 4 * found.stderr[0]


@pytest.mark.parametrize("name", WITH_DIM_VALUES)
@pytest.mark.parametrize("share", [0.3, -0.3])
def test_values_come_back_to_a_tenth_of_what_was_wrong_with_them(name, share):
    measurement, truth, _ = with_dark_level(name, share)
    mended = examine.prepared(measurement)
    assert "dark-level" in {each.code for each in mended.findings}

    def wrong(values):
        return np.nanmedian(np.abs(np.log(values[:, 0] / truth)))

    clean = 0.01 * 0.6745  # the noise of the run
    assert wrong(mended.brdf) - clean < 0.1 * (wrong(measurement.brdf) - clean)


@pytest.mark.parametrize("name", SURFACES)
def test_none_is_found_in_a_clean_run(name):
    theta_i, theta_r, phi, f = dome_run(name, seed=1)
    assert dark_level.dark_level_finding(Measurement(geometry(theta_i, theta_r, phi), f[:, None])) is None


@pytest.mark.parametrize("name", SURFACES)
def test_values_times_a_cosine_keep_their_dim_ones(name):
    """That cosine leaves exchanged values alike, bright or dim; what a dark level would take off does not."""
    theta_i, theta_r, phi, f = dome_run(name, seed=17)
    weighted = Measurement(geometry(theta_i, theta_r, phi), (f * np.cos(np.radians(theta_i)))[:, None])
    found = dark_level.dark_level_of(weighted)
    assert not found.shows and found.left_by_cosine == pytest.approx(0.0095, rel=0.3)  # its noise: √2 * 0.6745 * 1 %
    assert found.left > 5 * found.left_by_cosine


def test_it_stays_where_the_user_says_that_the_values_are_a_brdf(data):
    measurement = formats.read(data / "cornell" / "garnet_red.brdf", quantity="brdf")
    np.testing.assert_array_equal(examine.corrected(measurement).brdf, measurement.brdf)
    assert "dark-level" in {each.code for each in examine.examine(measurement)}


@pytest.mark.parametrize("name", ["cayman.brdf", "garnet_red.brdf"])
def test_both_files_of_one_instrument_show_that_it_takes_off_too_much(data, name):
    measurement = formats.read(data / "cornell" / name)
    found = dark_level.dark_level_of(measurement)
    green = [measurement.channels.index(f"{nm}nm") for nm in (500, 510, 520, 530)]
    assert found.shows and np.all(found.offset[green] < -5 * found.stderr[green])
    assert np.median(found.offset[green]) == pytest.approx(-0.00094, abs=0.0003)
    assert found.corrected_ratio < 1.3 < found.ratio


def test_taken_out_once_it_is_not_found_again(data):
    mended = examine.prepared(formats.read(data / "cornell" / "garnet_red.brdf"))
    assert sum(each.code == "dark-level" for each in (*mended.findings, *examine.examine(mended))) == 1
