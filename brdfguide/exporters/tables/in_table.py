"""A surface as a table holds it, in its channels or in one, and what that costs."""

from collections.abc import Callable

import numpy as np

from ...physics import colour
from ...physics.geometry import Geometry
from ...records import dataclass
from .._directions import judged_over, rms_ln
from .._shown import seen_of
from ..exporter import ColouredSurface, Statement, status_of

MIDDLE_UM = 0.555  # where a luminance is said to stand
ONE_CHANNEL = "the colour: the file holds its luminance; --channel writes one channel"


@dataclass(frozen=True, eq=False)
class InTable:
    """`surface`, without what the format cannot hold, of `original`; a colour becomes its luminance where it is
    `single`."""

    original: ColouredSurface
    surface: ColouredSurface
    lost: tuple[str, ...]
    single: bool

    @property
    def channels(self) -> tuple[str, ...]:
        return ("brdf",) if self.single else self.surface.channels

    @property
    def wavelength(self) -> np.ndarray:
        """[µm], (channels,)."""
        um = MIDDLE_UM if self.single else self.surface.wavelength
        return np.broadcast_to(np.asarray(um, float), (len(self.channels),))

    def brdf(self, directions: Geometry) -> np.ndarray:
        """[1/sr], (samples, channels)."""
        if self.single:
            return np.maximum(self.surface.rgb(directions) @ colour.LUMINANCE, 0.0)[:, None]
        return self.surface.spectral(directions)

    def stated(
        self,
        target: str,
        read: Callable[[Geometry], np.ndarray],
        geom: Geometry | None,
        size: dict[str, int],
        note: str,
    ) -> Statement:
        """What a table is off that a program will `read` so, over `geom` or over the directions of all exports."""

        def shown(directions: Geometry) -> np.ndarray:
            values = read(directions)
            if self.single:
                return np.repeat(values, 3, axis=1)
            return np.maximum(values @ self.surface.colour.matrix.T, 0.0)

        where, wanted, over = judged_over(self.surface, geom, spectral=not self.single)
        wanted = np.where(np.isfinite(wanted), self.brdf(where), np.nan)
        rms = rms_ln(np.maximum(read(where), 1e-300), wanted)
        return Statement(
            target,
            status_of(rms, self.lost),
            rms,
            int(np.isfinite(wanted).any(axis=1).sum()),
            over,
            size,
            self.lost,
            (note,),
            self.surface.colour.how,
            seen_of(self.original, shown),
            shown,
        )


def held_in_table(original: ColouredSurface, kept: ColouredSurface, lost: tuple[str, ...], *, several: bool) -> InTable:
    """`several` says that the format holds several channels; otherwise the colour of one is lost."""
    single = len(kept.channels) > 1 and not several
    return InTable(original, kept, (*lost, ONE_CHANNEL) if single else lost, single)
