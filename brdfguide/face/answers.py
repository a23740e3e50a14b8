"""What the public functions give: answers that show themselves as the commands do, and hold what programs want.

Words and tables are made from the document that `--json` prints, and from nothing else.
"""

from collections.abc import Mapping
from dataclasses import field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import printable
from ..data.measurement import Measurement
from ..errors import choices
from ..models.surface import Surface
from ..records import dataclass

if TYPE_CHECKING:
    from ..advice.recommend import Recommendation
    from ..data.metal_or_dielectric import Verdict
    from ..exporters.exporter import ColouredSurface
    from ..fitting.fit import Fit
    from ..fitting.ranked import Ranking, Row
    from ..fitting.side_by_side import Pair


@dataclass(frozen=True, eq=False, repr=False)
class FitAnswer:
    """Every candidate fitted to a measurement, in order of error, and the one to use."""

    ranking: "Ranking"
    measurement: Measurement  # as it was fitted: certain mistakes undone, spikes left out, every doubt noted
    judged: "Verdict"  # metal or dielectric, by the data
    timing: bool = True  # whether the document holds times, which differ from run to run
    read_with: Mapping[str, Any] = field(default_factory=dict)  # what was said of the file's meaning

    @property
    def rows(self) -> "tuple[Row, ...]":
        """Candidates in their places, best first."""
        return self.ranking.rows

    @property
    def recommended(self) -> "Fit":
        """The fit to use: `values`, `stderr`, `warnings`, `residuals`."""
        return self.ranking.recommended.fit

    @property
    def surface(self) -> Surface:
        """The recommended model with its values."""
        return self.recommended.surface

    @property
    def no_answer(self) -> str:
        """Why no model should be trusted, by which the command ends with status 1; nothing where one may be."""
        return self.ranking.no_answer

    def __getitem__(self, candidate: str) -> "Fit":
        """The fit of the candidate of this name. Raises InputError where there is none."""
        found = {row.fit.name: row.fit for row in self.rows}
        if candidate not in found:
            raise choices("candidate", candidate, list(found))
        return found[candidate]

    @cached_property
    def document(self) -> dict[str, Any]:
        """What `brdfguide fit --json` prints."""
        from ..report.documents.fit import fit_document

        return fit_document(self.ranking, self.measurement, self.judged, timing=self.timing, read_with=self.read_with)

    def plot(self, path: str | PathLike[str], theme: str = "light") -> None:
        """Draws the ranking into a .png, .svg or .pdf, light or dark, as `fit --plot` does. Raises InputError for
        another suffix."""
        from ..report.figures.ranking import plot_ranking

        plot_ranking(self.ranking, self.measurement, Path(path), theme)

    def __repr__(self) -> str:
        from ..report.text.ranking import ranking_text

        return ranking_text(printable.document(self.document))

    def _repr_html_(self) -> str:
        from ..report.notebook import ranking_html

        return ranking_html(printable.document(self.document))


@dataclass(frozen=True, eq=False, repr=False)
class RecommendAnswer:
    """What the guidelines make of a description: models with values to begin with, and why."""

    recommendation: "Recommendation"

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """The candidates, best first; none outside the guide's domain."""
        return tuple(each.surface for each in self.recommendation.candidates)

    @property
    def surface(self) -> Surface:
        """The first of them. Raises NoAnswer outside the guide's domain."""
        from .surfaces import of_recommendation

        return of_recommendation(self.recommendation)

    @cached_property
    def document(self) -> dict[str, Any]:
        """What `brdfguide recommend --json` prints."""
        from ..report.documents import recommendation

        return recommendation.document(self.recommendation)

    def __repr__(self) -> str:
        from ..report.text.recommendation import text

        return text(printable.document(self.document))


@dataclass(frozen=True, eq=False, repr=False)
class CompareAnswer:
    """Two surfaces side by side."""

    pair: "Pair"

    @property
    def seen(self) -> float:
        """S, the rms difference in lightness of two spheres [L*]."""
        return self.pair.seen

    @property
    def rms_ln(self) -> float:
        """rms of ln(other/one) over the same directions."""
        return self.pair.rms_ln

    @cached_property
    def document(self) -> dict[str, Any]:
        """What `brdfguide compare --json` prints."""
        from ..report.documents.compare import of_pair

        return of_pair(self.pair)

    def __repr__(self) -> str:
        from ..report.text.compare import pair_text

        return pair_text(printable.document(self.document))


@dataclass(frozen=True, eq=False, repr=False)
class Preview:
    """Surfaces on objects among surroundings, side by side, in one light."""

    surfaces: "tuple[ColouredSurface, ...]"
    radiance: np.ndarray  # (surfaces, size, size, 3) in linear sRGB; 1 is white at the horizon
    about: str  # what lights them
    compared: bool = True  # whether the picture shows how each differs from the first

    @cached_property
    def pixels(self) -> np.ndarray:
        """As displays want it: (surfaces, size, size, 3), uint8, sRGB."""
        from ..report import render

        return (255 * np.clip(render.tone(self.radiance), 0, 1) + 0.5).astype(np.uint8)

    @cached_property
    def png(self) -> bytes:
        """The picture with names, and with what differs between the surfaces, as a file."""
        from ..report.figures import spheres

        return spheres.preview_sheet(self.surfaces, self.radiance, self.about, self.compared)

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the picture whole or not at all: .png for displays, .exr with radiances in linear sRGB, side by side.

        Raises InputError where it cannot be written, for another suffix, and for .exr without the OpenEXR library.
        """
        from ..errors import InputError
        from ..files import writable, write_whole

        suffix = writable(Path(path)).suffix.lower()
        if suffix not in (".png", ".exr"):
            raise InputError(f"{path}: a preview is a .png or .exr")
        write_whole(Path(path), self.png if suffix == ".png" else self._exr(path))

    def _exr(self, path: str | PathLike[str]) -> bytes:
        from tempfile import TemporaryDirectory

        from ..errors import InputError

        try:
            import OpenEXR
        except ImportError:
            raise InputError(f"{path}: needs OpenEXR; pip install 'brdfguide[photo]'") from None
        row = np.concatenate(list(self.radiance), axis=1).astype(np.float32)
        channels = {"RGB": OpenEXR.Channel(np.ascontiguousarray(row))}
        with TemporaryDirectory() as folder:  # its library writes to a file alone
            made = Path(folder) / "preview.exr"
            OpenEXR.File({"type": OpenEXR.scanlineimage}, channels).write(str(made))
            return made.read_bytes()

    def __repr__(self) -> str:
        return f"preview of {' | '.join(each.name for each in self.surfaces)}: {self.about}"

    def _repr_png_(self) -> bytes:
        return self.png
