"""Tables as people write them, near relatives of those that were once misread: each gives back the surface that made
it, or one sentence that says what is unclear."""

from time import process_time

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.data.columns import prose
from brdfguide.errors import BrdfguideError, InputError

from .plane_tables import PLANE, THETA_I, THETA_R, agrees, angles_of, law, lines, read

# --- what stands in place of a wavelength -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("heads", "nm"),
    [
        (("20000 cm-1", "16000.0 cm^-1"), (500, 625)),
        (("BRDF 1000 cm⁻¹", "BRDF 2000 cm-1"), (10000, 5000)),
        (("BRDF 500 THz", "BRDF 600 THz"), (599.584916, 499.654097)),
        (("f_r 2.0 eV", "f_r 2.5 eV"), (619.920992, 495.936794)),
    ],
)
def test_columns_by_wavenumber_frequency_or_photon_energy(tmp_path, heads, nm):
    found = read(tmp_path, f"theta_i,theta_r,{','.join(heads)}\n" + lines(THETA_I, THETA_R, PLANE, 2 * PLANE))
    assert 1000 * found.geom.wavelength == pytest.approx(nm, rel=1e-8)
    agrees(found, 1, 2.0)


@pytest.mark.parametrize(
    ("head", "values", "nm"),
    [("frequency (THz)", (500, 600), (499.654097, 599.584916)), ("photon energy [eV]", (2, 2.5), (495.936794, 619.92))],
)
def test_rows_by_frequency_or_photon_energy_are_channels(tmp_path, head, values, nm):
    both = [np.tile(each, 2) for each in (THETA_I, THETA_R, PLANE)]
    table = lines(*both[:2], np.repeat(values, len(PLANE)), both[2])
    found = read(tmp_path, f"theta_i,theta_r,{head},brdf\n{table}")
    assert sorted(1000 * found.geom.wavelength) == pytest.approx(nm, rel=1e-5)
    agrees(found)


@pytest.mark.parametrize("head", ["frequency (Hz)", "frequency", "laser energy (mJ)", "energy"])
def test_other_frequencies_and_energies_are_no_wavelengths(tmp_path, head):
    found = read(tmp_path, f"theta_i,theta_r,{head},brdf\n" + lines(THETA_I, THETA_R, 500 + 0 * PLANE, PLANE))
    assert found.geom.wavelength == pytest.approx(0.55)


# --- lines between the rows -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "again"),
    [
        ("# theta_i = {:g} deg", True),
        ("# AOI: {:g}", False),
        ("theta_i = {:g} deg", True),
        ("AOI: {:g}", True),
        ("; incidence angle {:g} degrees", True),
        ("% phi = 180; theta_i = {:g}", False),
    ],
)
def test_lines_between_the_rows_say_the_incidence_of_those_below(tmp_path, line, again):
    text = "" if again else "theta_r,brdf\n"
    for theta_i in np.unique(THETA_I):
        text += line.format(theta_i) + "\n" + "theta_r,brdf\n" * again
        text += lines(THETA_R[theta_i == THETA_I], PLANE[theta_i == THETA_I]) + "\n"
    agrees(read(tmp_path, text))


@pytest.mark.parametrize("line", ["# wavelength: {:g} nm", "wavelength: {:g} nm", "# lambda = {:g} nm, run 3"])
def test_lines_between_the_rows_say_the_wavelength_of_those_below(tmp_path, line):
    text = "theta_i,theta_r,brdf\n"
    for nm, factor in ((450, 1.0), (550, 1.1), (650, 1.2)):
        text += line.format(nm) + "\n" + lines(THETA_I, THETA_R, factor * PLANE)
    if line.startswith("w"):
        text = "wavelength: 450 nm\ntheta_i,theta_r,brdf\n" + text.split("\n", 2)[2]
    found = read(tmp_path, text)
    assert 1000 * found.geom.wavelength == pytest.approx([450, 550, 650])
    agrees(found, 2, 1.2)


