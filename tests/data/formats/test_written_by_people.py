"""Sheets of angles, marks and numbers as spreadsheets, word processors and people write them."""

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.errors import InputError

from .plane_tables import PLANE, THETA_I, THETA_R, agrees, lines, read

# --- sheets of angles -------------------------------------------------------------------------------------

SHEET = PLANE.reshape(3, -1)  # a row for each incidence


@pytest.mark.parametrize(
    "head", ["{:g}", "theta_r={:g}", "BRDF @ {:g} deg", "{:g}°", "BRDF({:g})", "BRDF theta_r = {:g} deg"]
)
def test_columns_for_reflected_angles_of_both_signs(tmp_path, head):
    text = "theta_i," + ",".join(head.format(each) for each in THETA_R[: SHEET.shape[1]]) + "\n"
    found = read(tmp_path, text + lines([10, 30, 50], *SHEET.T))
    agrees(found)
    assert found.geom.theta_r_deg.max() == 75


@pytest.mark.parametrize("corner", ["theta_r\\theta_i", "theta_r / theta_i", "theta_r (deg) \\ theta_i (deg)"])
def test_a_sheet_whose_corner_names_bothangles_of(tmp_path, corner):
    agrees(read(tmp_path, f"{corner},10,30,50\n" + lines(THETA_R[: SHEET.shape[1]], *SHEET)))
    text = corner.replace("_r", "_x").replace("_i", "_r").replace("_x", "_i")
    text += "," + ",".join(f"{each:g}" for each in THETA_R[: SHEET.shape[1]]) + "\n"
    agrees(read(tmp_path, text + lines([10, 30, 50], *SHEET.T)))


def test_a_hyphen_that_may_be_a_minus_sign_is_asked_about(tmp_path):
    text = "theta_i," + ",".join(f"theta_r {each:g}" for each in THETA_R[: SHEET.shape[1]]) + "\n"
    with pytest.raises(InputError, match="the columns theta_r -75, .* a minus sign or a hyphen before the angle"):
        read(tmp_path, text + lines([10, 30, 50], *SHEET.T))


@pytest.mark.parametrize("head", ["|beta-beta0|", "|β−β₀|", "|beta_s - beta_i|"])
def test_sizes_of_a_difference_have_no_side(tmp_path, head):
    sizes = np.abs(np.sin(np.radians(THETA_R)) - np.sin(np.radians(THETA_I)))
    with pytest.raises(
        InputError, match=r"line 2: column .*: found 1\.1\d*, toward grazing beyond the horizon: on which"
    ):
        read(tmp_path, f"AOI,{head},BSDF\n" + lines(THETA_I, sizes, PLANE))
    ahead = THETA_R > THETA_I
    found = read(tmp_path, f"AOI,{head},BSDF\n" + lines(THETA_I[ahead], sizes[ahead], PLANE[ahead]))
    np.testing.assert_allclose(found.geom.theta_r_deg[:, 0], THETA_R[ahead], atol=1e-5)


def test_names_of_latex_and_german_azimuths(tmp_path):
    table = lines(THETA_I, np.abs(THETA_R), np.where(THETA_R < 0, 0, 180), PLANE)
    agrees(read(tmp_path, "$\\theta_i$,$\\theta_r$,$\\phi$,$f_r$\n" + table))
    agrees(read(tmp_path, "Einfallswinkel,Reflexionswinkel,Azimutwinkel,BRDF\n" + table))


# --- how numbers are written ------------------------------------------------------------------------------


