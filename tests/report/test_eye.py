"""Every figure of every example and given file, looked at by the probe: nothing empty, nothing over anything else."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from brdfguide import models
from brdfguide.advice import library, material
from brdfguide.advice import recommend as advisor
from brdfguide.data import examine, formats
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows
from brdfguide.report.documents import emergence
from brdfguide.report.figures import beta, inspection, lobe_views, lobes, paper, promises, style
from brdfguide.report.figures import emergence as contours
from brdfguide.report.figures import ranking as drawing
from brdfguide.report.figures.dark import darken

from ..conftest import DATA, ROOT
from .probe import faults
from .test_plot import ggx, table

EXAMPLES = sorted((ROOT / "examples").glob("*.csv"))
GIVEN = (
    "merl_format/red-plastic.binary",
    "cornell/garnet_red.brdf",
    "alta/retro-3M-jaune.dat",
    "nist/PTFE.data.csv",
    "mwir/steel_sandblasted.csv",
    "starlink/*.csv",
    "rgl/*.bsdf",
    "zemax/*.bsdf",
    "anisotropic/*azimuths.csv",
)
MOST_SURVEYED = 20_000  # directions; a table is examined elsewhere
CANDIDATES = ("lambertian+ggx", "oren-nayar+ggx", "lambertian+he-torrance", "lambertian+ward", "lambertian+phong")
MATERIALS = ("porcelain", "gold-leaf", "white-paper", "blue-car-paint", "varnished-wood", "chrome")


def given():
    found = [path for pattern in GIVEN for path in sorted(DATA.glob(pattern))[:1]] if DATA.is_dir() else []
    return found or [pytest.param(None, marks=pytest.mark.skip(reason="BRDFGUIDE_DATA names no folder"))]


def ranking(measurement):
    """Models at their start values: what is looked at here are the figures, not the fits."""
    value = np.nanmedian(measurement.brdf[measurement.usable.any(axis=1)])
    rows = []
    for place, name in enumerate(CANDIDATES):
        model = models.get(name)
        start = model.defaults() | {f"{name.split('+')[0]}.albedo": min(np.pi * value, 0.9)}
        surface = Surface(model, start, measurement.channels, measurement.geom.wavelength)
        fit = SimpleNamespace(name=name, surface=surface)
        rows.append(
            SimpleNamespace(
                fit=fit, rms_ln=0.05 * 1.3**place, ns_per_sample=100.0 * 1.1**place, on_front=place in (0, 3)
            )
        )
    return SimpleNamespace(rows=rows, recommended=rows[1])


@pytest.fixture
def saved(monkeypatch):
    """Figures in place of files."""
    kept: list[Figure] = []
    monkeypatch.setattr(style, "save", lambda fig, path, theme="light": kept.append(fig))
    return kept


@pytest.mark.parametrize("path", [*EXAMPLES, *given()], ids=lambda path: path.name if path else "none")
def test_every_figure_of_a_measurement_may_be_shown(path, saved):
    measurement = formats.read(path)
    rows = ranking(measurement)
    drawing.plot_ranking(rows, measurement, path)
    if path in EXAMPLES:
        lobe_views.plot_polar(rows, measurement, path)
    if path in EXAMPLES[:1]:
        beta.plot_beta(rows, measurement, path)
    if len(measurement.brdf) < MOST_SURVEYED:
        inspection.plot_survey(*examine.plotted(measurement), path, path.name)
    assert [fault for fig in saved for fault in faults(fig)] == []


def test_a_survey_of_a_table_slices_it(saved):
    """Panel d: lines through a table of 40,000 half-vector directions where it has no scans, to 3 % of the law."""
    data = table()
    assert len(data.theta_i_groups) > inspection.FEW
    inspection.plot_survey(data, np.zeros(len(data.geom), bool), None, None, "it.png", "made")
    panel = next(axes for axes in saved[0].axes if axes.get_title("left").startswith("d"))
    assert panel.get_title("left") == "d  interpolated into the plane of incidence"
    curves = {line.get_label(): line for line in panel.get_lines() if len(line.get_xdata()) > 100}
    assert list(curves) == ["10°", "45°", "75°"]
    for theta_i, line in zip((10.0, 45.0, 75.0), curves.values(), strict=True):
        expected = ggx(in_plane(theta_i, line.get_xdata()))
        assert np.median(np.abs(np.log(line.get_ydata() / expected))) < 0.03
    assert faults(saved[0]) == []


def test_a_survey_without_a_value_says_so(saved):
    data = Measurement(rows(in_plane(30.0, np.arange(0.0, 60, 10))), np.zeros((6, 1)))
    inspection.plot_survey(data, np.zeros(6, bool), None, None, "it.png", "made")
    panel = next(axes for axes in saved[0].axes if axes.get_title("left").startswith("d"))
    assert [text.get_text() for text in panel.texts] == ["no positive value"] and faults(saved[0]) == []


@pytest.mark.parametrize("name", MATERIALS)
def test_every_figure_of_a_description_may_be_shown(name):
    found = advisor.recommend(material.read_material(library.path(name)))
    assert faults(promises.promised(found.candidates, name=name)) == []


@pytest.mark.parametrize("name, spiky", [("porcelain", True), ("copper", False)])
def test_spikes_are_explained_where_there_are_some(name, spiky):
    """The He-Torrance of copper has a mirror image that is nothing to see."""
    found = advisor.recommend(material.read_material(library.path(name)))
    assert any(each.model.has_mirror for each in found.candidates)
    assert ("spikes" in promises.promised(found.candidates, name=name).get_supxlabel()) == spiky


@pytest.mark.parametrize("number", [1, 2, 13, 14])
def test_the_reports_figures_of_laws_may_be_shown(number):
    assert faults(paper.plot_figure(number)) == []


def test_a_lobe_in_space_may_be_shown(saved):
    measurement = formats.read(EXAMPLES[0])
    lobe_views.plot_in_space(ranking(measurement), measurement, "lobe.png")
    assert faults(saved[0]) == []


def test_contours_with_an_answer_may_be_shown():
    assert faults(contours.figure14(emergence.document(angle=80.0, slope=0.1))) == []


@pytest.mark.parametrize("spoil, words", [("text", "over each other"), ("panel", "empty"), ("limits", "outside")])
def test_the_probe_sees_what_is_wrong(spoil, words):
    with style.look():
        fig = style.figure(120, 80)
        axis, _ = fig.subplots(1, 2)[:2]
        fig.axes[1].plot([0, 1], [0, 1])
        axis.plot([0, 1, 2], [1, 2, 3], "o", color=style.INK)
        if spoil == "text":
            axis.text(0.5, 2, "one")
            axis.text(0.5, 2, "other")
        elif spoil == "panel":
            fig.axes[1].lines[0].remove()
        else:
            axis.set_ylim(0, 2.5)
    assert any(words in fault for fault in faults(fig))


def test_a_lobe_in_space_keeps_its_shades_on_a_dark_ground():
    """What the surface gives back as its colours is in the order of depth, which is not that of its facets."""
    fig = style.figure(90, 72)
    axis = fig.add_subplot(projection="3d")
    x, y = np.meshgrid(np.linspace(-1, 1, 12), np.linspace(-1, 1, 12))
    surface = axis.plot_surface(x, y, np.exp(-(x**2) - y**2), facecolors=lobe_views.HEIGHT(x**2 + y**2))
    fig.draw_without_rendering()
    before = np.array(surface.get_facecolor())
    darken(fig)
    fig.draw_without_rendering()
    np.testing.assert_array_equal(surface.get_facecolor(), before)


@pytest.mark.parametrize(("low", "high", "most"), [(2e-16, 0.2, 10), (1e-3, 0.5, 10), (0.03, 0.2, 8)])
def test_numbers_on_a_log_axis_are_plain_and_keep_apart(low, high, most):
    axis = style.figure(90, 72).subplots()
    axis.set(yscale="log", ylim=(low, high))
    lobes.plain_log(axis.yaxis)
    axis.figure.draw_without_rendering()
    shown = [label.get_text() for label in axis.get_yticklabels() if label.get_text()]
    inside = [text for text in shown if low <= float(text) <= high]
    assert 2 <= len(inside) <= most, shown
