"""The contract of every file in models/: laws it obeys, or breaks and says so, which is then a strict expected failure."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from brdfguide import fitting, hemisphere, models
from brdfguide.geometry import Geometry, in_plane, rows
from brdfguide.measurement import Measurement

from . import textbook

TERMS = [models.term(name) for name in models.names()]
every_term = pytest.mark.parametrize("term", TERMS, ids=lambda term: term.name)
# what the recovery test hides in its data: away from defaults and from the starts
TRUTH = {
    "alpha": 0.27, "n": 1.72, "albedo": 0.37, "rho_s": 0.23, "exponent": 33.0, "ks": 0.31, "tilt": 0.9, "spread": 0.41, "roughness": 0.63,
    "sigma": 0.17, "slope": 0.13, ("lafortune", "exponent"): 7.0,
}  # fmt: skip
GRAZING = (0.0, 60.0, 85.0, 89.9, 89.99)


def every_term_but(law):
    """Every model; those that declare to break `law` must fail it."""
    marks = lambda term: [pytest.mark.xfail(reason=term.breaks[law], raises=AssertionError, strict=True)] if law in term.breaks else []  # noqa: E731
    return pytest.mark.parametrize("term", [pytest.param(term, marks=marks(term), id=term.name) for term in TERMS])


def draws(term, seed, count=12):
    """Values of `term`: the defaults, both corners of its box, and some from within."""
    rng = np.random.default_rng(seed)
    yield term.defaults()
    yield {p.name: p.low for p in term.parameters}
    yield {p.name: p.high for p in term.parameters}
    for _ in range(count):
        yield {p.name: within(p, rng.uniform()) for p in term.parameters}


def within(p, share):
    """The value at `share` 0..1 of the parameter's range, even in its logarithm if that is how it is fitted."""
    if not p.log:
        return p.low + share * (p.high - p.low)
    low, high = np.log(p.low - p.origin), np.log(p.high - p.origin)
    return float(np.clip(p.origin + np.exp(low + share * (high - low)), p.low, p.high))


def scattered(seed, count=400, highest=89.99):
    """Directions all over the hemisphere, half of them crowded toward grazing and toward the mirror."""
    rng = np.random.default_rng(seed)
    theta_i = np.where(rng.uniform(size=count) < 0.5, rng.uniform(0, 90, count), 90 - 10 ** rng.uniform(-2, 2, count) * 0.9)
    beside = theta_i + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count)
    theta_r = np.where(rng.uniform(size=count) < 0.5, rng.uniform(0, 90, count), beside)
    phi_r = np.where(rng.uniform(size=count) < 0.5, rng.uniform(0, 360, count), 180 + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count))
    fold = lambda a: np.clip(np.abs(a), 0, highest)[:, None]  # noqa: E731
    return Geometry.from_degrees(fold(theta_i), 0.0, fold(theta_r), phi_r[:, None])


@every_term
def test_pins_are_met_and_lie_away_from_the_defaults(term):
    assert term.pins or not np.any(term(scattered(1))), "a law without a value that was computed elsewhere"
    for pin in term.pins:
        assert float(term(pin.geom, **pin.values)) == pytest.approx(pin.f, rel=pin.rtol, abs=0)
        assert any(pin.values[name] != value for name, value in term.defaults().items() if name in pin.values)


@every_term
def test_extremes_are_finite_and_met(term):
    for extreme in term.extremes:
        f = term(extreme.geom, **extreme.values)
        assert np.isfinite(f) and f >= 0, extreme.why
        if extreme.f is not None:
            assert float(f) == pytest.approx(extreme.f, rel=extreme.rtol, abs=0), extreme.why


@every_term
def test_finite_and_not_negative_over_the_whole_box_with_seed_11(term):
    geom = scattered(11)
    for values in draws(term, 11):
        f = term(geom, **values)
        assert np.all(np.isfinite(f)) and np.all(f >= 0), values


@every_term
def test_nothing_is_sent_below_the_horizon(term):
    geom = Geometry.from_degrees([[30.0], [95.0], [90.0], [120.0]], 0.0, [[100.0], [20.0], [89.0], [120.0]], 180.0)
    for values in draws(term, 12, 3):
        assert np.all(term(geom, **values) == 0.0)


@every_term_but("reciprocity")
def test_light_and_detector_may_change_places_with_seed_13(term):
    geom = scattered(13)
    for values in draws(term, 13):
        np.testing.assert_allclose(term(geom.swapped(), **values), term(geom, **values), rtol=1e-12)


