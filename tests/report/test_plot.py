"""The figures of a ranking: what is drawn, from which directions, and files that come out the same twice."""

from types import SimpleNamespace

import numpy as np
import pytest

from brdfguide import models, outputs
from brdfguide.errors import InputError
from brdfguide.geometry import Geometry, in_plane, rows
from brdfguide.measurement import Measurement
from brdfguide.report import plot

TRUE = {"lambertian.albedo": np.array([0.4, 0.5]), "ward.rho_s": np.array([0.1, 0.1]), "ward.alpha": 0.2}


def scan(angles=(10.0, 30.0, 45.0, 60.0, 75.0)) -> Measurement:
    """A two-channel scan in the plane of incidence, made by lambertian+ward."""
    theta_i, theta_r = np.meshgrid(angles, np.arange(-80, 81, 5.0), indexing="ij")
    geom = rows(in_plane(theta_i, theta_r, np.array([0.45, 0.55])))
    return Measurement(geom, models.get("lambertian+ward")(geom, TRUE), ("450nm", "550nm"))


def row(name, rms_ln, ns, on_front, values=None):
    model = models.get(name)
    return SimpleNamespace(fit=SimpleNamespace(model=model, name=name, values=values or model.defaults()), rms_ln=rms_ln, ns_per_sample=ns, on_front=on_front)


def ranking(times=True):
    rows_ = [row("lambertian+ward", 0.01, 30, True, TRUE), row("ward", 0.4, 20, True), row("lambertian", 0.6, 25, False)]
    for each in rows_:
        each.ns_per_sample = each.ns_per_sample if times else None
    return SimpleNamespace(rows=rows_)


@pytest.mark.parametrize("suffix", outputs.PICTURES)
def test_a_figure_is_the_same_file_each_time(tmp_path, suffix):
    first, second = tmp_path / f"a.{suffix}", tmp_path / f"b.{suffix}"
    plot.fit(ranking(), scan(), first)
    plot.fit(ranking(), scan(), second)
    assert first.read_bytes() == second.read_bytes()
    assert list(tmp_path.glob(".*")) == []


def test_an_unknown_kind_of_picture_is_refused_before_drawing(tmp_path):
    with pytest.raises(InputError, match="no kind of picture called 'jpg'; .*there are: png, svg, pdf"):
        plot.fit(ranking(), scan(), tmp_path / "a.jpg")


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match="cannot write .*nowhere"):
        plot.fit(ranking(), scan(), tmp_path / "nowhere" / "a.svg")


def test_panels_are_the_least_the_middle_and_the_largest_incidence():
    panels, (off_plane, _) = plot.slices(scan(), 0)
    assert [theta_i for theta_i, _ in panels] == [10, 45, 75] and off_plane < 1


def test_a_hemisphere_is_cut_near_the_plane_of_incidence():
    rng = np.random.default_rng(1)
    theta_i, theta_r, phi = rng.uniform(5, 80, 6000), rng.uniform(0, 85, 6000), rng.uniform(0, 360, 6000)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi, np.array([0.55])))
    panels, (off_plane, spread) = plot.slices(Measurement(geom, np.ones((6000, 1))), 0)
    assert len(panels) == 3
    for centre, picked in panels:
        assert np.all(geom.off_plane_deg[picked] <= off_plane) and picked.size >= plot.LEAST_POINTS
        assert np.all(np.abs(geom.theta_i_deg[picked, 0] - centre) <= spread)


def test_the_channel_drawn_is_the_one_nearest_550_nm_that_has_values():
    full = scan()
    assert plot.nominal_channel(full) == 1
    empty = full.brdf.copy()
    empty[:, 1] = np.nan
    assert plot.nominal_channel(Measurement(full.geom, empty, full.channels)) == 0


def test_the_line_drawn_is_the_model_itself():
    line = plot.lines_of(ranking())[0]
    drawn = plot.curve(line, 45.0, np.array([50.0]), 0.55, 1)
    geom = in_plane(45, 50)
    expected = models.term("lambertian")(geom, albedo=0.5) + models.term("ward")(geom, rho_s=0.1, alpha=0.2)
    np.testing.assert_allclose(drawn[0], expected, rtol=1e-14)


def test_many_models_are_drawn_as_the_best_and_the_reports_families():
    names = ["lambertian+ggx", "lambertian+beckmann", "lambertian+ward-gmd", "lambertian+lafortune:2", "ward", "lambertian+ward", "phong-lewis", "phong"]
    lines = [plot.Line(name, None, {}, 0.1) for name in names]
    assert [line.name for line in plot.chosen(lines)] == ["lambertian+ggx", "lambertian+lafortune:2", "ward", "phong"]


def test_without_times_the_errors_are_drawn_alone(tmp_path):
    plot.fit(ranking(times=False), scan(), tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_no_point_and_no_name_lies_outside_the_frame():
    fig = plot.cost(plot.lines_of(ranking()))
    fig.draw_without_rendering()
    frame = fig.axes[0].get_window_extent()
    for text in fig.axes[0].texts:
        box = text.get_window_extent()
        assert frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1, text.get_text()


@pytest.mark.parametrize("errors", [(0.75, 1.13), (0.056, 0.061), (0.07, 2.2)])
def test_an_axis_of_errors_has_at_least_two_numbers(errors):
    lines = [plot.Line(name, None, {}, error, ns, True) for name, error, ns in zip(("ward", "ggx"), errors, (50, 20))]
    axis = plot.cost(lines).axes[0]
    low, high = axis.get_ylim()
    assert np.count_nonzero((axis.get_yticks() >= low) & (axis.get_yticks() <= high)) >= 2
