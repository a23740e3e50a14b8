"""What values are: quantity, scale, doubts and wavelengths, by name, by title, by comment and by option."""

import numpy as np
import pytest

from brdfguide.data import formats
from brdfguide.errors import InputError

from ...surfaces import table
from . import containers
from .test_conventions import IN_PLANE, PLANE, PLANE_I, PLANE_R, codes, read

ANGLES = (PLANE_I, PLANE_R)
COS_I, COS_R = PLANE.cos_i[:, 0], PLANE.cos_r[:, 0]
SENTENCE = "theta_i,theta_r,{}\n20,20,{}\n20,30,{}\n40,20,{}\n40,40,{}\n"


def sheet(name: str, values, *more, title: str = "") -> str:
    """An in-plane table with these values under this name, and further (name, values)."""
    names, columns = zip(*more, strict=True) if more else ((), ())
    return title + table(("theta_i", "theta_r", name, *names), *ANGLES, values, *columns)


def check(measurement) -> None:
    np.testing.assert_allclose(measurement.brdf[:, 0], IN_PLANE, rtol=1e-5)


BY_NAME = {
    "BRDF": IN_PLANE,
    "BRF": np.pi * IN_PLANE,
    "reflectance factor [%]": 100 * np.pi * IN_PLANE,
    "HDRF": np.pi * IN_PLANE,
    "RADF": np.pi * IN_PLANE * COS_I,
    "I/F": np.pi * IN_PLANE * COS_I,
    "CCBRDF": IN_PLANE * COS_R,
    "BRDF cos theta_i": IN_PLANE * COS_I,
    "ARS": IN_PLANE * COS_R,
    "BRDF (dB)": 10 * np.log10(IN_PLANE),
    "10*log10(BRDF)": 10 * np.log10(IN_PLANE),
    "log10(BRDF)": np.log10(IN_PLANE),
    "ln BRDF": np.log(IN_PLANE),
    "BRDF [10⁻³ sr⁻¹]": 1000 * IN_PLANE,
    "pi*BRDF": np.pi * IN_PLANE,
    "reflectance factor / pi": IN_PLANE,
    "BRF (dB)": 10 * np.log10(np.pi * IN_PLANE),
}


@pytest.mark.parametrize("name", BY_NAME)
def test_a_quantity_by_name(tmp_path, name):
    check(read(tmp_path, sheet(name, BY_NAME[name])))


@pytest.mark.parametrize("name", ["Panel BRF", "sample 3: RADF", "my BRDF (dB)", "fresh CCBRDF"])
def test_a_quantity_by_the_name_of_what_is_mapped(tmp_path, name):
    plain = name.split(": ")[-1].removeprefix("Panel ").removeprefix("my ").removeprefix("fresh ")
    text = sheet(name, BY_NAME[plain])
    with pytest.raises(
        InputError, match=rf"no column for brdf; is it '{name}'".replace("(", r"\(").replace(")", r"\)")
    ):
        read(tmp_path, text)
    check(read(tmp_path, text, columns={"brdf": name}))
    check(read(tmp_path, text, columns=f"brdf={name}"))


TITLES = {
    "BRF values of a grey panel\n": np.pi * IN_PLANE,
    "# bidirectional reflectance factors, white standard\n": np.pi * IN_PLANE,
    "I/F of regolith\n": np.pi * IN_PLANE * COS_I,
    "# quantity: brdf-cos\n": IN_PLANE * COS_R,
    "# cosine-corrected BRDF\n": IN_PLANE * COS_R,
    "# BRDF, after division of the reflectance factor by pi\n": IN_PLANE,
}


@pytest.mark.parametrize("title", TITLES)
def test_a_quantity_by_title_or_comment(tmp_path, title):
    check(read(tmp_path, sheet("633nm", TITLES[title], title=title)))


