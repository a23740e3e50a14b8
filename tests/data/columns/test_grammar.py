"""What a column's name says, word by word: role, quantity, unit, wavelength, and the part of a doubt."""

import pytest

from brdfguide.data.columns.grammar import understood
from brdfguide.data.columns.header import columns_of
from brdfguide.data.columns.tokens import LONGEST, tokens
from brdfguide.data.columns.vocabulary import ANGLE_UNITS, LENGTH_UNITS, QUANTITIES, SCALES

ROLES = {
    "theta_i": (
        "theta_i|Theta In|thetai|θᵢ|θ_0|theta_inc (deg)|polar_in|AOI|Angle of incidence (°)|incidence|"
        "Incident_angle|SZA|solar_zenith_angle|incidence angle theta_i|Einfallswinkel [°]|theta_i / deg|"
        "theta_i in deg|IncidentAngle"
    ),
    "theta_r": (
        "theta_r|theta_s|theta_v|theta_o|θ_e|polar_out|scatter angle|Scattering angle|emission|emergence|"
        "Measure_angle|VZA|Viewing Zenith Angle|Detector angle / mrad|theta_ref|view angle"
    ),
    "phi_i": "phi_i|phi_in|azimuth_i|SAA|source azimuth|φ0",
    "phi_r": "phi_r|phir|phi_s|azimuth_out|VAA|detector azimuth angle",
    "dphi": "dphi|Δφ|delta phi|relative azimuth|RAA|relaz|phi|azimuth|phi_d|phi_diff|azimuth difference",
    "theta_h": "theta_h|thetah|theta_half|half angle|th_h",
    "theta_d": "theta_d|theta_diff|thetad|difference angle",
    "phase": "phase|phase angle|Phase_angle_deg",
    "rotation": "rotation|sample rotation|psi|sample azimuth|ψ (deg)|sample_rotation",
    "from_mirror": "angle from specular|aspecular angle|off-specular angle|theta_s - theta_i|angle relative to mirror",
    "beta_from_mirror": "beta-beta0|β - β₀|beta_s - beta_i",
    "beta_r": "beta_s|beta_r|β_s",
    "wavelength": "lambda|λ / nm|wavelength (nm)|Wavelength_um|wl|Wellenlänge",
    "wavenumber": "wavenumber (cm-1)|wavenumber [cm^-1]",
    "x_i": "wi_x|wix|in_x|light x",
    "z_r": "wo_z|wo.z|out_z|view z",
    "value": (
        "brdf|BRDF [1/sr]|BRDF (sr^-1)|f_r|fr|f_r11|BSDF|brdf_sr-1|f_r(theta_i, theta_r)|BRDF(θi,θr)|"
        "reflectance factor [%]|BRF|RADF|I/F|HDRF|ARS|CCBRDF|BRDF*cos(theta_r)|log10(BRDF)|BRDF (dB)|value|"
        "reflectance|mean BRDF|550nm|400|BRDF @ 30 deg|BSDF 405 nm (1/sr)|BRF_865|pi*BRDF|refl. factor|"
        "BRDF [10⁻³ sr⁻¹]|BRDF [1e-3/sr]"
    ),
    "stderr": (
        "stderr|u(BSDF)|u_brdf|uncertainty (k=2) %|BRDF std|std dev|expanded uncertainty|relative uncertainty [%]|"
        "2 sigma|u(BSDF) 405 nm|stderr_550nm|BRDF uncertainty (k=2)|error|uncertainty (95%)|ubrdf"
    ),
}
NAMES = [(name, role) for role, names in ROLES.items() for name in names.split("|")]


@pytest.mark.parametrize(("name", "role"), NAMES)
def test_a_name_has_its_role(name, role):
    assert understood(name).role == role


@pytest.mark.parametrize(
    "name",
    [
        "Panel BRF",  # whose?
        "normalised BRDF",
        "relative BRDF",
        "BRDF s-pol",
        "BRDF model",
        "theta_i_err",
        "theta_i-theta_r-x",
        "f_r12/f_r11",
        "BRDF/cos",
        "BRDF*1000",
        "sample_id",
        "time",
        "temperature (C)",
        "counts",
        "dtheta",
        "measured",
        "d",
        "",
        "wavelength 2 3",
        "a b c d e f g h i j k l m n",
    ],
)
def test_a_name_that_is_not_understood_to_the_last_word_has_no_role_and_says_why(name):
    column = understood(name)
    assert column.role is None and column.why


@pytest.mark.parametrize(
    ("name", "quantity"),
    [
        ("BRDF", "brdf"),
        ("bidirectional reflectance distribution function", "brdf"),
        ("CCBRDF [1/sr]", "brdf-cos"),
        ("cosine-corrected BSDF", "brdf-cos"),
        ("angle resolved scattering", "brdf-cos"),
        ("BRDF cos theta_s", "brdf-cos"),
        ("BRDF*cos(theta_i)", "brdf-cos-i"),
        ("BRF", "reflectance-factor"),
        ("Bidirectional Reflectance Factor", "reflectance-factor"),
        ("BRDF x pi", "reflectance-factor"),
        ("reflectance factor / pi", "brdf"),
        ("I/F", "radf"),
        ("RADF", "radf"),
        ("HDRF", "hdrf"),
        ("radiance factor", "radiance-factor"),
        ("reflectance", None),
    ],
)
def test_a_quantity_is_told_from_its_words(name, quantity):
    assert understood(name).quantity == quantity


