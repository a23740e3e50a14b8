"""The pictures of a grain: there where data have one, right in what they draw, absent elsewhere."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.lobe_ellipse import widths_of_turns
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.report.figures import grain, inspection, panels
from brdfguide.report.figures.lines import Line

WIDE, NARROW, AXIS = 0.3, 0.1, 30.0
TURNS = (0.0, 30.0, 60.0, 90.0, 120.0, 150.0)


def scans(alpha_x=WIDE, alpha_y=NARROW, turns=TURNS):
    """A metal of Gaussian slopes in the plane of incidence under some turns."""
    law = models.term("beckmann-aniso")
    signed = np.arange(-70.0, 71.0, 2.0)
    turn, theta_i, theta_r = (each.ravel() for each in np.meshgrid(turns, (10.0, 30.0, 50.0), signed, indexing="ij"))
    side = np.where(theta_r < 0, 0.0, 180.0)
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + side, np.array([0.55])))
    values = {"alpha_x": alpha_x, "alpha_y": alpha_y, "axis": np.radians(AXIS), "n": 1.0, "k": 6.0, "scale": 1.0}
    return Measurement(geom, law(geom, **values) + 1e-4, ("brdf",), name="made.csv")


@pytest.fixture(scope="module")
def drawn():
    data = scans()
    surface = Surface.named("beckmann-aniso", {"alpha_x": WIDE, "alpha_y": NARROW, "axis": AXIS, "n": 1.0, "k": 6.0})
    line = Line("beckmann-aniso", surface, 0.01, recommended=True)
    return data, grain.plot_grain(grain.grain_of(data), [line])


def test_the_widths_of_turns_follow_the_ellipse():
    found = widths_of_turns(scans())
    assert sorted(np.degrees(list(found))) == pytest.approx(TURNS)
    for azimuth, width in found.items():
        expected = grain.effective_width(WIDE, NARROW, np.radians(AXIS), azimuth)
        assert width == pytest.approx(expected, rel=0.08)


def test_scans_along_the_axis_between_and_across_are_drawn_with_the_models_curves(drawn):
    data, figure = drawn
    axes = figure.axes[0]
    words = [text.get_text() for text in axes.get_legend().get_texts()]
    assert words == ["30°: 0° off the axis", "60°: 30° off the axis", "120°: 90° off the axis"]
    dots, curves = axes.get_lines()[0::2], axes.get_lines()[1::2]
    for points, curve in zip(dots, curves, strict=True):
        model = np.interp(points.get_xdata(), curve.get_xdata(), curve.get_ydata())
        np.testing.assert_allclose(model, points.get_ydata(), rtol=0.02, atol=2e-3)


def test_both_ellipses_lie_along_the_axis(drawn):
    ellipses = [line.get_xydata() for line in drawn[1].axes[1].get_lines()]
    assert len(ellipses) == 2
    for each in ellipses:
        far = each[np.argmax(np.hypot(*each.T))]
        assert np.degrees(np.arctan2(far[1], far[0])) % 180 == pytest.approx(AXIS, abs=2)
        assert np.hypot(*far) == pytest.approx(WIDE, rel=0.08)


def test_dots_of_the_width_lie_on_the_curve(drawn):
    polar = next(axes for axes in drawn[1].axes if axes.name == "polar")
    [dots] = [line for line in polar.get_lines() if line.get_marker() == "o"]
    assert len(dots.get_xdata()) == 2 * len(TURNS)
    expected = grain.effective_width(WIDE, NARROW, np.radians(AXIS), dots.get_xdata())
    np.testing.assert_allclose(dots.get_ydata(), expected, rtol=0.08)


def test_a_round_sample_and_one_without_turns_have_no_such_picture():
    assert grain.grain_of(scans(alpha_x=0.2, alpha_y=0.2)) is None
    assert grain.grain_of(scans(turns=(0.0,))) is None


def test_incidences_are_drawn_of_one_turn(drawn):
    found = panels.panels(drawn[0], 0)
    assert found.how == "in plane, light at azimuth 0°" and len(found.shown) == 3
    for panel in found.shown:
        assert np.ptp(panel.geom.phi_i_deg) == 0
        np.testing.assert_array_equal(drawn[0].brdf[panel.rows, 0], panel.value)
    turned = panels.panels(scans(turns=(20.0, 65.0)), 0)
    assert {panel.azimuth for panel in turned.shown} == {20.0}


def test_the_survey_has_three_panels_more(tmp_path, monkeypatch):
    kept = []
    monkeypatch.setattr(inspection.style, "save", lambda figure, path, theme: kept.append(figure))
    for data in (scans(), scans(alpha_x=0.2, alpha_y=0.2)):
        calm = np.zeros(len(data.geom), bool)
        inspection.plot_survey(data, calm, None, None, tmp_path / "it.png", "made")
    with_grain, without = (sum(len(part.axes) for part in figure.subfigs or [figure]) for figure in kept)
    assert with_grain == without + 4  # three panels and a scale of colours


def test_a_hemisphere_under_one_azimuth_is_drawn_too():
    law = models.term("beckmann-aniso")
    theta_i, theta_r, phi = (
        each.ravel()
        for each in np.meshgrid((10.0, 25.0, 40.0), np.arange(1.0, 75, 4), np.arange(0.0, 360, 10), indexing="ij")
    )
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi, np.array([0.55])))
    values = {"alpha_x": WIDE, "alpha_y": NARROW, "axis": np.radians(AXIS), "n": 1.0, "k": 6.0, "scale": 1.0}
    data = Measurement(geom, law(geom, **values) + 1e-4, ("brdf",), name="made.csv")
    found = grain.grain_of(data)
    assert found is not None and widths_of_turns(data) == {}
    assert np.degrees(found.ellipse.axis) == pytest.approx(AXIS, abs=2)
    assert len(grain.plot_grain(replace(found, theta_i=25.0)).axes) == 4