@every_term
def test_turning_the_surface_changes_nothing_with_seed_14(term):
    rng = np.random.default_rng(14)
    theta_i, theta_r, phi = rng.uniform(0, 89.99, (300, 1)), rng.uniform(0, 89.99, (300, 1)), np.round(rng.uniform(0, 360, (300, 1)), 3)
    straight = Geometry.from_degrees(theta_i, 0.0, theta_r, phi)
    for values in draws(term, 14):
        for turn in (90.0, -256.5):
            turned = Geometry.from_degrees(theta_i, turn, theta_r, phi + turn)
            np.testing.assert_allclose(term(turned, **values), term(straight, **values), rtol=1e-8, atol=1e-200)


@cache
def reflectances(name, seed):
    """Greatest reflectances over the incidence angles, amplitude at its greatest where that is a share of the light,
    and else such that the reflectance at normal incidence is 1."""
    term, greatest = models.term(name), []
    for values in draws(term, seed, 6):
        for p in term.parameters:
            values[p.name] = min(p.high, 1.0) if p.linear or p.name == "albedo" else values[p.name]
        dhr = hemisphere.dhr(term, GRAZING, values)[:, 0]
        if any(p.linear and p.unit == "1/sr" for p in term.parameters):
            dhr = dhr / max(dhr[0], 1e-100)
        greatest.append(dhr.max())
    return greatest


@every_term_but("energy")
def test_no_more_is_sent_than_received_to_a_hundredth_degree_from_grazing_with_seed_15(term):
    assert max(reflectances(term.name, 15)) <= 1.001


@every_term
def test_scalars_arrays_and_channels_agree(term):
    geom = scattered(16, 50)
    values = next(draws(term, 16))
    column = term(geom, **values)
    assert column.shape == (50, 1)
    for row in (0, 17):
        assert float(term(geom[row], **values)[0]) == float(column[row, 0])
    channels = {p.name: np.array([within(p, 0.4), within(p, 0.6)]) if p.per_channel else values[p.name] for p in term.parameters}
    both = term(geom.at(np.array([0.45, 0.65])), **channels)
    assert both.shape[0] == 50
    for place, wavelength in enumerate((0.45, 0.65)):
        single = {name: value[place] if np.ndim(value) else value for name, value in channels.items()}
        alone = term(geom.at(wavelength), **single)[:, 0]
        np.testing.assert_allclose(np.broadcast_to(both, (50, 2))[:, place], alone, rtol=1e-14)


@every_term
def test_brdf_is_proportional_to_its_amplitude(term):
    if term.amplitude is None:
        assert term.name in ("oren-nayar", "eon", "mirror")  # quadratic in the albedo; no finite part
        return
    geom = scattered(17, 50)
    values = {**term.defaults(), term.amplitude: 0.25}
    np.testing.assert_allclose(term(geom, **{**values, term.amplitude: 0.75}), 3 * term(geom, **values), rtol=1e-14)


@every_term
def test_gradient_agrees_with_differences_with_seed_18(term):
    names = [p.name for p in term.parameters if not p.linear]
    if term.gradient is None:
        assert not names or term.name in ("mirror", "he-torrance")  # differenced by the fit
        return
    geom = scattered(18, 200, highest=88.0)
    for values in draws(term, 18):
        inside = {p.name: within(p, 0.02) if values[p.name] <= within(p, 0.02) else min(values[p.name], within(p, 0.98)) for p in term.parameters}
        slopes = term.gradient(geom, names, **inside)
        if term.amplitude:
            np.testing.assert_allclose(slopes[term.amplitude] * inside[term.amplitude], term(geom, **inside), rtol=1e-12, atol=1e-300)
        for name in names:
            f, slope = term(geom, **inside), np.broadcast_to(slopes[name], geom.shape)
            seen = f > 1e-6 * f.max()  # over which the step keeps ln f within a hundredth
            steepest = np.max(np.abs(slope[seen] / f[seen]), initial=0.0)
            step = min(1e-3 * (inside[name] - term.parameter(name).origin), 0.01 / (steepest + 1e-9))
            if name == "tilt" and abs(abs(inside[name]) - np.pi / 4) <= 3 * step:
                continue  # the greatest value changes its place there: a crease in ks, not in the fit
            at = lambda shift: term(geom, **{**inside, name: inside[name] + shift * step})  # noqa: B023, E731
            wide, middle, narrow = ((at(s) - at(-s)) / (2 * s * step) for s in (2, 1, 0.5))
            once, twice = (4 * middle - wide) / 3, (4 * narrow - middle) / 3
            expected = (16 * twice - once) / 15
            edge = (at(-2) == 0) != (at(2) == 0)  # of a lobe's support, where a small power has any slope
            expected = np.where(edge, slope, expected)
            size = np.abs(expected).max() + np.abs(at(0)).max() / (step * 1e10)
            np.testing.assert_allclose(slopes[name], expected, rtol=1e-5, atol=1e-6 * size)


