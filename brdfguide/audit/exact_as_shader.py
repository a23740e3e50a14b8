"""What one shader can do for the data (`fit --as`), once more from the numbers that are told of it."""

from mpmath import expm1, mpf

from .exact_errors import Readings, exact_residuals, exact_rms
from .exact_surface import NoLaw, RoundingDecides, TooNarrow, surface_of
from .rederived import Comparisons


def compare_as_shader(answer: dict, data: Readings, found: Comparisons) -> int:
    """The error of its best setting, where that is told again, and the best law's row once more; nothing where an
    instrument drifted beside the laws. Gives how many numbers were used."""
    told = answer.get("as")
    if told is None or any(row.get("instrument") for row in answer["ranking"]):
        return 0
    rows = {row["candidate"]: row for row in answer["ranking"]}
    law = told["best_law"]
    found.copy("as.best_law", law, {key: rows.get(law["candidate"], {}).get(key) for key in law})
    for best in told["settings"][:1]:
        found.copy("as.settings[0]", best, {key: told.get(key) for key in best})
    try:
        surface = surface_of(told["target"], told["parameters"])
        error = exact_rms(exact_residuals(surface, data), data.share)
    except (NoLaw, TooNarrow, RoundingDecides):
        return 0
    found.check("as.rms_ln", told["rms_ln"], error, absolute=surface.lost)
    found.rounded("as.off_percent", told["off_percent"], 100 * expm1(min(error, mpf(50))))
    return sum(len(each["value"]) if isinstance(each["value"], list) else 1 for each in told["parameters"].values())
