"""What the judge says of kinds of data that practitioners have: a black dielectric, a white standard."""

import numpy as np
import pytest

from brdfguide import fit, models
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows

from .. import synthetic

SCAN_I, SCAN_R = (
    each.ravel() for each in np.meshgrid(np.arange(5.0, 76.0, 14.0), np.arange(-75.0, 76.0, 5.0), indexing="ij")
)
GEOM = rows(in_plane(SCAN_I, SCAN_R))


def test_a_black_dielectric_whose_kind_cannot_be_told_is_not_answered_by_a_metal_seed_6():
    """Beckmann 0.32, n 1.42, albedo 0.023, and an error of each scan that is smooth and reaches 25 %."""
    random = np.random.default_rng(6)
    values = {"lambertian.albedo": 0.023, "beckmann.alpha": 0.32, "beckmann.n": 1.42}
    true = Surface(models.get("lambertian+beckmann"), values, ("550 nm",)).brdf(GEOM)[:, 0]
    scan = np.round((SCAN_I - 5) / 14).astype(int)
    phase, rate = random.uniform(0, 6.3, 6)[scan], random.uniform(1, 2, 6)[scan]
    smooth = 0.25 * np.sin(phase + rate * np.radians(SCAN_R))
    noise = 0.01 * random.standard_normal(len(SCAN_I))
    answer = fit(Measurement(GEOM, (true * np.exp(smooth + noise))[:, None], ("550 nm",)), anyway=True)
    assert answer.judged.known is None
    assert "metal" not in answer.recommended.name


def test_a_white_standard_is_a_body_alone_seed_16():
    noise = 0.01 * np.random.default_rng(16).standard_normal((len(SCAN_I), 1))
    answer = fit(Measurement(GEOM, 0.95 / np.pi * np.exp(noise), ("550 nm",)))
    assert answer.recommended.name == "lambertian" and answer.recommended.rms_ln < 0.012
    assert answer.document["ranking"][0]["candidate"] == "lambertian", "the recommended row is the first"


def test_a_made_metal_of_which_the_kind_is_not_told_is_answered_as_the_metal_it_is_seed_0():
    """A body of 0 under a lobe of 1.26 times a dielectric's F0 errs as little, and returns 0.55 at the normal."""
    truth = {"ggx.alpha": 0.2, "ggx.n": 3.2, "ggx.k": 3.3}
    data = synthetic.surface(models.get("ggx"), synthetic.scan(), truth, noise=0.02)
    answer = fit(data, timing=False)
    assert answer.judged.known is None
    assert answer.recommended.name == "ggx (metal, edge free)"
    assert "lambertian+ggx (height free)" in answer.document["because"]


@pytest.mark.parametrize(("n", "k"), [(0.42, 2.35), (1.02, 6.63), (3.17, 3.31)], ids=["gold", "aluminium", "chromium"])
@pytest.mark.parametrize("theta_i", [30, 45, 60])
def test_a_metal_at_one_incidence_is_answered_as_one_seed_0(n, k, theta_i):
    """A dielectric of n 7 to 45 errs as little, and one scan does not grow; no dielectric returns as much there."""
    truth = {"ggx.alpha": 0.2, "ggx.n": n, "ggx.k": k}
    data = synthetic.surface(models.get("ggx"), synthetic.scan((theta_i,)), truth, noise=0.02)
    answer = fit(data, timing=False)
    assert answer.recommended.name.startswith("ggx (metal") and answer.recommended.rms_ln < 0.035
    assert not [each for each in answer.document["warnings"] if each["code"] == "f0-above-dielectrics"]


@pytest.mark.parametrize("scan", [(20, 45, 70), (75,)], ids=["three", "steep"])
def test_a_metal_of_another_law_than_what_grows_has_its_edge_as_well_seed_0(scan):
    """GGX's metal grows and is ten times as far off; Cook and Torrance's with n = 1 tied with a dielectric of n 7.5."""
    truth = {"cook-torrance.alpha": 0.3, "cook-torrance.n": 2.5, "cook-torrance.k": 3.4}
    data = synthetic.surface(models.get("cook-torrance"), synthetic.scan(scan), truth, noise=0.005)
    answer = fit(data, timing=False)
    assert answer.recommended.name == "cook-torrance (metal, edge free)" and answer.recommended.rms_ln < 0.006
    for name, error in (("n", 0.3), ("k", 0.1)):
        assert abs(answer.recommended.values[f"cook-torrance.{name}"][0] - truth[f"cook-torrance.{name}"]) < error


def test_a_dielectric_that_needs_a_lobe_as_bright_as_none_has_is_said():
    truth = {"ggx.alpha": 0.2, "ggx.n": 3.2, "ggx.k": 3.3}
    data = synthetic.surface(models.get("ggx"), synthetic.scan(), truth, noise=0.02)
    answer = fit(data, ["lambertian+ggx (height free)"], timing=False)
    said = [each["text"] for each in answer.document["warnings"] if each["code"] == "f0-above-dielectrics"]
    assert said == ["its lobe returns 0.55 at the normal, more than any dielectric's surface (0.25 at most)"]
