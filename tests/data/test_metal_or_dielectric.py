"""Metal, dielectric or cannot tell: never a confident wrong answer."""

import csv

import numpy as np
import pytest

from brdfguide import models
from brdfguide.advice.material import from_values
from brdfguide.advice.recommend import recommend
from brdfguide.data import formats
from brdfguide.data.measurement import Measurement
from brdfguide.data.metal_or_dielectric import CANNOT_TELL, verdict
from brdfguide.physics.geometry import in_plane, rows

THETA = np.repeat([10.0, 30.0, 50.0, 65.0, 75.0], 165)
SEEN = np.tile(np.arange(-82.0, 83.0), 5)
# file -> what it is; anodised and blackened metals are coats on metals, so that either word alone would be wrong
TRUTH = {
    "mwir/aluminium_anodised.csv": {"metal"},
    "mwir/copper.csv": {"metal"},
    "mwir/stainless_brushed.csv": {"metal"},
    "mwir/steel_sandblasted.csv": {"metal"},
    "mwir/lacquer_smooth.csv": {"dielectric"},
    "cornell/garnet_red.brdf": {"dielectric"},
    "cornell/cayman.brdf": {"dielectric"},
    "nist/PTFE.data.csv": {"dielectric"},
    "starlink/aluminum_brdf.csv": {"metal"},
    "starlink/chassis_brdf.csv": {"metal"},
    "rgl/paper_white_rgb.bsdf": {"dielectric"},
    "rgl/cg_sunflower_rgb.bsdf": {"dielectric"},
    "rgl/vch_golden_yellow_rgb.bsdf": {"dielectric"},
    "rgl/cc_ibiza_sunset_rgb.bsdf": {"dielectric"},
    "zemax/test_13_planesymmetric_brdf_zemax.bsdf": {"dielectric"},
    "ua_loft/AnoBlackEC1onAlum.bsdf": set(),
    "ua_loft/AnoBlackNiTEonSteel.bsdf": set(),
    "alta/retro-3M-jaune.dat": {"dielectric"},
}
DECIDED = {
    "mwir/stainless_brushed.csv",
    "cornell/garnet_red.brdf",
    "cornell/cayman.brdf",
    "nist/PTFE.data.csv",
    "starlink/chassis_brdf.csv",
    "rgl/paper_white_rgb.bsdf",
    "rgl/cg_sunflower_rgb.bsdf",
    "rgl/cc_ibiza_sunset_rgb.bsdf",
    "zemax/test_13_planesymmetric_brdf_zemax.bsdf",
}


def made(name: str, colours=3, **values) -> Measurement:
    """A scan in the plane of incidence of a model."""
    model = models.get(name)
    geom = rows(in_plane(THETA, SEEN, np.array([0.65, 0.55, 0.45][:colours])))
    filled = {
        key.replace("__", ".").replace("_t", "-t"): np.array(value)[:colours] if np.ndim(value) else value
        for key, value in values.items()
    }
    return Measurement(geom, np.broadcast_to(model(geom, filled), (len(THETA), colours)).copy(), tuple("rgb"[:colours]))


@pytest.mark.parametrize("path", TRUTH)
def test_no_wrong_answer_on_real_measurements(data, path):
    found = verdict(formats.read(data / path))
    assert found.kind in TRUTH[path] | {CANNOT_TELL}
    assert (found.kind != CANNOT_TELL) == (path in DECIDED)
    assert found.evidence


def test_a_polished_metal_is_told_by_its_level():
    found = verdict(made("ggx", 1, ggx__alpha=0.05, ggx__n=0.96, ggx__k=6.69))
    assert found.kind == "metal" and "of the light near the normal" in found.evidence[0]


def test_a_coloured_plastic_is_told_by_its_white_highlight():
    found = verdict(made("lambertian+ggx", lambertian__albedo=[0.6, 0.1, 0.05], ggx__alpha=0.1, ggx__n=1.5))
    assert found.kind == "dielectric" and "coloured" in found.evidence[0]


def test_a_coloured_metal_is_no_plastic():
    gold = {"ggx__n": [0.156, 0.424, 1.383], "ggx__k": [3.6, 2.47, 1.92]}
    assert verdict(made("ggx", ggx__alpha=0.3, **gold)).kind != "dielectric"
    assert verdict(made("ggx", ggx__alpha=0.05, **gold)).kind == "metal"


def test_white_paper_is_told_by_its_body():
    assert verdict(made("lambertian+ggx", lambertian__albedo=0.75, ggx__alpha=0.4, ggx__n=1.5)).kind == "dielectric"


@pytest.mark.parametrize("alpha", [0.05, 0.2, 0.4, 0.6])
@pytest.mark.parametrize("lobe", ["ggx", "beckmann"])
def test_no_rough_metal_is_called_a_dielectric(lobe, alpha):
    for n, k in ((0.96, 6.69), (2.95, 2.93), (2.54, 3.43)):
        assert (
            verdict(made(lobe, 1, **{f"{lobe}__alpha": alpha, f"{lobe}__n": n, f"{lobe}__k": k})).kind != "dielectric"
        )


@pytest.mark.parametrize("alpha", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("albedo", [0.02, 0.2, 0.8])
def test_no_plastic_is_called_a_metal(albedo, alpha):
    assert verdict(made("lambertian+ggx", 1, lambertian__albedo=albedo, ggx__alpha=alpha, ggx__n=1.5)).kind != "metal"


def test_too_little_data_is_no_verdict():
    whole = made("ggx", 1, ggx__alpha=0.05, ggx__k=6.0)
    grazing = whole[np.asarray(THETA) > 60]
    assert verdict(grazing).kind == CANNOT_TELL and "within 35°" in verdict(grazing).evidence[0]


# --- from words and indices: the database of everyday materials ---------------------------------------


def database(data) -> list[dict]:
    lines = [
        line
        for line in (data / "physically_based" / "materials.csv").read_text().splitlines()
        if not line.startswith("#")
    ]
    return list(csv.DictReader(lines))


def described(row: dict, *keys: str) -> dict:
    """What a person would write of a row, from some of its columns."""
    given = {}
    if "name" in keys:
        given["composition"] = row["name"]
    colour = [float(word) for word in row["color_linear_srgb"].split()]
    if "colour" in keys and row["metalness"] == "1":
        given["f0"] = [min(each, 0.99) for each in colour]
    if "index" in keys and row["n_rgb"]:
        given["index"] = {
            "n": [max(float(word), 1e-3) for word in row["n_rgb"].split()],
            "k": [float(word) for word in row["k_rgb"].split()],
        }
    elif "index" in keys and row["ior"]:
        given["index"] = {"n": [float(row["ior"])]}
    return given or {"finish": "satin"}


@pytest.mark.parametrize(
    "keys, most_unknown", [(("name",), 0.1), (("index",), 0.1), (("colour",), 1.0), (("name", "index", "colour"), 0.05)]
)
def test_no_wrong_answer_over_the_database(data, keys, most_unknown):
    table = database(data)
    unknown = 0
    for row in table:
        found = recommend(from_values(described(row, *keys)), anyway=True)
        truth = "metal" if row["metalness"] == "1" else "dielectric"
        assert found.verdict in (truth, CANNOT_TELL), row["name"]
        unknown += found.verdict == CANNOT_TELL
    assert unknown <= most_unknown * len(table)
