"""`verify`: the noise of single values and the floor under every law, derived again from the data alone."""

import json
import re
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mpf, workdps

from brdfguide import models
from brdfguide.audit import (
    exact_floor,
    exact_followers,
    exact_noise,
    exact_stray_light,
    exact_two_parts,
    verification,
)
from brdfguide.audit.answer_shape import PrintedFit, refuse_gaps
from brdfguide.audit.rederived import Comparisons
from brdfguide.bases import smooth
from brdfguide.data import examine, formats
from brdfguide.data.formats.format import InputError
from brdfguide.data.measurement import Measurement
from brdfguide.data.noise_model import two_parts
from brdfguide.face.functions import fit
from brdfguide.models.surface import Surface
from brdfguide.numerics import bsplines
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.typed_json import Schema, parsed

from .. import synthetic
from ..conftest import ROOT
from ..data.test_noise_model import dim_run, on_a_floor
from .test_verification import _one_digit_off

STEP = re.compile(r"[.\[\]]+")
SURFACE = {"albedo": 0.02, "ggx.alpha": 0.2, "ggx.n": 1.5}


def noise_block(measurement: Measurement) -> dict:
    """What an answer says of a prepared measurement's noise, beside what it says of the data."""
    noise = measurement.noise
    assert noise is not None
    return {
        "ranking": [],
        "data": {
            "channels": list(measurement.channels),
            "findings": [{"code": each.code, "numbers": dict(each.numbers)} for each in measurement.findings],
        },
        "noise": {
            "relative": noise.relative,
            "absolute_per_sr": list(noise.absolute),
            "dark_level_per_sr": list(noise.dark) if noise.has_dark_level else None,
            "dark_level_stderr_per_sr": list(noise.dark_stderr) if noise.has_dark_level else None,
            "told_from_per_sr": list(noise.limit) if noise.matters else None,
            "missed": noise.missed,
        },
    }


def compared(measurement: Measurement, changed: dict | None = None) -> Comparisons:
    """The noise that was told of data that are prepared for a fit, or another, beside what it should be."""
    prepared = examine.prepared(measurement, anyway=True)
    answer = noise_block(prepared)
    answer["noise"] |= changed or {}
    found, whole = Comparisons(), examine.corrected(measurement, anyway=True)
    with workdps(verification.DIGITS):
        exact_noise.compare_noise(answer, verification.readings_of(prepared, answer, whole), found)
    return found


def scanned(seed: int, channels: int = 1, noise: float = 0.03) -> Measurement:
    """A dark gloss in scans."""
    model = models.get("lambertian+ggx")
    values = {**model.defaults(), **dict(zip(model.qualified(SURFACE), SURFACE.values(), strict=True))}
    return synthetic.surface(model, synthetic.scan(step=5.0), values, noise=noise, seed=seed, channels=channels)


def mesh(dark: float, seed: int, channels: int) -> Measurement:
    """Every incidence beside every reflected angle, so that each pair is exchanged; `dark`/cos theta_i added."""
    angles = np.arange(5.0, 76.0, 5.0)
    theta_i, theta_r = (each.ravel() for each in np.meshgrid(angles, angles, indexing="ij"))
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, 180.0)).at(np.linspace(0.45, 0.65, channels))
    brdf = Surface.named("lambertian+ggx", SURFACE).brdf(geom) * np.ones(channels)
    noisy = brdf * np.exp(0.01 * np.random.default_rng(seed).standard_normal(brdf.shape))
    return Measurement(geom, noisy + dark / geom.cos_i, tuple(f"{place}nm" for place in range(channels)))


def hemisphere(seed: int) -> Measurement:
    """Directions on both sides of the plane of incidence, too far apart for scans."""
    angles = np.meshgrid([10.0, 35.0], [20.0, 42.0, 63.0], np.arange(-165.0, 181.0, 15.0), indexing="ij")
    theta_i, theta_r, phi = (each.ravel() for each in angles)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    brdf = Surface.named("lambertian+ggx", SURFACE).brdf(geom)
    return Measurement(geom, brdf * np.exp(0.02 * np.random.default_rng(seed).standard_normal(brdf.shape)))