def test_a_column_called_brdf_under_a_title_that_says_otherwise_is_doubted(tmp_path):
    measurement = read(tmp_path, sheet("brdf", IN_PLANE, title="BRF of a panel\n"))
    check(measurement)
    (doubt,) = [finding for finding in measurement.findings if finding.code == "quantity-unclear"]
    assert doubt.severity == "warning" and doubt.option == "--quantity reflectance-factor"


@pytest.mark.parametrize(
    ("quantity", "values"),
    [
        ("brdf", IN_PLANE),
        ("brf", np.pi * IN_PLANE),
        ("reflectance-factor", np.pi * IN_PLANE),
        ("hdrf", np.pi * IN_PLANE),
        ("radf", np.pi * IN_PLANE * COS_I),
        ("brdf-cos", IN_PLANE * COS_R),
        ("brdf-cos-i", IN_PLANE * COS_I),
    ],
)
def test_a_quantity_by_option(tmp_path, quantity, values):
    check(read(tmp_path, sheet("RADF", values), quantity=quantity))  # the option comes before the name


def test_a_radiance_factor_is_that_of_the_field_whose_angles_stand_beside_it(tmp_path):
    phase = np.degrees(np.arccos((PLANE.dot_xy + PLANE.cos_i * PLANE.cos_r)[:, 0]))
    names = ("incidence", "emission", "phase", "radiance factor")
    planetary = read(tmp_path, table(names, PLANE_I, np.abs(PLANE_R), phase, np.pi * IN_PLANE * COS_I))
    np.testing.assert_allclose(planetary.brdf[:, 0], IN_PLANE, rtol=1e-5)
    colorimetric = read(tmp_path, sheet("radiance factor", np.pi * IN_PLANE))
    check(colorimetric)
    for measurement in (planetary, colorimetric):
        assert any(
            finding.severity == "warning" for finding in measurement.findings if finding.code == "quantity-stated"
        )


def test_light_from_the_whole_sky_is_doubted(tmp_path):
    assert "skylight" in codes(read(tmp_path, sheet("HDRF", np.pi * IN_PLANE)))


def test_columns_of_different_quantities_are_not_mixed(tmp_path):
    text = sheet("BRDF 450 nm", IN_PLANE, ("BRF 650 nm", IN_PLANE))
    with pytest.raises(InputError, match="its columns hold different quantities, brdf and reflectance-factor"):
        read(tmp_path, text)


def test_of_a_brdf_and_what_follows_from_it_the_brdf_counts(tmp_path):
    text = sheet("CCBRDF", IN_PLANE * COS_R, ("BRDF (dB)", 10 * np.log10(IN_PLANE)), ("BRDF", IN_PLANE))
    check(read(tmp_path, text))


def test_unnamed_logarithms_are_refused_and_noise_about_zero_is_not(tmp_path):
    with pytest.raises(InputError, match=r"column 'brdf': \d+ of 45 values are negative.*decibels or logarithms\?"):
        read(tmp_path, sheet("brdf", 10 * np.log10(IN_PLANE / 3)))
    noise = np.where(np.arange(len(IN_PLANE)) % 3, -0.001 * IN_PLANE, IN_PLANE)
    read(tmp_path, sheet("brdf", noise))


def test_a_channel_below_zero_beside_bright_ones_is_a_colour(tmp_path):
    blue = np.full(len(IN_PLANE), -0.01)
    found = read(tmp_path, sheet("R", IN_PLANE + 0.3, ("G", IN_PLANE + 0.2), ("B", blue)))
    assert np.all(found.brdf[:, 2] == -0.01)


# --- doubts -----------------------------------------------------------------------------------------------

