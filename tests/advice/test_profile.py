"""Numbers of a workshop in a description: what each becomes, how it is told, and hints that keep to one quantity."""

from math import pi, sqrt

import pytest

from brdfguide.advice import profile
from brdfguide.advice.material import parse_material
from brdfguide.errors import InputError

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
