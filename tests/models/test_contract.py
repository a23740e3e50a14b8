"""The contract of every file in models/: the checks of `brdfguide check`, which a law obeys or says that it breaks, a
strict expected failure then; and what only we who call laws need of them.
"""

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from brdfguide import models
from brdfguide.audit import audit, checks
from brdfguide.audit import textbook_more as textbook
from brdfguide.audit.trials import parameter_sets, trial_directions, within
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit
from brdfguide.physics.geometry import Geometry, rows

TERMS = [models.term(name) for name in models.names()]
every_term = pytest.mark.parametrize("term", TERMS, ids=lambda term: term.name)
# what the recovery test hides in its data: away from defaults and from the starts
TRUTH = {
    "alpha": 0.27,
    "alpha_x": 0.27,
    "alpha_y": 0.09,
    "n": 1.72,
    "albedo": 0.37,
    "rho_s": 0.23,
    "exponent": 33.0,
    "ks": 0.31,
    "tilt": 0.9,
    "spread": 0.41,
    "roughness": 0.63,
    "base_color": 0.37,
    "specular_roughness": 0.41,
    "specular_ior": 1.72,
    "ior": 1.72,
    "specular": 0.7,
    "sigma": 0.17,
    "slope": 0.13,
    "exponent_x": 33.0,
    "exponent_y": 210.0,
    "r_s": 0.23,
    "r_d": 0.31,
    "c_x": -0.97,
    "c_y": -0.88,
    "spacing": 2.9,
    "sink": 0.37,
    ("cylinders", "exponent"): 33.0,
    ("lafortune", "exponent"): 7.0,
    ("flakes", "tilt"): 0.17,
    ("flakes-beckmann", "tilt"): 0.17,
    "flake": 0.31,
    "rho": 0.23,
}


def marks(check, term):
    """What a law declares to break it must be seen to break."""
    if check not in term.breaks:
        return ()
    return pytest.mark.xfail(reason=term.breaks[check], raises=AssertionError, strict=True)


CHECKS = [
    pytest.param(check, term, marks=marks(check, term), id=f"{check}-{term.name}".replace(" ", "-"))
    for term in TERMS
    for check in audit.CHECKS
]


# as `check` does, at fewer points: laws whose masking is an integral for each value of a parameter take seconds
SPARSER = {"continuity": partial(checks.continuity, count=0, points=200, suspects=1)}


@pytest.mark.parametrize("check, term", CHECKS)
def test_law_obeys_what_every_law_has_to(check, term):
    measure, allowed, what = audit.CHECKS[check]
    outcome = SPARSER.get(check, measure)(term)
    assert outcome.worst <= allowed, f"{what}: {outcome.worst:.3g} at {outcome.at}"


@every_term
def test_a_law_declares_what_it_breaks_under_the_name_of_a_check(term):
    assert term.breaks.keys() <= audit.CHECKS.keys() and all(term.breaks.values())


@every_term
def test_pins_lie_away_from_the_defaults(term):
    assert term.pins or not np.any(term(trial_directions(1))), "a law without a value that was computed elsewhere"
    for pin in term.pins:
        assert any(pin.values[name] != value for name, value in term.defaults().items() if name in pin.values)


@every_term
def test_a_law_asks_to_be_tried_where_it_can_be(term):
    asks = term.candidacy
    if asks is None:
        return
    assert term.is_body != term.is_lobe and 1 <= asks.lobes <= models.MOST_LOBES
    assert term.is_lobe or not (asks.substitutes or asks.lobes > 1)
    assert term.is_body or asks.under is None
    assert not asks.substitutes or term.amplitude, "it takes the height of the lobe that it stands in for"
    assert all(models.term(name).is_lobe for name in asks.under or ())


@every_term
def test_scalars_arrays_and_channels_agree(term):
    geom = trial_directions(16, 50)
    values = next(parameter_sets(term, 16))
    column = term(geom, **values)
    assert column.shape == (50, 1)
    for row in (0, 17):
        assert float(term(geom[row], **values)[0]) == float(column[row, 0])
    channels = {
        p.name: np.array([within(p, 0.4), within(p, 0.6)]) if p.per_channel else values[p.name] for p in term.parameters
    }
    both = term(geom.at(np.array([0.45, 0.65])), **channels)
    assert both.shape[0] == 50
    for place, wavelength in enumerate((0.45, 0.65)):
        single = {name: value[place] if np.ndim(value) else value for name, value in channels.items()}
        alone = term(geom.at(wavelength), **single)[:, 0]
        np.testing.assert_allclose(np.broadcast_to(both, (50, 2))[:, place], alone, rtol=1e-14)


