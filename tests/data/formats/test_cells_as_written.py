"""Cells that state more than a number: errors, units, thousands, limits, words for missing. Each table gives back the
surface that made it, or one sentence."""

import numpy as np
import pytest

from brdfguide.errors import InputError

from .plane_tables import PLANE, THETA_I, THETA_R, agrees, angles_of, law, lines, read

HEAD = ("theta_i", "theta_r", "brdf")


def table(values, sep: str = ",", names=HEAD, angles: str = "{:g}") -> str:
    """Rows of the surface with the last cells as given."""
    rows = zip(map(angles.format, THETA_I), map(angles.format, THETA_R), values, strict=True)
    return "\n".join(sep.join(row) for row in (names, *rows)) + "\n"


def cells(form: str, factor: float = 1.0) -> list[str]:
    """Each value as `form` writes v and e, its error of 5 %."""
    return [form.format(v=factor * value, e=0.05 * factor * value) for value in PLANE]


@pytest.mark.parametrize("sep", [",", "\t", ";", "  "])
@pytest.mark.parametrize(
    "form",
    [
        "{v:.7g}±{e:.7g}",
        "{v:.7g} ± {e:.7g}",
        "{v:.7g} +/- {e:.7g}",
        "{v:.7g} +- {e:.7g}",
        "{v:.7g} ± 5%",
        "({v:.7e} ± {e:.7e})",
    ],
)
def test_errors_stated_in_the_cells_are_standard_errors(tmp_path, form, sep):
    found = read(tmp_path, table(cells(form), sep))
    agrees(found)
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-5)
    assert "stderr-read" in {each.code for each in found.findings}


def test_errors_in_brackets_count_in_the_last_digit(tmp_path):
    written = [f"{value:.6f}({round(1e6 * 0.05 * value)})" for value in PLANE]
    found = read(tmp_path, table(written))
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, atol=6e-7)
    written = [f"{value:.6e}".replace("e", "(50000)e") for value in PLANE]
    found = read(tmp_path, table(written))
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * 10 ** np.floor(np.log10(PLANE)), rtol=1e-6)
    agrees(found)


def test_errors_with_decimal_commas_and_a_common_power_of_ten(tmp_path):
    text = table(cells("({v:.7g} ± {e:.7g})×10⁻³", 1e3), ";").replace(".", ",")
    found = read(tmp_path, text)
    agrees(found)
    np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-5)


def test_each_channel_has_the_errors_of_its_cells(tmp_path):
    both = [f"{one},{other}" for one, other in zip(cells("{v:.7g}±{e:.7g}"), cells("{v:.7g}±{v:.7g}", 2), strict=True)]
    found = read(tmp_path, table(both, names=("theta_i", "theta_r", "450 nm", "650 nm")))
    agrees(found, 1, 2.0)
    np.testing.assert_allclose(found.stderr, np.stack([0.05 * PLANE, 2 * PLANE], axis=1), rtol=1e-5)


def test_errors_of_percents_are_percents_as_well(tmp_path):
    for form, name in (("{v:.7g} % ± {e:.7g} %", "BRF"), ("{v:.7g} ± {e:.7g}", "BRF (%)")):
        found = read(tmp_path, table(cells(form, 100 * np.pi), names=("theta_i", "theta_r", name)))
        agrees(found)
        np.testing.assert_allclose(found.stderr[:, 0], 0.05 * PLANE, rtol=1e-5)


def test_errors_of_angles_are_left_out_and_those_beside_a_column_of_errors(tmp_path):
    found = read(tmp_path, table(cells("{v:.7g}"), angles="{:g}±0.1"))
    agrees(found)
    assert found.stderr is None
    two = [f"{cell},{0.1 * value:.7g}" for cell, value in zip(cells("{v:.7g}±{e:.7g}"), PLANE, strict=True)]
    found = read(tmp_path, table(two, names=(*HEAD, "stderr")))
    np.testing.assert_allclose(found.stderr[:, 0], 0.1 * PLANE, rtol=1e-5)


@pytest.mark.parametrize("angles", ["{:g} deg", "{:g}deg", "{:g}°", "{:g} °"])
@pytest.mark.parametrize("form", ["{v:.7g}", "{v:.7g} 1/sr", "{v:.7g} sr^-1", "{v:.7g} sr⁻¹", "~{v:.7g}"])
@pytest.mark.parametrize("sep", [",", "\t"])
def test_units_in_the_cells_are_those_of_the_column(tmp_path, angles, form, sep):
    agrees(read(tmp_path, table(cells(form), sep, angles=angles)))


