"""What pictures may hold without its being noticed, and how their values would read with it.

Each fault is taken at about its standard deviation: what is seen of it where it can be seen (light on the dark side,
the lamp's and the outline's doubt), what is usual where it cannot (a lens's blur). A fit counts what they change as
doubt, since all values err together.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.ndimage import gaussian_filter

from ..finding import Finding
from ..physics.directions import FIELDS, Directions
from ..records import dataclass
from .cells import Cells
from .faults import OFF_DEG, STRAY, dark_level
from .lamp import LIMB_PX, Lamp
from .sight import Sight
from .solids import Pinhole, Points, points

BLUR_PX = 1.5  # of a lens that is not sharp; its square, which widens a highlight, is half that of two pixels (ours)
LEAST_LAMP_DEG = 0.25  # no shading tells a lamp's direction better (ours)
UNSEEN_DISTANCE = 0.05  # relative, of a lamp that no reference shows (ours)


@dataclass(frozen=True)
class Doubts:
    """What is known of a shot's faults: the lamp's direction [deg] and relative distance, stray light as a share of the
    reference's greatest value, the outline's centre [px]; 0 where a fault cannot be."""

    lamp_deg: float = OFF_DEG / 2
    lamp_distance: float = UNSEEN_DISTANCE
    stray: float = STRAY / 2
    centre_px: float = LIMB_PX

    @classmethod
    def by_reference(cls, seen: Points, shading: np.ndarray, shown: Lamp, stated) -> "Doubts":
        """As far as a matt reference tells: points (n,), their grey light, the lamp that this shows, and the lamp's
        stated position, or None."""
        distance, turned = shown.doubt_distance, max(shown.doubt_deg, LEAST_LAMP_DEG)
        if stated is not None:
            away = float(np.linalg.norm(stated))
            cosine = float(np.dot(stated, shown.position)) / away / shown.distance
            turned = np.hypot(turned, np.degrees(np.arccos(np.clip(cosine, -1, 1))))
            distance = min(abs(away / shown.distance - 1), 1.0)
        level = dark_level(seen, shading, shown)
        return cls(float(turned), distance, STRAY / 2 if level is None else max(level, 0.0))


@dataclass(frozen=True, eq=False)
class Changed:
    """Cells of one shot with a fault: where lamp and camera stand then, and what it multiplies the values by."""

    fault: str
    directions: Directions
    factor: np.ndarray  # (cells, 3)


def shot_changes(
    seen: Sight, cells: Cells, doubts: Doubts, block: int, solid: str = "", view: Pinhole | None = None
) -> list[Changed]:
    """Every fault that the pictures of one shot may hold, with its consequence for the cells.

    Takes  `block`, pixels of the picture along a side of one of the shot's; `view` of a sphere or rod.
    """
    here = cells.points.directions(seen.lamp)
    found = [
        Changed("blur", here, _mean_factor(seen, cells, *_blurred(seen, BLUR_PX / block))),
        Changed("stray light", here, _mean_factor(seen, cells, *_veiled(seen, doubts.stray))),
    ]
    for number, lamp in enumerate(_lamps(seen.lamp, doubts)):
        factor = np.ones_like(cells.f)
        if seen.reference is None:
            factor *= (cells.points.irradiance(seen.lamp) / cells.points.irradiance(lamp))[:, None]
        found.append(Changed(f"{seen.label}: lamp {number}", cells.points.directions(lamp), factor))
    if view is not None:
        x, y = view.pixels(cells.points.at)
        for axis, (right, down) in (("right", (1, 0)), ("down", (0, 1))):
            centre = view.centre_px[0] + right * doubts.centre_px, view.centre_px[1] + down * doubts.centre_px
            moved = points(solid, replace(view, centre_px=centre), x, y).directions(seen.lamp)
            lost = ~np.isfinite(np.stack([getattr(moved, name) for name in FIELDS])).all(axis=0)
            kept = {name: np.where(lost, getattr(here, name), getattr(moved, name)) for name in FIELDS}
            found.append(Changed(f"centre {axis}", Directions(**kept), np.ones_like(cells.f)))
    return found


def unseen_finding(doubts: list[Doubts]) -> Finding:
    """What every doubt includes."""
    lamp, centre, stray = (max(getattr(each, name) for each in doubts) for name in ("lamp_deg", "centre_px", "stray"))
    text = (
        f"every doubt includes faults that would not be noticed: a lens that blurs by {BLUR_PX:g} px, lamps to "
        f"{lamp:.2g} degrees, the outline to {centre:.2g} px"
        + (f", stray light of {stray:.2g} of the brightest" if stray else "")
    )
    numbers = (("blur_px", BLUR_PX), ("lamp_deg", lamp), ("centre_px", centre), ("stray", stray))
    return Finding("unseen-faults", text, numbers=numbers)


def in_all_shots(changed: list[list[Changed]], here: list[Directions]) -> tuple[Changed, ...]:
    """Over the cells of all shots together, whose directions are `here`: a fault of lens or camera is in all of them,
    that of a lamp in its own."""
    sizes = [getattr(each, FIELDS[0]).shape[0] for each in here]
    found = []
    for fault in dict.fromkeys(each.fault for of_shot in changed for each in of_shot):
        parts = [{each.fault: each for each in of_shot}.get(fault) for of_shot in changed]
        stands = [each if part is None else part.directions for part, each in zip(parts, here, strict=True)]
        fields = {name: np.concatenate([getattr(each, name) for each in stands]) for name in FIELDS}
        factors = [np.ones((size, 3)) if part is None else part.factor for part, size in zip(parts, sizes, strict=True)]
        found.append(Changed(fault, Directions(**fields), np.concatenate(factors)))
    return tuple(found)


def _lamps(lamp: np.ndarray, doubts: Doubts) -> Iterator[np.ndarray]:
    """The lamp turned to two sides, and farther away."""
    distance = np.linalg.norm(lamp)
    along = lamp / distance
    across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    across /= np.linalg.norm(across)
    turn = np.radians(doubts.lamp_deg)
    for side in (across, np.cross(along, across)):
        yield distance * (np.cos(turn) * along + np.sin(turn) * side)
    if doubts.lamp_distance > 0:
        yield lamp * (1 + doubts.lamp_distance)


def _blurred(seen: Sight, sigma: float) -> tuple[np.ndarray, np.ndarray | None]:
    """Light of sample and reference through a lens that spreads it by `sigma` pixels of the shot."""
    spread = (sigma, sigma, 0.0)
    light = gaussian_filter(seen.light, spread)
    return light, None if seen.reference is None else gaussian_filter(seen.reference, spread)


def _veiled(seen: Sight, share: float) -> tuple[np.ndarray, np.ndarray | None]:
    """Light of sample and reference under a veil that is a share of the greatest light."""
    shown = seen.light if seen.reference is None else seen.reference
    veil = share * np.quantile(shown[seen.used], 0.999, axis=0).astype(np.float32)
    return seen.light + veil, None if seen.reference is None else seen.reference + veil


def _mean_factor(seen: Sight, cells: Cells, light, reference) -> np.ndarray:
    """(cells, 3): by what other light would multiply the values, geometric mean over the pixels of each cell."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ln = np.log(light[seen.used] / seen.light[seen.used])
        if reference is not None and seen.reference is not None:
            ln -= np.log(reference[seen.used] / seen.reference[seen.used])
    ln = np.where(np.isfinite(ln), ln, 0.0)
    sums = [np.bincount(cells.of_pixel, each, minlength=len(cells.f)) for each in ln.T]
    return np.exp(np.stack(sums, -1) / cells.count[:, None])
