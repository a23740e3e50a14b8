"""The synthetic stand-ins: the generators keep their laws, the files in examples/ are what the generators make."""

import os
import subprocess
import sys
from math import lgamma

import numpy as np
import pytest

from .conftest import ROOT

sys.path.insert(0, str(ROOT / "examples" / "samples"))
import heightfield
import instrument
import kirchhoff
import white_paper

SAMPLES = ROOT / "examples" / "samples"
TRUTHS = sorted((SAMPLES / "truth").glob("*.csv"))
MADE = {
    "rough_aluminium.csv": ("rough_aluminium_a", "10,45,75"),
    "rough_plastic.csv": ("rough_plastic_a", "10,45,75"),
    "rough_plastic_held_out.csv": ("rough_plastic_a", "30,60,80"),
    "white_paper.csv": ("white_paper_c", "10,45,75"),
    "smooth_steel.csv": ("smooth_steel_a", ""),
    "metallic_paint.csv": ("metallic_paint_a", "10,45,75"),
}


@pytest.mark.parametrize("name", MADE)
def test_a_sample_is_what_the_instrument_makes_of_its_truth_with_seed_1(name):
    truth, angles = MADE[name]
    words = [sys.executable, "examples/samples/instrument.py", f"examples/samples/truth/{truth}.csv", "--seed", "1"] + (
        ["--theta-i", angles] if angles else []
    )
    made = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert made == (ROOT / "examples" / name).read_text()


@pytest.mark.parametrize("path", TRUTHS, ids=lambda path: path.stem)
def test_a_truth_says_that_it_is_synthetic_and_is_reciprocal(path):
    header, i, r, f = instrument.read_truth(path)
    assert any("origin: synthetic, level L" in line for line in header)
    assert np.all(np.isfinite(f)) and np.all(f > 0)
    # closer than 6 degrees to the mirror direction the receiver's cone blurs a peak on its own side alone
    both = [(a, b) for a in i for b in i if a + 6 < b]
    ratio = [f[list(i).index(a), list(r).index(b)] / f[list(i).index(b), list(r).index(a)] for a, b in both]
    np.testing.assert_allclose(ratio, 1, atol=0.02)


def test_light_on_a_height_field_is_reflected_or_enters():
    rng = np.random.default_rng(3)
    surface = heightfield.Map(heightfield.soft_tailed, 0.228, rng)
    reflected, entered, *_ = heightfield.trace(surface, 45.0, 1.5, 0.0, 4000, rng)
    assert reflected + entered == pytest.approx(1, abs=2e-3)
    assert reflected == pytest.approx(0.054, abs=0.002)


def test_slopes_of_a_height_field_are_those_asked_for():
    surface = heightfield.Map(heightfield.gaussian, 0.3, np.random.default_rng(4))
    assert np.sqrt(0.5 * (surface.sx.var() + surface.sy.var())) == pytest.approx(0.3)
    across = (np.roll(surface.z, -1, axis=1) - np.roll(surface.z, 1, axis=1)) / (2 * heightfield.CELL)
    np.testing.assert_allclose(across, surface.sx, atol=0.02)


def test_first_reflection_of_a_gaussian_surface_is_the_facet_law_near_the_mirror_direction():
    rng = np.random.default_rng(5)
    maps = [heightfield.Map(heightfield.gaussian, 0.2, rng) for _ in range(2)]
    found = heightfield.first_reflection(maps, [30.0], np.array([30.0]), 1.5)[0, 0]
    density = 1 / (2 * np.pi * 0.2**2)
    expected = heightfield.fresnel(np.cos(np.radians(30)), 1.5) * density / (4 * np.cos(np.radians(30)) ** 2)
    assert found == pytest.approx(expected, rel=0.08)


@pytest.mark.parametrize("g, v", [(83.0, 3.0), (20.0, 5.0), (3.0, 1.0), (0.1, 0.5)])
def test_diffraction_integral_is_the_known_series_for_a_gaussian_correlation(g, v):
    tau, step = 3.2, 0.1 / (4 * np.pi / 0.55)
    r = np.arange(0.5, 8 * tau / step) * step
    m = np.arange(1, 2000)
    terms = (
        np.exp(-g + m * np.log(g) - np.array([lgamma(k + 1) for k in m]))
        * np.pi
        * tau**2
        / m
        * np.exp(-((v * tau) ** 2) / (4 * m))
    )
    assert kirchhoff._integral(r, step, lambda x: np.exp(-((x / tau) ** 2)), g, v) == pytest.approx(
        terms.sum(), rel=1e-4
    )


def test_h_function_obeys_its_integral():
    """Chandrasekhar 1960: the mean of H is (2/w)(1 - sqrt(1 - w))."""
    x, weight = np.polynomial.legendre.leggauss(64)
    mean = np.sum(0.5 * weight * white_paper.chandrasekhar(0.5 * (x + 1)))
    assert mean == pytest.approx(2 / white_paper.W * (1 - np.sqrt(1 - white_paper.W)), rel=1e-9)


def test_no_sample_is_importable_from_the_package():
    code = (
        "import sys, brdfguide, pkgutil; names = [m.name for m in pkgutil.walk_packages(brdfguide.__path__)]; "
        "sys.exit('heightfield' in names or 'kirchhoff' in names)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0


def test_the_study_runs_and_says_which_findings_re_emerge():
    done = subprocess.run(
        [sys.executable, "examples/study.py", "1"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 0, done.stderr
    kept = (ROOT / "docs" / "study.md").read_text()
    for key in ("S1.3", "S1.5b", "S2.6a", "S2.6b", "S3.3a", "S5.1", "S5.2b", "S0"):
        line = next(line for line in kept.splitlines() if line.startswith(f"| {key} "))
        assert line in done.stdout
