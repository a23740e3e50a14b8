"""The audit holds for our models and fails bad ones: clamps, wrong derivatives, outdated declarations."""

import json
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.audit import audit, fitted
from brdfguide.cli import main
from brdfguide.models import ggx_aniso, ward
from brdfguide.models.surface import Surface

QUICK = (
    "references",
    "finite",
    "positive",
    "horizon",
    "reciprocity",
    "rotation",
    "normal",
    "grazing",
    "n to 1",
    "k to infinity",
    "gradient",
    "condition",
)


def verdicts(model, wanted=QUICK):
    return {each.check: each.verdict for each in audit.audit_term(model, wanted)}


def test_all_models_are_audited_and_the_interface_below_them():
    found = list(audit.audit(wanted=("references", "horizon")))
    assert {each.model for each in found} == {*models.names(), "fresnel"}
    assert [(each.model, each.check, each.worst) for each in found if each.verdict == "fails"] == []


def test_only_the_terms_that_are_named_are_audited():
    assert {each.model for each in audit.audit(["lambertian+ward"], ("normal",))} == {"lambertian", "ward"}


def test_clamped_cosine_fails_at_the_references():
    def clamped(geom, *, rho_s, alpha):
        lobe = np.exp(-geom.tan2_h / alpha**2) / (4 * np.pi * alpha**2)
        return rho_s * lobe / np.sqrt(np.maximum(geom.cos_i * geom.cos_r, 1e-6))

    assert verdicts(replace(ward.MODEL, brdf=clamped))["references"] == "fails"


def test_epsilon_beside_the_width_fails_references_and_derivatives():
    def clamped(geom, *, rho_s, alpha):
        return ward.brdf(geom, rho_s=rho_s, alpha=np.sqrt(alpha**2 + 1e-4))

    found = verdicts(replace(ward.MODEL, brdf=clamped))
    assert found["references"] == "fails" and found["gradient"] == "fails"


def test_wrong_jacobian_fails():
    def wrong(geom, names, **values):
        return {"alpha": 1.001 * ward.gradient(geom, names, **values)["alpha"]}

    found = verdicts(replace(ward.MODEL, gradient=wrong))
    assert found.pop("gradient") == "fails"
    assert set(found.values()) == {"holds"}


def test_an_axis_that_turns_the_wrong_way_fails():
    def mirrored(geom, *, axis, **values):
        return ggx_aniso.MODEL.brdf(geom, axis=np.pi - axis, **values)

    assert verdicts(ggx_aniso.MODEL, ("grain",)) == {"grain": "holds"}
    assert verdicts(replace(ggx_aniso.MODEL, brdf=mirrored), ("grain",)) == {"grain": "fails"}
    assert verdicts(ward.MODEL, ("grain",)) == {}


def test_switch_between_two_formulas_fails_continuity():
    def switched(geom, *, rho_s, alpha):
        return np.where(np.asarray(alpha) > 0.1, 1.0, 1.0001) * ward.brdf(geom, rho_s=rho_s, alpha=alpha)

    assert verdicts(replace(ward.MODEL, brdf=switched), ("continuity",)) == {"continuity": "fails"}
    assert verdicts(ward.MODEL, ("continuity",)) == {"continuity": "holds"}


def test_overflow_and_division_by_zero_fail():
    def naive(geom, *, rho_s, alpha):
        return ward.brdf(geom, rho_s=rho_s, alpha=alpha) / (1 - np.cos(geom.theta_r))

    assert verdicts(replace(ward.MODEL, brdf=naive), ("normal",)) == {"normal": "fails"}


def test_gain_of_energy_must_be_declared_and_a_declaration_must_be_true():
    (gain,) = audit.audit_term(replace(ward.MODEL, breaks={}), ("energy",))
    assert gain.verdict == "fails" and gain.at["theta_i_deg"] > 89
    (outdated,) = audit.audit_term(replace(ward.MODEL, breaks={"reciprocity": "no"}), ("reciprocity",))
    assert outdated.verdict == "fails" and "it holds" in outdated.reason


def saved(name, **values):
    surface = models.get(name)
    keyed = {**surface.defaults(), **{key.replace("__", "."): value for key, value in values.items()}}
    return Surface(surface, keyed)


