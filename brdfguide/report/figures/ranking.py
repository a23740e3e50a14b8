"""A ranking as a figure: its lobes, what is left, and error against run time; and the figures of its page."""

from ...data.measurement import Measurement
from . import spheres, style
from .cost import cost_height_mm, draw_cost, plot_cost
from .grain import HEIGHT_MM, draw_grain, grain_of, plot_grain
from .lines import lines_of, shown_lines, title_of
from .lobes import draw_lobes, plot_lobes
from .style import PageFigure

GRAIN_WORDS = (
    "The grain: scans under turns of the sample; the peak over facet slopes with the ellipse of the data (dashed) and "
    "of the model; the width of the lobe against the azimuth of the plane of incidence."
)
LOBES_MM, COST_MM = 113.0, 63.0
TIMED_WORDS = "Error against run time. A model on the front is beaten by no other in both."


def plot_ranking(ranking, measurement: Measurement, path, theme: str = style.LIGHT) -> None:
    """Draw the ranking into `path`, a .png, .svg or .pdf file, light or dark."""
    with style.look():
        lines, grain = lines_of(ranking), grain_of(measurement)
        parts = [LOBES_MM, *([] if grain is None else [HEIGHT_MM]), max(COST_MM, cost_height_mm(lines, COST_MM))]
        fig = style.figure(180, sum(parts))
        above, *middle, below = fig.subfigures(len(parts), 1, squeeze=False, height_ratios=parts)[:, 0]
        if grain is not None:
            draw_grain(middle[0], grain, lines)
        draw_lobes(above, shown_lines(lines), measurement, title_of(lines, measurement.name))
        draw_cost(below, lines)
        style.save(fig, path, theme)


def ranking_figures(ranking, measurement: Measurement) -> list[PageFigure]:
    """What a report page shows of a ranking: the lobes, error against run time, and how the recommended model and the
    worst of those drawn look."""
    lines = lines_of(ranking)
    plotted = shown_lines(lines)
    pick = next((line for line in plotted if line.recommended), plotted[0])
    pair = [pick] + [line for line in plotted[-1:] if line is not pick]
    grain = grain_of(measurement)
    return [
        (
            style.figure_file(plot_lobes(plotted, measurement, title=title_of(lines, measurement.name))),
            "BRDF against reflection angle, on a log axis as the guide plots it, and what each model leaves over.",
        ),
        *([] if grain is None else [(style.figure_file(plot_grain(grain, lines)), GRAIN_WORDS)]),
        (
            style.figure_file(plot_cost(lines)),
            TIMED_WORDS if any(line.ns for line in lines) else "The error of every model, times left out.",
        ),
        spheres.pictures_of_looks([line.surface for line in pair]),
    ]
