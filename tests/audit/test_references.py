"""Points where straightforward double precision fails: ours to twelve digits, at the printed points and at others."""

import csv
import json

import numpy as np
import pytest

from brdfguide.audit.references import QUANTITIES, REFERENCES, RTOL, TABLE, Reference, our_value
from brdfguide.models import term
from brdfguide.physics.geometry import Geometry

from ..conftest import ROOT
from ..models import stiff

SPEC = ROOT.parent / "shared" / "spec" / "stability_cases.csv"
LAWS = {
    "phong": "phong",
    "ward": "ward",
    "ward_duer": "ward-duer",
    "ward_bounded": "ward-gmd",
    "cook_torrance": "cook-torrance",
}
# quantity of that table -> ours, and our names of its parameters
SAME = {
    "fresnel": ("fresnel", {}), "one_minus_fresnel": ("one_minus_fresnel", {}),
    "index_from_f0": ("index_from_f0", {"F0": "f0"}), "index_minus_one": ("index_minus_one", {"F0": "f0"}),
    "eq1_ln": ("davies_ln", {"sigma_um": "sigma", "lambda_um": "wavelength"}),
    "eq1_scattered": ("davies_scattered", {"sigma_um": "sigma", "lambda_um": "wavelength"}),
    "lafortune": ("lafortune_lobe", {"Cxy": "c_xy", "Cz": "c_z", "n": "exponent"}),
    "lafortune_ln": ("lafortune_lobe_ln", {"Cxy": "c_xy", "Cz": "c_z", "n": "exponent"}),
    "d_ggx": ("ggx_distribution", {}), "d_beckmann": ("beckmann_distribution", {}),
}  # fmt: skip


def matches(got, right, rtol=RTOL):
    return got == pytest.approx(right, rel=rtol, abs=0)


@pytest.mark.parametrize("reference", REFERENCES, ids=lambda r: f"{r.quantity}-{r.why}".replace(" ", "-"))
def test_reference_is_met(reference):
    assert matches(our_value(reference), reference.right)


def test_printed_table_is_what_the_generator_prints():
    assert stiff.table() == TABLE.read_text()


@pytest.mark.parametrize("seed", [101, 102, 103])
def test_other_points_of_the_same_regimes_are_met_with_seed(seed):
    for model, quantity, angles, values, why in stiff.draw(seed, 1):
        right = float(stiff.right(quantity, angles, values))
        got = our_value(Reference(model, quantity, angles, values, right, why))
        assert matches(got, right), (quantity, why, angles, values)


@pytest.mark.skipif(not SPEC.is_file(), reason=f"no table of hard cases at {SPEC}")
def test_every_row_of_the_stability_table_below_the_wave_laws():
    rows = [row for row in csv.DictReader(SPEC.read_text().splitlines()) if not row["quantity"].startswith("ht_")]
    for row in rows:
        geom = Geometry.from_degrees(
            *(float(row[name]) for name in ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg"))
        )
        p, quantity = json.loads(row["params_json"]), row["quantity"]
        if quantity in LAWS:
            got = term(LAWS[quantity])(
                geom, **{"exponent" if quantity == "phong" and key == "n" else key: v for key, v in p.items()}
            )
        elif quantity == "oren_nayar":  # the paper's qualitative form
            got = QUANTITIES["oren_nayar_qualitative"](geom, {"albedo": p["rho"], "spread": np.radians(p["sigma_deg"])})
        else:
            ours, names = SAME[quantity]
            got = QUANTITIES[ours](geom, {names.get(key, key): v for key, v in p.items()})
        assert matches(float(got), float(row["right"]), min(float(row["rtol"]), 1e-12)), row["id"]
    assert len(rows) == 90
