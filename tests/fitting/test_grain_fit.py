"""A search finds a grain whatever its axis, says where there is none, and needs a law with one only where it shows."""

import numpy as np
import pytest

import brdfguide
from brdfguide import models
from brdfguide.data import examine
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import grain_walk
from brdfguide.fitting.choosing import ALLOWED
from brdfguide.fitting.compare import compare
from brdfguide.fitting.diagnostics import scan_gains, standard_errors
from brdfguide.fitting.fit import FitOptions
from brdfguide.fitting.job import Job, case_of
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.next_measurement import turns_wanted
from brdfguide.fitting.objective import Misfit, metric
from brdfguide.models.candidates import Grained, with_grain
from brdfguide.report.documents.errors_of_grain import errors_of_grain

from .. import synthetic
from ..data.test_rotation import scans

TURNS = [0.0, 30, 60, 90, 120, 150]


def free(name):
    return with_grain(models.get(name), Grained())


@pytest.mark.parametrize("axis", [1.0, 44.0, 91.0, 179.5])
def test_the_axis_is_found_whatever_it_is(axis):
    values = {"alpha_x": 0.3, "alpha_y": 0.075, "axis": np.radians(axis)}
    found = fitting.fit(free("ggx-aniso"), scans("ggx-aniso", TURNS, seed=91, **values))
    off = np.remainder(np.degrees(found.values["ggx-aniso.axis"]) - axis + 90, 180) - 90
    assert abs(off) < 3 * np.degrees(found.stderr["ggx-aniso.axis"]) + 0.01 < 1.0
    for name in ("alpha_x", "alpha_y"):
        assert abs(found.values[f"ggx-aniso.{name}"] - values[name]) < 4 * found.stderr[f"ggx-aniso.{name}"]
    assert not {"at-bound", "axis-undetermined"} & {each.code for each in found.warnings}


@pytest.mark.parametrize("name", ["he-torrance-aniso", "ashikhmin-shirley", "stam", "ward-aniso"])
def test_other_grains_are_found_as_well(name):
    law = models.term(name)
    pin = next(each for each in law.pins if "axis" in each.values)
    truth = law.defaults() | dict(pin.values)
    measurement = scans("ggx", TURNS, alpha=0.2)
    brdf = law(measurement.geom, **truth)
    data = Measurement(measurement.geom, np.where(brdf > 1e-8 * brdf.max(), brdf, np.nan))
    found = fitting.fit(free(name), data)
    assert found.rms_ln < 1e-3
    off = np.remainder(found.values[f"{name}.axis"] - truth["axis"] + np.pi / 2, np.pi) - np.pi / 2
    assert abs(off) < 1e-3


def test_slopes_by_the_walk_are_those_of_differences():
    layout = Layout(free("ggx-aniso"), 1).walking()
    data = scans("ggx-aniso", TURNS, alpha_x=0.2, alpha_y=0.1)
    misfit = Misfit(layout, data, metric("ln"), np.ones_like(data.brdf))
    for q1, q2 in ((0.9, 0.4), (-0.3, 1.1), (1e-3, 0.0)):
        at = layout.encode({"ggx-aniso.alpha_x": 0.2, "ggx-aniso.alpha_y": 0.1, "ggx-aniso.n": 4.0})
        places = [layout.shared.index(f"ggx-aniso.{key}") for key in ("alpha_x", "alpha_y", "axis")]
        at[0][places] = -1.5, q1, q2
        _, shared, _ = misfit(*at, True)
        for place in places:
            ends = []
            for step in (1e-5, -1e-5):
                moved = at[0].copy()
                moved[place] += step
                ends.append(misfit(moved, at[1], False))
            np.testing.assert_allclose(np.ravel(shared[..., place]), np.ravel((ends[0] - ends[1]) / 2e-5), atol=2e-5)


@pytest.mark.parametrize(
    ("name", "given"), [("ggx-aniso", (0.3, 0.1)), ("stam", (0.1, 3.0)), ("ashikhmin-shirley", (20.0, 300.0))]
)
def test_the_walk_goes_there_and_back(name, given):
    grain = models.term(name).grain
    back = grain_walk.parameters_of(grain, *grain_walk.walk_of(grain, *given, 1.0))
    assert back == pytest.approx((*given, 1.0), rel=1e-12)