@pytest.mark.parametrize(
    ("name", "form", "factor"),
    [
        ("reflectance factor", "{v:.7g} %", 100 * np.pi),
        ("BRF", "{v:.7g}%", 100 * np.pi),
        ("BRDF", "{v:.7g} × 10^-3", 1e3),
        ("BRDF", "{v:.7g}·10⁻³", 1e3),
        ("BRDF", "{v:.7g} x 10-3", 1e3),
        ("BRDF", "'{v:.7g}'", 1.0),
        ("BRDF", "={v:.7g}", 1.0),
    ],
)
def test_percent_powers_of_ten_and_quotes(tmp_path, name, form, factor):
    agrees(read(tmp_path, table(cells(form, factor), names=("theta_i", "theta_r", name))))


def test_decibels_radians_and_wavelengths_in_the_cells(tmp_path):
    agrees(read(tmp_path, table([f"{10 * np.log10(value):.7f} dB" for value in PLANE])))
    radians = "".join(
        f"{np.radians(i):.8f} rad,{np.radians(r):.8f} rad,0.633 µm,{value:.7g}\n"
        for i, r, value in zip(THETA_I, THETA_R, PLANE, strict=True)
    )
    found = read(tmp_path, "theta_i,theta_r,wavelength,brdf\n" + radians)
    agrees(found)
    assert 1000 * found.geom.wavelength == pytest.approx(633)


def test_degrees_and_minutes(tmp_path):
    found = read(tmp_path, table(cells("{v:.7g}"), angles="{:.0f}°30'"))
    assert sorted(set(np.round(found.geom.theta_i_deg[:, 0], 6))) == [10.5, 30.5, 50.5]


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ("10 deg,5,1\n20,5,1\n", "line 3: column 'theta_i': found '20' and above it '10deg'; wanted one unit for all"),
        ("10,5,1 %\n20,5,1\n30,5,2 %\n", "line 3: column 'brdf': found '1' and above it '1%'"),
        ("10,5,1±2 %\n20,5,~1?\n", "line 3: column 'brdf': found '~1\\?', wanted a number"),
        ("10,5,0.1*\n20,5,0.2\n", "line 2: column 'brdf': found '0.1\\*', wanted a number"),
    ],
)
def test_cells_that_are_not_clear_are_refused(tmp_path, rows, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, "theta_i,theta_r,brdf\n" + rows)


def test_a_unit_other_than_the_names_is_refused(tmp_path):
    with pytest.raises(InputError, match="is in rad by its name and in deg"):
        read(tmp_path, table(cells("{v:.7g}"), names=("theta_i (rad)", "theta_r", "brdf"), angles="{:g}deg"))
    with pytest.raises(InputError, match="line 2: column 'BRDF .dB.': found '.*%', which is in another unit"):
        read(tmp_path, table(cells("{v:.7g} %"), names=("theta_i", "theta_r", "BRDF (dB)")))
    with pytest.raises(InputError, match="percent of a logarithm"):
        read(tmp_path, table(cells("{v:.7g} ± 5%"), names=("theta_i", "theta_r", "BRDF (dB)")))


def test_limits_are_missing(tmp_path):
    written = [f"{value:.7g}" if value > 0.1 else "<0.1" for value in PLANE]
    found = read(tmp_path, table(written))
    assert np.count_nonzero(np.isnan(found.brdf)) == written.count("<0.1") > 0
    text = next(each.text for each in found.findings if each.code == "marks-missing")
    assert "are limits, such as '<0.1'" in text


@pytest.mark.parametrize("mark", ["OVER", "saturated", "<LOD", "bad", "no data", "####", "x", "n.m."])
def test_words_for_missing(tmp_path, mark):
    written = [mark if place % 7 == 0 else f"{value:.7g}" for place, value in enumerate(PLANE)]
    found = read(tmp_path, table(written))
    kept = np.isfinite(found.brdf[:, 0])
    assert np.count_nonzero(~kept) == written.count(mark)
    np.testing.assert_allclose(found.brdf[kept, 0], PLANE[kept], rtol=1e-5)


