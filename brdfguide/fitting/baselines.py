"""General representations beside the models: what spherical harmonics, Zernike's polynomials, wavelets, sums of
products, other surfaces, free factors, a smooth function and a small net take to describe the same data.

Each is fitted to every other of at most 8,000 directions and judged at the rest; those of a dense table by its cells.
None of them is ranked, recommended or exported from here.
"""

from collections.abc import Callable, Iterable

import numpy as np

from ..bases import components, factored, net, pairs, smooth, tables
from ..data import subsample
from ..data.measurement import Measurement
from ..errors import InputError
from ..models import cost
from ..physics.geometry import Geometry
from ..records import dataclass

DIRECTIONS = 8000
LINEAR = (("sh", 4), ("sh", 8), ("sh", 12), ("zernike", 8))
WAVELETS = (100, 1000, 5000)
RANKS = (1, 2, 3, 4)
LEAST_OTHERS = 3
COVERED = 0.9  # of the data's cells that another surface must have
COMPONENTS = (1, 2, 5, 10, 20, 50)
VALUES_EACH = 3  # for each coefficient, below which a basis is not fitted
LOWEST = 1 / 30  # of the data's least value: what a negative or smaller value counts as
TIMED = 2048  # directions


@dataclass(frozen=True)
class Baseline:
    """One representation of the data."""

    name: str
    coefficients: int  # of one channel
    rms_ln: float | None = None  # at what it was fitted to; None: it was not fitted
    left_out_rms_ln: float | None = None  # at directions that it was not fitted to; None: there are none
    ns_per_sample: float | None = None  # None: a table that is only looked up
    negative: float = 0.0  # share of its values that no reflectance can have
    note: str = ""


@dataclass(frozen=True, eq=False)
class _Halves:
    """Two halves of the directions: one to fit to, one to judge by."""

    fitted: Measurement
    left_out: Measurement

    @classmethod
    def of(cls, measurement: Measurement) -> "_Halves":
        rows = subsample.representative_rows(measurement, DIRECTIONS, among=measurement.clear.any(axis=1))
        return cls(measurement[rows[::2]], measurement[rows[1::2]])


def baselines(
    measurement: Measurement,
    progress: Callable[[str], None] = lambda what: None,
    others: Iterable[Measurement] | None = None,
) -> tuple[Baseline, ...]:
    """Every row, cheapest basis first; `others` are tables of further surfaces, of which a linear basis is made.

    Raises InputError for fewer than three of these.
    """
    halves, found = _Halves.of(measurement), []
    for name, order in LINEAR:
        progress(f"{name}:{order}")
        found.append(_linear(name, order, halves))
    progress("factors, smooth, net")
    found += [_factors(halves), _smooth(halves), _net(halves)]
    progress("wavelets and separable sums")
    found += _of_table(measurement)
    if others is not None:
        progress("components")
        found += _components(halves, others)
    return tuple(found)


def _too_few(coefficients: int, halves: _Halves) -> bool:
    return np.count_nonzero(halves.fitted.clear, axis=0).min() < VALUES_EACH * coefficients


def _linear(basis: str, order: int, halves: _Halves) -> Baseline:
    name, count = f"{basis}:{order}", pairs.count(order)
    if _too_few(count, halves):
        return Baseline(name, count, note="too few data")
    known = np.where(halves.fitted.clear, halves.fitted.brdf, np.nan)
    return _judged(name, count, pairs.fit_pairs(basis, order, halves.fitted.geom, known), halves)


def _factors(halves: _Halves) -> Baseline:
    if _too_few(factored.COUNT, halves):
        return Baseline("factors", factored.COUNT, note="too few data")
    found = factored.fit_factors(factored.Columns(halves.fitted.geom), _ln(halves.fitted))
    return _judged("factors", factored.COUNT, found, halves)


def _smooth(halves: _Halves) -> Baseline:
    data = halves.fitted
    harmonics = (0,) if data.in_plane else smooth.HARMONICS
    count = smooth.TILTS * smooth.DIFFERENCES * len(harmonics)
    if _too_few(factored.COUNT, halves):
        return Baseline("smooth", count, note="too few data")
    found = smooth.fit_smooth(smooth.design(data.geom, harmonics=harmonics), _ln(data))

    def evaluate(geom: Geometry) -> np.ndarray:
        return np.exp(smooth.design(geom, harmonics=harmonics) @ found.coefficients + found.mean)

    note = f"{found.edf.mean():.0f} effective"
    return _judged("smooth", count, evaluate, halves, note)