@every_term
@settings(max_examples=60, deadline=None, derandomize=True)
@given(data=st.data())
def test_double_precision_agrees_with_the_textbook_at_50_digits(term, data):
    if term.name not in textbook.LAWS:
        assert term.pins  # compared at 50 digits in a file of its own
        return
    share = st.floats(0, 1)
    values = {p.name: within(p, data.draw(share, p.name)) for p in term.parameters}
    angle = st.one_of(st.floats(0, 89.9999), st.floats(-12, 0).map(lambda e: 90 - 10**e))
    theta_i = data.draw(angle, "theta_i")
    theta_r = data.draw(st.one_of(angle, st.floats(-1e-3, 1e-3).map(lambda d: abs(min(theta_i + d, 89.9999)))), "theta_r")
    phi_r = data.draw(st.one_of(st.floats(-360, 360), st.just(180.0)), "phi_r")
    angles = (theta_i, 0.0, theta_r, phi_r)
    right = float(textbook.value(term.name, angles, values))
    got = float(term(Geometry.from_degrees(*angles), **values))
    # as right as the law itself, were the angles off by 1e-14° and the parameters by 1e-15 of their value
    moved = [(theta_i + 1e-14, 0, theta_r, phi_r), (theta_i, 0, theta_r + 1e-14, phi_r), (theta_i, 0, theta_r, phi_r + 5e-14)]
    blur = [float(textbook.value(term.name, other, values)) - right for other in moved]
    blur += [float(textbook.value(term.name, angles, {**values, name: value * (1 + 1e-15)})) - right for name, value in values.items()]
    tolerance = 1e-13 * right + 2 * sum(map(abs, blur)) + 1e-290
    if "exponent" in values and right > 0:  # and as right as a power whose base is off by 1e-15
        base = (right / values["ks"]) ** (1 / values["exponent"]) if values["ks"] else 1.0
        tolerance += right * np.expm1(min(values["exponent"] * np.log1p(1e-15 / min(base, 1.0)), 700.0))
    assert got == pytest.approx(right, rel=0, abs=tolerance), (angles, values)



@every_term
def test_any_parameter_may_have_a_value_for_each_channel_at_one_wavelength(term):
    geom, values = scattered(20, 30), next(draws(term, 20))
    for p in term.parameters:
        pair = np.array([within(p, 0.4), within(p, 0.6)])
        both = np.broadcast_to(term(geom, **{**values, p.name: pair}), (30, 2))
        for place in (0, 1):
            np.testing.assert_allclose(both[:, place], term(geom, **{**values, p.name: pair[place]})[:, 0], rtol=1e-13)


@every_term
@pytest.mark.parametrize("start", ["near", "far"])
def test_fit_recovers_the_parameters_that_made_the_data(term, start):
    free = [p for p in term.parameters if p.free]
    if not free or term.name == "mirror":
        return
    angles = np.concatenate([np.arange(-80.0, 81, 8), [2.0, 6, 22, 34, 48, 52, 58, 66, 70, 76]])
    theta_i, theta_r = (a.ravel() for a in np.meshgrid([5.0, 30, 50, 70], angles))
    geom = rows(in_plane(theta_i, theta_r))
    # a lobe that is 0 where there are data has no ln there: over a body, as it is used
    surface = models.get(f"lambertian+{term.name}" if term.name == "lafortune" else term.name)
    truth = {**term.defaults(), **{p.name: TRUTH.get((term.name, p.name), TRUTH.get(p.name, p.default)) for p in free}}
    keyed = {f"{term.name}.{name}": value for name, value in truth.items()}
    keyed = {**surface.defaults(), **keyed}
    measurement = Measurement(geom, np.broadcast_to(surface(geom, keyed), geom.shape), name=term.name)
    begin = {} if start == "far" else {f"{term.name}.{p.name}": 1.1 * truth[p.name] for p in free if not p.linear}
    found = fitting.fit(surface, measurement, fitting.Options(start=begin))
    assert found.rms_ln < 1e-6
    for p in free:
        assert float(np.ravel(found.values[f"{term.name}.{p.name}"])[0]) == pytest.approx(truth[p.name], rel=1e-4), p.name


def test_sum_is_the_sum_of_its_terms():
    surface, geom = models.get("lambertian+lafortune:2+mirror"), scattered(19, 50)
    values = surface.defaults()
    values["lafortune.2.tilt"] = 1.0
    lobes = [models.term("lafortune")(geom), models.term("lafortune")(geom, tilt=1.0)]
    np.testing.assert_allclose(surface(geom, values), models.term("lambertian")(geom) + lobes[0] + lobes[1], rtol=1e-15)
    np.testing.assert_allclose(surface.mirror(geom, values), models.term("mirror").mirror(geom, n=1.5, k=0.0, sigma=0.0), rtol=1e-15)