DOUBTS = {
    ("BRDF", "u(BRDF)"): 0.02 * IN_PLANE,
    ("BRDF", "uncertainty (k=2)"): 0.04 * IN_PLANE,
    ("BRDF", "uncertainty (k=2) %"): np.full_like(IN_PLANE, 4.0),
    ("BRDF", "relative uncertainty [%]"): np.full_like(IN_PLANE, 2.0),
    ("BRDF", "relative uncertainty"): np.full_like(IN_PLANE, 0.02),
    ("BRDF", "stderr"): 0.02 * IN_PLANE,
    ("BRDF", "2 sigma"): 0.04 * IN_PLANE,
    ("BRDF", "expanded uncertainty"): 0.04 * IN_PLANE,
    ("BRDF", "uncertainty (95 %)"): 1.96 * 0.02 * IN_PLANE,
    ("BRDF", "u [dB]"): np.full_like(IN_PLANE, 10 * np.log10(np.e) * 0.02),
    ("reflectance factor", "u"): np.pi * 0.02 * IN_PLANE,
    ("reflectance factor [%]", "u"): 100 * np.pi * 0.02 * IN_PLANE,
    ("reflectance factor [%]", "u [%]"): 100 * np.pi * 0.02 * IN_PLANE,
    ("reflectance factor [%]", "relative uncertainty [%]"): np.full_like(IN_PLANE, 2.0),
    ("BRDF [10⁻³ sr⁻¹]", "u(BRDF) [10⁻³ sr⁻¹]"): 20 * IN_PLANE,
    ("BRDF (dB)", "u (dB)"): np.full_like(IN_PLANE, 10 * np.log10(np.e) * 0.02),
    ("RADF", "standard deviation (sigma)"): 0.02 * np.pi * IN_PLANE * COS_I,
}


@pytest.mark.parametrize(("name", "doubt"), DOUBTS)
def test_a_doubt_becomes_a_standard_error(tmp_path, name, doubt):
    measurement = read(
        tmp_path, sheet(name, BY_NAME[name] if name in BY_NAME else np.pi * IN_PLANE, (doubt, DOUBTS[name, doubt]))
    )
    check(measurement)
    np.testing.assert_allclose(measurement.stderr[:, 0], 0.02 * IN_PLANE, rtol=1e-5)


def test_a_doubt_that_says_nothing_of_the_values_is_left_out_with_its_reason(tmp_path):
    measurement = read(tmp_path, sheet("BRDF (dB)", BY_NAME["BRDF (dB)"], ("uncertainty", 0.1 + 0 * IN_PLANE)))
    (note,) = [finding for finding in measurement.findings if finding.code == "columns-ignored"]
    assert measurement.stderr is None and "'uncertainty' (whether it is in the unit of the values" in note.text


def test_the_commonest_sheet_has_a_column_and_a_doubt_for_each_wavelength(tmp_path):
    nm, factors = (405, 532, 633), (1.0, 0.5, 2.0)
    names = ["AOI (deg)", "Scatter angle (deg)"]
    names += [f"BSDF {each} nm (1/sr)" for each in nm] + [f"u(BSDF) {each} nm" for each in nm]
    columns = [factor * IN_PLANE for factor in factors] + [0.03 * factor * IN_PLANE for factor in factors]
    text = table(names, *ANGLES, *columns)
    mapped = ",".join(f"brdf={name}" for name in names[2:5])
    for measurement in (read(tmp_path, text), read(tmp_path, text, columns=mapped)):
        check(measurement)
        assert measurement.channels == ("405nm", "532nm", "633nm")
        np.testing.assert_allclose(measurement.geom.wavelength, [0.405, 0.532, 0.633])
        np.testing.assert_allclose(measurement.stderr, 0.03 * measurement.brdf, rtol=1e-6)


def test_names_under_heads_that_span_them_are_joined(tmp_path):
    rows = table(("a", "b", "c", "d", "e", "f"), *ANGLES, IN_PLANE, 0.1 * IN_PLANE, 2 * IN_PLANE, 0.1 * IN_PLANE)
    text = ",,450 nm,,650 nm,\ntheta_i,theta_r,BRDF,u,BRDF,u\n" + rows.partition("\n")[2]
    measurement = read(tmp_path, text)
    check(measurement)
    assert measurement.channels == ("450nm", "650nm") and measurement.stderr.shape == (len(IN_PLANE), 2)


