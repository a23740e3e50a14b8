"""Errors at incidence angles, and turns of the sample, that a fit did not see, from the numbers found without them."""

from collections.abc import Sequence
from functools import lru_cache

from mpmath import fsum, mpf, sqrt

from ..errors import InputError
from ..records import dataclass
from .exact_errors import Readings, residuals_of, turn_azimuths
from .exact_surface import ExactSurface, TooNarrow, surface_of
from .rederived import Comparisons


@dataclass(frozen=True)
class LookedAt:
    """The directions and channels that fits without a group looked at, by their numbers; None: all."""

    rows: tuple[int, ...] | None
    channels: tuple[int, ...]

    @classmethod
    def of(cls, answer: dict, data: Readings) -> "LookedAt":
        """Raises InputError for a direction or a channel that the data do not have."""
        told, every = answer.get("held_out_on"), answer["data"]["channels"]
        if told is None:
            return cls(None, tuple(range(len(every))))
        beyond = [row for row in told["rows"] if not 0 <= row < len(data.angles)]
        beyond += [each for each in told["channels"] if each not in every]
        if beyond:
            raise InputError(
                f"the answer: held_out_on: found {beyond[0]}, which the data do not have: are they its data?"
            )
        return cls(tuple(told["rows"]), tuple(map(every.index, told["channels"])))


def compare_held_out(printed: dict, place: str, every: Readings, at: LookedAt, found: Comparisons) -> None:
    """rms of ln(model/data) over all groups, each by the numbers that were found without it, and over the last, the
    steepest incidences; nothing where the answer does not tell these numbers, and where one makes a lobe so narrow that
    the program's own series tells too few digits."""
    folds = printed.get("held_out_fits") or []
    try:
        surfaces = [_without(printed, fold["values"], at.channels) for fold in folds]
    except TooNarrow:
        return
    data, squares = _among(every, at), list[mpf]()
    turns = turn_azimuths(data)
    for number, (fold, surface) in enumerate(zip(folds, surfaces, strict=True)):
        (lowest, highest), turned = fold["theta_i_deg"], fold.get("turns_deg")
        inside = [row for row, (theta_i, *_) in enumerate(data.angles) if lowest <= theta_i <= highest]
        inside = [row for row in inside if not turned or turns[row] in turned]
        part = [v * v for row in inside for v in residuals_of(surface, data, row) if v is not None]
        squares += part
        for end, angle in enumerate((min, max)):
            right = angle((data.angles[row][0] for row in inside), default=0.0)
            found.check(f"{place}.held_out_fits[{number}].theta_i_deg[{end}]", fold["theta_i_deg"][end], right)
        if number == len(folds) - 1:
            told = printed["held_out_highest"] or {"theta_i_deg": None, "rms_ln": None}
            steepest = max((data.angles[row][0] for row in inside if any(data.told[row])), default=0.0)
            found.check(f"{place}.held_out_highest.theta_i_deg", told["theta_i_deg"], steepest)
            found.check(f"{place}.held_out_highest.rms_ln", told["rms_ln"], _root_mean(part))
            found.check(f"{place}.held_out_rms_ln", printed["held_out_rms_ln"], _root_mean(squares))


@lru_cache(maxsize=4)
def _among(data: Readings, at: LookedAt) -> Readings:
    return data if at.rows is None else data.part(at.rows, at.channels)


def _root_mean(squares: list):
    return sqrt(fsum(squares) / max(len(squares), 1))


def _without(printed: dict, values: dict, channels: Sequence[int]) -> ExactSurface:
    """A row's law with the numbers that were found without a group, in the channels that were looked at."""
    parameters = {
        key: entry | {"value": values[key] if key in values else _of_channels(entry["value"], channels)}
        for key, entry in printed["parameters"].items()
    }
    return surface_of(printed["model"], parameters)


def _of_channels(value, channels: Sequence[int]):
    return [value[c] for c in channels] if isinstance(value, list) and len(value) > 1 else value
