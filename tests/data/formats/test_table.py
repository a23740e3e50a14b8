"""Goniometer tables in the variety in which they come: separators, names, units, long and wide form, and
conventions.
"""

import io
import sys

import numpy as np
import pytest

from brdfguide.data import formats

ROWS = [
    (30.0, -40.0, 0.1),
    (30.0, 20.0, 0.25),
    (30.0, 30.0, 0.5),
    (60.0, -40.0, 0.12),
    (60.0, 20.0, 0.2),
    (60.0, 60.0, 1.5),
]


def read(tmp_path, text, **options):
    path = tmp_path / "run.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return formats.read(path, **options)


def plain(separator=",", header=("theta_i", "theta_r", "brdf"), end="\n", form="{:g}"):
    return (
        end.join([separator.join(header), *(separator.join(form.format(cell) for cell in row) for row in ROWS)]) + end
    )


def codes(measurement):
    return {finding.code for finding in measurement.findings}


def check(measurement):
    theta_i, theta_r, f = np.array(ROWS).T
    np.testing.assert_allclose(measurement.geom.theta_i_deg[:, 0], theta_i, atol=1e-4)
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], theta_r, atol=1e-4)
    np.testing.assert_allclose(measurement.brdf[:, 0], f, rtol=1e-9)


GOOD = {
    "commas": plain(),
    "semicolons": plain(";"),
    "tabs": plain("\t"),
    "spaces": plain("   "),
    "carriage returns": plain(end="\r\n"),
    "old Mac lines": plain(end="\r"),
    "byte order mark": b"\xef\xbb\xbf" + plain().encode(),
    "sixteen bits": plain().encode("utf-16"),
    "decimal commas": plain(";", form="{:g}").replace(".", ","),
    "decimal commas between blanks": plain(" ").replace(".", ","),
    "decimal commas between tabs": plain("\t").replace(".", ","),
    "comments and blank lines": "# a run\n\n" + plain().replace("\n", "\n# between\n\n", 3),
    "percent comments": "% matlab\n" + plain(),
    "quoted cells": plain(form='"{:g}"', header=('"theta_i"', '"theta_r"', '"brdf"')),
    "trailing separators": plain().replace("\n", ",\n"),
    "title above the header": "Sample 12, paint shop\n" + plain(),
    "units in a row": plain().replace("\n", "\ndeg,deg,1/sr\n", 1),
    "header as a comment": "# theta_i theta_r brdf\n" + "\n".join(plain(" ").split("\n")[1:]),
    "header twice": plain().replace("60,-40", "theta_i,theta_r,brdf\n60,-40"),
    "capitals and units": plain(header=("Theta_I [deg]", "THETA_R (deg)", "BRDF [1/sr]")),
    "words": plain(header=("Incident_angle", "Measure_angle", "value")),
    "more words": plain(header=("incidence", "scatter angle", "bsdf")),
    "polar": plain(header=("polar_in", "polar_out", "f_r")),
    "greek": plain(header=("θ_i", "θ_r", "f_r")),
    "abbreviations": plain(header=("AOI", "theta_s", "BRDF (sr^-1)")),
    "hyphens": plain(header=("theta-in", "theta-out", "brdf_sr-1")),
    "Fortran's exponents": plain(form="{:E}").replace("E-", "D-").replace("E+", "D+"),
    "planetary letters": plain(header=("i", "e", "brdf")),
    "source and viewer": plain(header=("theta_s", "theta_v", "brdf")),
    "a reference direction": plain(header=("theta_inc", "theta_ref", "brdf")),
    "naught for the incidence": plain(header=("theta_0", "theta", "brdf")),
    "a spreadsheet's separator line": "sep=;\n" + plain(";"),
    "sixteen bits, the other way round": b"\xfe\xff" + plain().encode("utf-16-be"),
    "a spreadsheet's missing values": plain() + "60,70,#N/A\n",
    "angles from the mirror direction": "theta_i,angle from specular,brdf\n"
    + "".join(f"{i:g},{r - i:g},{f:g}\n" for i, r, f in ROWS),
    "differences of sines": "theta_i,beta-beta0,brdf\n"
    + "".join(f"{i:g},{np.sin(np.radians(r)) - np.sin(np.radians(i)):.9g},{f:g}\n" for i, r, f in ROWS),
    "decimal logarithms": "theta_i,theta_r,log10(BRDF)\n"
    + "".join(f"{i:g},{r:g},{np.log10(f):.12g}\n" for i, r, f in ROWS),
}


@pytest.mark.parametrize("name", GOOD)
def test_reads_a_table_with(tmp_path, name):
    measurement = read(tmp_path, GOOD[name])
    check(measurement[: len(ROWS)])
    assert not np.any(measurement.usable[len(ROWS) :])


def test_reads_standard_input(monkeypatch):
    monkeypatch.setattr(sys, "stdin", type("Stdin", (), {"buffer": io.BytesIO(plain().encode())})())
    check(formats.read("-"))