def findings(*args, **values):
    return {found.code: found for found in fitted.audit_fitted(saved(*args, **values))[1]}


def test_fitted_surface_that_gains_energy_says_beyond_which_angle():
    text = findings("phong", phong__ks=3.3422538, phong__exponent=20.0)["gains-energy"].text
    assert text.startswith("gains energy beyond 75 deg") and "times what it receives at 89.99 deg" in text
    assert findings("phong", phong__ks=5.0, phong__exponent=20.0)["gains-energy"].text.startswith(
        "gains energy at every angle"
    )


def test_fitted_surface_says_what_a_renderer_meets():
    found = findings("lambertian+phong", phong__exponent=1e5, phong__ks=100.0)
    assert "exchanging light and eye" in found["not-reciprocal"].text
    assert found["narrow-lobe"].numbers[0][1] == pytest.approx(2 * np.degrees(np.sqrt(2 * np.log(2) / 1e5)), rel=0.1)
    kept = findings("lambertian+mirror", lambertian__albedo=0.5)
    assert "mirror-part" in kept and "gains-energy" in kept  # 0.5 and a mirror that nears 1 at grazing
    assert "energy-kept" in findings("lambertian+ggx", lambertian__albedo=0.2, ggx__alpha=0.3)


def test_ridge_is_named_where_two_parameters_do_the_same():
    assert "ridge" in findings("phong+phong", **{"phong.1.exponent": 20.0, "phong.2.exponent": 20.0})
    assert "ridge" not in findings("lambertian+ward")


def run(argv, capsys):
    with pytest.raises(SystemExit) as stop:
        main(argv)
    captured = capsys.readouterr()
    return stop.value.code, captured.out, captured.err


def test_command_prints_a_table_or_one_object(capsys):
    status, out, err = run(["check", "lambertian"], capsys)
    assert (
        status == 0
        and err == ""
        and out.splitlines()[0].split() == ["model", "law", "cases", "worst", "error", "allowed", "verdict"]
    )
    assert out.splitlines()[-1].endswith("0 broken as declared, 0 fail")
    status, out, err = run(["check", "lambertian", "--json"], capsys)
    document = json.loads(out)
    assert document["schema"] == "brdfguide/check/1" and document["models"][0]["model"] == "lambertian"
    assert {"law", "cases", "worst_error", "at", "verdict"} <= document["models"][0]["checks"][0].keys()


def test_command_ends_with_1_where_a_law_fails_undeclared(capsys, monkeypatch):
    monkeypatch.setattr(
        audit, "audit", lambda expressions: audit.audit_term(replace(ward.MODEL, breaks={}), ("energy", "finite"))
    )
    status, out, err = run(["check"], capsys)
    assert status == 1 and err == "brdfguide: 1 undeclared failures: ward energy\n"
    assert "fails     ward energy" not in out and "fails  ward energy" in out


def test_command_ends_with_2_for_an_unknown_model_and_for_two_subjects(capsys, tmp_path):
    status, out, err = run(["check", "wrad"], capsys)
    assert (status, out) == (2, "") and "did you mean ward" in err
    status, out, err = run(["check", "ward", "--fit", str(tmp_path / "fit.json")], capsys)
    assert (status, out) == (2, "") and "either models or --fit" in err


def test_command_audits_a_saved_fit_at_its_own_parameters(capsys, tmp_path):
    values = {"lambertian.albedo": 0.2, "phong.ks": [0.5, 4.0], "phong.exponent": 20.0}
    row = {
        "candidate": "lambertian+phong",
        "model": "lambertian+phong",
        "parameters": {key: {"value": value} for key, value in values.items()},
    }
    data = {"channels": ["blue", "red"], "wavelength_nm": [450.0, 650.0]}
    path = tmp_path / "fit.json"
    path.write_text(
        json.dumps({"schema": "brdfguide/fit/1", "recommended": "lambertian+phong", "ranking": [row], "data": data})
    )
    status, out, err = run(["check", "--fit", str(path), "--json"], capsys)
    document = json.loads(out)
    verdict = {each["law"]: each["verdict"] for each in document["models"][0]["checks"]}
    assert status == 0 and verdict["finite"] == "holds" and verdict["energy"] == verdict["reciprocity"] == "declared"
    assert {"gains-energy", "not-reciprocal"} <= {found["code"] for found in document["findings"]}