def test_lines_between_the_rows_say_the_azimuth_of_those_below(tmp_path):
    grid = [each.ravel() for each in np.meshgrid([20.0, 50.0], [0.0, 30.0, 60.0], indexing="ij")]
    text = ""
    for phi in (0.0, 60.0, 120.0, 180.0):
        text += f"# azimuth: {phi:g} deg\ntheta_i,theta_r,brdf\n" + lines(*grid, law(*grid, np.full(6, phi)))
    found = read(tmp_path, text)
    np.testing.assert_allclose(found.brdf, law(*(each[:, 0] for each in angles_of(found.geom)))[:, None], rtol=1e-5)
    assert len(np.unique(np.round(np.abs(found.geom.phi_deg[found.geom.theta_r_deg > 1])))) == 4


def test_lines_between_the_rows_name_the_samples_of_those_below(tmp_path):
    text = "theta_i,theta_r,brdf\n"
    for name, factor in (("white", 1.0), ("black", 0.1)):
        text += f"# sample: {name}\n" + lines(THETA_I, THETA_R, factor * PLANE)
    with pytest.raises(BrdfguideError, match="fit one with --select sample=white, each with --group sample"):
        read(tmp_path, text)
    agrees(read(tmp_path, text, select=("sample=black",)), 0, 0.1)


def test_remarks_between_the_rows_change_nothing(tmp_path):
    half = len(PLANE) // 2
    text = "theta_i,theta_r,brdf\n" + lines(THETA_I[:half], THETA_R[:half], PLANE[:half])
    text += "# warning: lamp restarted\n# temperature: 21.5 C\n" + lines(THETA_I[half:], THETA_R[half:], PLANE[half:])
    agrees(read(tmp_path, text + "# temperature: 22.5 C\n# checked: twice\n"))


def test_thousands_of_remarks_between_the_rows_take_no_time(tmp_path):
    rows_ = "".join(f"# k{k} = {k}\n# t = {k}\n{k % 80},{k % 85},0.1\n" for k in range(12000))
    began = process_time()
    assert len(read(tmp_path, "theta_i,theta_r,brdf\n" + rows_).brdf) == 12000
    assert process_time() - began < 3


def test_lines_between_the_rows_of_a_huge_table_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(formats, "LARGEST_TABLE", 100)
    path = tmp_path / "huge.csv"
    part = lines(THETA_R, PLANE)
    path.write_text(f"# theta_i: 10\ntheta_r,brdf\n{part}# theta_i: 30\n{part}")
    with pytest.raises(InputError, match=f"line {3 + len(PLANE)}: '# theta_i: 30' between the rows"):
        list(formats.in_blocks(path))


