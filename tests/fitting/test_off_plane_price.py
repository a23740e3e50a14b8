"""What data in the plane of incidence cost outside it."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.face.functions import fit
from brdfguide.fitting import off_plane_price as pricing
from brdfguide.fitting.reading import reading
from brdfguide.report import page
from brdfguide.report.documents.off_plane import price_block
from brdfguide.report.text.off_plane import off_plane_text

from .. import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {**GGX.defaults(), "lambertian.albedo": 0.2, "ggx.alpha": 0.15, "ggx.n": 1.5}


@pytest.fixture(scope="module")
def answer():
    data = synthetic.surface(GGX, synthetic.scan(step=5.0), TRUTH, noise=0.03, seed=3)
    data.brdf[:] *= np.exp(0.1 * np.cos(np.radians(3 * (data.geom.theta_i_deg + data.geom.theta_r_deg))))
    return fit(data, ["lambertian+ggx", "lambertian+lafortune", "lambertian+ward"], timing=False, anyway=True)


def test_it_is_what_the_law_misses_in_the_plane_and_its_parameters_leave_open_outside(answer):
    price = pricing.off_plane_price(answer.ranking, answer.measurement)
    assert price is not None and price.in_plane == answer.ranking.recommended.rms_ln
    assert price.rms_ln == pytest.approx(np.hypot(pricing.IN_PLANE * price.in_plane, pricing.DOUBT * price.doubt))
    assert price.doubt > 0


def test_nothing_is_said_of_data_that_leave_the_plane():
    data = synthetic.surface(GGX, synthetic.hemisphere(80), TRUTH, noise=0.03)
    found = fit(data, ["lambertian+ggx"], timing=False, anyway=True)
    assert pricing.off_plane_price(found.ranking, found.measurement) is None
    assert found.document["off_plane"] is None


def test_directions_outside_go_as_far_as_the_data(answer):
    there, weights = pricing.outside_plane(answer.measurement)
    assert weights.sum() == pytest.approx(1) and np.all(there.geom.off_plane_deg >= pricing.OFF_DEG)
    assert there.geom.theta_i_deg.max() <= 80


def test_laws_that_tie_and_part_outside_are_named_with_the_directions(answer):
    rows = tuple(replace(row, tied=row.fit.name != "lambertian+ward") for row in answer.rows)
    price = pricing.off_plane_price(replace(answer.ranking, rows=rows), answer.measurement)
    assert price is not None
    (apart,) = price.apart
    assert apart.name == "lambertian+lafortune" and apart.rms_ln > pricing.PARTS
    theta_i, theta_r, phi, ratio = apart.at[0]
    there, _ = pricing.outside_plane(answer.measurement)
    angles = np.concatenate([there.geom.theta_i_deg, there.geom.theta_r_deg, there.geom.phi_deg], axis=1)
    place = int(np.argmin(np.sum((angles - [theta_i, theta_r, phi]) ** 2, axis=1)))
    other, best = (np.log(reading(each.surface, there))[:, 0] for each in (answer[apart.name], answer.recommended))
    assert ratio == pytest.approx(other[place] - best[place]) and abs(ratio) == pytest.approx(
        np.abs(other - best).max()
    )
    text = " ".join(off_plane_text({"off_plane": price_block(price)}).split())
    assert apart.then == pytest.approx(np.hypot(price.rms_ln, apart.rms_ln))
    assert f"{100 * np.expm1(apart.then):.2g} % off if that one is right" in text
    assert "lambertian+lafortune ties with it in the plane and parts from it outside, most at theta_i" in text


def test_document_text_and_page_say_the_same_percentage(answer):
    block = answer.document["off_plane"]
    assert block["expected_percent"] == pytest.approx(100 * np.expm1(block["rms_ln"]), rel=5e-3)
    said = f"expect it {block['expected_percent']:.2g} % off"
    assert said in " ".join(off_plane_text(answer.document).split())
    assert said in page.html(answer.document)
