"""What an answer says of files that were written beside it, once more, where a target holds the law as it is."""

from collections import defaultdict

from mpmath import fsum, log, mpf, radians, sqrt

from .exact_errors import Readings
from .exact_followers import RowOfAnswer
from .exact_surface import ANGLES, ExactSurface
from .rederived import Comparisons

# of an incidence's peak, and 1/sr: what is darker than both does not count
FAINTEST, DARKEST = mpf("1e-3"), mpf("1e-3")


def compare_exports(answer: dict, best: RowOfAnswer | None, data: Readings, found: Comparisons) -> None:
    """Of every exact export the numbers that were written, its error, and of one channel over how many directions it
    was judged and how far it is from the measurement. A refit or lossy one shows a shader's law, which is not written
    down a second time."""
    if best is None:
        return
    for number, told in enumerate(answer.get("exports") or ()):
        if told["status"] != "exact" or told["model"] != best.row["model"]:
            continue
        place = f"exports[{number}]"
        _compare_numbers(told.get("written"), best, f"{place}.written", found)
        found.check(f"{place}.rms_ln", told["rms_ln"], 0.0)
        found.check(f"{place}.seen", told["seen"], 0.0)
        if len(data.wavelengths) == 1:
            directions, error = _judged(best.surface, data)
            found.check(f"{place}.directions", told["directions"], directions)
            found.loosened(best.surface.slack).check(f"{place}.measured_rms_ln", told["measured_rms_ln"], error)


def _compare_numbers(written, best: RowOfAnswer, place: str, found: Comparisons) -> None:
    """The parameters, angles in radians; of channels the number of each."""
    if not isinstance(written, dict):
        return
    laws = {name: part.law for part in best.surface.parts for name in dict(part.keys).values()}
    for key in written.keys() & best.surface.values.keys():
        value, turned = best.surface.values[key], laws.get(key) in ANGLES.get(key.rpartition(".")[2], ())
        right = [float(radians(mpf(each))) if turned else each for each in _many(value)]
        if len(_many(written[key])) == len(right):
            found.copy(f"{place}.{key}", _many(written[key]), right)


def _many(value) -> list:
    return value if isinstance(value, list) else [value]


def _judged(surface: ExactSurface, data: Readings) -> tuple[int, mpf]:
    """Over how many of the data's directions, and rms ln over those with a value."""
    values, squares = defaultdict(list), []
    for row, (sight, up) in enumerate(zip(data.sights, data.lit, strict=True)):
        f = surface.brdf(sight.pair, 0, data.wavelengths[0]) if up else mpf(0)
        if f > 0:
            values[round(data.angles[row][0], 1)].append(f)
            if data.values[row][0] > 0:
                squares.append(log(f / mpf(data.values[row][0])) ** 2)
    counted = (sum(f >= min(FAINTEST * max(of), DARKEST) for f in of) for of in values.values())
    return sum(counted), sqrt(fsum(squares) / max(len(squares), 1))
