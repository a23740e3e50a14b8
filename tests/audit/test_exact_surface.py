"""Surfaces of an answer, evaluated by the laws that are written down a second time, against the program's."""

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mp, mpf, workdps

from brdfguide import models
from brdfguide.audit import exact_surface, textbook, textbook_more
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.reading import reading
from brdfguide.models.surface import Surface
from brdfguide.physics.aperture import Instrument
from brdfguide.physics.geometry import Geometry, rows

from .. import synthetic


@pytest.mark.parametrize(
    "expression",
    [
        *("lambertian+beckmann+beckmann", "beckmann:2+lambertian", "beckmann+lambertian+ggx:2+beckmann:2"),
        *("ggx+coated:lambertian+ggx", "beckmann:2+coated:lambertian+flakes", "ward:2+lambertian+ward"),
    ],
)
def test_lobes_of_one_law_are_counted_over_all_words(expression):
    surface = Surface(
        models.get(expression), synthetic.random_values(Layout(models.get(expression), 1), np.random.default_rng(7))
    )
    geom = rows(Geometry.from_degrees([30.0, 60.0], 0.0, [20.0, 65.0], [180.0, 150.0]))
    parameters = {key: {"value": np.squeeze(value).tolist()} for key, value in surface.values.items()}
    exact = exact_surface.surface_of(surface.model.name, parameters)
    with workdps(30):
        for value, theta_i, theta_r, phi in zip(surface.brdf(geom)[:, 0], (30, 60), (20, 65), (180, 150), strict=True):
            sight = exact_surface.ExactReading((theta_i, 0.0, theta_r, phi))
            assert value == pytest.approx(float(sight.reading(exact, 0, mpf(0.55))), rel=1e-11)


@pytest.mark.parametrize("pin", models.term("he-torrance").pins, ids=lambda pin: pin.source)
def test_he_torrance_is_written_down_a_second_time(pin):
    angles = (pin.geom.theta_i_deg, pin.geom.phi_i_deg, pin.geom.theta_r_deg, pin.geom.phi_i_deg + pin.geom.phi_deg)
    values = {**models.term("he-torrance").defaults(), **pin.values, "wavelength": float(pin.geom.wavelength)}
    right = textbook_more.exact_value("he-torrance", [float(np.squeeze(a)) for a in angles], values)
    assert float(right) == pytest.approx(pin.f, rel=1e-15)


def test_a_coat_an_aperture_and_its_mirror_beam_are_too():
    surface = Surface.named("coated:lambertian+flakes", {"lambertian.albedo": 0.4, "coat.sigma": 0.05})
    geom = rows(Geometry.from_degrees([30.0, 30.0, 60.0], 0.0, [30.0, 10.0, 50.0], [180.0, 90.0, 181.0]))
    ours = reading(surface, Instrument(geom, 0.003))[:, 0]
    parameters = {key: {"value": float(np.squeeze(value))} for key, value in surface.values.items()}
    exact = exact_surface.surface_of("coated:lambertian+flakes", parameters)
    with workdps(30):
        for value, theta_i, theta_r, phi in zip(ours, (30, 30, 60), (30, 10, 50), (180, 90, 181), strict=True):
            sight = exact_surface.ExactReading((theta_i, 0.0, theta_r, phi), 0.003)
            assert value == pytest.approx(float(sight.reading(exact, 0, mpf(0.55))), rel=1e-11)
    assert mp.dps == 15


@pytest.mark.parametrize(("model", "times"), [("lambertian+ggx", 7), ("ggx+coated:lambertian", 7)])
def test_what_channels_share_is_evaluated_once(model, times, monkeypatch):
    """Of six channels: a lobe once, and each body by itself."""
    draw = np.random.default_rng(5)
    parameters = {
        key: {"value": draw.uniform(0.2, 0.6, 6).tolist() if each.per_channel else 0.3}
        for key, each in models.get(model).parameters.items()
    }
    parameters |= {key: {"value": 1.5 if key.endswith(".n") else 0.0} for key in parameters if key[-2:] in (".n", ".k")}
    calls, evaluated = [], textbook_more.evaluated
    monkeypatch.setattr(textbook_more, "evaluated", lambda *words: calls.append(words) or evaluated(*words))
    surface, pair = exact_surface.surface_of(model, parameters), textbook.ExactDirections(30.0, 0.0, 35.0, 170.0)
    together = [surface.brdf(pair, channel, mpf("0.55")) for channel in range(6)]
    assert len(calls) == times
    for channel, found in enumerate(together):
        one = {
            key: {"value": v["value"][channel] if isinstance(v["value"], list) else v["value"]}
            for key, v in parameters.items()
        }
        assert abs(found / exact_surface.surface_of(model, one).brdf(pair, 0, mpf("0.55")) - 1) < 1e-14
