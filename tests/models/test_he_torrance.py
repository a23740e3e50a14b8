"""What is peculiar to He-Torrance: values to 17 digits, its limits, its mirror part."""

import csv
import json

import numpy as np
import pytest

from brdfguide.geometry import Geometry, in_plane
from brdfguide.models import he_torrance as he
from brdfguide.models._series import by_terms, hump
from brdfguide.models._series_cells import ln_series
from brdfguide.special import erfcx, lambert_w

from ..conftest import ROOT

SPEC = ROOT.parent / "shared" / "spec"


def spec_rows(name):
    if not (SPEC / name).is_file():
        pytest.skip(f"no table of reference values at {SPEC / name}")
    with open(SPEC / name, newline="") as file:
        return list(csv.DictReader(file))


def columns(rows, *names):
    return [np.array([float(row[name]) for row in rows]) for name in names]


def close(got, right, rtol=1e-10):
    """Relative where the reference is a number of ordinary size, absolute below."""
    large = np.abs(right) > 1e-280
    assert np.all(np.abs(got[~large]) < 1e-270)
    np.testing.assert_allclose(got[large], right[large], rtol=rtol)


def test_every_row_of_the_reference_table_within_1e_10():
    rows = spec_rows("hetorrance_cases.csv")
    angles = columns(rows, "theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", "lambda_um")
    geom = Geometry.from_degrees(*angles)
    sigma, tau, n, k, g, x = columns(rows, "sigma0_um", "tau_um", "n", "k", "g", "x")
    rho_dd, rho_s, series = columns(rows, "rho_dd", "rho_s", "series")
    values = dict(sigma=sigma, slope=sigma / tau, n=n, k=k, scale=1.0)
    close(he.MODEL(geom, **values), rho_dd)
    close(he.MODEL.mirror(geom, **values), rho_s)
    close(np.exp(ln_series(g, x / 4)), series)


def test_every_hard_case_of_the_stability_table():
    rows = [row for row in spec_rows("stability_cases.csv") if row["quantity"].startswith("ht_")]
    checked = 0
    for row in rows:
        p = json.loads(row["params_json"])
        geom = Geometry.from_degrees(*(float(row[a]) for a in ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg")), p.get("lambda_um", 0.55))
        slope = p["sigma0_um"] / p["tau_um"] if "tau_um" in p else None
        got = {
            "ht_series": lambda: np.exp(ln_series(p["g"], p["x"] / 4)),
            "ht_G": lambda: (geom.v2 / geom.v_z) ** 2,
            "ht_F": lambda: he.optics.fresnel(geom.cos_d, p["n"], p["k"]),
            "ht_S": lambda: product(geom, slope) * geom.cos_i * geom.cos_r,
            "ht_shadow_over_cos": lambda: he.shadowing(geom.cos_i, geom.sin_i, slope)[0],
            "ht_sigma_eff": lambda: p["sigma0_um"] * he.shadow_free(spread(geom, slope)),
            "ht_rho_dd": lambda: he.MODEL(geom, sigma=p["sigma0_um"], slope=slope, n=p["n"], k=p["k"]),
            "ht_rho_s": lambda: he.MODEL.mirror(geom, sigma=p["sigma0_um"], slope=slope, n=p["n"], k=p["k"], scale=1.0),
        }[row["quantity"]]()
        close(np.array([got]), np.array([float(row["right"])]))
        checked += 1
    assert checked == 54


def product(geom, slope):
    return he.shadowing(geom.cos_i, geom.sin_i, slope)[0] * he.shadowing(geom.cos_r, geom.sin_r, slope)[0]


def spread(geom, slope):
    return he.shadowing(geom.cos_i, geom.sin_i, slope)[1] + he.shadowing(geom.cos_r, geom.sin_r, slope)[1]