@pytest.mark.parametrize("line", ["# azimuth: 90 deg", "# phi = 90", "phi_r: 90"])
def test_one_azimuth_for_all_stands_in_a_comment(tmp_path, line):
    values = law(THETA_I, np.abs(THETA_R), np.where(THETA_R < 0, -90.0, 90.0))
    found = read(tmp_path, f"{line}\ntheta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, values))
    agrees(found)
    assert not found.in_plane


@pytest.mark.parametrize(
    ("line", "heads"),
    [
        ("# theta_i [rad]: 0.523598776", "theta_r [deg],brdf"),
        ("# theta_i = 0.523598776", "theta_r [rad],brdf"),
        ("# elevation of the light: 60 deg", "theta_r,brdf"),
        ("# cos(theta_i) = 0.866025404", "theta_r,brdf"),
        ("# AOI=30°; λ=633nm", "theta_r,brdf"),
    ],
)
def test_one_incidence_for_all_in_whatever_form(tmp_path, line, heads):
    here = THETA_I == 30
    angles = np.radians(THETA_R[here]) if "theta_r [rad]" in heads else THETA_R[here]
    found = read(tmp_path, f"{line}\n{heads}\n" + lines(angles, PLANE[here]))
    assert found.geom.theta_i_deg == pytest.approx(30, abs=1e-5)
    np.testing.assert_allclose(found.brdf[:, 0], PLANE[here], rtol=1e-6)


@pytest.mark.parametrize("line", ["# azimuth: 5 deg steps", "# phi = 90 and 270", "# phi = 180", "# phi: 0"])
def test_what_is_no_azimuth_for_all_leaves_the_plane_of_incidence(tmp_path, line):
    agrees(read(tmp_path, f"{line}\ntheta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, PLANE)))


@pytest.mark.parametrize("gap", ["", "NaN"])
def test_an_incidence_at_the_head_of_each_scan_holds_for_it(tmp_path, gap):
    first = np.r_[True, np.diff(THETA_I) != 0]
    text = "theta_i,theta_r,wavelength_nm,brdf\n"
    for new, i, r, f in zip(first, THETA_I, THETA_R, PLANE, strict=True):
        text += f"{i if new else gap},{r:g},{'633' if new and i == 10 else gap},{f:.9g}\n"
    found = read(tmp_path, text)
    agrees(found)
    assert found.geom.wavelength == pytest.approx(0.633)
    assert "most cells of 'theta_i' are empty: they hold what stands above them" in str(found.findings)


def test_rows_that_lack_an_angle_here_and_there_are_left_out(tmp_path):
    text = lines(THETA_I, THETA_R, PLANE).splitlines()
    text[7] = "," + text[7].partition(",")[2]
    assert len(read(tmp_path, "theta_i,theta_r,brdf\n" + "\n".join(text)).brdf) == len(PLANE) - 1


def test_readings_of_one_laser_are_one_wavelength(tmp_path):
    """Of a column that varies by 0.1 nm, seed 3."""
    nm = 633 + 0.1 * np.random.default_rng(3).random(len(PLANE))
    found = read(tmp_path, "theta_i,theta_r,wavelength_nm,brdf\n" + lines(THETA_I, THETA_R, nm, PLANE))
    assert found.geom.wavelength == pytest.approx([nm.mean() / 1000], rel=1e-6)
    agrees(found)


def test_a_scan_of_the_side_of_the_light_alone_stays_there(tmp_path):
    here = THETA_R < 0
    found = read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I[here], THETA_R[here], PLANE[here]))
    np.testing.assert_allclose(found.brdf[:, 0], law(*(each[:, 0] for each in angles_of(found.geom))), rtol=1e-5)
    assert "only the other side was measured, that of the light" in str(found.findings)
    lobe = THETA_R > 0
    turned = read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I[lobe], -THETA_R[lobe], PLANE[lobe]))
    np.testing.assert_allclose(turned.brdf[:, 0], law(*(each[:, 0] for each in angles_of(turned.geom))), rtol=1e-5)


# --- what was done to the numbers -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("head", "said"),
    [
        ("sqrt(BRDF)", "'sqrt', which is not undone"),
        ("BRDF/pi", "'pi', which is not undone"),
        ("-log10(BRDF)", "which is not undone"),
        ("BRDF x 10^3", "has a factor, which may mean either way"),
        ("1000*BRDF", "has a factor, which may mean either way"),
        ("Value (x1e-3)", "has a factor, which may mean either way"),
        ("BRDF/1000", "has a factor, which may mean either way"),
    ],
)
def test_a_function_in_a_name_is_not_forgotten_where_columns_maps_it(tmp_path, head, said):
    text = f"theta_i,theta_r,{head}\n" + lines(THETA_I, THETA_R, PLANE)
    with pytest.raises(InputError, match="no column for brdf"):
        read(tmp_path, text)
    with pytest.raises(InputError, match=said):
        read(tmp_path, text, columns=f"brdf={head}")
    if "factor" in said:
        agrees(read(tmp_path, text, columns=f"brdf={head}", scale=0.5), 0, 0.5)


def test_a_tangent_is_no_angle(tmp_path):
    text = "tan_theta_i,theta_r,brdf\n" + lines(np.tan(np.radians(THETA_I)), THETA_R, PLANE)
    with pytest.raises(InputError, match="'tan', which is not undone"):
        read(tmp_path, text, columns="theta_i=tan_theta_i")


