"""Scan, profile and TIS of one made surface: they agree; where one assumption fails it is named."""

import json

import numpy as np
import pytest

from brdfguide import models
from brdfguide.physics import hemisphere
from brdfguide.physics.geometry import in_plane
from brdfguide.physics.height_spectrum import KCorrelation, profile_height

from ..cli.test_advice import run

POLISH = {"a": 4e-5, "b": 60.0, "c": 1.8}
F0 = 0.9
BAND = (1 / 100.0, 1 / 1.0)  # [1/µm]: waves from 1 to 100 µm
STOP_DEG = 2.0
ABC = models.term("abc")


def scan(path, *, scale=1.0, body=0.0, sigma_scale=1.0) -> str:
    """A scan at 633 nm and 5 degrees, 0.3 to 80 degrees from the mirror direction, with 2 % noise."""
    values = {**POLISH, "a": POLISH["a"] * sigma_scale**2, "f0": F0}
    off = np.concatenate((np.geomspace(0.3, 10, 25), np.arange(12.0, 75.0, 3.0)))
    angles = np.sort(np.concatenate((5 + off, 5 - off)))
    geom = in_plane(5.0, angles, 0.633)
    brdf = ABC(geom, **values) * scale + body / np.pi
    brdf = brdf * np.exp(0.02 * np.random.default_rng(4).standard_normal(brdf.shape))
    rows = [f"5,{angle:.6f},{value:.8g}" for angle, value in zip(angles, brdf.ravel(), strict=True)]
    path.write_text("# 633 nm\nAOI,theta_s,BSDF (1/sr)\n" + "\n".join(rows) + "\n")
    return str(path)


def rq_nm() -> float:
    return 1000 * profile_height(KCorrelation(**POLISH), *BAND)


def tis(stop_deg: float = STOP_DEG, body: float = 0.0) -> float:
    """What a sphere gathers beyond the stop at normal incidence, as a share of what is reflected."""
    stop2 = (2 * np.sin(np.radians(stop_deg) / 2)) ** 2

    def lobe(geom):
        brdf = ABC(geom.at(0.633), **POLISH, f0=1.0) + body / np.pi / F0
        return np.where(geom.mirror_distance2 >= stop2, brdf, 0.0)

    return float(hemisphere.dhr(lobe, (0.0,))[0, 0])


def ways(file: str, rq: float, total: float, *more: str) -> dict:
    words = ["--rq", f"{rq:.6g}nm", "--band", "1um:100um", "--tis", f"{total:.8g}", "--stop-deg", f"{STOP_DEG:g}"]
    return json.loads(run("scatter", file, *words, "--f0", f"{F0}", "--json", *more).stdout)["three_ways"]


def test_three_that_agree(tmp_path):
    found = ways(scan(tmp_path / "scan.csv"), rq_nm(), tis())
    assert found["agree"] and found["fails"] is None
    for each in found["compared"]:
        assert each["ratio"] == pytest.approx(1.0, abs=0.12)
        assert each["share_in_scan"] > 0.7


def test_a_scan_with_a_wrong_scale(tmp_path):
    found = ways(scan(tmp_path / "scan.csv", scale=0.5), rq_nm(), tis())
    assert found["fails"] == "scale"
    assert "calibration" in found["because"]
    assert all(each["ratio"] == pytest.approx(2.0, rel=0.12) for each in found["compared"])


def test_a_surface_that_scatters_by_more_than_its_heights(tmp_path):
    """A body, as of a film of dust: scan and TIS see it, the profile does not."""
    body = 2e-3
    found = ways(scan(tmp_path / "scan.csv", body=body), rq_nm(), tis(body=body))
    assert found["fails"] == "heights"
    assert "something else than heights scatters" in found["because"]


def test_a_stop_that_is_wider_than_stated(tmp_path):
    found = ways(scan(tmp_path / "scan.csv"), rq_nm(), tis(stop_deg=8.0))
    assert found["fails"] == "stop"
    text = run(
        "scatter", str(tmp_path / "scan.csv"), "--rq", f"{rq_nm():.6g}nm", "--band", "1um:100um", "--f0", "0.9",
        "--tis", f"{tis(8.0):.6g}", "--stop-deg", "2",
    ).stdout  # fmt: skip
    assert "do not agree: scan and profile agree, and the TIS is" in text


def test_a_surface_too_rough_for_the_first_order(tmp_path):
    found = ways(scan(tmp_path / "scan.csv", sigma_scale=30.0), 30 * rq_nm(), 0.9)
    assert found["fails"] == "smooth"


def test_a_profile_of_waves_that_the_light_does_not_see(tmp_path):
    """Waves of 0.1 to 5 mm: extrapolated, and so not compared."""
    file = scan(tmp_path / "scan.csv")
    low, high = 1 / 5000.0, 1 / 300.0
    rq = 1000 * profile_height(KCorrelation(**POLISH), low, high)
    words = ["--rq", f"{rq:.6g}nm", "--band", "300um:5mm", "--f0", f"{F0}", "--json"]
    found = json.loads(run("scatter", file, *words).stdout)["three_ways"]
    assert found["fails"] == "band" and found["compared"][0]["share_in_scan"] < 0.5


def test_a_spectrum_beside_a_scan_is_compared_in_the_common_band(tmp_path):
    nu = np.geomspace(1e-4, 0.5, 60)
    rows = [f"{f:.8g},{s:.8g}" for f, s in zip(nu, KCorrelation(**POLISH).of_profile(nu), strict=True)]
    (tmp_path / "psd.csv").write_text("f (1/um), S (um^3)\n" + "\n".join(rows))
    words = [scan(tmp_path / "scan.csv"), str(tmp_path / "psd.csv"), "--f0", f"{F0}", "--json"]
    found = json.loads(run("scatter", *words).stdout)["three_ways"]
    assert found["agree"]
    low, high = found["compared"][0]["band_per_um"]
    assert low == pytest.approx(np.sin(np.radians(0.3)) / 0.633, rel=0.1) and high == pytest.approx(0.5)


def test_all_three_in_one_description(tmp_path):
    scan(tmp_path / "scan.csv")
    text = (
        f"measurements: [scan.csv]\nf0: {F0}\n"
        f"stylus: {{rq_um: {rq_nm() / 1000:.6g}, shortest_um: 1, cutoff_um: 100}}\n"
        "tis: {share: TIS, wavelength_nm: 633, stop_deg: 2}\n"
    )
    for total, fails in ((tis(), None), (2.2 * tis(), "beam")):
        (tmp_path / "mirror.yaml").write_text(text.replace("TIS", f"{total:.7g}"))
        found = json.loads(run("scatter", str(tmp_path / "mirror.yaml"), "--json").stdout)["three_ways"]
        assert found["fails"] == fails
    (tmp_path / "mirror.yaml").write_text(text.replace("TIS", "0.01").replace("shortest_um: 1, ", ""))
    assert "needs 'shortest_um' and 'cutoff_um'" in run("scatter", str(tmp_path / "mirror.yaml"), status=2).stderr
