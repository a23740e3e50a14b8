"""`brdfguide scatter`: numbers, laws, spectra and scans, each to the others."""

import json

import numpy as np
import pytest

from brdfguide.physics.height_spectrum import KCorrelation
from brdfguide.report.figures import style
from brdfguide.report.figures.scatter import scatter_figure

from ..report import probe
from .test_advice import run

MIRROR = {"a": 1e-4, "b": 1e-5, "g": 1.8}


def answered(*words: str) -> dict:
    return json.loads(run("scatter", *words, "--json").stdout)


def abg_scan(path) -> str:
    """A scan of an ABg mirror at 633 nm, incidence 5 and 40 degrees."""
    lines = ["# 633 nm", "AOI,theta_s,BSDF (1/sr)"]
    for theta_i in (5.0, 40.0):
        for theta_r in np.arange(-80.0, 81.0, 4.0):
            x = abs(np.sin(np.radians(theta_r)) - np.sin(np.radians(theta_i)))
            if x > 1e-3:
                lines.append(f"{theta_i:g},{theta_r:g},{MIRROR['a'] / (MIRROR['b'] + x ** MIRROR['g']):.9g}")
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def test_ra_to_scatter_to_height():
    from_ra = answered("--ra", "12nm", "--wavelength-nm", "633")["heights"]
    assert from_ra["sigma_um"] == pytest.approx(0.012 * np.sqrt(np.pi / 2), rel=1e-12)
    back = answered("--tis", repr(from_ra["tis"]), "--wavelength-nm", "633")["heights"]
    assert back["sigma_um"] == pytest.approx(from_ra["sigma_um"], rel=1e-12)


def test_the_answer_comes_first_in_plain_words():
    first = run("scatter", "--tis", "0.01").stdout.splitlines()[0]
    assert first == "an rms height of 4.39 nm (Ra 3.5 nm) scatters 1 % of what is reflected at 550 nm and 0 degrees"


def test_another_wavelength_and_its_validity():
    document = answered("--sigma", "0.3um", "--to-nm", "10600")["heights"]
    assert not document["smooth"]
    assert not document["elsewhere"]["smooth"]
    assert document["elsewhere"]["tis"] == pytest.approx(-np.expm1(-((4 * np.pi * 0.3 / 10.6) ** 2)), rel=1e-12)
    assert answered("--sigma", "0.2um", "--to-nm", "10600")["heights"]["elsewhere"]["smooth"]


@pytest.mark.parametrize(
    "unit, length", [("(1/um), S (um^3)", 1.0), ("(1/mm), psd [nm^2 mm]", 1e3), ("[1/um] ; PSD [nm³]", 0)]
)
def test_a_profiles_spectrum_in_any_unit(tmp_path, unit, length):
    spectrum, nu = KCorrelation(1e-4, 20.0, 2.2), np.geomspace(1e-3, 3, 80)
    scale = {1.0: (1, 1), 1e3: (1e3, 1e3), 0: (1, 1e9)}[length]
    rows = [f"{a * scale[0]:.9g}, {b * scale[1]:.9g}" for a, b in zip(nu, spectrum.of_profile(nu), strict=True)]
    file = tmp_path / "psd.csv"
    file.write_text(f"# a profile\nf {unit}\n" + "\n".join(rows))
    document = answered(str(file), "--wavelength-nm", "633", "--band", "2.5um:0.8mm")
    law = next(row for row in document["laws"] if row["law"] == "abc")
    assert law["off_percent"] < 0.5
    assert law["parameters"]["b"]["value"] == pytest.approx(20.0, rel=0.01)
    assert document["shape"]["rq_in_band_um"] == pytest.approx(0.00254, rel=0.01)


@pytest.mark.parametrize(
    "text, says",
    [
        ("f (1/um), S (um^2)\n1,1\n2,1\n", "wanted `f (1/um), S (um^3)`"),
        ("f (um), S (um^3)\n1,1\n2,1\n", "line 1: 'um' is no unit of a spatial frequency"),
        ("f (1/um), S (um^3)\n1,1\n2,-1\n", "line 3: found 2,-1; wanted a frequency and a density above zero"),
        ("f (1/um), S (furlong^3)\n1,1\n", "unknown unit 'furlong'"),
        ("f (1/um), S (um^3)\n1,1\n", "1 points; wanted two or more"),
    ],
)
def test_a_bad_spectrum_is_one_sentence(tmp_path, text, says):
    file = tmp_path / "psd.csv"
    file.write_text(text)
    said = run("scatter", str(file), status=2).stderr
    assert said.count("\n") == 1 and says in said


