"""Kinds of file that practitioners publish and that were once misread: each gives back the surface that made it."""

import json

import numpy as np
import pytest

from brdfguide import models
from brdfguide.cli import main
from brdfguide.data import examine, formats
from brdfguide.fitting import fit as fitting
from brdfguide.physics.geometry import Geometry, rows

from ...surfaces import table

MODEL = models.get("lambertian+ggx")
TRUTH = {"ggx.alpha": 0.2, "ggx.n": 1.5, "lambertian.albedo": 0.2}
PLANE = [each.ravel() for each in np.meshgrid([10.0, 30.0, 50.0, 70.0], np.r_[-75.0:76.0:5.0], indexing="ij")]


def in_plane(theta_i, theta_r) -> Geometry:
    return rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))


def made(geom: Geometry, seed: int, **other) -> np.ndarray:
    """Values (rows,) of the surface with 1 % noise."""
    brdf = np.broadcast_to(MODEL(geom, {**TRUTH, **other}), (len(geom), 1))[:, 0]
    return brdf * np.exp(0.01 * np.random.default_rng(seed).standard_normal(len(geom)))


def check(path, *, noise=0.01, wanted=None, **options) -> None:
    """Fits the file and compares with the truth."""
    fit = fitting.fit(MODEL, examine.prepared(formats.read(path, **options)))
    assert fit.rms_ln < 1.3 * noise
    for key, value in {**TRUTH, **(wanted or {})}.items():
        assert fit.values[key] == pytest.approx(value, rel=0.05), key


def test_an_azimuth_that_only_the_phase_angle_tells_seed_1(tmp_path):
    grid = np.meshgrid([20.0, 40.0, 60.0], np.r_[0.0:76.0:15.0], [0.0, 60.0, 120.0, 160.0, 180.0], indexing="ij")
    theta_i, theta_r, phi = (each.ravel() for each in grid)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    phase = np.round(np.degrees(np.arccos((geom.dot_xy + geom.cos_i * geom.cos_r)[:, 0])), 2)
    path = tmp_path / "phase.csv"
    path.write_text(table(("incidence", "emission", "phase", "BRDF"), theta_i, theta_r, phase, made(geom, 1)))
    check(path)


def test_two_surfaces_in_one_table_are_fitted_each_by_itself_seed_2(tmp_path, capsys):
    path = tmp_path / "paints.csv"
    light, dark = made(in_plane(*PLANE), 2), made(in_plane(*PLANE), 3, **{"ggx.alpha": 0.4, "lambertian.albedo": 0.03})
    lines = ["sample,theta_i,theta_r,brdf"]
    for name, values in (("white", light), ("black", dark)):
        lines += [f"{name},{i:g},{r:g},{f:.6g}" for i, r, f in zip(*PLANE, values, strict=True)]
    path.write_text("\n".join(lines) + "\n")
    assert status("fit", path) == 1
    assert "fit one with --select sample=white, each with --group sample" in capsys.readouterr().err
    check(path, select=("sample=white",))
    assert status("fit", path, "--group", "sample", "-m", "lambertian+ggx", "--json", "--no-timing") == 0
    parts = json.loads(capsys.readouterr().out)["rows"]
    assert [part["file"] for part in parts] == [f"{path} [sample=white]", f"{path} [sample=black]"]
    alphas = [part["fit"]["ranking"][0]["parameters"]["ggx.alpha"]["value"] for part in parts]
    np.testing.assert_allclose(np.ravel(alphas), [0.2, 0.4], rtol=0.05)


@pytest.mark.parametrize(
    ("title", "name", "factor", "options"),
    [
        ("BRF values, grey panel against a white standard\n", "633nm", np.pi, {}),
        ("", "Panel BRF", np.pi, {"columns": "brdf=Panel BRF"}),
        ("", "BRDF (dB)", None, {}),
        ("", "fresh BRDF (dB)", None, {"columns": "brdf=fresh BRDF (dB)"}),
    ],
)
def test_a_quantity_that_only_a_title_or_an_unknown_name_states_seed_4(tmp_path, title, name, factor, options):
    values = made(in_plane(*PLANE), 4)
    path = tmp_path / "panel.txt"
    shown = 10 * np.log10(values) if factor is None else factor * values
    path.write_text(title + table(("theta_i", "theta_r", name), *PLANE, shown))
    check(path, **options)


def test_the_radiance_factor_of_planetary_work_is_divided_by_pi_and_the_cosine(tmp_path):
    """f = w / (4 pi (mu0 + mu)), the law of Lommel and Seeliger, w = 0.4."""
    geom = in_plane(*PLANE)
    brdf = 0.4 / (4 * np.pi * (geom.cos_i + geom.cos_r)[:, 0])
    path = tmp_path / "soil.csv"
    path.write_text(table(("incidence", "emission", "RADF"), *PLANE, np.pi * brdf * geom.cos_i[:, 0]))
    for options in ({}, {"columns": "brdf=RADF"}, {"quantity": "radf"}):
        np.testing.assert_allclose(formats.read(path, **options).brdf[:, 0], brdf, rtol=1e-5)


def status(*words) -> int:
    """What the shell would see of a command."""
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code or 0