def test_content_decides_not_the_suffix(tmp_path):
    path = tmp_path / "table.binary"
    path.write_text(plain())
    check(formats.read(path))


def test_columns_can_be_named(tmp_path):
    text = plain(header=("a", "b", "c"))
    check(read(tmp_path, text, columns={"theta_i": "a", "theta_r": "b", "brdf": "c"}))
    check(read(tmp_path, text, columns="theta_i=a,theta_r=b,brdf=c"))
    bare = "\n".join(plain().split("\n")[1:])
    check(read(tmp_path, bare, columns="theta_i,theta_r,brdf"))


def test_radians_by_name_and_by_option(tmp_path):
    rows = "\n".join(f"{np.radians(a):.9g},{np.radians(b):.9g},{f}" for a, b, f in ROWS)
    check(read(tmp_path, f"theta_i_rad,theta_r_rad,brdf\n{rows}\n"))
    check(read(tmp_path, f"theta_i,theta_r,brdf\n{rows}\n", unit="rad"))


def test_wide_form_has_a_channel_for_each_column(tmp_path):
    text = "theta_i,theta_r,450nm,brdf_550nm,0.65um,stderr_450nm,stderr_550nm,stderr_650nm\n"
    text += "30,30,.1,.2,.3,.01,.02,.03\n30,40,.4,.5,,.01,.02,.03\n"
    measurement = read(tmp_path, text)
    assert measurement.channels == ("450nm", "550nm", "650nm")
    np.testing.assert_allclose(measurement.geom.wavelength, [0.45, 0.55, 0.65])
    np.testing.assert_allclose(measurement.brdf, [[0.1, 0.2, 0.3], [0.4, 0.5, np.nan]])
    np.testing.assert_allclose(measurement.stderr[0], [0.01, 0.02, 0.03])


def test_colours_stand_at_nominal_wavelengths(tmp_path):
    measurement = read(tmp_path, "theta_i,theta_r,red,green,blue\n30,30,.1,.2,.3\n30,40,.4,.5,.6\n")
    assert measurement.channels == ("R", "G", "B")
    np.testing.assert_allclose(measurement.geom.wavelength, [0.61, 0.55, 0.465])
    assert "nominal-wavelengths" in codes(measurement)


def test_a_lone_f_r_is_no_red_channel(tmp_path):
    assert read(tmp_path, plain(header=("theta_i", "theta_r", "f_r"))).channels == ("brdf",)


def test_long_form_is_turned_into_channels(tmp_path):
    text = "lambda,theta_i,theta_r,brdf,u_brdf\n450,30,30,.1,.01\n550,30,30,.2,.02\n450,30,40,.3,.03\n"
    measurement = read(tmp_path, text)
    assert measurement.channels == ("450nm", "550nm")
    np.testing.assert_allclose(measurement.brdf, [[0.1, 0.2], [0.3, np.nan]])
    np.testing.assert_allclose(measurement.stderr, [[0.01, 0.02], [0.03, np.nan]])


def test_a_direction_measured_twice_is_two_samples(tmp_path):
    measurement = read(tmp_path, "lambda,theta_i,theta_r,brdf\n450,30,30,.1\n450,30,30,.2\n550,30,30,.3\n")
    np.testing.assert_allclose(np.sort(measurement.brdf[:, 0]), [0.1, 0.2])
    assert "repeated-rows" in codes(measurement)


@pytest.mark.parametrize(
    "names",
    [
        "400nm,700nm",
        "400,700",
        "BRDF_400,BRDF_700",
        "wl400,wl700",
        "lambda=400,lambda=700",
        "0.4um,0.7um",
        "brdf 400 nm,brdf 700 nm",
    ],
)
def test_a_column_for_each_wavelength_named(tmp_path, names):
    measurement = read(
        tmp_path, f"theta_i,theta_r,{names}\n" + "".join(f"{i:g},{r:g},{f:g},{2 * f:g}\n" for i, r, f in ROWS)
    )
    check(measurement)
    np.testing.assert_allclose(measurement.geom.wavelength, [0.4, 0.7])
    np.testing.assert_allclose(measurement.brdf[:, 1], 2 * measurement.brdf[:, 0])


@pytest.mark.parametrize("form", ["{}", "theta_i={}", "{} deg", "AOI {}", "{}°", "BRDF @ {} deg", "inc{}"])
def test_a_column_for_each_incidence_named(tmp_path, form):
    names = ",".join(form.format(angle) for angle in (15, 30, 60))
    measurement = read(tmp_path, f"theta_r,{names}\n-40,.1,.2,.3\n0,.2,.3,.4\n30,.4,.8,.5\n")
    assert "incidence-columns" in codes(measurement)
    np.testing.assert_allclose(measurement.geom.theta_i_deg[:, 0], np.repeat([15, 30, 60], 3))
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], np.tile([-40, 0, 30], 3))
    np.testing.assert_allclose(measurement.brdf[:, 0], [0.1, 0.2, 0.4, 0.2, 0.3, 0.8, 0.3, 0.4, 0.5])