@pytest.mark.parametrize("mark", [-1.0, -9.99, -99.0])
@pytest.mark.parametrize("name", ["brdf", "BRDF*cos"])
def test_one_negative_number_again_and_again_is_a_mark(tmp_path, mark, name):
    cosine = np.cos(np.radians(THETA_R)) if "cos" in name else 1.0
    values = np.where(np.arange(len(PLANE)) % 7 == 0, mark, PLANE * cosine)
    found = read(tmp_path, table(map("{:.7g}".format, values), names=("theta_i", "theta_r", name)))
    assert np.count_nonzero(np.isnan(found.brdf)) == np.count_nonzero(values == mark)
    assert f"are {mark:g}, and no other is negative" in " ".join(each.text for each in found.findings)


@pytest.mark.parametrize("step", [1.0, 0.01])
def test_negative_noise_in_steps_is_no_mark(tmp_path, step):
    random = np.random.default_rng(3)
    values = step * np.round(3 * PLANE / PLANE.max() / 0.1 + random.normal(0, 0.4, len(PLANE)))
    values[:8] = -step
    found = read(tmp_path, table(map("{:.7g}".format, values)))
    assert np.count_nonzero(found.brdf < 0) == np.count_nonzero(values < 0)


# --- thousands --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("sep", "parts", "point"),
    [
        ("\t", ",", "."),
        (";", ",", "."),
        (";", " ", ","),
        (";", "\u00a0", ","),
        (";", "\u202f", ","),
        ("\t", "'", "."),
        ("\t", "’", "."),
        ("\t", ".", ","),
        ("\t", " ", "."),
    ],
)
def test_thousands_that_are_parted(tmp_path, sep, parts, point):
    written = [f"{2e4 * value:,.4f}".replace(",", "T").replace(".", point).replace("T", parts) for value in PLANE]
    found = read(tmp_path, table(written, sep), scale=1 / 2e4)
    agrees(found)


def test_thousands_without_decimals_beside_numbers_with_points(tmp_path):
    written = [f"{round(1e6 * value):,}" for value in PLANE]
    text = table(written, "\t", angles="{:.1f}")
    agrees_roughly(read(tmp_path, text, scale=1e-6))
    with pytest.raises(InputError, match="a decimal comma, or one that parts thousands"):
        read(tmp_path, table(written, "\t"))


def agrees_roughly(found) -> None:
    angles = [each[:, 0] for each in angles_of(found.geom)]
    np.testing.assert_allclose(found.brdf[:, 0], law(*angles), rtol=1e-4)


def test_points_that_part_thousands_beside_decimal_commas_are_refused(tmp_path):
    written = ["950,25" if place % 2 else "1.234" for place in range(len(PLANE))]
    with pytest.raises(InputError, match="line 2: found '1.234' in a column with '950,25': wanted one decimal mark"):
        read(tmp_path, table(written, ";"))


# --- angles -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("turned", [(0, 1), (1, 0), (1, 1)])
def test_arms_that_count_from_0_to_360(tmp_path, turned):
    theta_i = 360 - THETA_I if turned[0] else THETA_I
    theta_r = -THETA_R if all(turned) else THETA_R
    theta_r = np.remainder(theta_r, 360) if turned[1] else theta_r
    found = read(tmp_path, "theta_i,theta_r,brdf\n" + lines(theta_i, theta_r, PLANE))
    agrees(found)
    assert "goes round a circle" in " ".join(each.text for each in found.findings)


def test_an_arm_of_a_circle_beside_azimuths_at_rest_is_no_azimuth(tmp_path):
    still = 0 * THETA_I
    text = "theta_i,phi_i,theta_r,phi_r,brdf\n" + lines(THETA_I, still, np.remainder(THETA_R, 360), still + 180, PLANE)
    agrees(read(tmp_path, text))


def test_an_arm_behind_the_sample_is_refused(tmp_path):
    with pytest.raises(InputError, match="theta_r = 255 degrees"):
        read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I, 180 - THETA_R, PLANE))


@pytest.mark.parametrize("sines", [False, True])
def test_angles_from_the_mirror_direction_toward_the_normal(tmp_path, sines):
    if sines:
        away, name = np.sin(np.radians(THETA_I)) - np.sin(np.radians(THETA_R)), "beta-beta0"
    else:
        away, name = THETA_I - THETA_R, "aspecular angle"
    found = read(tmp_path, f"theta_i,{name},brdf\n" + lines(THETA_I, away, PLANE))
    agrees_roughly(found)
    assert "positive toward the normal" in " ".join(each.text for each in found.findings)