def test_a_scan_of_an_abg_mirror_gives_its_numbers(tmp_path):
    laws = answered(abg_scan(tmp_path / "scan.csv"))["laws"]
    abg = next(row for row in laws if row["law"] == "abg")["parameters"]
    for name, value in MIRROR.items():
        assert np.ravel(abg[name]["value"])[0] == pytest.approx(value, rel=1e-4)


def test_abg_to_harvey_shack_is_a_refit_with_its_error():
    """At the shoulder the two differ by 2^(g/2 - 1); for slope 2 they are one law."""
    rows = {row["law"]: row for row in answered("abg", "a=1e-4", "b=1e-5", "g=1.8")["laws"]}
    assert rows["abg"]["off_percent"] < 1e-3 and rows["abg"]["by"] == "as given"
    assert 0.3 < rows["harvey-shack"]["off_percent"] < 3
    assert rows["harvey-shack"]["parameters"]["s"]["value"] == pytest.approx(-1.8, abs=0.02)
    rows = {row["law"]: row for row in answered("abg", "a=1e-4", "b=1e-4", "g=2")["laws"]}
    assert rows["harvey-shack"]["off_percent"] < 1e-3
    assert rows["harvey-shack"]["parameters"]["l"]["value"] == pytest.approx(0.01, rel=1e-4)


def test_k_correlation_scatters_as_its_height_says():
    document = answered("abc", "a=1e-5", "b=200", "c=2.5", "--wavelength-nm", "633")
    assert document["theory"] == "rayleigh-rice"
    assert document["heights"]["sigma_total_um"] == pytest.approx(KCorrelation(1e-5, 200.0, 2.5).height, rel=1e-9)
    assert document["heights"]["sigma_um"] == pytest.approx(document["heights"]["sigma_total_um"], rel=0.01)


def test_a_rough_spectrum_is_scattered_beyond_the_first_order():
    document = answered("abc", "a=1", "b=200", "c=2.5")
    assert document["theory"] == "correlation in the exponent" and not document["heights"]["smooth"]
    assert all(value is not None and value >= 0 for value in document["curve"]["brdf_per_sr"])


def test_a_spectrum_without_a_total_height_says_so():
    assert "heights without a bound" in run("scatter", "abc", "a=1e-7", "b=20", "c=0.8").stdout


def test_lengths_want_a_unit():
    assert "--ra 12: wanted a length with its unit" in run("scatter", "--ra", "12", status=2).stderr
    assert (
        "the first wave has to be the shorter" in run("scatter", "--ra", "12nm", "--band", "1mm:2um", status=2).stderr
    )
    assert "no law or file called 'abgg'; did you mean abg?" in run("scatter", "abgg", "a=1", status=2).stderr


def test_the_plot_is_the_same_twice(tmp_path):
    for name in ("one.svg", "two.svg"):
        run("scatter", "abg", "a=1e-4", "b=1e-5", "g=1.8", "--plot", str(tmp_path / name))
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


def test_a_scan_scatters_what_a_fit_of_it_says(tmp_path):
    """Rayleigh and Rice's spectrum of an ABg mirror, which has no cosines, holds more."""
    path = abg_scan(tmp_path / "mirror.csv")
    summed = answered(path)["heights"]["summed"]
    fitted = json.loads(run("fit", path, "-m", "abg", "--json").stdout)["stray_light"][0]
    assert summed["law"] == "abg"
    assert summed["scattered"] == pytest.approx(fitted["scattered"][0]["measured"], rel=1e-3)
    first = run("scatter", path).stdout.splitlines()[0]
    assert first.startswith("it scatters 0.") and first.endswith("0.017..1.6, as abg adds it up")


@pytest.mark.parametrize("words", [("abg", "a=1e-4", "b=1e-5", "g=1.8"), ("abc", "a=1e-4", "b=20", "c=1.4")])
def test_the_picture_has_a_title_and_says_what_rises_toward_grazing(words):
    with style.look():
        figure = scatter_figure(answered(*words))
    assert probe.faults(figure) == []
    assert figure.get_suptitle() == f"scatter of {words[0]} at 550 nm, light from 0°"
    assert ("hollow" in figure.get_supxlabel()) == (words[0] == "abg")