def test_a_role_given_twice_is_an_error_but_for_values(tmp_path):
    text = sheet("brdf", IN_PLANE, ("other", IN_PLANE))
    with pytest.raises(InputError, match="--columns gives theta_i twice: theta_i and other"):
        read(tmp_path, text, columns="theta_i=theta_i,theta_i=other")
    with pytest.raises(InputError, match="'other' names no wavelength or colour|both look like the BRDF"):
        read(tmp_path, text, columns="brdf=brdf,brdf=other")


# --- wavelengths ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["633", "633nm", "633 nm", "0.633um", "0.633 µm"])
def test_a_wavelength_by_columns_is_in_nanometres_unless_it_says_otherwise(tmp_path, text):
    measurement = read(tmp_path, sheet("brdf", IN_PLANE), columns=f"wavelength={text}")
    np.testing.assert_allclose(measurement.geom.wavelength, 0.633)
    assert "wavelength-by-option" in codes(measurement) and "wavelength-assumed" not in codes(measurement)


@pytest.mark.parametrize("text", ["0.633", "0", "-5", "633000", "1e9nm"])
def test_a_wavelength_that_no_light_has_is_refused(tmp_path, text):
    with pytest.raises(InputError, match="wanted 100 to 100000 nm"):
        read(tmp_path, sheet("brdf", IN_PLANE), columns=f"wavelength={text}")


def test_one_wavelength_for_rows_of_several_is_refused(tmp_path):
    text = sheet("brdf", IN_PLANE, ("lambda", np.where(PLANE_R > 0, 450.0, 650.0)))
    for options in ({"columns": "wavelength=450"}, {"wavelength_nm": 450}):
        with pytest.raises(
            InputError, match="says the wavelength of each row|its channels state theirs, 450 to 650 nm"
        ):
            read(tmp_path, text, **options)


@pytest.mark.parametrize("name", ["zemax", "fred", "alta", "table", "lighttools", "astm"])
def test_every_format_can_be_told_its_wavelength(tmp_path, name):
    path = tmp_path / "run"
    path.write_bytes(
        containers.astm(names="theta_i,phi_i,theta_s,phi_s,brdf", rows=((0.5, 1, 0.4, 4.1, 0.1),)).encode()
        if name == "astm"
        else containers.every()[name]
    )
    assert "wavelength-assumed" in codes(formats.read(path))
    measurement = formats.read(path, wavelength_nm=633)
    np.testing.assert_allclose(measurement.geom.wavelength, 0.633)
    assert "wavelength-assumed" not in codes(measurement)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("cornell", "its channels state theirs, 400 to 600 nm; --wavelength 633 picks the nearest"),
        ("rgl", r"its channels are colours \(R, G, B\)"),
        ("lighttools-bsdf", "contradicts the file, whose values are those of 550 nm"),
    ],
)
def test_a_wavelength_that_the_file_states_itself_cannot_be_told(tmp_path, name, sentence):
    path = tmp_path / "run"
    path.write_bytes(containers.every()[name])
    with pytest.raises(InputError, match=sentence):
        formats.read(path, wavelength_nm=633)


@pytest.mark.parametrize(
    "comment",
    ["wavelength_nm: 0", "wavelength: 0.001 nm", "lambda = 3e7 nm", "wavelength: 900 um", "wavelength 1e306 um"],
)
def test_nonsense_in_a_comment_is_refused_with_its_line(tmp_path, comment):
    with pytest.raises(InputError, match=r"line 1: found a wavelength of .* nm; wanted 100 to 100000 nm"):
        read(tmp_path, f"# {comment}\n" + sheet("brdf", IN_PLANE))
    told = read(tmp_path, f"# {comment}\n" + sheet("brdf", IN_PLANE), wavelength_nm=550)
    np.testing.assert_allclose(told.geom.wavelength, 0.55)


def test_a_channel_far_from_the_wavelength_that_was_asked_for_is_refused(tmp_path):
    text = sheet("brdf", IN_PLANE)
    with pytest.raises(
        InputError, match=r"no channel near 633 nm; there is 550 nm \(taken, .*--wavelength-nm 633 says"
    ):
        read(tmp_path, text, wavelength=[633])
    assert read(tmp_path, text, wavelength=[560]).channels == ("brdf",)