@every_term
def test_brdf_is_proportional_to_its_amplitude(term):
    if term.amplitude is None:  # a body that is quadratic in its albedo, an ideal mirror
        return
    geom = trial_directions(17, 50)
    values = {**term.defaults(), term.amplitude: 0.25}
    np.testing.assert_allclose(term(geom, **{**values, term.amplitude: 0.75}), 3 * term(geom, **values), rtol=1e-14)


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
    theta_r = data.draw(
        st.one_of(angle, st.floats(-1e-3, 1e-3).map(lambda d: abs(min(theta_i + d, 89.9999)))), "theta_r"
    )
    phi_r = data.draw(st.one_of(st.floats(-360, 360), st.just(180.0)), "phi_r")
    angles = (theta_i, 0.0, theta_r, phi_r)
    right = float(textbook.exact_value(term.name, angles, values))
    geom = Geometry.from_degrees(*angles)
    got = float(term(geom, **values))
    # as right as the law itself, were the angles off by 1e-14° and the parameters by 1e-15 of their value
    moved = [
        (theta_i + 1e-14, 0, theta_r, phi_r),
        (theta_i, 0, theta_r + 1e-14, phi_r),
        (theta_i, 0, theta_r, phi_r + 5e-14),
    ]
    blur = [float(textbook.exact_value(term.name, other, values)) - right for other in moved]
    blur += [
        float(textbook.exact_value(term.name, angles, {**values, name: value * (1 + 1e-15)})) - right
        for name, value in values.items()
    ]
    tolerance = 1e-13 * right + 2 * sum(map(abs, blur)) + 1e-290
    if "exponent" in values and right > 0:  # and as right as a power whose base is off by 1e-15
        base = (right / values["ks"]) ** (1 / values["exponent"]) if values["ks"] else 1.0
        tolerance += right * np.expm1(min(values["exponent"] * np.log1p(1e-15 / min(base, 1.0)), 700.0))
    if (
        "r_s" in values and geom.cos_d < 1
    ):  # and as right as Schlick's (1 - cos)^5 whose cos is off by four of its last digits
        tolerance += right * 5 * 2**-51 / (1 - float(geom.cos_d))
    assert got == pytest.approx(right, rel=0, abs=tolerance), (angles, values)


@every_term
def test_any_parameter_may_have_a_value_for_each_channel_at_one_wavelength(term):
    geom, values = trial_directions(20, 30), next(parameter_sets(term, 20))
    for p in term.parameters:
        pair = np.array([within(p, 0.4), within(p, 0.6)])
        both = np.broadcast_to(term(geom, **{**values, p.name: pair}), (30, 2))
        for place in (0, 1):
            np.testing.assert_allclose(both[:, place], term(geom, **{**values, p.name: pair[place]})[:, 0], rtol=1e-13)


@every_term
@pytest.mark.parametrize("start", ["near", "far"])
def test_fit_recovers_the_parameters_that_made_the_data(term, start):
    free = [p for p in term.parameters if p.free]
    if not free or term.is_mirror:
        return
    angles = np.concatenate([np.arange(-80.0, 81, 8), [2.0, 6, 22, 34, 48, 52, 58, 66, 70, 76]])
    # two widths show only where the sample is turned as well
    turns = [0.0, 45.0, 90.0] if term.turns else [0.0]
    turn, theta_i, theta_r = (a.ravel() for a in np.meshgrid(turns, [5.0, 30, 50, 70], angles, indexing="ij"))
    side = np.where(theta_r < 0, 0.0, 180.0)
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + side))
    # a lobe that is 0 where there are data has no ln there: over a body, as it is used
    surface = models.get(f"lambertian+{term.name}" if term.name == "lafortune" else term.name)
    truth = {**term.defaults(), **{p.name: TRUTH.get((term.name, p.name), TRUTH.get(p.name, p.default)) for p in free}}
    keyed = {f"{term.name}.{name}": value for name, value in truth.items()}
    keyed = {**surface.defaults(), **keyed}
    measurement = Measurement(geom, np.broadcast_to(surface(geom, keyed), geom.shape), name=term.name)
    begin = {} if start == "far" else {f"{term.name}.{p.name}": 1.1 * truth[p.name] for p in free if not p.linear}
    found = fit.fit(surface, measurement, fit.FitOptions(start=begin))
    assert found.rms_ln < 1e-6
    for p in free:
        assert float(np.ravel(found.values[f"{term.name}.{p.name}"])[0]) == pytest.approx(truth[p.name], rel=1e-4), (
            p.name
        )


def test_sum_is_the_sum_of_its_terms():
    surface, geom = models.get("lambertian+lafortune:2+mirror"), trial_directions(19, 50)
    values = surface.defaults()
    values["lafortune.2.tilt"] = 1.0
    lobes = [models.term("lafortune")(geom), models.term("lafortune")(geom, tilt=1.0)]
    np.testing.assert_allclose(surface(geom, values), models.term("lambertian")(geom) + lobes[0] + lobes[1], rtol=1e-15)
    np.testing.assert_allclose(
        surface.mirror(geom, values), models.term("mirror").mirror(geom, n=1.5, k=0.0, sigma=0.0), rtol=1e-15
    )
