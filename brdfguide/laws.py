"""What a reflectance law has to obey, as measurements of how far it falls short: the content of `check`.

Each function takes a Model and gives an Outcome. Values are drawn from the whole box of its parameters, directions
from the whole hemisphere, half of them crowded toward the mirror direction and toward grazing. Seeds are fixed.
"""

from dataclasses import dataclass, field

import numpy as np

from . import hemisphere
from .geometry import Geometry, in_plane, rows
from .models import Model
from .references import REFERENCES, evaluate

INCIDENCE = (0.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.99)  # of the energy law [deg]
# a scan in the plane of incidence, as instruments make it: every 5°, and closer about the mirror direction
BESIDE = np.concatenate([-np.geomspace(0.02, 10, 10), np.geomspace(0.02, 10, 10)])
SCAN = rows(in_plane(np.repeat([10.0, 45, 60, 75], 55), np.concatenate([np.concatenate([np.arange(-85.0, 86, 5), t + BESIDE]) for t in (10, 45, 60, 75)])))


@dataclass(frozen=True)
class Outcome:
    """How often a law was tried, how far it was missed at worst, and there: angles [deg] and parameters."""

    cases: int
    worst: float
    at: dict = field(default_factory=dict)


class Worst:
    """Keeps the largest error and where it was."""

    def __init__(self):
        self.cases, self.error, self.at = 0, 0.0, {}

    def see(self, errors, geom: Geometry | None = None, values=None, **more) -> None:
        """Errors over the directions of `geom`; one that is not a number is infinitely wrong."""
        errors = np.abs(np.atleast_1d(np.asarray(errors, float)))
        errors = np.where(np.isfinite(errors), errors, np.inf)
        self.cases += errors.size
        if errors.size and errors.max() > self.error:
            self.error = float(errors.max())
            self.at = {**where(geom, int(np.argmax(errors.reshape(errors.shape[0], -1).max(1)))), **plain(values or {}), **more}

    def outcome(self) -> Outcome:
        return Outcome(self.cases, self.error, self.at)


def where(geom: Geometry | None, row: int) -> dict:
    if geom is None:
        return {}
    at = lambda a: float(np.ravel(np.broadcast_to(a, geom.shape))[row])  # noqa: E731
    return {"theta_i_deg": at(geom.theta_i_deg), "theta_r_deg": at(geom.theta_r_deg), "phi_deg": round(at(np.remainder(geom.phi_deg, 360)), 6)}


def plain(values) -> dict:
    return {name: float(f"{value:.6g}") for name, value in values.items() if np.ndim(value) == 0}


def within(p, share: float) -> float:
    """The value at `share` 0..1 of a parameter's range, even in its logarithm if that is how it is fitted."""
    if not p.log:
        return p.low + share * (p.high - p.low)
    low, high = np.log(p.low - p.origin), np.log(p.high - p.origin)
    return float(np.clip(p.origin + np.exp(low + share * (high - low)), p.low, p.high))


def draws(term: Model, seed: int, count: int = 10, amplitude: float = 1.0):
    """The defaults, both corners of the box and `count` points in it; the amplitude as told, or at its bound below it."""
    rng = np.random.default_rng(seed)
    if not term.parameters:  # a surface with its values already in it
        yield {}
        return
    for values in (
        term.defaults(),
        {p.name: p.low for p in term.parameters},
        {p.name: p.high for p in term.parameters},
        *({p.name: within(p, rng.uniform()) for p in term.parameters} for _ in range(count)),
    ):
        yield {**values, **{p.name: min(p.high, amplitude) for p in term.parameters if p.linear}}


def directions(seed: int, count: int = 400, highest: float = 89.9999) -> Geometry:
    """Random pairs as rows; half of either kind near the mirror direction or near grazing."""
    rng = np.random.default_rng(seed)
    half = lambda a, b: np.where(rng.uniform(size=count) < 0.5, a, b)  # noqa: E731
    theta_i = half(rng.uniform(0, 90, count), 90 - 10 ** rng.uniform(-4, 1.5, count))
    theta_r = half(rng.uniform(0, 90, count), theta_i + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count))
    phi = half(rng.uniform(0, 360, count), 180 + rng.normal(size=count) * 10 ** rng.uniform(-4, 1, count))
    fold = lambda a: np.clip(np.abs(a), 0, highest)  # noqa: E731
    return rows(Geometry.from_degrees(fold(theta_i), 0.0, fold(theta_r), phi))


