"""Channels to linear sRGB: white stays white, the approximation follows the tables, and the file says which it was."""

import numpy as np
import pytest

from brdfguide.errors import NoAnswer
from brdfguide.physics import colour

BANDS = np.arange(0.40, 0.701, 0.01)
NAMES = tuple(f"{1e3 * um:.0f}nm" for um in BANDS)


def test_flat_spectrum_is_white():
    np.testing.assert_allclose(colour.to_srgb(NAMES, BANDS).matrix @ np.ones(31), 1.0, rtol=1e-12)


def test_long_wavelengths_are_red_and_short_ones_blue():
    matrix = colour.to_srgb(NAMES, BANDS).matrix
    red, blue = matrix @ (BANDS > 0.6), matrix @ (BANDS < 0.47)
    assert red[0] > 0.8 and red[2] < 0.1 and blue[2] > 0.7 and blue[0] < 0.3


def test_order_of_channels_does_not_matter():
    backwards = colour.to_srgb(NAMES[::-1], BANDS[::-1]).matrix[:, ::-1]
    np.testing.assert_allclose(backwards, colour.to_srgb(NAMES, BANDS).matrix, atol=1e-14)


def test_named_colours_are_taken_as_they_are():
    made = colour.to_srgb(("blue", "green", "red"), np.array([0.45, 0.55, 0.65]))
    assert (made.matrix @ [1, 2, 3]).tolist() == [3, 2, 1] and not made.mixes and "linear sRGB" in made.how


def test_infrared_carries_no_colour():
    with pytest.raises(
        NoAnswer, match="carry no colour: they do not span 450..620 nm in three steps; name one with --channel"
    ):
        colour.to_srgb(("905nm", "1064nm"), np.array([0.905, 1.064]))


@pytest.mark.filterwarnings("ignore")
def test_approximation_follows_the_published_tables(monkeypatch):
    """Smooth reflectances: within 0.045 in linear sRGB, of which the light, equal energy instead of D65, has a part."""
    pytest.importorskip("colour", reason="pip install colour-science: the tables")
    tables = colour.to_srgb(NAMES, BANDS)
    assert "colour-science" in tables.how
    monkeypatch.setattr(colour, "_matching", lambda nm: (colour.approximate_matching_functions(nm), "approximation"))
    rough = colour.to_srgb(NAMES, BANDS)
    for centre in (0.45, 0.5, 0.55, 0.6, 0.65):
        reflectance = 0.2 + 0.5 * np.exp(-(((BANDS - centre) / 0.06) ** 2))
        np.testing.assert_allclose(rough.matrix @ reflectance, tables.matrix @ reflectance, atol=0.045)


def test_matching_functions_peak_where_the_standard_has_them():
    """CIE 1931: 600, 555 and 445 nm; each has the area of the 1 nm table."""
    nm = np.arange(380.0, 781.0)
    x, y, z = colour.approximate_matching_functions(nm)
    assert nm[np.argmax(x)] == pytest.approx(600, abs=5)
    assert nm[np.argmax(y)] == pytest.approx(555, abs=3) and y.max() == pytest.approx(1.0, abs=0.02)
    assert nm[np.argmax(z)] == pytest.approx(445, abs=4)
    assert y.sum() == pytest.approx(106.86, rel=0.01)
    assert x.sum() == pytest.approx(y.sum(), rel=0.02) and z.sum() == pytest.approx(y.sum(), rel=0.02)


def test_a_straight_spectrum_takes_its_srgb_coefficients_near_where_srgb_is_said_to_lie():
    """Outside the primaries' dominant wavelengths, which is why the index tables are not read at these. Of the
    standard's own functions: the approximation, without the tables, has red at 634 nm."""
    pytest.importorskip("colour", reason="pip install colour-science: the tables")
    weights, _ = colour.of_wavelengths(BANDS)
    assert weights @ BANDS == pytest.approx(colour.SRGB_UM, abs=0.015)
    red, _, blue = weights @ BANDS - [colour.CHANNEL_UM[name] for name in "RGB"]
    assert red > 0.02 and blue < -0.01


def test_channels_lie_at_the_dominant_wavelengths_of_srgb():
    library = pytest.importorskip("colour", reason="pip install colour-science: the tables")
    space = library.RGB_COLOURSPACES["sRGB"]
    for name, primary in zip("RGB", space.primaries, strict=True):
        dominant, *_ = library.dominant_wavelength(primary, space.whitepoint)
        assert 1e-3 * float(dominant) == pytest.approx(colour.CHANNEL_UM[name], abs=0.0015)


def test_display_values_are_coded_as_srgb():
    """IEC 61966-2-1: a middle grey of 18 % is code 0.4613; the two pieces meet."""
    assert colour.encoded(np.array([0.0, 0.18, 1.0])) == pytest.approx([0.0, 0.46136, 1.0], abs=1e-5)
    assert colour.encoded(np.array([0.0031308])) == pytest.approx([0.04045], rel=1e-4)
