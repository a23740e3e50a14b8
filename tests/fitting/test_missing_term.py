"""The term that a law lacks, by name, and none where it lacks none."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.face.functions import fit
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.missing_term import WORDS, missing_term
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.report.documents.off_plane import missing_block
from brdfguide.report.text.off_plane import off_plane_text

from .. import synthetic

GGX = models.get("lambertian+ggx")
BASE = {"lambertian.albedo": 0.2, "ggx.alpha": 0.2, "ggx.n": 1.5}
GEOM = synthetic.hemisphere(400, 7, 75.0)


def values(expression: str, geom=GEOM, **given) -> np.ndarray:
    sum_of = models.get(expression)
    return synthetic.surface(sum_of, geom, {**sum_of.defaults(), **sum_of.qualified(given)}).brdf


def named(brdf: np.ndarray, geom=GEOM, seed: int = 1):
    data = synthetic.surface(GGX, geom, {**GGX.defaults(), **BASE}, noise=0.02, seed=seed)
    noise = data.brdf / synthetic.surface(GGX, geom, {**GGX.defaults(), **BASE}).brdf
    data.brdf[:] = brdf * noise
    return missing_term(fitting.fit(GGX, data), data)


PLAIN = values("lambertian+ggx", albedo=0.2, alpha=0.2, n=1.5)
WITH = {
    "retro": PLAIN + 0.03 * values("retro", alpha=0.15),
    "second lobe": PLAIN + 0.2 * values("ggx", alpha=0.05),
    "haze": PLAIN + 1.5 * values("ggx", alpha=0.6),
    "sheen": PLAIN + 0.3 * values("sheen", spread=0.4),
    "flakes": PLAIN + 0.1 * values("coated:flakes", tilt=0.1),
    "coat": values("ggx+coated:lambertian", **{"lambertian.albedo": 0.4, "ggx.alpha": 0.2}),
}


GROWN = {
    "retro": "lambertian+ggx+retro",
    "second lobe": "lambertian+ggx:2",
    "haze": "lambertian+ggx:2",
    "sheen": "lambertian+ggx+sheen",
    "flakes": "ggx+coated:lambertian+flakes",
    "coat": "ggx+coated:lambertian",
}


@pytest.mark.parametrize("kind", WITH)
def test_each_kind_is_named_with_its_share_and_confidence(kind):
    found = named(WITH[kind])
    assert found is not None and found.kind == kind
    assert 0.3 < found.share <= 1 and found.confidence > 0.9
    assert found.candidate == GROWN[kind] and models.get(found.candidate)


def test_a_second_axis_shows_where_the_sample_was_turned():
    turn = np.random.default_rng(3).choice([0.0, 45.0, 90.0], GEOM.shape)
    geom = rows(Geometry.from_degrees(GEOM.theta_i_deg, turn, GEOM.theta_r_deg, GEOM.phi_deg + turn))
    grain = values("lambertian+ggx-aniso", geom, albedo=0.2, alpha_x=0.3, alpha_y=0.13, axis=0.0, n=1.5)
    found = named(grain, geom)
    assert found is not None and found.kind == "second axis" and found.candidate == "lambertian+ggx-aniso"
    assert named(values("lambertian+ggx", geom, albedo=0.2, alpha=0.2, n=1.5), geom) is None


@pytest.mark.parametrize("seed", range(5))
def test_none_is_invented_on_a_plain_surface_with_seeds_0_to_4(seed):
    assert named(PLAIN, seed=seed) is None


def test_a_term_that_the_law_has_is_not_missing():
    data = synthetic.surface(GGX, GEOM, {**GGX.defaults(), **BASE}, noise=0.02, seed=1)
    data.brdf[:] *= WITH["retro"] / PLAIN
    whole = fitting.fit(models.get("lambertian+ggx+retro"), data)
    assert missing_term(whole, data) is None


def test_too_few_values_name_nothing():
    few = synthetic.surface(GGX, GEOM, {**GGX.defaults(), **BASE}, noise=0.02)[:20]
    assert missing_term(fitting.fit(GGX, few), few) is None


def test_it_stands_in_document_and_text():
    data = synthetic.surface(GGX, GEOM, {**GGX.defaults(), **BASE}, noise=0.02, seed=1)
    data.brdf[:] *= WITH["retro"] / PLAIN
    document = fit(data, ["lambertian+ggx"], timing=False, anyway=True).document
    block = document["missing"]
    assert block["term"] == "retro" and block["words"] == WORDS["retro"]
    text = " ".join(off_plane_text(document).split())
    share = f"{100 * block['share']:.0f} % of what is left"
    assert f"what it lacks looks like a lobe about the light: {share}" in text
    assert text.endswith("`-m lambertian+ggx+retro` tries it")
    assert missing_block(None) is None and off_plane_text({"missing": None, "off_plane": None}) == ""