def references(term: Model) -> Outcome:
    """Relative error at pins, at extremes whose value is known, and at the stiff points of `references`."""
    worst = Worst()
    for point in (*term.pins, *(extreme for extreme in term.extremes if extreme.f is not None)):
        worst.see(_relative(float(term(point.geom, **point.values)), point.f), point.geom, point.values)
    for point in REFERENCES:
        if point.model == term.name:
            worst.see(_relative(evaluate(point, term), point.right), point.geom, point.values, why=point.why)
    return worst.outcome()


def _relative(got: float, right: float) -> float:
    return abs(got - right) / (abs(right) or 1.0)


def finite(term: Model) -> Outcome:
    """1 for each value that is not a finite number, or on whose way something overflowed or was 0/0."""
    worst, geom = Worst(), directions(21)
    for values in draws(term, 21):
        worst.see(~np.isfinite(term(geom, **values)), geom, values)
    for extreme in term.extremes:
        worst.see(~np.isfinite(term(extreme.geom, **extreme.values)), extreme.geom, extreme.values, why=extreme.why)
    return worst.outcome()


def positive(term: Model) -> Outcome:
    """How far below 0, of the greatest value."""
    worst, geom = Worst(), directions(22)
    for values in draws(term, 22):
        f = term(geom, **values)
        worst.see(np.maximum(-f, 0) / (np.abs(f).max() or 1.0), geom, values)
    return worst.outcome()


def horizon(term: Model) -> Outcome:
    """What is sent from or to below the horizon."""
    worst = Worst()
    geom = rows(Geometry.from_degrees(np.array([30.0, 95, 90, 120]), 0.0, np.array([100.0, 20, 89, 120]), 180.0))
    for values in draws(term, 23, 3):
        worst.see(term(geom, **values), geom, values)
    return worst.outcome()


def reciprocity(term: Model) -> Outcome:
    """Relative change when light and detector change places."""
    worst, geom = Worst(), directions(24)
    for values in draws(term, 24):
        f, swapped = np.broadcast_arrays(term(geom, **values), term(geom.swapped(), **values))
        worst.see(np.abs(f - swapped) / np.maximum(np.maximum(f, swapped), 1e-200), geom, values)
    return worst.outcome()


def energy(term: Model) -> Outcome:
    """How much more than 1 is reflected, with the greatest amplitude that sends no more than 1 at normal incidence."""
    worst = Worst()
    for values in draws(term, 25, 4):
        if "albedo" in values:
            values["albedo"] = 1.0
        dhr = hemisphere.dhr(term, INCIDENCE, values).max(axis=1)
        amount = next((p for p in term.parameters if p.linear), None)
        if amount is not None and amount.unit == "1/sr":
            dhr = dhr / max(dhr[0], 1e-6)  # a lobe that sends nothing there is taken as it is, a million times
        worst.see(np.maximum(dhr - 1, 0), in_plane(np.array(INCIDENCE), 0.0), values)
    return worst.outcome()


def rotation(term: Model) -> Outcome:
    """Relative change when the surface is turned in its plane."""
    rng, worst = np.random.default_rng(26), Worst()
    theta_i, theta_r = rng.uniform(0, 89.99, 300), rng.uniform(0, 89.99, 300)
    phi = np.round(rng.uniform(0, 360, 300), 3)
    straight, turned = (rows(Geometry.from_degrees(theta_i, turn, theta_r, phi + turn)) for turn in (0.0, -256.5))
    for values in draws(term, 26):
        f, g = term(straight, **values), term(turned, **values)
        worst.see(np.abs(f - g) / np.maximum(np.maximum(f, g), 1e-200), straight, values)
    return worst.outcome()


def continuity(term: Model) -> Outcome:
    """The largest jump, of the values beside it, along a parameter or an angle."""
    worst, rng = Worst(), np.random.default_rng(27)
    places = directions(27, 16, highest=88.0)
    for values in draws(term, 27, 2):
        for p in term.parameters:
            if not p.linear:
                along = lambda share: term(places, **{**values, p.name: np.array([within(p, s) for s in share])}).T  # noqa: B023, E731
                _see_jump(worst, along, values, along=p.name)
        theta_i, phi = rng.uniform(0, 85), rng.uniform(0, 180)
        tilted = lambda share: term(rows(Geometry.from_degrees(theta_i, 0, 89 * share, phi)), **values)  # noqa: B023, E731
        turned = lambda share: term(rows(Geometry.from_degrees(theta_i, 0, 0.7 * theta_i, 180 * share)), **values)  # noqa: B023, E731
        _see_jump(worst, tilted, {**values, "theta_i_deg": theta_i, "phi_deg": phi}, along="theta_r_deg")
        _see_jump(worst, turned, {**values, "theta_i_deg": theta_i}, along="phi_deg")
    return worst.outcome()


