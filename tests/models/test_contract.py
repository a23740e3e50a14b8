"""The laws that every model obeys, or breaks and says so: finite, positive, dark below the horizon, reciprocal, ..."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.geometry import Geometry

TERMS = [models.term(name) for name in models.names()]
NAMES = [term.name for term in TERMS]


@pytest.mark.parametrize("term", TERMS, ids=NAMES)
def test_pins_are_met(term):
    for pin in term.pins:
        assert float(term(pin.geom, **pin.values)) == pytest.approx(pin.f, rel=pin.rtol, abs=0)


@pytest.mark.parametrize("term", TERMS, ids=NAMES)
def test_extremes_are_finite_and_met(term):
    for extreme in term.extremes:
        f = term(extreme.geom, **extreme.values)
        assert np.isfinite(f) and f >= 0, extreme.why
        if extreme.f is not None:
            assert float(f) == pytest.approx(extreme.f, rel=extreme.rtol, abs=0), extreme.why


@pytest.mark.parametrize("term", TERMS, ids=NAMES)
def test_nothing_is_sent_below_the_horizon(term):
    geom = Geometry.from_degrees([[30.0], [95.0], [90.0]], 0.0, [[100.0], [20.0], [89.0]], 180.0)
    assert np.all(term(geom) == 0.0)
