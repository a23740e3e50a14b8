"""sigma and tau from a dimmed mirror image: the errors of PHOTO.md's table, and sentences for tables that are none."""

import numpy as np
import pytest

from brdfguide.advice.mirror_table import inferred_from, read_mirror_table
from brdfguide.advice.wave_gloss import mirror_share
from brdfguide.errors import InputError
from brdfguide.models import get
from brdfguide.physics.fresnel import fresnel
from brdfguide.physics.geometry import in_plane

SURFACES = ((0.1, 0.05), (0.2, 0.1), (0.5, 0.1), (0.5, 0.03), (0.8, 0.1), (0.5, 0.2))  # sigma [µm], sigma/tau


def written(path, sigma, slope, seed, columns="R,G,B", waves=(0.65, 0.55, 0.45)):
    """A table of 15 angles with 3 % and 0.003 of noise."""
    rng, lines = np.random.default_rng(seed), [f"theta_deg,{columns}"]
    for angle in np.linspace(60, 88, 15):
        ratios = [float(mirror_share(angle, sigma, slope, wave)) for wave in waves]
        noisy = [max(each * (1 + 0.03 * rng.normal()) + 0.003 * rng.normal(), 0.0) for each in ratios]
        lines.append(",".join(f"{each:.5f}" for each in (angle, *noisy)))
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("sigma, slope", SURFACES)
def test_both_numbers_come_out_of_a_noisy_table_seed_5(sigma, slope, tmp_path):
    law = inferred_from(read_mirror_table(written(tmp_path / "it.csv", sigma, slope, 5))).laws[0]
    assert law.name == "he-torrance" and law.meets
    assert law.numbers["sigma"].value == pytest.approx(sigma, rel=0.03)
    assert law.numbers["slope"].value == pytest.approx(slope, rel=0.05)
    for name, truth in (("sigma", sigma), ("slope", slope)):
        number = law.numbers[name]
        assert number.high / number.low < 1.2 and number.low / 1.03 < truth < 1.03 * number.high


def test_the_dimming_is_the_mirror_of_the_law_over_fresnel():
    values = {"sigma": 0.3, "slope": 0.08, "n": 1.5, "k": 0.0}
    geom = in_plane([[75.0]], 75.0, 0.65)
    mirror = float(get("he-torrance").mirror(geom, {f"he-torrance.{key}": each for key, each in values.items()})[0, 0])
    expected = mirror / float(fresnel(np.cos(np.radians(75.0)), 1.5))
    assert float(mirror_share(75.0, 0.3, 0.08, 0.65)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "empty"),
        ("theta_deg,X\n60,1\n", ":1: a column called 'X'"),
        ("angle,theta,R\n60,60,1\n", ":1: 2 columns of angles"),
        ("theta_deg\n60\n", ":1: no column of ratios"),
        ("theta_deg,R\n", "no row below the header"),
        ("theta_deg,R\n60,a\n", ":2: found 'a', wanted a number"),
        ("theta_deg,R\n95,0.5\n", ":2: an angle of 95"),
        ("theta_deg,R\n60,5\n", ":2: a ratio of 5"),
        ("theta_deg,R\n60\n", ":2: 1 values under a header of 2"),
    ],
)
def test_a_table_that_is_none_is_refused_in_words(text, words, tmp_path):
    (tmp_path / "it.csv").write_text(text)
    with pytest.raises(InputError) as error:
        read_mirror_table(tmp_path / "it.csv")
    assert words in str(error.value)


def test_a_single_column_has_the_wavelength_that_is_said(tmp_path):
    path = written(tmp_path / "it.csv", 0.3, 0.1, 2, "attenuation", (0.65,))
    law = inferred_from(read_mirror_table(path, 0.65)).laws[0]
    assert law.numbers["sigma"].value == pytest.approx(0.3, rel=0.05)
    by_name = read_mirror_table(written(tmp_path / "named.csv", 0.3, 0.1, 2, "650nm", (0.65,)))
    assert by_name.rows == read_mirror_table(path, 0.65).rows
    with pytest.raises(InputError, match="is for a column called attenuation"):
        read_mirror_table(tmp_path / "named.csv", 0.65)
