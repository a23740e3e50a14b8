"""What titles and comments say of a table."""

import pytest

from brdfguide.data.columns import prose


@pytest.mark.parametrize(
    ("line", "um"),
    [
        ("wavelength_nm: 633", 0.633),
        ("Wavelength (nm) = 550.0", 0.55),
        ("wavelength [um]: 1.55", 1.55),
        ("measured at lambda = 532 nm, 3 mm spot", 0.532),
        ("lambda_0 = 1064nm", 1.064),
        ("red laser (650 nm, 3.5mm spot)", 0.65),
        ("2-5.7 um band", 3.85),
        ("400..700 nm", 0.55),
        ("wavelength: 10.6 µm", 10.6),
        ("wavelength = 633", 0.633),
        ("Wavelength 0.633", 0.633),
        ("wavenumber = 1000 cm-1", 10.0),
        ("wavenumber: 20000", 0.5),
        ("frequency: 500 THz", 0.599584916),
        ("photon energy = 2 eV", 0.619920992),
    ],
)
def test_wavelengths(line, um):
    assert prose.wavelength_in([line]).um == pytest.approx(um)


@pytest.mark.parametrize(
    "line",
    [
        "lambda: 1064",
        "no wave here",
        "sigma/lambda = 0.1",
        "12 nm roughness",
        "wavelength unknown",
        "wavelengths: 3",
        "chopper frequency: 500 Hz",
        "frequency: 500",
        "laser energy 2 mJ",
    ],
)
def test_no_wavelength(line):
    assert prose.wavelength_in([line]) is None


def test_what_the_word_says_comes_before_what_only_a_unit_says():
    found = prose.wavelength_in(["coated for 400-700 nm", "a 1064 nm laser beside", "wavelength: 532 nm"])
    assert (found.um, found.line) == (0.532, 2)


@pytest.mark.parametrize(
    ("line", "degrees"),
    [
        ("theta_i: 45", 45),
        ("AOI = 45 deg", 45),
        ("Angle of incidence: 45°", 45),
        ("measured at incident angle = 30.5", 30.5),
        ("incidence = -5 deg", -5),
        ("theta_i [rad]: 0.5", 28.647889757),
        ("theta_i = 0.5 rad", 28.647889757),
        ("elevation of the light: 60 deg", 30),
        ("cos(theta_i) = 0.5", 60),
        ("AOI=30°; λ=633nm", 30),
        ("AOI = 30, run 2", 30),
        ("theta_i: 10, 30, 50", None),
        ("theta_r: 30", None),
        ("AOI: 30 nm", None),
        ("time: 30", None),
    ],
)
def test_one_incidence_for_a_whole_file(line, degrees):
    assert prose.incidence_in([line]) == (None if degrees is None else pytest.approx(degrees))


@pytest.mark.parametrize(
    ("line", "quantities"),
    [
        ("BRF Values, grey panel against a white standard", {"reflectance-factor"}),
        ("Bidirectional reflectance factor of sand", {"reflectance-factor"}),
        ("BRDF of an anodised panel", {"brdf"}),
        ("BRDF, from reflectance factors", {"brdf", "reflectance-factor"}),
        ("I/F at 750 nm", {"radf"}),
        ("HDRF of snow", {"hdrf"}),
        ("cosine-corrected BRDF", {"brdf-cos"}),
        ("a run of Tuesday, operator RF", set()),
    ],
)
def test_quantities(line, quantities):
    assert set(prose.quantities_in([line])) == quantities


def test_the_unit_of_all_angles():
    assert prose.angle_unit_in(["angles in radians, both from the normal"]) == "rad"
    assert prose.angle_unit_in(["Angles: gon"]) == "gon"
    assert prose.angle_unit_in(["angle of incidence 30 deg"]) is None  # of one angle, not of all
    assert prose.angle_unit_in(["angles in deg or rad"]) is None


def test_the_sense_of_rotations():
    assert prose.sense_in(["psi: rotation of the sample, clockwise seen from above"]) == "cw"
    assert prose.sense_in(["sample rotated counter-clockwise"]) == "ccw"
    assert prose.sense_in(["rotation of the sample", "cw laser"]) is None
    assert prose.sense_in(["rotation cw", "turned ccw"]) is None


def test_comments_of_any_length_take_a_moment():
    for text in (
        "wavelength" + " " * 10**6 + "x",
        "1" * 10**6,
        "wavelength " * 10**5,
        "theta_i: " * 10**5,
        "BRF " * 10**5,
    ):
        prose.wavelength_in([text])
        prose.incidence_in([text])
        prose.quantities_in([text])
