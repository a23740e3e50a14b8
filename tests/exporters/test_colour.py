"""Channels to linear sRGB: white stays white, the approximation follows the tables, and the file says which it was."""

import numpy as np
import pytest

from brdfguide.errors import NoAnswer
from brdfguide.exporters import _colour

BANDS = np.arange(0.40, 0.701, 0.01)
NAMES = tuple(f"{1e3 * um:.0f}nm" for um in BANDS)


def test_flat_spectrum_is_white():
    np.testing.assert_allclose(_colour.to_srgb(NAMES, BANDS).matrix @ np.ones(31), 1.0, rtol=1e-12)


def test_long_wavelengths_are_red_and_short_ones_blue():
    matrix = _colour.to_srgb(NAMES, BANDS).matrix
    red, blue = matrix @ (BANDS > 0.6), matrix @ (BANDS < 0.47)
    assert red[0] > 0.8 and red[2] < 0.1 and blue[2] > 0.7 and blue[0] < 0.3


def test_order_of_channels_does_not_matter():
    backwards = _colour.to_srgb(NAMES[::-1], BANDS[::-1]).matrix[:, ::-1]
    np.testing.assert_allclose(backwards, _colour.to_srgb(NAMES, BANDS).matrix, atol=1e-14)


def test_named_colours_are_taken_as_they_are():
    made = _colour.to_srgb(("blue", "green", "red"), np.array([0.45, 0.55, 0.65]))
    assert (made.matrix @ [1, 2, 3]).tolist() == [3, 2, 1] and not made.mixes and "linear sRGB" in made.how


def test_infrared_carries_no_colour():
    with pytest.raises(NoAnswer, match="carry no colour: they do not span 450..620 nm in three steps; name one with --channel"):
        _colour.to_srgb(("905nm", "1064nm"), np.array([0.905, 1.064]))


@pytest.mark.filterwarnings("ignore")
def test_approximation_follows_the_published_tables(monkeypatch):
    """Smooth reflectances: within 0.045 in linear sRGB, of which the light, equal energy instead of D65, has a part."""
    pytest.importorskip("colour", reason="pip install colour-science: the tables")
    tables = _colour.to_srgb(NAMES, BANDS)
    assert "colour-science" in tables.how
    approximation = lambda: (lambda grid: np.array([sum(_colour._lobe(grid, *lobe) for lobe in lobes) for lobes in _colour.LOBES]), "approximation")  # noqa: E731
    monkeypatch.setattr(_colour, "_matching", approximation)
    rough = _colour.to_srgb(NAMES, BANDS)
    for centre in (0.45, 0.5, 0.55, 0.6, 0.65):
        reflectance = 0.2 + 0.5 * np.exp(-(((BANDS - centre) / 0.06) ** 2))
        np.testing.assert_allclose(rough.matrix @ reflectance, tables.matrix @ reflectance, atol=0.045)


def test_lobes_have_the_luminous_efficiency_of_the_observer():
    """The y lobe peaks near 556 nm at about 1 and has equal area with x and z, as CIE 1931 has."""
    nm = np.arange(380.0, 781.0)
    x, y, z = (sum(_colour._lobe(nm, *lobe) for lobe in lobes) for lobes in _colour.LOBES)
    assert abs(nm[np.argmax(y)] - 556) < 8 and y.max() == pytest.approx(1.0, abs=0.02)
    assert x.sum() == pytest.approx(y.sum(), rel=0.02) and z.sum() == pytest.approx(y.sum(), rel=0.02)
