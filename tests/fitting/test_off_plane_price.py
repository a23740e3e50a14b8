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


@pytest.fixture(scope="module")
def price(answer):
    return pricing.off_plane_price(answer.ranking, answer.measurement)


def test_it_is_the_error_of_the_laws_that_are_most_probable_after_the_data(answer, price):
    assert price.in_plane == answer.ranking.recommended.rms_ln
    assert price.by_law[0].name == "lambertian+ggx" and price.by_law[0].probability > 0.9
    near = [each for each in price.by_law if abs(np.log(each.rms_ln / price.rms_ln)) < pricing.WITHIN]
    assert price.probability == pytest.approx(sum(each.probability for each in near), abs=0.02)
    outside, weights = pricing.outside_plane(answer.measurement)
    truth = np.log(GGX(outside.geom, TRUTH)) - np.log(reading(answer.surface, outside))
    assert price.rms_ln > np.sqrt(weights @ truth[:, 0] ** 2)  # the factor was not in it


def test_of_errors_alike_the_most_probable_together_are_told():
    laws = [("a", 0.35, 0.10), ("b", 0.25, 0.30), ("c", 0.4, 0.32)]
    told, probability = pricing.most_probable(tuple(pricing.IfRight(*each) for each in laws))
    assert told == pytest.approx(np.sqrt((0.25 * 0.3**2 + 0.4 * 0.32**2) / 0.65)) and probability == pytest.approx(0.65)


def test_a_lobe_about_the_mirror_direction_that_follows_one_about_the_half_vector_is_found_out():
    blinn = models.get("lambertian+blinn")
    values = {"lambertian.albedo": 0.1, "blinn.ks": 0.1, "blinn.exponent": 60.0}
    data = synthetic.surface(blinn, synthetic.scan(step=5.0), values, noise=0.02, seed=4)
    found = fit(data, ["lambertian+phong-lewis", "lambertian+blinn"], timing=False, anyway=True)
    mirror = replace(found.ranking, recommended=next(row for row in found.rows if "phong" in row.fit.name))
    price = pricing.off_plane_price(mirror, found.measurement)
    there, weights = pricing.outside_plane(found.measurement)
    apart = np.log(reading(mirror.recommended.fit.surface, there)) - np.log(blinn(there.geom, values))
    error = np.sqrt(weights @ apart[:, 0] ** 2)
    assert price is not None and error > 5 * price.in_plane
    assert abs(np.log(price.rms_ln / error)) < pricing.WITHIN


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
    assert apart.name == "lambertian+lafortune" and apart.ties and apart.rms_ln > pricing.PARTS
    assert apart.then == next(each.rms_ln for each in price.by_law if each.name == apart.name)
    theta_i, theta_r, phi, ratio = apart.at[0]
    there, _ = pricing.outside_plane(answer.measurement)
    angles = np.concatenate([there.geom.theta_i_deg, there.geom.theta_r_deg, there.geom.phi_deg], axis=1)
    place = int(np.argmin(np.sum((angles - [theta_i, theta_r, phi]) ** 2, axis=1)))
    other, best = (np.log(reading(each.surface, there))[:, 0] for each in (answer[apart.name], answer.recommended))
    assert ratio == pytest.approx(other[place] - best[place]) and abs(ratio) == pytest.approx(
        np.abs(other - best).max()
    )
    text = " ".join(off_plane_text({"off_plane": price_block(price)}).split())
    assert f"{100 * np.expm1(apart.then):.2g} % off if that one is right" in text
    assert "lambertian+lafortune ties with it in the plane and parts from it outside, most at theta_i" in text


def test_document_text_and_page_say_the_same_percentage(answer):
    block = answer.document["off_plane"]
    assert block["expected_percent"] == pytest.approx(100 * np.expm1(block["rms_ln"]), rel=5e-3)
    said = f"expect it {block['expected_percent']:.2g} % off"
    assert said in " ".join(off_plane_text(answer.document).split())
    assert said in page.html(answer.document)


def test_channels_that_share_no_direction_have_no_price():
    """Found by the fuzz: there is no value that every law is compared with in all channels."""
    data = synthetic.surface(GGX, synthetic.scan(step=5.0), TRUTH, channels=3)
    data.brdf[np.arange(data.brdf.size).reshape(data.brdf.shape) % 2 == 0] = np.nan
    assert fit(data, ["lambertian+ggx"], timing=False, anyway=True).document["off_plane"] is None
