"""SciPy on fits: it agrees with minima, goes on from anything else, and judges only the data that were fitted."""

import json
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.audit.certify import ENOUGH, certify
from brdfguide.cli import main
from brdfguide.errors import InputError
from brdfguide.fitting import saved
from brdfguide.fitting.fit import FitOptions, fit
from brdfguide.fitting.job import read_for_fit
from brdfguide.fitting.residuals import ln_residuals, rms
from brdfguide.fitting.weights import sample_weights
from brdfguide.report.documents.fit import fit_document

from .. import synthetic
from ..conftest import ROOT

SAMPLE = ROOT / "examples" / "rough_plastic.csv"
TRUTH = {"lambertian.albedo": np.array([0.1, 0.3, 0.5]), "ggx.alpha": 0.3, "ggx.n": 1.5}


@pytest.fixture(scope="module")
def coloured():
    """Three channels with noise, seed 3."""
    model = models.get("lambertian+ggx")
    return synthetic.surface(model, synthetic.hemisphere(400), TRUTH, noise=0.05, seed=3, channels=3)


def saved_fit(tmp_path, measurement, options=FitOptions(), model="lambertian+ggx"):
    from brdfguide.fitting import ranking

    ranked = ranking.rank([fit(models.get(model), measurement, options)], measurement, options)
    (tmp_path / "fit.json").write_text(json.dumps(fit_document(ranked, measurement)))
    return saved.read_minimum(tmp_path / "fit.json")


@pytest.mark.parametrize(
    "options",
    [
        FitOptions(),
        FitOptions(weights="none", metric="cube-root"),
        FitOptions(shape_per_channel=True),
        FitOptions(fixed={"n": 1.6}),
    ],
    ids=["plain", "cube-root", "shape-per-channel", "fixed"],
)
def test_what_a_fit_found_is_a_minimum_to_scipy_too(options, tmp_path, coloured):
    found = certify(saved_fit(tmp_path, coloured, options), coloured)
    assert found.agrees and found.lower < 1e-7 and max(found.moved.values()) < 0.02
    assert ("ggx.n" in found.moved) == (not options.fixed)
    assert found.finding().severity == "note"


def test_from_anywhere_else_scipy_goes_back_to_the_minimum(tmp_path, coloured):
    fit_ = saved_fit(tmp_path, coloured)
    off = fit_.surface.with_value("ggx.alpha", 1.05 * fit_.surface.values["ggx.alpha"])
    moved = replace(fit_, surface=off, rms_ln=rms(ln_residuals(off, coloured)))
    found = certify(moved, coloured)
    assert not found.agrees and found.lower > 100 * ENOUGH and found.moved["ggx.alpha"] > 3
    assert found.finding().severity == "warning" and "--robust" in found.finding().consequence


def test_other_data_and_other_weights_are_refused(tmp_path, coloured):
    fit_ = saved_fit(tmp_path, coloured)
    brighter = replace(coloured, brdf=1.01 * coloured.brdf)
    with pytest.raises(InputError, match="wanted the data that it was fitted to"):
        certify(fit_, brighter)
    with pytest.raises(InputError, match="weighed in another way"):
        certify(replace(fit_, weighing=frozenset({"weighed-by-stderr"})), coloured)
    with pytest.raises(InputError, match="has 1 channels, the surface's values 3"):
        certify(fit_, coloured.of_channels([0]))
    with pytest.raises(InputError, match="nothing to certify"):
        certify(replace(fit_, held=tuple(fit_.surface.model.parameters)), coloured)


def test_the_command_ends_with_1_where_scipy_goes_on(tmp_path, capsys):
    def status(*words):
        with pytest.raises(SystemExit) as end:
            main(list(map(str, words)))
        return end.value.code

    assert status("fit", SAMPLE, "-m", "lambertian+ggx", "--json", "--no-timing") == 0
    document = json.loads(capsys.readouterr().out)
    (tmp_path / "fit.json").write_text(json.dumps(document))
    line = "check", "--fit", tmp_path / "fit.json", "--certify", SAMPLE
    assert status(*line) == 0
    assert "it is a minimum to SciPy too" in capsys.readouterr().out
    value = document["ranking"][0]["parameters"]["ggx.alpha"]
    value["value"] *= 1.05
    (tmp_path / "fit.json").write_text(json.dumps(document))
    assert status(*line) == 2, "the error stated is no longer that of the values"
    assert "wanted the data that it was fitted to" in capsys.readouterr().err
    measurement = read_for_fit(SAMPLE)
    off = saved.read_fit(tmp_path / "fit.json")
    document["ranking"][0]["rms_ln"] = rms(ln_residuals(off, measurement), sample_weights(measurement))
    (tmp_path / "fit.json").write_text(json.dumps(document))
    assert status(*line) == 1
    shown = capsys.readouterr()
    assert "warning: SciPy's least_squares" in shown.out and "SciPy does not agree" in shown.err