def coarse(measurement: Measurement) -> Measurement:
    """The same to three digits, so that levels are alike."""
    return replace(measurement, brdf=np.vectorize(lambda v: float(f"{v:.2e}"))(measurement.brdf))


def with_spike(measurement: Measurement) -> Measurement:
    """The same with an ideal mirror at one incidence, which a fit leaves out."""
    geom, brdf = measurement.geom, measurement.brdf.copy()
    brdf[(geom.theta_i_deg[:, 0] == 40.0) & (np.abs(geom.signed_theta_r_deg[:, 0] - 40.0) < 1e-9)] *= 1e4
    return replace(measurement, brdf=brdf)


CASES = {
    "scans": (scanned(1), 0.03, False),
    "to three digits": (coarse(scanned(2)), 0.03, False),
    "three channels": (scanned(3, channels=3), 0.03, False),
    "seven channels": (scanned(4, channels=7), 0.03, False),
    "without noise": (scanned(1, noise=0.0), 0.0, False),
    "a dark level's noise": (dim_run(0.01, 0.002, 3), 0.01, True),
    "of two channels": (dim_run(0.02, 0.002, 5, channels=2), 0.02, True),
    "mirrored at the plane": (hemisphere(2), 0.02, False),
    "of the detector": (on_a_floor(1e-5), 0.03, True),
    "a spike, left out": (with_spike(scanned(6)), 0.03, False),
}


@pytest.mark.parametrize("name", CASES)
def test_the_doubts_of_single_values_follow_from_them(name):
    measurement, relative, dim = CASES[name]
    found = compared(measurement)
    told = {each.place: each.right for each in found.derived}
    assert all(each.agrees for each in found.derived)
    assert told["noise.relative"] == pytest.approx(relative, rel=0.6, abs=5e-3)
    assert len([place for place in told if "absolute" in place]) == len(measurement.channels)
    assert ("noise.told_from_per_sr[0]" in told) == dim
    assert any(value > 0 for place, value in told.items() if "absolute" in place) == dim


@pytest.mark.parametrize("name", ["scans", "a dark level's noise", "of the detector", "mirrored at the plane"])
def test_a_changed_digit_of_them_is_found(name):
    measurement, _, _ = CASES[name]
    noise = examine.prepared(measurement, anyway=True).noise
    relative = noise.relative * (1 + 1e-7)
    assert [each.place for each in compared(measurement, {"relative": relative}).derived if not each.agrees] == [
        "noise.relative"
    ]
    absolute = [each * (1 + 1e-7) + 1e-7 for each in noise.absolute]
    wrong = {each.place for each in compared(measurement, {"absolute_per_sr": absolute}).derived if not each.agrees}
    assert "noise.absolute_per_sr[0]" in wrong


@pytest.mark.parametrize("channels", [1, 2])
def test_a_dark_level_that_was_taken_out_follows_from_exchanged_values(channels):
    measurement = mesh(0.006, 3, channels)
    noise = examine.prepared(measurement, anyway=True).noise
    assert noise.has_dark_level
    found = compared(measurement)
    assert all(each.agrees for each in found.derived)
    for name, told in (("dark_level_per_sr", noise.dark), ("dark_level_stderr_per_sr", noise.dark_stderr)):
        assert f"noise.{name}[{channels - 1}]" in {each.place for each in found.derived}
        changed = {name: [*told[:-1], told[-1] * (1 + 1e-7)]}
        assert [each for each in compared(measurement, changed).derived if not each.agrees]


def test_so_does_the_doubt_that_exchanged_pairs_leave(data):
    measurement = formats.read(data / "mwir" / "lacquer_smooth.csv")
    found = compared(measurement)
    assert {each.place for each in found.derived} >= {"noise.absolute_per_sr[0]", "noise.told_from_per_sr[0]"}
    assert found.derived[1].right > 0.002 and all(each.agrees for each in found.derived)


def test_a_floor_that_was_noticed_is_three_doubts(data):
    found = compared(formats.read(data / "starlink" / "chassis_brdf.csv"))
    assert [each.place for each in found.derived] == ["noise.relative", "noise.absolute_per_sr[0]"]
    assert all(each.agrees for each in found.derived) and found.derived[1].right == pytest.approx(1e-4 / 3)


