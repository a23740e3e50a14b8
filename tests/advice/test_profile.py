"""Numbers of a workshop in a description: what each becomes, how it is told, and hints that keep to one quantity."""

from math import pi, sqrt

import numpy as np
import pytest

from brdfguide.advice import profile
from brdfguide.advice.material import parse_material, read_material
from brdfguide.errors import InputError
from brdfguide.models import term
from brdfguide.physics.geometry import in_plane
from brdfguide.physics.height_spectrum import KCorrelation, profile_height, profile_slope, surface_height

from ..cli.test_advice import answer, run


def test_ra_and_spacing_are_height_and_length(tmp_path):
    """A milled plate: Ra 0.8 µm, RSm 80 µm."""
    plate = parse_material("composition: aluminium\nstylus: {ra_um: 0.8, rsm_um: 80}")
    assert plate.sigma == pytest.approx(0.8 * sqrt(pi / 2), rel=1e-12)
    assert plate.tau == pytest.approx(80 / (sqrt(2) * pi), rel=1e-12)
    (tmp_path / "plate.yaml").write_text("composition: aluminium\nstylus: {ra_um: 0.8, rsm_um: 80}\n")
    text = run("recommend", str(tmp_path / "plate.yaml"), "--full", "--no-timing").stdout
    assert "rms height 1.003 µm: 1.2533 Ra, heights being Gaussian" in text
    assert "unused" not in text
    start = answer("recommend", str(tmp_path / "plate.yaml"))["candidates"]
    facets = next(each for each in start if each["model"] == "ggx")["start"]
    assert (
        facets["ggx.alpha"]["value"]
        if isinstance(facets["ggx.alpha"], dict)
        else facets["ggx.alpha"] == (pytest.approx(2 * plate.sigma / plate.tau, rel=0.02))
    )


def test_slopes_give_the_width():
    rdq = parse_material("kind: metal\nstylus: {rq_um: 0.2, rdq: 0.05}")
    sdq = parse_material("kind: metal\nstylus: {sq_um: 0.2, sdq: 0.0707106781}")
    assert rdq.tau == pytest.approx(sqrt(2) * 0.2 / 0.05, rel=1e-12)
    assert sdq.tau == pytest.approx(rdq.tau, rel=1e-8)
    assert 2 * rdq.sigma / rdq.tau == pytest.approx(sqrt(2) * 0.05, rel=1e-12)


def test_total_scatter_is_a_height():
    mirror = parse_material("kind: metal\ntis: {share: 0.01, wavelength_nm: 633, theta_i_deg: 60}")
    assert mirror.sigma == pytest.approx(0.633 * sqrt(0.010050335853501441) / (4 * pi * 0.5), rel=1e-9)


def test_cut_offs_are_said_and_doubted_where_they_hide_the_surface():
    """erf(π tau/λs) - erf(π tau/λc) of a Gaussian correlation."""
    assert profile.kept({"cutoff_um": 800.0}, 10.0) == pytest.approx(1 - 0.04428, abs=1e-4)
    assert profile.kept({"cutoff_um": 20.0}, 10.0) == pytest.approx(1 - 0.97368, abs=1e-4)
    assert profile.kept({}, 10.0) is None


@pytest.mark.parametrize(
    "text, says",
    [
        ("stylus: {Ra_um: 0.1}", "did you mean 'ra_um'?"),
        ("stylus: {Rz_um: 0.1}", "no key called 'Rz_um' in 'stylus'; there are"),
        ("stylus: {rdq: 0.1}", "has a slope without a height"),
        ("stylus: {ra_um: 0.1, shortest_um: 800, cutoff_um: 80}", "not below 'cutoff_um'"),
        ("tis: {share: 1.5}", "share"),
    ],
)
def test_what_is_refused(text, says):
    with pytest.raises(InputError) as error:
        parse_material(text)
    assert says in str(error.value) and "tau_um'?" not in str(error.value)


POLISH = KCorrelation(4e-5, 60.0, 1.8)  # rms height 1.1 nm, 0.91 nm of it in waves of 1 to 100 µm


def psd(path, low: float, high: float, *, area: bool = False, factor: float = 1.0) -> None:
    """The spectrum's file as an instrument writes it, heights `factor` times as high."""
    nu = np.geomspace(low, high, 40)
    density, unit = (POLISH.of_surface(nu), "um^4") if area else (POLISH.of_profile(nu), "um^3")
    rows = [f"{f:.8g},{factor**2 * s:.8g}" for f, s in zip(nu, density, strict=True)]
    path.write_text(f"f (1/um), S ({unit})\n" + "\n".join(rows))


