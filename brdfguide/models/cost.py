"""What an evaluation costs: time measured so that two laws can be compared, and operations that no machine changes.

All laws take turns in every repeat, on the same directions and one thread; the least processor time of a thread counts,
because whatever else a machine does can only add to it. Directions are fresh each time, as in a renderer.
"""

import time
from collections import Counter
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from typing import TypeVar

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass

Key = TypeVar("Key")

VALUES = 2048  # directions times channels: fit the processor's cache, and hide the cost of a call
COUNTED = 64  # directions to count operations on
BATCHES = 9  # times that the least of the repeats is taken: their scatter is the error
REPEATS = 3
GROUPS = {
    "exp": (
        "exp",
        "expm1",
        "log",
        "log1p",
        "sin",
        "cos",
        "tan",
        "arcsin",
        "arccos",
        "arctan",
        "arctan2",
        "log10",
        "exp2",
        "log2",
        "cbrt",
    ),
    "pow": ("power", "float_power"),
    "div": ("divide", "reciprocal", "remainder", "fmod"),
    "sqrt": ("sqrt", "hypot"),
    "simple": (
        "add",
        "subtract",
        "multiply",
        "square",
        "negative",
        "absolute",
        "minimum",
        "maximum",
        "matmul",
        "conjugate",
    ),
}
# of one addition, in arrays that fit the cache; ours
WORK = {"exp": 10.0, "pow": 20.0, "div": 2.0, "sqrt": 3.0, "simple": 1.0}
GROUP_OF = {name: group for group, names in GROUPS.items() for name in names}


@dataclass(frozen=True)
class Time:
    """Nanoseconds per direction, all channels together: the least of each batch of repeats."""

    batches: tuple[float, ...]

    @property
    def ns(self) -> float:
        return min(self.batches)

    def over(self, other: "Time") -> "Saving":
        """How much longer this takes; the error from batches in pairs, since a busy machine slows both alike."""
        pairs = np.subtract(self.batches, other.batches)
        # standard error of a median, from the median distance to it: a batch that something disturbed does not count
        spread = 1.2533 * 1.4826 * np.median(np.abs(pairs - np.median(pairs))) / np.sqrt(len(pairs))
        return Saving(self.ns - other.ns, float(spread))


@dataclass(frozen=True)
class Saving:
    """A difference of two times [ns], and its standard error."""

    ns: float
    stderr: float

    @property
    def measurable(self) -> bool:
        """Whether it is more than twice its error."""
        return self.ns > 2 * self.stderr


NO_TIME = Time((0.0,) * BATCHES)


def times(evaluators: Mapping[Key, Callable], geom: Geometry) -> dict[Key, Time]:
    """The time of each law, interleaved. Takes laws(geom) -> array; gives Time by the same keys."""
    wanted = VALUES // np.size(geom.wavelength)
    geom = geom[np.arange(wanted) % len(geom)]  # a short list of directions again and again, as in a renderer's batch
    for evaluator in evaluators.values():
        evaluator(geom.afresh())  # tables and caches warm
    batches = [interleaved(evaluators, geom.afresh, REPEATS) for _ in range(BATCHES)]
    return {key: Time(tuple(min(batch[key]) / len(geom) for batch in batches)) for key in evaluators}


def interleaved(evaluators: Mapping[Key, Callable], argument: Callable, repeats: int) -> dict[Key, list[int]]:
    """Processor time [ns] of this thread for each evaluator in each repeat; all take turns.

    `argument()` gives what an evaluator is called with, anew each time and outside the time.
    """
    found: dict[Key, list[int]] = {key: [] for key in evaluators}
    for _ in range(repeats):
        for key, evaluator in evaluators.items():
            given = argument()
            began = time.thread_time_ns()
            evaluator(given)
            found[key].append(time.thread_time_ns() - began)
    return found


def counted(evaluators: Mapping[object, Callable], geom: Geometry) -> dict[object, Time]:
    """Operations in place of times, where two runs must give the same: in additions, without scatter."""
    return {
        key: Time((work(operations(evaluator, geom[:COUNTED])),) * BATCHES) for key, evaluator in evaluators.items()
    }


def compare_times(longer: Callable, shorter: Callable, geom: Geometry, clock=times, most: int = 8) -> tuple[Time, Time]:
    """The times of two laws side by side, by `times` or `counted`, up to `most` times, until they can be told apart."""
    evaluators, long, short = {"longer": longer, "shorter": shorter}, (), ()
    for _ in range(most if clock is times else 1):
        each = clock(evaluators, geom)
        long, short = long + each["longer"].batches, short + each["shorter"].batches
        if Time(long).over(Time(short)).measurable:
            break
    return Time(long), Time(short)


def work(counted: Mapping[str, float]) -> float:
    """Operations in the time of one addition: what orders candidates, the same on every machine and in every run."""
    return sum(WORK[group] * number for group, number in counted.items())


def operations(evaluator: Callable, geom: Geometry) -> dict[str, float]:
    """Operations for each direction: exp (with log and the like), pow, div, sqrt, simple (add, multiply, compare)."""
    tally: Counter = Counter()
    counted = _TALLY.set(tally)
    try:
        evaluator(
            Geometry(geom.directions.each(lambda values: np.array(values, float).view(_Counted)), geom.wavelength)
        )
    finally:
        _TALLY.reset(counted)
    return {group: tally[group] / len(geom) for group in GROUPS}


_TALLY: ContextVar[Counter] = ContextVar("tally")


class _Counted(np.ndarray):
    """An array whose operations are counted."""

    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **options):
        bare = [each.view(np.ndarray) if type(each) is _Counted else each for each in inputs]
        if not options and out is None and method == "__call__" and ufunc.signature is None:  # most calls by far
            result = ufunc(*bare)
            size = np.size(result[0]) if isinstance(result, tuple) else result.size
            _TALLY.get()[GROUP_OF.get(ufunc.__name__, "simple")] += size
            return result.view(_Counted) if isinstance(result, np.ndarray) else result
        for name, value in options.items():
            options[name] = _bare(value)
        if out is not None:
            options["out"] = tuple(map(_bare, out))
        result = getattr(ufunc, method)(*bare, **options)
        size = np.size(result) if isinstance(result, tuple) else getattr(result, "size", 1)
        for each in bare:
            size = max(size, getattr(each, "size", 1))
        _TALLY.get()[GROUP_OF.get(ufunc.__name__, "simple")] += size
        if out is not None:
            return out[0] if len(out) == 1 else out
        return result.view(_Counted) if isinstance(result, np.ndarray) else result

    def __array_function__(self, function, types, arguments, options):
        result = super().__array_function__(function, types, arguments, options)
        return result.view(_Counted) if type(result) is np.ndarray else result


def _bare(value):
    """An array of a subclass as a plain one; anything else as it is."""
    return np.asarray(value) if isinstance(value, np.ndarray) else value
