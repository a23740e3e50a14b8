"""What an answer says of files that were written beside it, once more: over how many directions they were judged, how
far their laws are from the surface, and how far from the measurement.

A file is what its numbers make of its target's law (`exact_targets`). Tables and learned factors do not hold what they
were made of, and are left out. Where the numbers do not say which of two laws a file holds, it is the one that agrees.
"""

from collections.abc import Mapping, Sequence

from mpmath import isfinite, mpf, pi, radians

from .exact_errors import Readings
from .exact_followers import RowOfAnswer
from .exact_judged import Judged, colours_of, judged
from .exact_surface import ANGLES, ExactSurface, NoLaw, TooNarrow, surface_of
from .exact_tables import ExactTable, table_of_target
from .exact_targets import SHADERS, laws_of_target, mirror_of_target
from .rederived import Comparisons

IN_TABLE = 1e-8  # relative, of what is between nodes that lie close
ROUNDED = 1e-12  # rms ln that is left of a law that is the surface's own


def compare_exports(answer: dict, best: RowOfAnswer | None, data: Readings, found: Comparisons) -> int:
    """Of every file of which the law is written down a second time. Gives how many of their numbers were only used."""
    used, colours = 0, colours_of(answer["data"]["channels"])
    known, tables = dict[str, Judged | None](), _Tables()
    for number, told in enumerate(answer.get("exports") or ()):
        place, written = f"exports[{number}]", told.get("written")
        surface = _exported(answer, told, best)
        if surface is None or not written or not all(map(_is_number, _all(written))):
            continue
        exact = told["status"] == "exact" and _is_itself(written, surface)
        if exact:
            _compare_numbers(written, surface, f"{place}.written", found)
            found.check(f"{place}.rms_ln", told["rms_ln"], 0.0)
            found.check(f"{place}.seen", told["seen"], 0.0)
        name = told["model"]
        if name not in known:
            known[name] = judged(surface, data, colours) if colours else None
        by = known[name]
        if by is None:
            continue
        loose = found.loosened(surface.slack)
        table = None if exact else tables.of(told, by)
        if exact:
            loose.check(f"{place}.directions", told["directions"], by.directions)
            loose.check(f"{place}.measured_rms_ln", told["measured_rms_ln"], by.off_the_data(by.itself, by.mirror))
        elif table is not None:
            used += _compare_table(told, table, place, loose)
        else:
            used += _compare_refit(told, by, place, loose)
    return used


class _Tables:
    """Tables of one answer; those with the same nodes are evaluated once."""

    def __init__(self) -> None:
        self.known: dict[tuple, ExactTable] = {}

    def of(self, told: dict, by: Judged) -> ExactTable | None:
        table = table_of_target(told["target"], told["written"], by)
        if table is None:
            return None
        return self.known.setdefault((told["model"], table.about_mirror, *map(len, table.nodes)), table)


def _compare_table(told: dict, table: ExactTable, place: str, found: Comparisons) -> int:
    """Its sizes, and how far off it is."""
    for key, nodes in zip(("azimuths", "polars"), table.nodes[1:], strict=True):
        found.check(f"{place}.written.{key}", told["written"].get(key), len(nodes))
    found.check(f"{place}.rms_ln", told["rms_ln"], table.by.error(table), IN_TABLE, ROUNDED)
    found.check(f"{place}.directions", told["directions"], table.by.directions)
    found.check(f"{place}.measured_rms_ln", told["measured_rms_ln"], table.by.off_the_data(table), IN_TABLE)
    return 1


def _exported(answer: dict, told: dict, best: RowOfAnswer | None) -> ExactSurface | None:
    """The surface that a file was made of: the one fitted as this shader, else the recommended row's."""
    shader = answer.get("as")
    if shader is not None and shader["target"] == told["target"]:
        try:
            return surface_of(told["model"], shader["parameters"])
        except (NoLaw, TooNarrow):
            return None
    return best.surface if best is not None and told["model"] == best.row["model"] else None


def _is_itself(written: Mapping, surface: ExactSurface) -> bool:
    """Whether what was written is the law with its own numbers, and no other target's."""
    return written.keys() == surface.values.keys()


def _compare_numbers(written: Mapping, surface: ExactSurface, place: str, found: Comparisons) -> None:
    """The parameters, angles in radians; of channels the number of each."""
    laws = {name: part.law for part in surface.parts for name in dict(part.keys).values()}
    for key in written.keys() & surface.values.keys():
        value, turned = surface.values[key], laws.get(key) in ANGLES.get(key.rpartition(".")[2], ())
        right = [float(radians(mpf(each))) if turned else each for each in _many(value)]
        if len(_many(written[key])) == len(right):
            found.copy(f"{place}.{key}", _many(written[key]), right)


def _compare_refit(told: dict, by: Judged, place: str, found: Comparisons) -> int:
    """Gives how many of its numbers were used."""
    target, written = told["target"], told["written"]
    laws = laws_of_target(target, written, _axis(by.surface))
    if not laws or by.has_mirror and target not in SHADERS:
        return 0
    mirror = mirror_of_target(target, written) if by.has_mirror else None
    directions, errors = by.directions, [by.error(law) for law in laws]
    if mirror is not None:
        count, worst = by.against_mirror(mirror)
        directions, errors = directions + count, [max(each, worst) for each in errors]
    law, error = min(zip(laws, errors, strict=True), key=lambda each: _apart(each[1], told["rms_ln"]))
    if not isfinite(error):
        return 0
    found.check(f"{place}.rms_ln", told["rms_ln"], error, absolute=ROUNDED)
    found.check(f"{place}.directions", told["directions"], directions)
    found.check(f"{place}.measured_rms_ln", told["measured_rms_ln"], by.off_the_data(law, mirror))
    return len(_all(written))


def _apart(error: mpf, told: float | None) -> mpf:
    return abs(error - mpf(told or 0))


def _axis(surface: ExactSurface) -> mpf | None:
    """The azimuth [rad] across the grain, where its streak lies, of the one law that has a grain by two widths, by two
    exponents or by a ratio of correlation lengths."""
    grained = [part for part in surface.parts if "axis" in dict(part.keys)]
    if len(grained) != 1:
        return None
    values = {name: surface.at(key, 0) for name, key in grained[0].keys}
    along = {
        "alpha_x": lambda: values["alpha_x"] < values["alpha_y"],
        "exponent_x": lambda: values["exponent_x"] > values["exponent_y"],
        "ratio": lambda: values["ratio"] < 1,
    }
    known = [narrow() for name, narrow in along.items() if name in values]
    return radians(values["axis"]) + known[0] * pi / 2 if known else None


def _all(written: Mapping) -> list:
    return [number for value in written.values() for number in _many(value)]


def _is_number(value) -> bool:
    return isinstance(value, (int, float))


def _many(value) -> Sequence:
    return value if isinstance(value, list) else [value]