def test_a_spectrum_in_a_description_is_a_height_and_a_length(tmp_path):
    psd(tmp_path / "psd.csv", 0.01, 1.0)
    (tmp_path / "mirror.yaml").write_text("kind: metal\nstylus: {spectrum: psd.csv}\n")
    mirror = read_material(tmp_path / "mirror.yaml")
    rq, rdq = profile_height(POLISH, 0.01, 1.0), profile_slope(POLISH, 0.01, 1.0)
    assert mirror.sigma == pytest.approx(rq, rel=1e-3)
    assert mirror.tau == pytest.approx(sqrt(2) * rq / rdq, rel=1e-3)
    assert mirror.cutoff == pytest.approx(100.0) and profile.band_of(mirror.given["stylus"])[1] == pytest.approx(1.0)
    said = run("recommend", str(tmp_path / "mirror.yaml"), "--full", "--no-timing").stdout
    assert "of the spectrum in psd.csv, waves of 1 to 100 µm" in " ".join(said.split())
    assert "unused" not in said


def test_an_areas_spectrum_is_its_own_height(tmp_path):
    psd(tmp_path / "psd.csv", 0.01, 1.0, area=True)
    (tmp_path / "mirror.yaml").write_text("kind: metal\nstylus: {spectrum: psd.csv}\n")
    assert read_material(tmp_path / "mirror.yaml").sigma == pytest.approx(surface_height(POLISH, 0.01, 1.0), rel=1e-3)


@pytest.mark.parametrize(
    "text, says", [(None, "there is no such file"), ("secret: 1\n", "is none; wanted two columns")]
)
def test_a_file_that_is_no_spectrum_is_named_and_not_quoted(tmp_path, text, says):
    if text is not None:
        (tmp_path / "psd.csv").write_text(text)
    (tmp_path / "mirror.yaml").write_text("kind: metal\nstylus: {spectrum: psd.csv}\n")
    with pytest.raises(InputError) as error:
        read_material(tmp_path / "mirror.yaml")
    assert says in str(error.value) and "secret" not in str(error.value)


def scan(path) -> None:
    """633 nm at 5 degrees, 0.3 to 74 degrees from the mirror direction."""
    off = np.concatenate((np.geomspace(0.3, 10, 25), np.arange(12.0, 75.0, 3.0)))
    angles = np.sort(np.concatenate((5 + off, 5 - off)))
    values = term("abc")(in_plane(5.0, angles, 0.633), a=POLISH.a, b=POLISH.b, c=POLISH.c, f0=1.0)
    rows = [f"5,{angle:.6f},{value:.8g}" for angle, value in zip(angles, values.ravel(), strict=True)]
    path.write_text("# 633 nm\nAOI,theta_s,BSDF (1/sr)\n" + "\n".join(rows) + "\n")


@pytest.mark.parametrize(
    "stylus, disagrees",
    [
        ("rq_um: 0.0009, shortest_um: 1, cutoff_um: 100", False),
        ("rq_um: 0.003, shortest_um: 1, cutoff_um: 100", True),
        ("rq_um: 0.0003, shortest_um: 3000, cutoff_um: 30000", False),  # waves that no angle of the scan sees
        ("spectrum: psd.csv", False),
        ("spectrum: high.csv", True),
    ],
)
def test_a_height_is_compared_with_the_lights_over_the_waves_that_both_see(tmp_path, stylus, disagrees):
    scan(tmp_path / "scan.csv")
    psd(tmp_path / "psd.csv", 1e-3, 1.0)
    psd(tmp_path / "high.csv", 1e-3, 1.0, factor=3.0)
    (tmp_path / "mirror.yaml").write_text(f"kind: metal\nmeasurements: [scan.csv]\nstylus: {{{stylus}}}\n")
    found = answer("recommend", str(tmp_path / "mirror.yaml"), "-m", "abc", "--no-timing")
    said = [each for each in found["disagreements"] if each["code"] == "height-disagrees"]
    assert bool(said) == disagrees
    if said:
        assert "both in waves of" in said[0]["text"]
        ratio = said[0]["numbers"]["stylus_um"] / said[0]["numbers"]["fitted_um"]
        assert ratio == pytest.approx(3.0 if "spectrum" in stylus else 0.003 / 0.000912, rel=0.03)