@pytest.mark.parametrize("unit", [*ANGLE_UNITS, *LENGTH_UNITS])
def test_every_spelling_of_a_unit_is_read_in_brackets_behind_and_after_a_stroke(unit):
    base = "theta_i" if unit in ANGLE_UNITS else "lambda"
    _, spellings = (ANGLE_UNITS | LENGTH_UNITS)[unit]
    for word in spellings.split():
        for form in (
            f"{base} [{word}]",
            f"{base} ({word})",
            f"{base}_{word}",
            f"{base} / {word}",
            f"{base}_{word} ({word})",
        ):
            column = understood(form)
            assert (column.role, column.unit) == ("theta_i" if unit in ANGLE_UNITS else "wavelength", unit), form


def test_every_spelling_of_a_scale_and_every_phrase_of_a_quantity_is_read():
    for scale, spellings in SCALES.items():
        for word in spellings.split():
            assert understood(f"BRDF ({word})").scale == scale
    for name, quantity in QUANTITIES.items():
        for phrase in quantity.phrases:
            column = understood(phrase)
            assert (column.role, column.quantity) == ("value", name), phrase


@pytest.mark.parametrize(
    ("name", "um"),
    [
        ("550nm", 0.55),
        ("BSDF 405 nm (1/sr)", 0.405),
        ("0.65um", 0.65),
        ("0,65 µm", 0.65),
        ("lambda=400", 0.4),
        ("wl1064", 1.064),
        ("u(BSDF) 10.6 microns", 10.6),
        ("BRDF 400-500 nm", 0.45),
        ("5500 Å", 0.55),
    ],
)
def test_a_wavelength_stands_anywhere_in_a_name(name, um):
    assert understood(name).um == pytest.approx(um)


@pytest.mark.parametrize(
    ("name", "k", "proportional", "scale"),
    [
        ("uncertainty (k=2) %", 2.0, False, "%"),
        ("U(k=2)", 2.0, False, ""),
        ("2 sigma", 2.0, False, ""),
        ("uncertainty (95 %)", 1.96, False, ""),
        ("uncertainty, coverage factor 3", 3.0, False, ""),
        ("relative uncertainty [%]", None, True, "%"),
        ("u(BRDF)", None, False, ""),
        ("u(BRDF) [dB]", None, False, "dB"),
    ],
)
def test_a_doubt_says_how_it_was_expanded_and_of_what_it_is_a_share(name, k, proportional, scale):
    column = understood(name)
    assert (column.role, column.k, column.proportional, column.scale) == ("stderr", k, proportional, scale)


@pytest.mark.parametrize(
    ("name", "form"),
    [
        ("sun elevation", "elevation"),
        ("cos(theta_i)", "cos"),
        ("cos_theta_r", "cos"),
        ("mu0", "cos"),
        ("sin theta_r", "sin"),
    ],
)
def test_an_angle_may_be_given_by_its_elevation_or_a_function(name, form):
    assert understood(name).form == form


@pytest.mark.parametrize(
    ("name", "role", "sense"),
    [
        ("rotation (cw)", "rotation", "cw"),
        ("psi [deg, clockwise]", "rotation", "cw"),
        ("sample_rotation_cw", "rotation", "cw"),
        ("RotationCW", "rotation", "cw"),
        ("stage angle (+CW) / deg", "rotation", "cw"),
        ("rotation (positive clockwise, seen from above)", "rotation", "cw"),
        ("psi (counter-clockwise)", "rotation", "ccw"),
        ("sample azimuth (anti-clockwise)", "rotation", "ccw"),
        ("rotation ccw", "rotation", "ccw"),
        ("phi_i [° clockwise]", "phi_i", "cw"),
        ("azimuth (cw)", "dphi", "cw"),
        ("psi", "rotation", None),
        ("cw laser", None, None),
    ],
)
def test_a_turn_says_in_which_sense_it_counts(name, role, sense):
    assert (understood(name).role, understood(name).sense) == (role, sense)


def test_letters_mean_what_they_mean_beside_others():
    assert [column.role for column in columns_of(["i", "e", "g", "I/F"])] == ["theta_i", "theta_r", "phase", "value"]
    assert [column.role for column in columns_of(["theta_s", "theta_v", "brdf"])] == ["theta_i", "theta_r", "value"]
    assert [column.form for column in columns_of(["mu0", "mu", "BRF"])] == ["cos", "cos", ""]
    assert [column.role for column in columns_of(["beta0", "beta", "brdf"])] == ["beta_i", "beta_r", "value"]
    assert [column.colour for column in columns_of(["theta_i", "theta_r", "f_r"])] == [None, None, None]
    assert [column.colour for column in columns_of(["theta_i", "theta_r", "f_r", "f_g", "f_b"])][2:] == ["R", "G", "B"]


def test_a_bare_number_is_an_angle_where_one_is_missing_and_else_a_wavelength():
    sheet = columns_of(["theta_r", "15", "30", "60"])
    assert [column.at for column in sheet[1:]] == [15, 30, 60] and {column.at_role for column in sheet[1:]} == {
        "theta_i"
    }
    assert [column.at_role for column in columns_of(["theta_i", "0", "20", "40"])[1:]] == ["theta_r"] * 3
    assert [column.um for column in columns_of(["theta_i", "theta_r", "400", "0.55"])[2:]] == [0.4, 0.55]
    assert columns_of(["theta_i", "theta_r", "15", "30"])[2].role is None


def test_a_name_of_any_length_takes_a_moment():
    for text in (
        "(" * 10**6,
        " " * 10**6,
        "theta" * 10**5,
        "é" * 10**6,
        "e\u0301\u0323" * 10**5,
        "1" * 10**6,
        "-" * 10**6,
    ):
        assert len(tokens(text)) <= LONGEST
        understood(text)