@pytest.mark.parametrize("minus", ["\N{MINUS SIGN}", "\N{EN DASH}", "\N{FULLWIDTH HYPHEN-MINUS}"])
def test_minus_signs_of_word_processors(tmp_path, minus):
    agrees(read(tmp_path, "theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, PLANE).replace("-", minus)))


def test_degree_signs_behind_the_numbers(tmp_path):
    table = "".join(f"{a:g}°,{b:g} °,{c:.9g}\n" for a, b, c in zip(THETA_I, THETA_R, PLANE, strict=True))
    agrees(read(tmp_path, "theta_i,theta_r,brdf\n" + table))


def test_decimal_commas_in_quotes_between_commas(tmp_path):
    cells = [[f'"{cell:.9g}"'.replace(".", ",") for cell in row] for row in zip(THETA_I, THETA_R, PLANE, strict=True)]
    agrees(read(tmp_path, "theta_i,theta_r,brdf\n" + "".join(",".join(row) + "\n" for row in cells)))


@pytest.mark.parametrize("sep", [";", "\t"])
def test_a_comma_that_may_part_thousands_is_asked_about(tmp_path, sep):
    table = sep.join(("theta_i", "theta_r", "BRDF (10^-5/sr)")) + "\n"
    for row in zip(THETA_I, THETA_R, 1e5 * PLANE, strict=True):
        table += sep.join((f"{row[0]:g}", f"{row[1]:g}", f"{row[2]:,.0f}")) + "\n"
    with pytest.raises(InputError, match=r"line \d+: found '\d+,\d{3}': a decimal comma, or one that parts thousands"):
        read(tmp_path, table)
    plain = sep.join(("theta_i", "theta_r", "brdf")) + "\n" + lines(THETA_I, THETA_R, PLANE, sep=sep)
    agrees(read(tmp_path, plain.replace(".", ",")))


def test_two_units_in_a_name_are_named(tmp_path):
    with pytest.raises(InputError, match=r"is it 'theta_i_deg \(rad\)' \(its name says two units, deg and rad\)\?"):
        read(tmp_path, "theta_i_deg (rad),theta_r_deg (rad),brdf\n" + lines(THETA_I, THETA_R, PLANE))


def test_a_description_is_no_data(tmp_path):
    path = tmp_path / "mug.yaml"
    path.write_text("name: mug\ncomposition: porcelain\n")
    with pytest.raises(InputError, match="a description without measured values: `brdfguide recommend` takes it"):
        formats.read(path)


@pytest.mark.parametrize("encoding", ["utf-32-le", "utf-32", "utf-32-be"])
def test_encodings_that_are_not_read_are_named(tmp_path, encoding):
    with pytest.raises(InputError, match="text in UTF-32, which is not read; save it as UTF-8"):
        read(tmp_path, ("theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, PLANE)).encode(encoding))


FRAMES = {
    "Markdown": ("| theta_i | theta_r | brdf |\n|---------|:-------:|-----:|\n", "| {} |\n", ""),
    "Markdown without edges": ("theta_i | theta_r | brdf\n--- | --- | ---\n", "{}\n", ""),
    "Org mode": ("| theta_i | theta_r | brdf |\n|---------+---------+------|\n", "| {} |\n", ""),
    "a grid": ("+----+----+----+\n| theta_i | theta_r | brdf |\n+====+====+====+\n", "| {} |\n+----+----+----+\n", ""),
    "a frame": ("+----+----+----+\n| theta_i | theta_r | brdf |\n+----+----+----+\n", "| {} |\n", "+----+----+----+\n"),
}


@pytest.mark.parametrize("frame", FRAMES)
def test_tables_in_frames(tmp_path, frame):
    above, row, below = FRAMES[frame]
    rows = "".join(row.format(line) for line in lines(THETA_I, THETA_R, PLANE, sep=" | ").splitlines())
    found = read(tmp_path, "# Sample 12\n\nMeasured at 633 nm.\n\n" + above + rows + below)
    agrees(found)
    assert found.geom.wavelength == pytest.approx(0.633)


def test_words_below_the_rows_are_skipped_and_named(tmp_path):
    table = "theta_i,theta_r,brdf\n" + lines(THETA_I, THETA_R, PLANE)
    found = read(tmp_path, table + "\nEnd of data\n\x1a")
    agrees(found)
    assert any("'End of data'" in each.text for each in found.findings if each.code == "lines-skipped")
    found = read(tmp_path, table + "mean,0.1\n")
    agrees(found)
    assert any("'mean,0.1'" in each.text for each in found.findings if each.code == "lines-skipped")
    with pytest.raises(InputError, match="found 2 cells, wanted 3"):  # a file that was not written to its end
        read(tmp_path, table + "50,75")


def test_rows_that_repeat_others_digit_for_digit_count_once(tmp_path):
    head, rows = "theta_i,theta_r,brdf,operator\n", lines(THETA_I, THETA_R, PLANE).replace("\n", ",Jane\n")
    joined = read(tmp_path, head + rows + rows)
    agrees(joined)
    assert "rows-copied" in [each.code for each in joined.findings]
    again = lines(THETA_I, THETA_R, PLANE * (1 + 0.001 * np.sin(np.arange(len(PLANE))))).replace("\n", ",Jane\n")
    measured_twice = read(tmp_path, head + rows + again)
    assert len(measured_twice.brdf) == 2 * len(PLANE)
    assert "rows-copied" not in [each.code for each in measured_twice.findings]


# --- other languages --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("heads", "encoding"),
    [
        (("angle d'incidence (°)", "angle de réflexion (°)", "FDRB"), "latin-1"),
        (("Angle d’éclairement [degrés]", "angle de diffusion [degrés]", "BRDF"), "utf-8"),
        (("ángulo de incidencia (grados)", "ángulo de reflexión (grados)", "BRDF"), "utf-8"),
        (("angolo di incidenza", "angolo di riflessione", "BRDF"), "ascii"),
        (("ângulo de incidência", "ângulo de reflexão", "BRDF"), "cp1252"),
        (("Einfallswinkel [°]", "Streuwinkel [°]", "BRDF"), "latin-1"),
        (("invalshoek", "uitvalshoek", "BRDF"), "ascii"),
        (("kąt padania", "kąt odbicia", "BRDF"), "cp1250"),
        (("угол падения", "угол отражения", "ДФОС"), "cp1251"),
        (("入射角(°)", "散射角(°)", "BRDF(1/sr)"), "gb18030"),
        (("入射天顶角", "反射天顶角", "双向反射分布函数"), "utf-8"),
        (("入射角[deg]", "受光角[deg]", "BRDF[1/sr]"), "shift_jis"),
        (("입사각", "반사각", "BRDF"), "euc_kr"),
    ],
)
def test_heads_in_other_languages_and_their_encodings(tmp_path, heads, encoding):
    agrees(read(tmp_path, (";".join(heads) + "\n" + lines(THETA_I, THETA_R, PLANE, sep=";")).encode(encoding)))


def test_azimuths_wavelengths_and_doubts_in_other_languages(tmp_path):
    angles = [THETA_I, np.abs(THETA_R), np.where(THETA_R < 0, 0.0, 180.0)]
    head = "入射角,出射角,相对方位角,波长(纳米),BRDF,不确定度"
    with_all = read(tmp_path, head.replace("纳米", "nm") + "\n" + lines(*angles, 633 + 0 * PLANE, PLANE, 0.01 * PLANE))
    agrees(with_all)
    assert with_all.geom.wavelength == pytest.approx(0.633)
    np.testing.assert_allclose(with_all.stderr, 0.01 * with_all.brdf, rtol=1e-6)
    head = "# longueur d'onde : 633 nm\nangle d'incidence,angle de réflexion,azimut relatif,BRDF"
    assert read(tmp_path, head.replace("relatif", "") + "\n" + lines(*angles, PLANE)).geom.wavelength == 0.633


def test_words_that_are_in_no_language_here_stay_as_latin_1_has_them(tmp_path):
    with pytest.raises(InputError, match="no column for theta_i"):
        read(tmp_path, "vinkeln è,theta_r,brdf\n".encode("latin-1") + lines(THETA_I, THETA_R, PLANE).encode())
