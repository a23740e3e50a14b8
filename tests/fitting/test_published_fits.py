"""He-Torrance fits that others published (Ngan, Durand and Matusik 2005, to MERL): evaluated, and their known
degeneracies found.

Units and conventions as read from the numbers: `roughness` is sigma and `autocorrelation` tau [um] (2 sigma/tau is the
slope of their Ward fits), `eta` a real index, `albedo` of the lobe an amplitude for each colour, our `scale`.
"""

import re
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.fitting.diagnostics import sigma_bound, standard_errors
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import Misfit, metric
from brdfguide.numerics import least_squares
from brdfguide.physics.geometry import in_plane, rows

SUM = replace(models.get("lambertian+he-torrance"), free=("he-torrance.scale",))
COLOURS_UM = np.array([0.64, 0.55, 0.46])
NUMBER, THREE = r"([0-9.eE+-]+)", r"\[([^\]]*)\]"
LINE = re.compile(
    (
        rf"^(\S+) = Aggregate\(Lambertian\(albedo = {THREE}\), NganHe\(albedo = {THREE}, autocorrelation = {NUMBER}, "
        rf"roughness = {NUMBER}, eta = {NUMBER}\)\)$"
    ),
    re.M,
)


@pytest.fixture(scope="module")
def fits(data):
    """Material -> (values, tau).

    An index printed as 1.0 is taken as 1.0005, what its digits allow: at 1 there is no surface.
    """
    text = (data / "merl_fits" / "ngan_he.fit").read_text()
    found = {}
    for match in LINE.finditer(text):
        name, albedo, scale = match[1], *(np.array([float(each) for each in match[i].split(",")]) for i in (2, 3))
        tau, sigma, n = map(float, match.group(4, 5, 6))
        values = {"lambertian.albedo": albedo, "he-torrance.sigma": sigma, "he-torrance.slope": sigma / tau}
        found[name] = (
            values | {"he-torrance.n": np.full(3, max(n, 1.0005)), "he-torrance.k": 0.0, "he-torrance.scale": scale},
            tau,
        )
    assert len(found) == sum(" = Aggregate" in line for line in text.splitlines()) >= 40
    return found


def scan(step):
    theta_i, theta_r = np.meshgrid([5.0, 20.0, 35.0, 50.0, 65.0, 78.0], np.arange(-84.0, 85.0, step))
    return rows(in_plane(theta_i.ravel(), theta_r.ravel())).at(COLOURS_UM)


def doubts(values, noise):
    """What a fit that ended at these values would say, on data made from them."""
    geom = scan(6.0)
    data = Measurement(geom, SUM(geom, values), ("r", "g", "b"))
    layout = Layout(SUM, 3)
    start = layout.encode(values)
    normal, *_ = least_squares._normal(*Misfit(layout, data, metric("ln"), np.ones_like(data.brdf))(*start, True))
    independent = np.random.default_rng(0).normal(size=data.brdf.shape)
    stderr = standard_errors.standard_errors(layout, values, *normal.variances(noise**2), independent, 0.0)
    found = sigma_bound.in_place_of(
        standard_errors.parameter_doubts(layout, values, stderr, normal, noise**2),
        sigma_bound.rough_regime_doubts(layout, data, *start, noise**2, stderr),
    )
    return {finding.printed: dict(finding.numbers) for finding in found}


def test_every_published_fit_evaluates_to_finite_positive_numbers(fits):
    geom = scan(3.0)
    for name, (values, _) in fits.items():
        f = SUM(geom, values)
        assert np.all(np.isfinite(f)) and np.all(f > 0), name
        rho = SUM.mirror(geom, values)
        assert np.all(np.isfinite(rho)) and np.all(rho >= 0), name


def test_the_rough_ones_would_have_been_told_that_only_their_slope_is_determined(fits):
    """25 of their 86 fits kept the tau they started from, 28 um; where sigma > 2 um nothing could have moved it."""
    for name, (values, _) in fits.items():
        sigma, bound = values["he-torrance.sigma"], doubts(values, 0.03).get("rough-regime:he-torrance.sigma")
        if sigma > 2.5:
            assert bound and 0.5 < bound["sigma_um_above"] < sigma, name
        if sigma < 1.0:
            assert bound is None, name


def test_a_scale_of_a_million_with_an_index_of_1_would_have_been_called_undetermined(fits):
    degenerate = [name for name, (values, _) in fits.items() if np.max(values["he-torrance.scale"]) > 1e4]
    assert set(degenerate) == {"black-obsidian", "maroon-plastic"}
    for name in degenerate:
        found = doubts(fits[name][0], 0.03)
        assert {"undetermined:he-torrance.n", "undetermined:he-torrance.scale"} <= found.keys() or "ridge" in found, (
            name
        )
    found = doubts(fits["gray-plastic"][0], 0.03)
    assert not {"undetermined:he-torrance.n", "undetermined:he-torrance.scale"} & found.keys()