@pytest.mark.parametrize("colours", [False, True])
def test_values_below_zero_are_doubts_of_each_colour_or_of_all_other_channels_together(colours):
    below = {0: (0.001, 0.002, 0.003), 1: (0.004, 0.008, 0.006), 2: (0.1, 0.2)}
    values = [[0.5, 0.5, 0.5] for _ in range(4)]  # of a colour outside sRGB most is negative
    for channel, sizes in below.items():
        for row, size in enumerate(sizes):
            values[row][channel] = -size
    names = list("RGB") if colours else ["450nm", "550nm", "650nm"]
    geom = rows(Geometry.from_degrees([10.0, 20.0, 30.0, 40.0], 0.0, 20.0, 180.0)).at(np.array([0.45, 0.55, 0.65]))
    answer = {"data": {"channels": names, "findings": []}, "noise": {"absolute_per_sr": [0.0] * 3}}
    data = verification.readings_of(Measurement(geom, np.array(values), tuple(names)), answer)
    found = [float(each) for each in exact_noise._negative(exact_noise._as_read(answer, data))]
    right = [0.002, 0.006, 0.0] if colours else [0.005] * 3
    assert found == pytest.approx([1.4826 * each for each in right])


def test_nothing_is_derived_where_values_that_were_left_out_are_not_known():
    answer = noise_block(examine.prepared(with_spike(scanned(6)), anyway=False))
    assert "spikes" in {each["code"] for each in answer["data"]["findings"]}
    data = verification.readings_of(examine.prepared(with_spike(scanned(6))), answer)
    with workdps(verification.DIGITS):
        assert data.as_read is None and not exact_noise.compare_noise(answer, data, Comparisons())


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("shows", [0.7, 1.0])
def test_both_parts_are_found_by_other_arithmetic(seed, shows):
    """Of as good choices ours is one, and they are near each other."""
    random = np.random.default_rng(seed)
    level = np.exp(random.uniform(-6, 0, 130 + 17 * seed))
    sizes = np.hypot(0.03 * level, 0.004 * (seed % 2)) * random.standard_normal(len(level))
    with workdps(30):
        departures = [exact_two_parts.Departure(a, mpf(a), mpf(b)) for a, b in zip(level, sizes, strict=True)]
        found = [(float(a), float(b)) for a, b in exact_two_parts.relative_and_absolute(departures, 20, shows)]
    ours = two_parts(level, sizes, 20, shows)
    assert min(abs(a - ours[0]) + abs(b - ours[1]) for a, b in found) < 1e-14
    assert len(found) == 1 or max(abs(a / ours[0] - 1) + abs(b - ours[1]) for a, b in found) < 0.1


# --- the floor ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def described():
    """Two channels of a gloss in scans, one of them three times as dense, and the answer on it."""
    dense, sparse = synthetic.scan(theta_i=(20.0,), step=1.0), synthetic.scan(theta_i=(40.0, 60.0, 70.0), step=4.0)
    model = models.get("lambertian+he-torrance")
    values = {**model.defaults(), "lambertian.albedo": 0.3, "he-torrance.sigma": 0.3, "he-torrance.slope": 0.12}
    data = synthetic.surface(model, synthetic.joined([dense, sparse]), values, noise=0.03, seed=4, channels=2)
    data.brdf[5:40, 1] = np.nan
    found = fit(data, ("lambertian+ward", "lambertian+phong"), timing=False)
    return found.measurement, json.loads(json.dumps(found.document))


PLACES = ("model", "smooth", "gcv", "noise", "lambda", "coefficients", "residual", "reducible", "directions")


def verified(answer):
    return verification.verify(answer[1], verification.readings_of(*answer))


def test_the_floor_follows_from_the_data_and_from_its_row(described):
    found = verified(described)
    places = {each.place.partition("floor.")[2] for each in found.derived if each.place.startswith("floor.")}
    assert not found.wrong and places >= set(PLACES)
    assert "weighed-by-scan" in {each["code"] for each in described[1]["data"]["findings"]}


