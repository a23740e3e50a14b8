"""Finite directions and mirror directions as one list: what a shader is fitted to where a surface has both."""

from collections.abc import Mapping

import numpy as np

from ..models.model import Model
from ..physics.geometry import Geometry
from ..records import dataclass


@dataclass(frozen=True, eq=False)
class BesideMirror:
    """Directions in which the BRDF is wanted, and then those in which the mirror's reflectance is."""

    finite: Geometry
    mirrored: Geometry

    def __len__(self) -> int:
        return len(self.finite) + len(self.mirrored)

    def __getitem__(self, rows: np.ndarray) -> "BesideMirror":
        above = rows < len(self.finite)
        return BesideMirror(self.finite[rows[above]], self.mirrored[rows[~above] - len(self.finite)])

    @property
    def cos_i(self) -> np.ndarray:
        return np.concatenate((self.finite.cos_i, self.mirrored.cos_i))

    @property
    def mirror_distance2(self) -> np.ndarray:
        return np.concatenate((self.finite.mirror_distance2, self.mirrored.mirror_distance2))


def stacked(law: Model, both: BesideMirror, **values) -> np.ndarray:
    """BRDF in the finite directions and reflectances of the mirror: (..., samples, colours)."""
    parts = law(both.finite, **values), mirror_at(law, values, both.mirrored)
    sets = np.broadcast_shapes(*(each.shape[:-2] for each in parts))
    colours = max(each.shape[-1] for each in parts)
    return np.concatenate([np.broadcast_to(each, (*sets, each.shape[-2], colours)) for each in parts], axis=-2)


def mirror_at(law: Model, values: Mapping, geom: Geometry) -> np.ndarray:
    """The mirror's reflectance of a shader; 0 of one that has none."""
    return law.mirror(geom, **values) if law.mirror else np.zeros(geom.shape)
