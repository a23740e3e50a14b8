"""The report's Figure 14 drawn anew: the answer is on it, files are whole and come out the same twice."""

import numpy as np
import pytest

from brdfguide import cli
from brdfguide.physics import emergence as roughness
from brdfguide.report.documents import emergence
from brdfguide.report.figures import emergence as emergence_plot
from brdfguide.report.figures import style


def lines_of(figure):
    return {line.get_label(): line for line in figure.axes[0].lines}


def test_the_answers_lie_on_the_figure_and_the_criterion_on_its_contour():
    result = emergence.document(angle=75.0)
    figure = emergence_plot.figure14(result)
    axes = figure.axes[0]
    point = next(line for label, line in lines_of(figure).items() if "criterion" in label)
    (tau,), (sigma,) = point.get_data()
    assert (sigma, tau) == roughness.crossing(75.0, 0.1)
    solid = [line for line in axes.lines if len(line.get_xdata()) > 2 and line.get_linestyle() == "-"]
    assert len(solid) == 6  # one contour for each angle of Table 2
    on_contour = solid[3]
    assert np.exp(
        np.interp(np.log(tau), np.log(on_contour.get_xdata()), np.log(on_contour.get_ydata()))
    ) == pytest.approx(sigma, rel=1e-3)


def test_eq_3_is_drawn_only_for_the_eye_it_was_made_for():
    def dotted(figure):
        return sum(len(line.get_xdata()) > 2 and line.get_linestyle() != "-" for line in figure.axes[0].lines)

    assert dotted(emergence_plot.figure14(emergence.document(angle=80.0))) == 6
    assert dotted(emergence_plot.figure14(emergence.document(angle=80.0, pupil_mm=5.0))) == 0


def test_an_angle_between_the_contours_gets_its_own():
    assert (
        len(emergence_plot.figure14(emergence.document(angle=70.0)).axes[0].lines)
        == len(emergence_plot.figure14(emergence.document(angle=75.0)).axes[0].lines) + 1
    )


@pytest.mark.parametrize("suffix, begins", [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_plot_option_writes_a_whole_picture(tmp_path, capsys, suffix, begins):
    path = tmp_path / f"figure.{suffix}"
    with pytest.raises(SystemExit) as end:
        cli.main(["roughness", "--angle", "80", "--plot", str(path)])
    assert end.value.code == 0 and f"wrote {path}" in capsys.readouterr().err
    first = path.read_bytes()
    assert first.startswith(begins)
    assert style.figure_file(emergence_plot.figure14(emergence.document(angle=80.0)), suffix) == first


def test_an_unknown_kind_of_picture_is_refused_before_anything_is_printed(tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main(["roughness", "--angle", "80", "--plot", str(tmp_path / "figure.gif")])
    assert end.value.code == 2
    captured = capsys.readouterr()
    assert captured.out == "" and "there are: png, svg, pdf" in captured.err