def test_a_changed_digit_of_the_floor_is_found(described):
    document = deepcopy(described[1])
    for place in PLACES:
        told = document["floor"][place]
        document["floor"][place] = told + 1 if isinstance(told, int) else float(f"{told * 1.0015:.4g}")
    assert {each.place for each in verified((described[0], document)).wrong} >= {f"floor.{place}" for place in PLACES}


def test_so_is_one_of_what_another_law_of_its_form_would_remove(described):
    document = deepcopy(described[1])
    if document["floor"]["by_form"] is None:
        document["floor"] |= {"factored": document["floor"]["smooth"], "by_form": document["floor"]["reducible"]}
        document["floor"]["beyond_form"] = 0.0
        assert not verified((described[0], document)).wrong
    document["floor"]["by_form"] -= 0.002
    assert {each.place for each in verified((described[0], document)).wrong} == {"floor.by_form"}


def test_splines_and_what_bends_are_those_of_the_bases():
    with workdps(30):
        for x in (0.0, 0.013, 0.25, 0.9999, 1.0, 1.2):
            for count in (exact_floor.ACROSS, exact_floor.ALONG):
                row = np.zeros(count)
                for place, value in exact_floor._splines(mpf(x), count):
                    row[place] = float(value)
                np.testing.assert_allclose(row, bsplines.cubic(x, count)[0], atol=1e-15)
    whole = np.zeros((exact_floor.COUNT, exact_floor.COUNT))
    for (i, j), value in exact_floor.PENALTY.items():
        whole[i, j] = whole[j, i] = value
    np.testing.assert_array_equal(whole, smooth._penalty(1))
    np.testing.assert_allclose(exact_floor.STIFFNESSES, smooth.STIFFNESSES, rtol=1e-14)


def test_by_how_much_values_scatter_follows_from_residuals_where_none_can_be_compared():
    geom = rows(synthetic.scan(theta_i=(20.0, 50.0), step=40.0))
    data = synthetic.surface(models.get("lambertian"), geom, {"lambertian.albedo": 0.4}, noise=0.05, seed=2)
    found = fit(data, ("lambertian", "oren-nayar"), timing=False)
    document = json.loads(json.dumps(found.document))
    assert document["noise"]["relative"] is None and document["noise_rms_ln"] > 0.01
    result = verified((found.measurement, document))
    assert "noise_rms_ln" in {each.place for each in result.derived} and not result.wrong
    document["noise_rms_ln"] = _one_digit_off(document["noise_rms_ln"])
    assert [each.place for each in verified((found.measurement, document)).wrong] == ["noise_rms_ln"]


# --- what else follows -------------------------------------------------------------------------------


def test_growth_of_data_outside_the_plane_follows_from_their_scans_near_it():
    measurement = hemisphere(4)
    found = fit(measurement, ("lambertian+ggx",), timing=False, anyway=True)
    answer = found.measurement, json.loads(json.dumps(found.document))
    places = {each.place for each in verified(answer).derived}
    assert not verified(answer).wrong
    assert {f"ranking[0].growth.{name}" for name in ("theta_i_deg[1]", "r_max", "r_max_data")} <= places
    changed = deepcopy(answer[1])
    changed["ranking"][0]["growth"]["r_max"] = _one_digit_off(changed["ranking"][0]["growth"]["r_max"])
    changed["ranking"][0]["growth"]["theta_i_deg"][0] += 1e-4
    wrong = {each.place for each in verified((measurement, changed)).wrong}
    assert {"ranking[0].growth.r_max", "ranking[0].growth.theta_i_deg[0]"} <= wrong


@pytest.fixture(scope="module")
def polished():
    """A mirror and its waves, and the answer on it."""
    data = examine.prepared(formats.read(ROOT / "examples" / "polished_mirror.csv"))
    found = fit(data, ("abg", "lambertian+he-torrance", "lambertian+abc"), timing=False)
    return found.measurement, json.loads(json.dumps(found.document))


STRAY = (
    *("phase", "first_order_from_nm", "band_per_um[1]", "highest_theta_i_deg", "beside[0].rms_ln"),
    *("intervals_95.a.high", "intervals_95.b.low", "intervals_95.g.value", "numbers[0].numbers.A"),
)


