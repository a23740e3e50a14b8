"""The table of reference values of bases, 17 digits each, and what every basis has to obey."""

import csv
import os
from pathlib import Path

import numpy as np
import pytest

from brdfguide.bases import harmonics, pairs, smooth, zernike
from brdfguide.numerics import bsplines
from brdfguide.physics.geometry import Geometry

from .. import synthetic
from ..conftest import ROOT

SPEC = Path(os.environ.get("BRDFGUIDE_SPEC", ROOT.parent / "shared" / "spec")) / "bases_reference.csv"
FUNCTIONS = {"zernike": zernike.zernike, "sh": harmonics.legendre, "legendre": harmonics.legendre}
# values that were computed elsewhere with 60 digits; the whole table is read where it lies
FEW = """kind,n,k,m,theta_i_deg,theta_r_deg,phi_deg,value
bspline3_of_8,1,,,0.1,,,0.59375
bspline3_of_8,2,,,0.35,,,0.31380208333333333
zernike_theta,8,,8,0,,,0.0
legendre_theta,1,,1,60,,,0.29920671030107451
legendre_theta,12,,4,89.9,,,0.32677649153944002
legendre_theta,100,,0,80,,,0.083085099556471218
project_sh_cos5,4,,0,,,,0.16616754852239213
project_zernike_cos5,8,,0,,,,0.042201282164417048
"""
RTOL = 5e-13


def value_of(row) -> float:
    kind, n, m = row["kind"], int(row["n"] or 0), int(row["m"] or 0)
    angle = float(row["theta_i_deg"] or 0)
    if kind.startswith("bspline3"):
        return bsplines.cubic(angle, int(kind.rpartition("_")[2]))[0, n]
    if kind.startswith("u_theta_h"):  # exchange of light and detector about a half vector at this angle
        return (
            float(smooth.tilt_coordinate(Geometry.from_degrees(0.0, 0.0, 2 * angle, 180.0)))
            if angle < 45
            else u_of(angle)
        )
    functions = FUNCTIONS[kind.split("_")[1 if kind.startswith("project") else 0]]
    if kind.startswith("project"):
        return projected(functions, n, 5 if kind.endswith("cos5") else 1)
    of_i = functions(*at(angle), n)
    if kind.endswith("theta"):
        return float(of_i[n, m])
    k, of_r = int(row["k"]), functions(*at(float(row["theta_r_deg"])), n)
    both = of_i[n, m] * of_r[k, m] + of_i[k, m] * of_r[n, m]
    return float(both * np.cos(m * np.radians(float(row["phi_deg"]))))


def at(degrees: float):
    """Cosine and sine, each without a difference of near numbers."""
    return np.sin(np.radians(90 - degrees)), np.sin(np.radians(degrees))


def u_of(angle: float) -> float:
    steepest = np.tan(smooth.STEEPEST)
    return float(np.arcsinh(min(np.tan(np.radians(angle)), steepest) / 0.02) / np.arcsinh(steepest / 0.02))


def projected(functions, n: int, power: int) -> float:
    """2π ∫ cos^p Z sin θ dθ over the hemisphere, by Gauss's rule in cos θ."""
    x, weight = np.polynomial.legendre.leggauss(80)
    cos, weight = 0.5 * (x + 1), 0.5 * weight
    return float(2 * np.pi * np.sum(weight * cos**power * functions(cos, np.sqrt(1 - cos**2), n)[n, 0]))


def check(rows):
    for row in rows:
        wanted = float(row["value"])
        assert value_of(row) == pytest.approx(wanted, rel=0, abs=RTOL * max(1.0, abs(wanted))), row


def test_values_computed_elsewhere():
    check(csv.DictReader(FEW.splitlines()))


@pytest.mark.skipif(not SPEC.exists(), reason=f"{SPEC}: the whole table of reference values")
def test_every_row_of_the_table():
    rows = list(csv.DictReader(SPEC.read_text().splitlines()))
    assert len(rows) > 100
    check(rows)


@pytest.mark.parametrize("name, norm", [("zernike", 2.0), ("sh", 0.5)])
def test_functions_of_one_azimuth_are_orthogonal(name, norm):
    """To 1e-12 up to order 16. Of harmonics that are even about the horizon half the sphere's norm is left."""
    x, weight = np.polynomial.legendre.leggauss(64)
    cos = 0.5 * (x + 1)
    found = pairs.BASES[name](cos, np.sqrt(1 - cos**2), 16)
    for m in range(0, 17, 4):
        of_m = np.stack([value for (_, of), value in found.items() if of == m])
        inner = (of_m * 0.5 * weight) @ of_m.T * 2 * np.pi
        np.testing.assert_allclose(inner, norm * np.eye(len(of_m)), atol=2e-12)


@pytest.mark.parametrize("name", pairs.BASES)
def test_pairs_are_counted_reciprocal_and_isotropic(name):
    geom = synthetic.hemisphere(60)
    columns = pairs.pairs(geom, pairs.BASES[name], 8)
    assert columns.shape[1] == pairs.count(8) == 55 and [pairs.count(n) for n in (0, 2, 4, 12)] == [1, 5, 14, 140]
    np.testing.assert_array_equal(columns, pairs.pairs(geom.swapped(), pairs.BASES[name], 8))
    turned = Geometry.from_degrees(geom.theta_i_deg, 70.0, geom.theta_r_deg, geom.phi_deg + 70.0)
    np.testing.assert_allclose(columns, pairs.pairs(turned, pairs.BASES[name], 8), atol=1e-12)


@pytest.mark.parametrize("name", pairs.BASES)
def test_a_truth_inside_the_space_comes_back_in_its_values(name):
    geom, random = synthetic.hemisphere(6000), np.random.default_rng(3)
    a = random.standard_normal((pairs.count(8), 1)) * 0.02
    a[0] = 8.0  # so that it is positive
    truth = pairs.Linear(name, 8, a)(geom)
    assert truth.min() > 0
    found = pairs.fit_pairs(name, 8, geom, truth)
    assert np.sqrt(np.mean((found(geom) / truth - 1) ** 2)) < 1e-4