def _net(halves: _Halves) -> Baseline:
    """The net of the channel in the middle."""
    if _too_few(factored.COUNT, halves):
        return Baseline("net", net.COUNT, note="too few data")
    middle = [len(halves.fitted.channels) // 2]
    one = _Halves(halves.fitted.of_channels(middle), halves.left_out.of_channels(middle))
    found = net.fit_net(one.fitted.geom, _ln(one.fitted)[:, 0])
    return _judged("net", net.COUNT, found, one, f"of {one.fitted.channels[0]} alone" if middle[0] else "")


def _ln(data: Measurement) -> np.ndarray:
    return np.where(data.clear, data.ln, np.nan)


def _judged(name: str, count: int, evaluate: Callable, halves: _Halves, note: str = "") -> Baseline:
    """Errors at both halves, time, and how much of it is negative."""
    errors, negative = [], []
    for data in (halves.fitted, halves.left_out):
        f = evaluate(data.geom)
        least = LOWEST * np.nanmin(np.where(data.clear, data.brdf, np.nan), axis=0)
        errors.append(float(np.sqrt(np.nanmean((np.log(np.maximum(f, least)) - _ln(data)) ** 2))))
        negative.append(float(np.mean(f <= 0)))
    return Baseline(name, count, errors[0], errors[1], _ns(evaluate, halves.fitted.geom), negative[1], note)


def _ns(evaluate: Callable, geom: Geometry) -> float:
    """Of one direction, all channels: the least of some turns on one thread."""
    geom = geom[np.arange(TIMED) % len(geom)]
    evaluate(geom.afresh())
    turns = cost.interleaved({"": evaluate}, geom.afresh, cost.REPEATS)[""]
    return min(turns) / TIMED


def _of_table(measurement: Measurement) -> list[Baseline]:
    """Wavelets and separable sums of the channel in the middle."""
    middle = len(measurement.channels) // 2
    table = tables.half_difference_table(measurement.geom, _ln(measurement)[:, middle])
    highest = float(max(measurement.geom.theta_i_deg.max(), measurement.geom.theta_r_deg.max()))
    cube = tables.angle_cube(measurement.geom, table, highest)
    if np.mean(np.isfinite(cube)) < tables.LEAST_FILLED:
        note = "needs a dense table"
        return [Baseline("wavelets", WAVELETS[1], note=note), Baseline("separable", _numbers(table, 1), note=note)]
    return [*_wavelets(cube), *(_sums(table, rank) for rank in RANKS)]


def _numbers(table: np.ndarray, rank: int) -> int:
    return rank * sum(table.shape)


def _wavelets(cube: np.ndarray) -> list[Baseline]:
    known = np.isfinite(cube)
    whole = tables.filled(cube.reshape(len(cube), -1)).reshape(cube.shape)
    found = []
    for name, values, back in (("wavelets of ln f", whole, np.asarray), ("wavelets of f", np.exp(whole), _ln_of)):
        coefficients = tables.haar(values)
        for count in WAVELETS:
            kept = tables.unhaar(tables.largest(coefficients, count))
            left = (back(kept) - cube)[known]
            negative = float(np.mean(kept[known] <= 0)) if back is _ln_of else 0.0
            found.append(Baseline(name, count, float(np.sqrt(np.mean(left**2))), negative=negative))
    return found


def _ln_of(values: np.ndarray) -> np.ndarray:
    positive = values[values > 0]
    return np.log(np.maximum(values, LOWEST * positive.min()))


def _sums(table: np.ndarray, rank: int) -> Baseline:
    left = tables.separable(table, rank).table - table
    return Baseline(f"separable:{rank}", _numbers(table, rank), float(np.sqrt(np.nanmean(left**2))))


def _looked_up(other: Measurement, cells: np.ndarray) -> np.ndarray:
    """ln f of another surface in these cells."""
    middle = len(other.channels) // 2
    return tables.half_difference_table(other.geom, other.ln[:, middle]).ravel()[cells]


def _components(halves: _Halves, others: Iterable[Measurement]) -> list[Baseline]:
    """Principal components of other surfaces at these directions, of the channel in the middle of each."""
    both = [tables.half_difference_cell(data.geom) for data in (halves.fitted, halves.left_out)]
    cells = np.concatenate(both)
    looked = [table for table in (_looked_up(each, cells) for each in others) if np.isfinite(table).mean() > COVERED]
    if len(looked) < LEAST_OTHERS:
        raise InputError(
            f"found {len(looked)} tables of other surfaces with values in {100 * COVERED:.0f} % of the cells of these "
            f"directions; wanted {LEAST_OTHERS} or more to make a basis of"
        )
    at = np.stack(looked)
    middle = len(halves.fitted.channels) // 2
    ln = np.concatenate([_ln(halves.fitted)[:, middle], _ln(halves.left_out)[:, middle]])
    kept = np.isfinite(at).all(axis=0) & np.isfinite(ln)
    first = (np.arange(len(ln)) < len(both[0]))[kept]
    mean, parts = components.principal(at[:, kept])
    found = []
    for count in (each for each in COMPONENTS if each <= len(parts)):
        left = components.fit_principal(mean, parts, ln[kept], first, count) - ln[kept]
        here, there = (float(np.sqrt(np.mean(left[half] ** 2))) for half in (first, ~first))
        found.append(Baseline(f"components:{count}", count, here, there, note=f"of {len(looked)} surfaces"))
    return found