def test_wavenumbers_and_bands_in_words(tmp_path):
    for name, cells in (("wavenumber (cm-1)", ("20000", "16000")), ("band", ("500 nm", "625 nm"))):
        rows = [
            f"{i:g},{r:g},{cells[place]},{(1 + place) * f:.9g}"
            for i, r, f in zip(*ANGLES, IN_PLANE, strict=True)
            for place in (0, 1)
        ]
        measurement = read(tmp_path, f"theta_i,theta_r,{name},brdf\n" + "\n".join(rows))
        check(measurement)
        assert measurement.channels == ("500nm", "625nm")
    rows = [
        f"{i:g},{r:g},{colour},{f:.9g}"
        for i, r, f in zip(*ANGLES, IN_PLANE, strict=True)
        for colour in ("red", "green", "blue")
    ]
    assert set(read(tmp_path, "theta_i,theta_r,colour,brdf\n" + "\n".join(rows)).channels) == set("RGB")


# --- single numbers ---------------------------------------------------------------------------------------


def test_infinite_and_absurd_numbers_are_missing_without_a_warning(tmp_path, recwarn):
    for cell in ("inf", "-inf", "1e400", "nan", "", "9" * 400):
        measurement = read(tmp_path, SENTENCE.format("brdf", "0.1", cell, "0.2", "0.3"))
        assert np.isfinite(measurement.brdf).sum() == 3, cell
    for cell in ("1e-300", "1e300", "-1e-300"):
        measurement = read(tmp_path, SENTENCE.format("brdf", "0.1", cell, "0.2", "0.3"))
        assert measurement.usable.sum() == 3, cell
    for name in ("BRDF (dB)", "log10(BRDF)"):
        read(tmp_path, SENTENCE.format(name, "0.1", "1e300", "-1e300", "0.3"))
    assert not recwarn


def test_inspect_names_channels_with_their_wavelengths_units_and_what_was_left_out(tmp_path, capsys):
    from brdfguide.cli import main

    names = ("AOI (deg)", "Scatter angle (deg)", "BSDF 405 nm (1/sr)", "BSDF 633 nm (1/sr)", "lamp current (A)")
    (tmp_path / "run.csv").write_text(table(names, *ANGLES, IN_PLANE, 2 * IN_PLANE, 1 + 0 * IN_PLANE))
    with pytest.raises(SystemExit) as ended:
        main(["inspect", str(tmp_path / "run.csv")])
    assert not ended.value.code
    out = capsys.readouterr().out
    assert "\nchannels: 405, 633 nm\n" in out
    assert "'AOI (deg)' as theta_i" in out and "angles in deg, as the names say" in out
    assert "columns ignored: 'lamp current (A)' ('current' is not understood)" in out


def test_a_zenith_without_a_unit_has_that_of_the_other_zenith(tmp_path):
    """Whatever the azimuth is in; one unit for all would misread what is named."""
    path = tmp_path / "run.csv"
    path.write_text("theta_i,theta_r_deg,phi_r_rad,brdf\n30,45,3.1415927,1\n30,60,0.5235988,1\n")
    geom = formats.read(path).geom
    assert geom.theta_i_deg.ravel().tolist() == [30, 30]
    assert geom.phi_deg.ravel() == pytest.approx([180, 30], abs=1e-5)


def test_an_angstrom_may_be_written_as_a_letter(tmp_path):
    for text in (
        sheet("brdf", IN_PLANE, ("wavelength (A)", 0 * IN_PLANE + 6328)),
        sheet("brdf", IN_PLANE, title="# wavelength: 6328 A\n"),
    ):
        measurement = read(tmp_path, text)
        assert float(np.ravel(measurement.geom.wavelength)[0]) == pytest.approx(0.6328)
        check(measurement)
