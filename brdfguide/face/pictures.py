"""The picture and the page of a fit: the same for one file and for one of many."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..data.measurement import Measurement
    from ..fitting.ranked import Ranking

ANGLE, BETA, POLAR, SPACE = AXES = ("angle", "beta", "polar", "3d")  # what a picture of a fit is drawn over


def draw_fit(
    path: Path, ranked: "Ranking", measurement: "Measurement", axis: str = ANGLE, theme: str = "light"
) -> None:
    """The picture over the reflection angle or as `axis` says, light or dark.

    Raises InputError where it cannot be drawn or written.
    """
    from ..report.figures import beta, lobe_views, ranking

    drawn = {BETA: beta.plot_beta, POLAR: lobe_views.plot_polar, SPACE: lobe_views.plot_in_space}
    drawn.get(axis, ranking.plot_ranking)(ranked, measurement, path, theme)


def write_page(
    path: Path,
    document: dict,
    ranked: "Ranking",
    measurement: "Measurement",
    file: Path,
    command: str,
    explore: bool = False,
) -> None:
    """One page with everything, the explorer as well where it is asked for. Raises InputError where it cannot be
    written.
    """
    from ..report import page
    from ..report.figures.ranking import ranking_figures
    from .explorer import block_of_ranking

    figures = [*_shots(ranked, measurement, file), *ranking_figures(ranked, measurement)]
    block = block_of_ranking(ranked, measurement) if explore else ""
    page.write(document, path, figures, command, [file], block)


def _shots(ranked: "Ranking", measurement: "Measurement", file: Path) -> list:
    """The pictures that were measured, beside what was made of them; none of other data, nor of what came by a pipe."""
    from ..flags import Effect
    from ..opening import is_plain

    photographed = any(each.effect is Effect.PHOTOGRAPHED for each in measurement.findings)
    if not photographed or not is_plain(file):
        return []
    from ..report.figures.shots import shot_figures

    return shot_figures(file, ranked.recommended.fit.surface)