def _see_jump(worst: Worst, law, values, along: str, points: int = 1500, suspects: int = 4, zooms: int = 14) -> None:
    """Looks closer and closer, 4-fold each time, where ln f is least like a polynomial of degree 5."""
    share = np.linspace(0, 1, points)
    rough = _roughness(law(share))
    for _ in range(suspects):
        place = int(np.argmax(rough))
        low, high, size, jumps = share[place], share[place + 6], None, []
        rough[max(place - 6, 0) : place + 7] = 0
        for _ in range(zooms):
            inner = np.linspace(low, high, 25)
            f = law(inner)
            size = np.abs(f).max(0) + 1e-200 if size is None else size
            start = int(np.argmax(_roughness(f)))
            jumps.append(float(np.max(np.abs(np.diff(f[start : start + 7], axis=0)) / size)))
            low, high = inner[start], inner[start + 6]
        stays = jumps[-1] > 0.5 * jumps[zooms // 2]  # the jump of a merely steep law shrinks as the view narrows
        worst.see(jumps[-1] if stays else 0.0, None, values, along=along, at_share=float(low))


def _roughness(f):
    """Sixth differences of ln f along the first axis, the largest over the directions; 0 where f is."""
    dark = f < 1e-250
    ln = np.log(np.where(dark, 1.0, f))
    return np.where(np.lib.stride_tricks.sliding_window_view(dark, 7, axis=0).any(-1), 0.0, np.abs(np.diff(ln, 6, axis=0))).max(1)


def gradient(term: Model) -> Outcome:
    """Relative error of the analytic derivatives against fourth-order differences, of the greatest."""
    worst, geom = Worst(), directions(28, 200, highest=88.0)
    names = [p.name for p in term.parameters if not p.linear]
    if term.gradient is None:
        return worst.outcome()
    for values in draws(term, 28):
        # a percent beside the values, since defaults may stand on a crease such as that of a mirror lobe
        inside = {p.name: min(max(1.01 * values[p.name], within(p, 0.02)), within(p, 0.98)) for p in term.parameters}
        f, slopes = term(geom, **inside), term.gradient(geom, names, **inside)
        for name, slope in slopes.items():
            slope = np.broadcast_to(slope, f.shape)
            seen = f > 1e-6 * f.max()
            steepest = np.max(np.abs(slope[seen] / f[seen]), initial=0.0)
            step = min(1e-3 * (inside[name] - term.parameter(name).origin), 0.01 / (steepest + 1e-9))
            if step <= 0:
                continue
            below, low, high, above = (term(geom, **{**inside, name: inside[name] + s * step}) for s in (-2, -1, 1, 2))
            expected = (below - 8 * low + 8 * high - above) / (12 * step)
            whole = (below > 0) == (above > 0)  # not across the edge of a lobe
            size = np.abs(expected).max() + f.max() / (step * 1e8) + 1e-200
            worst.see(np.where(whole, np.abs(slope - expected) / size, 0.0), geom, inside, by=name)
    return worst.outcome()


def condition(term: Model) -> Outcome:
    """Condition number of d ln f/d ln p at the defaults, over a scan in the plane of incidence; 0 for one parameter."""
    wanted = {p.name: p.origin for p in term.parameters if p.free}
    number = jacobian_condition(lambda values: term(SCAN, **values), term.defaults(), wanted)
    return Outcome(1, number, plain(term.defaults())) if number else Outcome(0, 0.0)


def jacobian_condition(f_of, values: dict, origins: dict) -> float:
    """Of the columns d ln f/d ln(p - origin), each of length 1: how much better one combination is known than another."""
    f = f_of(values)
    if len(origins) < 2 or not np.any(f):
        return 0.0
    columns = []
    for name, origin in origins.items():
        h = 1e-4 * (values[name] - origin)
        ahead, behind = (f_of({**values, name: values[name] + s * h}) for s in (1, -1))
        seen = (f > 1e-100) & (ahead > 1e-100) & (behind > 1e-100)
        columns.append(np.where(seen, np.log(np.where(seen, ahead, 1) / np.where(seen, behind, 1)), 0.0)[:, 0])
    matrix = np.stack(columns, 1)
    return float(np.linalg.cond(matrix / np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)))