@pytest.mark.parametrize("place", STRAY)
def test_what_is_said_of_polished_optics_follows(polished, place):
    found, document = Comparisons(), deepcopy(polished[1])
    with workdps(verification.DIGITS):
        exact_stray_light.compare_stray_light(document, found)
    assert all(each.agrees for each in found.derived) and len(found.derived) >= 18
    assert f"stray_light[0].{place}" in {each.place for each in found.derived}
    steps = [int(each) if each.isdigit() else each for each in STEP.split(place.rstrip("]"))]
    target, (*path, last) = document["stray_light"][0], steps
    for step in path:
        target = target[step]
    target[last] = _one_digit_off(target[last])
    changed = Comparisons()
    with workdps(verification.DIGITS):
        exact_stray_light.compare_stray_light(document, changed)
    assert f"stray_light[0].{place}" in {each.place for each in changed.derived if not each.agrees}


@pytest.mark.parametrize("name", ["sigma", "tau"])
def test_from_which_height_on_only_a_slope_is_known_is_told_twice(polished, name):
    document = deepcopy(polished[1])
    row = next(place for place, each in enumerate(document["ranking"]) if "he-torrance" in each["candidate"])
    told = document["ranking"][row]
    assert any(each["code"] == "rough-regime:he-torrance.sigma" for each in told["flags"])
    entry = told["parameters"][f"he-torrance.{name}"]
    entry["above"] = _one_digit_off(entry["above"])
    found = Comparisons()
    exact_followers.regimes(told, f"ranking[{row}]", found)
    wrong = [each.place for each in found.derived if not each.agrees]
    assert len(found.derived) == 3 and wrong == [f"ranking[{row}].parameters.he-torrance.{name}.above"]


def test_so_is_what_another_law_would_remove_where_the_answer_warns_of_it(described):
    document = deepcopy(described[1])
    told = round(document["floor"]["reducible"], 3)
    for step, wrong in ((0.0, False), (0.001, True), (-0.001, True)):
        document["warnings"] = [{"code": "at-the-floor", "numbers": {"reducible": told + step}}]
        places = {each.place for each in verified((described[0], document)).wrong}
        assert ("warnings[0].numbers.reducible" in places) == wrong


def test_a_rank_is_that_of_the_errors(described):
    document = deepcopy(described[1])
    last = max(range(2), key=lambda place: document["ranking"][place]["rank"])
    document["ranking"][last]["rank"] += 1
    assert f"ranking[{last}].rank" in {each.place for each in verified((described[0], document)).wrong}


def test_lists_of_another_length_than_the_channels_are_refused():
    measurement = examine.prepared(scanned(3, channels=3))
    for key in ("absolute_per_sr", "told_from_per_sr", "dark_level_per_sr", "dark_level_stderr_per_sr"):
        answer = noise_block(measurement)
        answer["noise"][key] = [0.0, 0.0]
        with pytest.raises(InputError, match=f"noise.{key}: found 2 numbers; wanted 3"):
            refuse_gaps(answer)


@pytest.mark.parametrize("number", ["z", "chance", "correlation"])
def test_a_flag_without_a_number_that_others_follow_from_is_refused(described, number):
    document = deepcopy(described[1])
    flag = next(each for row in document["ranking"] for each in row["flags"] if each["code"] == "discrepancy")
    flag["numbers"][number] = None
    with pytest.raises(InputError, match=f"there is no '{number}'; wanted a number"):
        verified((described[0], document))


def test_a_list_that_is_not_a_pair_is_refused(polished):
    document = deepcopy(polished[1])
    del document["stray_light"][0]["band_per_um"][1]
    shape = Schema({document["schema"]: PrintedFit}, "the output of `brdfguide fit --json`")
    with pytest.raises(InputError, match=r"band_per_um: found a list of 1; wanted a list of 2"):
        parsed(json.dumps(document).encode(), shape, "fit.json")
    assert parsed(json.dumps(polished[1]).encode(), shape, "fit.json").stray_light[0].law == "abg"
