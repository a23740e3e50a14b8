"""The pictures that are shipped give the law that they were rendered with, and are what their script makes."""

import runpy

import numpy as np
import pytest

from brdfguide import fit
from brdfguide.photographs.readers import read_picture

from ..conftest import ROOT

FOLDER = ROOT / "examples" / "photographs"


def test_the_shipped_pictures_give_their_truth():
    row = fit(FOLDER / "shots.yaml", models=["lambertian+ggx", "lambertian+beckmann"]).document["ranking"][0]
    assert row["model"] == "lambertian+ggx"
    found = row["parameters"]
    assert found["ggx.alpha"]["value"] == pytest.approx(0.18, rel=0.02)
    assert found["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.02)
    assert found["lambertian.albedo"]["value"] == pytest.approx([0.10, 0.22, 0.38], rel=0.015)


def test_the_script_makes_the_shipped_pictures():
    made = runpy.run_path(str(FOLDER / "make.py"))
    light = np.clip(made["EXPOSURE"] * made["picture"](40, made["ALBEDO"]), 0, 1)
    shipped = read_picture(FOLDER / "blue_040.jpg").light(slice(None))
    assert np.sqrt(np.mean((shipped - light) ** 2)) < 0.01