def test_a_round_sample_has_no_axis_and_its_law_no_grain():
    measurement = scans("ggx", TURNS, seed=92, alpha=0.2)
    found = fitting.fit(free("ggx-aniso"), measurement)
    assert found.has("axis-undetermined", "ggx-aniso.axis")
    case = case_of(measurement, Job())
    names = [each.name for each in case.candidates]
    assert "ggx" in names and "ggx-aniso" in names
    ranked = compare(measurement, [each for each in case.candidates if each.name in ("ggx", "ggx-aniso")])
    assert ranked.recommended.fit.name == "ggx (metal)"


def test_a_grain_that_the_data_show_is_kept_where_a_round_lobe_would_look_alike():
    law = models.get("lambertian+ggx-aniso")
    values = {"lambertian.albedo": 0.3, "ggx-aniso.alpha_x": 0.185, "ggx-aniso.alpha_y": 0.135, "ggx-aniso.n": 1.5}
    clean = scans("ggx", [0.0, 45, 90, 135], alpha=0.2)
    brdf = law(clean.geom, law.defaults() | values | {"ggx-aniso.axis": np.radians(154.0)})
    noise = 1 + 0.02 * np.random.default_rng(96).normal(size=brdf.shape)
    candidates = [models.get("lambertian+ggx"), free("lambertian+ggx-aniso")]
    ranked = compare(Measurement(clean.geom, brdf * noise), candidates, FitOptions(close="look"))
    round_ = next(row for row in ranked.rows if row.fit.name == "lambertian+ggx")
    assert ranked.recommended.fit.name == "lambertian+ggx-aniso"
    assert round_.seen < 2 and round_.rms_ln < ranked.rows[0].rms_ln + ALLOWED and not round_.close


def test_laws_with_a_grain_are_candidates_where_the_sample_was_turned_only():
    def names(measurement):
        return {each.name for each in case_of(measurement, Job()).candidates}

    grained = {"ggx-aniso", "beckmann-aniso", "ward-gmd-aniso", "he-torrance-aniso"}
    assert grained <= names(scans("ggx", TURNS, alpha=0.2))
    assert not grained & names(scans("ggx", [0.0], alpha=0.2))
    assert grained <= names(scans("beckmann-aniso", [0.0], alpha_x=0.3, alpha_y=0.06))  # too high for its width


def test_of_two_turns_the_axis_is_held_where_the_lobe_is_wider():
    measurement = scans("ggx-aniso", [0.0, 90.0], seed=93, alpha_x=0.08, alpha_y=0.3, axis=0.0)
    case = case_of(measurement, Job(models=("ggx-aniso",)))
    assert case.candidates[0].fixed["ggx-aniso.axis"] == pytest.approx(np.pi / 2)
    found = fitting.fit(case.candidates[0], measurement, FitOptions())
    assert found.values["ggx-aniso.alpha_x"] == pytest.approx(0.3, rel=0.05)
    assert found.values["ggx-aniso.alpha_y"] == pytest.approx(0.08, rel=0.05)


def test_one_scan_that_is_too_high_holds_the_metal_and_gives_the_width_along_the_grain():
    measurement = scans("beckmann-aniso", [0.0], seed=94, alpha_x=0.3, alpha_y=0.06)
    case = case_of(measurement, Job())
    assert not any(key.endswith(".k") for each in case.candidates for key in each.free)
    one = next(each for each in case.candidates if each.name == "beckmann-aniso")
    found = fitting.fit(one, measurement)
    assert found.values["beckmann-aniso.alpha_x"] == pytest.approx(0.3, rel=0.03)
    assert found.values["beckmann-aniso.alpha_y"] == pytest.approx(0.06, rel=0.25)  # F is 0.8 there, and was 0.92


@pytest.mark.parametrize("scan", [1, 2])
def test_what_hangs_on_a_number_that_one_scan_does_not_tell_has_no_error(data, scan):
    """Of a matrix that cannot be inverted, by rounding, no root is drawn."""
    answer = brdfguide.fit(data / "anisotropic" / f"brushed_aluminium_scan_{scan}.csv")
    assert answer.document["ranking"]