def test_values_in_percent_are_divided_by_a_hundred(tmp_path):
    measurement = read(tmp_path, plain(header=("theta_i", "theta_r", "reflectance factor [%]")))
    np.testing.assert_allclose(measurement.brdf[:, 0] * np.pi * 100, [row[2] for row in ROWS])
    assert {"percent", "quantity-stated"} <= codes(measurement)


def test_a_name_that_says_little_is_taken_for_the_brdf_and_noted(tmp_path):
    assert "quantity-assumed" in codes(read(tmp_path, plain(header=("theta_i", "theta_r", "intensity"))))


def test_expanded_uncertainties_are_divided_by_their_factor(tmp_path):
    measurement = read(tmp_path, "theta_i,theta_r,brdf,BRDF uncertainty (k=2)\n30,30,.5,.02\n30,40,.4,.01\n")
    np.testing.assert_allclose(measurement.stderr[:, 0], [0.01, 0.005])
    relative = read(tmp_path, "theta_i,theta_r,brdf,relative uncertainty [%]\n30,30,.5,2\n30,40,.4,5\n")
    np.testing.assert_allclose(relative.stderr[:, 0], [0.01, 0.02])


def test_a_title_above_the_header_may_name_the_wavelength(tmp_path):
    assert read(tmp_path, "Sample: paint\nWavelength: 633 nm\n\n" + plain()).geom.wavelength[0] == pytest.approx(0.633)


def test_percent_and_relative_uncertainties_become_absolute(tmp_path):
    measurement = read(tmp_path, "theta_i,theta_r,brdf,brdf error [%]\n30,30,.5,2\n30,40,.4,5\n")
    np.testing.assert_allclose(measurement.stderr[:, 0], [0.01, 0.02])


@pytest.mark.parametrize("incidence", ["theta_i: 45", "AOI = 45 deg", "Angle of incidence: 45°", "incident angle = 45"])
def test_wavelength_and_incidence_out_of_comments(tmp_path, incidence):
    measurement = read(tmp_path, f"# {incidence}\n# wavelength_nm: 633\ntheta_r,brdf\n-20,.1\n30,.2\n45,.4\n")
    assert measurement.theta_i_groups.keys() == {45.0}
    assert measurement.geom.wavelength[0] == pytest.approx(0.633)


@pytest.mark.parametrize(
    ("comment", "nm"),
    [
        ("wavelength_nm: 633", 633),
        ("Wavelength (nm) = 550.0", 550),
        ("measured at lambda = 532 nm, 3 mm spot", 532),
        ("red laser (650 nm, 3.5mm spot)", 650),
        ("2-5.7 um band", 3850),
        ("wavelength: 10.6 um", 10600),
    ],
)
def test_wavelength_out_of_free_text(tmp_path, comment, nm):
    measurement = read(tmp_path, f"# {comment}\n{plain()}")
    assert measurement.geom.wavelength[0] == pytest.approx(nm / 1000)


def test_quantity_by_name_is_undone(tmp_path):
    cosine = read(tmp_path, plain(header=("theta_i", "theta_r", "BRDF*cos(theta_r)")))
    np.testing.assert_allclose(cosine.brdf[:, 0] * cosine.geom.cos_r[:, 0], [row[2] for row in ROWS])
    factor = read(tmp_path, plain(header=("theta_i", "theta_r", "reflectance factor")))
    np.testing.assert_allclose(factor.brdf[:, 0] * np.pi, [row[2] for row in ROWS])
    assert "quantity-stated" in codes(factor)


def test_azimuths_and_relative_azimuth_agree(tmp_path):
    both = read(tmp_path, "theta_i,phi_i,theta_r,phi_r,brdf\n30,20,40,170,.5\n30,20,40,200,.6\n50,20,40,200,.7\n")
    relative = read(tmp_path, "theta_i,theta_r,dphi,brdf\n30,40,150,.5\n30,40,180,.6\n50,40,180,.7\n")
    np.testing.assert_allclose(both.geom.vxy2, relative.geom.vxy2, atol=1e-12)


def test_selections_keep_what_was_asked_for(tmp_path):
    text = "theta_i,theta_r,dphi,400nm,500nm,600nm\n30,40,180,.1,.2,.3\n30,85,180,.1,.2,.3\n30,40,90,.1,.2,.3\n"
    assert read(tmp_path, text, wavelength=[510]).channels == ("500nm",)
    assert read(tmp_path, text, wavelength=(450, 650)).channels == ("500nm", "600nm")
    assert len(read(tmp_path, text, in_plane=True).geom) == 2
    assert len(read(tmp_path, text, theta_max=80).geom) == 2
