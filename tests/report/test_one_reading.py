"""What is fitted, drawn, listed and evaluated is one reading: with an aperture of 3 degrees and a mirror part."""

import json
import subprocess
import sys

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting import cross_validation, fit, next_measurement, ranking
from brdfguide.fitting.job import Job, read_for_fit
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.reading import with_slopes
from brdfguide.physics.aperture import Instrument
from brdfguide.physics.geometry import in_plane, rows
from brdfguide.report.documents import values
from brdfguide.report.documents.fit import fit_document
from brdfguide.report.figures import lines as drawn
from brdfguide.report.figures import lobes as drawing
from brdfguide.report.figures import sketch
from brdfguide.report.figures.panels import panels

from ..conftest import ROOT

STEEL = ROOT / "examples" / "smooth_steel.csv"
NAMES = ("he-torrance", "ggx")


@pytest.fixture(scope="module")
def steel():
    return read_for_fit(STEEL, Job(aperture_deg=3.0))


@pytest.fixture(scope="module")
def ranked(steel):
    return ranking.rank(fit.fit_all(map(models.get, NAMES), steel), steel)


def fitted(row, steel) -> np.ndarray:
    """What the fit itself compared with the data, (samples, channels)."""
    return steel.brdf * np.exp(row.fit.residuals)


def test_the_mirror_part_and_the_aperture_count_in_this_example(ranked, steel):
    best = next(row.fit for row in ranked.rows if row.fit.name == "he-torrance")
    point = best.surface.brdf(steel.geom)
    ratio = fitted(next(row for row in ranked.rows if row.fit.name == "he-torrance"), steel) / point
    assert best.model.has_mirror and np.nanmin(ratio) < 0.98 and np.nanmax(ratio) > 1.15


def test_residuals_listed_are_those_fitted(ranked, steel):
    for row in ranked.rows:
        listed = values.residuals(row.fit, steel)
        model = np.array([each[listed["columns"].index("model")] for each in listed["rows"]])
        expected = fitted(row, steel)
        np.testing.assert_allclose(model, expected[np.isfinite(expected)], rtol=1e-12)


def test_points_and_curves_drawn_are_those_fitted(ranked, steel):
    lines = drawn.lines_of(ranked)
    fig = drawing.plot_lobes(lines, steel)
    shown = panels(steel, 0).shown
    strips = fig.axes[len(shown) :]
    for panel, axis in zip(shown, strips, strict=True):
        theta_i, picked = panel.theta_i, panel.rows
        for row, line, points in zip(ranked.rows, lines, axis.get_lines(), strict=False):
            expected = fitted(row, steel)[picked, 0]
            np.testing.assert_allclose(points.get_ydata(), row.fit.residuals[picked, 0], rtol=0, atol=1e-12)
            theta_r = steel.geom.signed_theta_r_deg[picked, 0]
            held = np.abs(steel.geom.theta_i_deg[picked, 0] - theta_i) < 1e-9
            curve = drawn.curve(line, 0, theta_i, theta_r, steel.solid_angle)
            np.testing.assert_allclose(curve[held], expected[held], rtol=1e-9)  # the plane's angles, not the data's


def test_the_curve_on_the_figure_is_what_the_instrument_reads(ranked, steel):
    """Every curve of a panel, at the angles that it is drawn at."""
    lines = drawn.lines_of(ranked)
    fig = drawing.plot_lobes(lines, steel)
    shown = panels(steel, 0).shown
    for panel, axis in zip(shown, fig.axes[: len(shown)], strict=True):
        for line, curve in zip(lines, axis.get_lines(), strict=False):
            grid, shown = curve.get_data()
            instrument = Instrument(rows(in_plane(panel.theta_i, grid)), steel.solid_angle)
            layout = Layout(line.surface.model, 1)
            read, _ = with_slopes(layout, line.surface, instrument)
            np.testing.assert_allclose(shown, read[:, 0], rtol=1e-12)


def test_the_sketch_on_a_terminal_is_the_model_fitted(ranked, steel):
    """Cells of braille that hold data are passed by the model: a detector taken for a point would miss the peak."""
    line = next(line for line in drawn.lines_of(ranked) if line.name == "he-torrance")
    text = sketch.sketch_lobes(line, steel, width=110, colour=True)
    point = sketch.sketch_lobes(line, steel.__class__(steel.geom, steel.brdf), width=110, colour=True)
    assert text != point


def test_growth_is_of_what_the_instrument_reads(ranked, steel):
    row = next(row for row in ranked.rows if row.fit.name == "he-torrance")
    grown = cross_validation.growth(row.fit, steel)
    low, high = grown["theta_i_deg"]
    line = next(line for line in drawn.lines_of(ranked) if line.name == "he-torrance")
    peaks = [drawn.curve(line, 0, theta, np.array([theta]), steel.solid_angle)[0] for theta in (low, high)]
    assert grown["r_mirror"] == pytest.approx(peaks[1] / peaks[0], rel=1e-12)


def test_the_next_direction_is_judged_by_what_the_instrument_reads(ranked, steel):
    one, other = (row.fit for row in ranked.rows)
    there = Instrument(steel.geom, steel.solid_angle)
    apart = np.abs(one.residuals - other.residuals)[:, 0]
    np.testing.assert_allclose(next_measurement.difference_at(one, other, there), apart, rtol=1e-9, atol=1e-12)


def test_evaluate_gives_what_was_fitted_through_the_aperture_of_the_fit(tmp_path, ranked, steel):
    path = tmp_path / "fit.json"
    path.write_text(json.dumps(fit_document(ranked, steel)))
    for row in ranked.rows:
        words = ("evaluate", "--fit", path, "--model", row.fit.name, "--data", STEEL, "--json")
        run = [sys.executable, "-m", "brdfguide", *map(str, words)]
        told = json.loads(subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=True).stdout)
        assert told["solid_angle_sr"] == steel.solid_angle
        model = np.array([each[told["columns"].index("brdf")] for each in told["rows"]])
        expected = fitted(row, steel)[:, 0]
        seen = np.isfinite(expected)
        np.testing.assert_allclose(model[seen], expected[seen], rtol=1e-12)