@pytest.mark.parametrize(
    ("head", "factor"),
    [
        ("reflectance (%)", 100 * np.pi),
        ("Reflectance [percent]", 100 * np.pi),
        ("intensity (%)", 100.0),
        ("BRDF (1/msr)", 1e-3),
        ("BRDF [1000/sr]", 1e-3),
        ("BRF (1)", np.pi),
        ("BRDF [10/sr]", 0.1),
    ],
)
def test_units_of_values(tmp_path, head, factor):
    agrees(read(tmp_path, f"theta_i,theta_r,{head}\n" + lines(THETA_I, THETA_R, factor * PLANE)))


@pytest.mark.parametrize(
    ("line", "head", "factor"),
    [
        ("# BRDF in 10^-3 sr^-1", "brdf", 1e3),
        ("# units: 1e-3/sr", "brdf", 1e3),
        ("# scale: 0.001", "BRDF [1e-3/sr]", 1e3),
        ("# all values in percent", "BRF", 100 * np.pi),
        ("# all values in percent", "BRF [%]", 100 * np.pi),
        ("# detector aperture 1e-4 sr", "brdf", 1.0),
        ("# noise floor 1e-6 /sr", "brdf", 1.0),
    ],
)
def test_a_unit_of_all_values_in_a_comment(tmp_path, line, head, factor):
    agrees(read(tmp_path, f"{line}\ntheta_i,theta_r,{head}\n" + lines(THETA_I, THETA_R, factor * PLANE)))


@pytest.mark.parametrize("line", ["values in % of white", "data: 45 %", "BRDF noise: 1e-6 1/sr", "unit: 10^-3 sr"])
def test_what_is_no_unit_of_values(line):
    assert prose.unit_of_values_in([line]) is None


# --- marks of good and bad --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "good", "bad"), [("mask", "1", "0"), ("valid", "1", "0"), ("flag", "0", "2"), ("quality", "ok", "poor")]
)
def test_a_column_that_marks_rows_is_asked_about(tmp_path, name, good, bad):
    text = f"theta_i,theta_r,brdf,{name}\n"
    odd = np.arange(len(PLANE)) % 11 == 7
    for row in zip(THETA_I, THETA_R, np.where(odd, 5.0, PLANE), np.where(odd, bad, good), strict=True):
        text += "{:g},{:g},{:.9g},{}\n".format(*row)
    with pytest.raises(InputError, match=f"the column '{name}' marks rows .*--select {name}={good}, or all with --col"):
        read(tmp_path, text)
    found = read(tmp_path, text, select=(f"{name}={good}",))
    assert len(found.brdf) == np.count_nonzero(~odd)
    assert found.brdf.max() < 5


@pytest.mark.parametrize("mark", [999, 9999, 99999, 999.99, 65535, 32767])
def test_full_scale_and_nines_are_no_values(tmp_path, mark):
    odd = np.arange(len(PLANE)) % 11 == 7
    found = read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, np.where(odd, mark, PLANE)))
    np.testing.assert_array_equal(np.isnan(found.brdf[:, 0]), odd)
    assert f"{np.count_nonzero(odd)} of 93 values are {mark:g}, far above all others" in str(found.findings)


def test_values_near_999_are_values(tmp_path):
    values = np.where(np.arange(len(PLANE)) % 11 == 7, 999.0, 150.0 + PLANE)
    found = read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, values))
    assert not np.isnan(found.brdf).any()


@pytest.mark.parametrize("mark", ["n.a.", "?", "...", "1.#QNAN", "-nan(ind)", "missing", "#REF!"])
def test_marks_for_missing_cells(tmp_path, mark):
    text = lines(THETA_I, THETA_R, PLANE).split("\n")
    text[5] = f"10,-50,{mark}"
    found = read(tmp_path, "theta_i,theta_r,brdf\n" + "\n".join(text))
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found.brdf[:, 0])), [5])
