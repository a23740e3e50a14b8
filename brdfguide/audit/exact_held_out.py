"""Errors at incidence angles that a fit did not see, from the numbers that were found without them."""

from mpmath import fsum, sqrt

from .exact_errors import Readings, residuals_of
from .exact_surface import TooNarrow, surface_of
from .rederived import Comparisons


def compare_held_out(printed: dict, place: str, data: Readings, found: Comparisons) -> None:
    """rms of ln(model/data) over all groups of incidences, each by the numbers that were found without it, and over the
    steepest group; nothing where the answer does not tell these numbers, and where one makes a lobe so narrow that the
    program's own series tells too few digits."""
    folds = printed.get("held_out_fits") or []
    try:
        surfaces = [surface_of(printed["model"], _without(printed["parameters"], fold["values"])) for fold in folds]
    except TooNarrow:
        return
    squares: list = []
    for number, (fold, surface) in enumerate(zip(folds, surfaces, strict=True)):
        lowest, highest = fold["theta_i_deg"]
        inside = [row for row, (theta_i, *_) in enumerate(data.angles) if lowest <= theta_i <= highest]
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


def _root_mean(squares: list):
    return sqrt(fsum(squares) / max(len(squares), 1))


def _without(parameters: dict, values: dict) -> dict:
    """The parameters of a row with the numbers that were found without a group."""
    return {key: entry | {"value": values.get(key, entry["value"])} for key, entry in parameters.items()}