def test_where_the_grain_is_not_told_the_next_scan_is_of_the_turned_sample():
    one = scans("beckmann-aniso", [0.0], alpha_x=0.3, alpha_y=0.06)
    assert turns_wanted(one) == (90.0, 45.0)
    two = scans("ggx-aniso", [0.0, 90.0], alpha_x=0.3, alpha_y=0.06)
    assert turns_wanted(two) == (45.0,)
    assert turns_wanted(scans("ggx", [0.0], alpha=0.2)) == () == turns_wanted(scans("ggx", TURNS, alpha=0.2))


@pytest.mark.parametrize("name", ["ggx-aniso", "beckmann-aniso", "ward-gmd-aniso"])
def test_without_its_grain_a_law_is_its_parent_of_the_mean_width(name):
    law, geom = models.term(name), scans("ggx", [20.0], alpha=0.2).geom
    bare = law.without["anisotropy"](geom, **law.defaults() | {"alpha_x": 0.4, "alpha_y": 0.1, "axis": 0.7})
    parent = models.term(name.removesuffix("-aniso"))(geom, alpha=0.2)
    np.testing.assert_allclose(bare, parent, rtol=1e-12)


@pytest.mark.parametrize(("alpha", "ratio", "axis"), [(0.08, 3.0, 37.0), (0.05, 2.5, 15.0)])
def test_a_grain_is_found_above_a_detectors_floor(alpha, ratio, axis):
    """Where most values only show the detector, those say nothing of the surface."""
    values = {"alpha_x": alpha * ratio**0.5, "alpha_y": alpha * ratio**-0.5, "axis": np.radians(axis)}
    clean = scans("beckmann-aniso", [0.0, 45, 90, 135], seed=95, **values)
    floor = 1e-5 * np.exp(0.1 * np.random.default_rng(96).normal(size=clean.brdf.shape))
    measurement = examine.prepared(Measurement(clean.geom, clean.brdf + floor))
    assert np.count_nonzero(~measurement.clear) > 0.3 * measurement.brdf.size
    names = ("beckmann", "beckmann-aniso")
    ranked = compare(measurement, [with_grain(models.get(name), Grained()) for name in names])
    found = ranked.recommended.fit
    assert found.name.startswith("beckmann-aniso")
    assert found.values["beckmann-aniso.alpha_x"] / found.values["beckmann-aniso.alpha_y"] == pytest.approx(
        ratio, rel=0.05
    )
    assert abs(np.remainder(np.degrees(found.values["beckmann-aniso.axis"]) - axis + 90, 180) - 90) < 1.0


@pytest.mark.parametrize("law", ["ggx-aniso", "he-torrance-aniso"])
def test_the_ratio_has_an_interval_in_which_both_widths_err_together(law):
    values = {"alpha_x": 0.2, "alpha_y": 0.1} if law == "ggx-aniso" else {"sigma": 0.5, "slope": 0.1, "ratio": 2.0}
    clean = scans("ggx", TURNS, alpha=0.2).geom
    brdf = models.term(law)(clean, **models.term(law).defaults() | values | {"n": 0.958, "k": 6.69, "axis": 0.5})
    noisy = brdf * (1 + 0.01 * np.random.default_rng(97).normal(size=brdf.shape))
    measurement = Measurement(clean, np.where(brdf > 1e-6 * brdf.max(), noisy, np.nan))
    found = fitting.fit(free(law), measurement)
    known = errors_of_grain(found, measurement)
    if law == "ggx-aniso":
        low, high = known["ggx-aniso.ratio"]["interval"]
        alone = np.hypot(*(found.stderr[f"{law}.{name}"] / found.values[f"{law}.{name}"] for name in values))
        assert low < 2.0 < high and 0.2 * alone < known["ggx-aniso.ratio"]["stderr"] / 2.0 < 1.5 * alone
        assert known["ggx-aniso.alpha"]["stderr"] > 0
    else:
        assert found.stderr["he-torrance-aniso.ratio"] > 0 and "he-torrance-aniso.ratio" not in known


def with_gains(seed: int, spread: float):
    """Sixteen scans of a grain, each with a gain of its own, and what the grain is."""
    draw = np.random.default_rng([seed, 2301])
    alpha, ratio = np.exp(draw.uniform(np.log([0.08, 1.3]), np.log([0.3, 5.0])))
    axis = draw.uniform(0, np.pi)
    widths = {"alpha_x": alpha * ratio**0.5, "alpha_y": alpha * ratio**-0.5}
    clean = scans("ggx-aniso", [0.0, 45, 90, 135], seed=seed, **widths, axis=axis)
    gains = np.exp(spread * draw.normal(size=16))
    scan = standard_errors.whole_scans(clean)
    return Measurement(clean.geom, clean.brdf * gains[scan][:, None]), ratio, axis


@pytest.mark.parametrize("spread", [0.02, 0.005])
def test_intervals_of_a_grain_hold_where_each_scan_has_a_gain_of_its_own_with_seeds_0_to_23(spread):
    """Also where a gain for each incidence, the same under all turns, explains what is seen along the scans."""
    off = []
    for seed in range(24):
        measurement, ratio, axis = with_gains(seed, spread)
        found = fitting.fit(free("ggx-aniso"), measurement)
        known = errors_of_grain(found, measurement)["ggx-aniso.ratio"]
        fitted = found.values["ggx-aniso.alpha_x"] / found.values["ggx-aniso.alpha_y"]
        turned = np.remainder(found.values["ggx-aniso.axis"] - axis + np.pi / 2, np.pi) - np.pi / 2
        off.append((np.log(fitted / ratio) * fitted / known["stderr"], turned / found.stderr["ggx-aniso.axis"]))
    assert np.all(np.sqrt(np.mean(np.square(off), axis=0)) < 1.4)
    assert np.all(np.count_nonzero(np.abs(off) > 2, axis=0) <= 3)


def test_scans_of_one_gain_have_no_wider_intervals_with_seeds_0_to_9(monkeypatch):
    cases = [with_gains(seed, 0.0)[0] for seed in range(10)]

    def errors():
        found = [fitting.fit(free("ggx-aniso"), each) for each in cases]
        known = [errors_of_grain(*each)["ggx-aniso.ratio"]["stderr"] for each in zip(found, cases, strict=True)]
        return np.array([known, [each.stderr["ggx-aniso.axis"] for each in found]])

    with_spread = errors()
    monkeypatch.setattr(scan_gains, "with_scan_gains", lambda layout, values, stderr, *_: (stderr, 0.0))
    assert np.all(np.median(with_spread / errors(), axis=1) < 1.1)


def test_a_ratio_that_the_data_do_not_tell_has_no_interval(monkeypatch):
    measurement = scans("ggx", TURNS, seed=100, alpha=0.2)
    found = fitting.fit(free("ggx-aniso"), measurement)
    assert {"ggx-aniso.ratio", "ggx-aniso.alpha"} <= errors_of_grain(found, measurement).keys()
    monkeypatch.setattr("brdfguide.report.documents.errors_of_grain.ln_stderrs", lambda *_: [800.0, np.inf])
    with np.errstate(all="raise"):
        assert errors_of_grain(found, measurement) == {}


def test_scans_under_other_turns_err_apart(monkeypatch):
    """Each is mounted anew: its gain turns the axis, and many directions of one scan say no more of that than one."""
    clean = scans("ggx-aniso", [0.0, 45, 90, 135], seed=98, alpha_x=0.2, alpha_y=0.08, axis=0.4)
    scan = standard_errors.whole_scans(clean)
    assert standard_errors.whole_scans(scans("ggx", [0.0], alpha=0.2)) is None
    assert len(np.unique(scan)) == 16
    gains = np.exp(0.03 * np.random.default_rng(99).normal(size=16))
    measurement = Measurement(clean.geom, clean.brdf * gains[scan][:, None])
    together = fitting.fit(free("ggx-aniso"), measurement).stderr["ggx-aniso.axis"]
    monkeypatch.setattr(standard_errors, "whole_scans", lambda measurement: None)
    assert together > 1.5 * fitting.fit(free("ggx-aniso"), measurement).stderr["ggx-aniso.axis"]


def test_a_brushed_metal_scanned_across_its_grain_in_colour_is_answered():
    """Its law has nothing that tells channels apart there, and reads the same in all of them."""
    truth = {"ggx-aniso.alpha_x": 0.3, "ggx-aniso.alpha_y": 0.05, "ggx-aniso.n": 1.0, "ggx-aniso.k": 6.6}
    data = synthetic.surface(models.get("ggx-aniso"), synthetic.scan((20, 45, 70)), truth, noise=0.02, channels=3)
    answer = brdfguide.fit(data, timing=False)
    assert answer["ggx-aniso"].rms_ln < 0.025
    assert [each.code for each in answer.measurement.findings if each.code == "height-against-width"]
