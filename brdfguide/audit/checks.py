"""What a reflectance law has to obey everywhere, as measurements of how far it falls short: the content of `check`.

Each function takes a Model and gives an Outcome. The limits that every law has are in `limits`.
"""

from functools import partial

import numpy as np

from ..models import Model
from ..physics import hemisphere
from ..physics.geometry import Geometry, in_plane, rows
from .references import REFERENCES, RTOL, our_value
from .trials import SCAN, TURNED_SCAN, Outcome, Worst, parameter_sets, six_digits, trial_directions, within

STREAK = 8.0  # length over width of a lobe in the energy law
INCIDENCE = (0.0, 60.0, 75.0, 85.0, 89.9, 89.99)  # of the energy law [deg]


def references(term: Model) -> Outcome:
    """Relative error at pins, at extremes whose value is known, and at the stiff points of `references`."""
    worst = Worst()
    for pin in term.pins:  # one of which an integral holds fewer digits counts by what it allows
        error = _relative(float(term(pin.geom, **pin.values)), pin.f)
        worst.see(error * min(1.0, RTOL / pin.rtol), pin.geom, pin.values)
    for extreme in term.extremes:
        if extreme.f is not None:
            error = _relative(float(term(extreme.geom, **extreme.values)), extreme.f)
            worst.see(error, extreme.geom, extreme.values)
    for point in REFERENCES:
        if point.model == term.name:
            worst.see(_relative(our_value(point, term), point.right), point.geom, point.values, why=point.why)
    return worst.outcome()


def _relative(got: float, right: float) -> float:
    return abs(got - right) / (abs(right) or 1.0)


def finite(term: Model) -> Outcome:
    """1 for each value that is not a finite number, or on whose way something overflowed or was 0/0."""
    worst, geom = Worst(), trial_directions(21)
    for values in parameter_sets(term, 21):
        worst.see(~np.isfinite(term(geom, **values)), geom, values)
    for extreme in term.extremes:
        worst.see(~np.isfinite(term(extreme.geom, **extreme.values)), extreme.geom, extreme.values, why=extreme.why)
    return worst.outcome()


def positive(term: Model) -> Outcome:
    """How far below 0, of the greatest value."""
    worst, geom = Worst(), trial_directions(22)
    for values in parameter_sets(term, 22):
        f = term(geom, **values)
        worst.see(np.maximum(-f, 0) / (np.abs(f).max() or 1.0), geom, values)
    for extreme in term.extremes:
        f = term(extreme.geom, **extreme.values)
        worst.see(np.maximum(-f, 0), extreme.geom, extreme.values, why=extreme.why)
    return worst.outcome()


def horizon(term: Model) -> Outcome:
    """What is sent from or to below the horizon."""
    worst = Worst()
    geom = rows(Geometry.from_degrees(np.array([30.0, 95, 90, 120]), 0.0, np.array([100.0, 20, 89, 120]), 180.0))
    for values in parameter_sets(term, 23, 3):
        worst.see(term(geom, **values), geom, values)
    return worst.outcome()


def reciprocity(term: Model) -> Outcome:
    """Relative change when light and detector change places."""
    worst, geom = Worst(), trial_directions(24)
    for values in parameter_sets(term, 24):
        f, swapped = np.broadcast_arrays(term(geom, **values), term(geom.swapped(), **values))
        worst.see(np.abs(f - swapped) / np.maximum(np.maximum(f, swapped), 1e-200), geom, values)
    return worst.outcome()


def energy(term: Model) -> Outcome:
    """How much more than 1 is reflected, with the greatest amplitude that sends no more than 1 at normal incidence."""
    worst = Worst()
    for values in parameter_sets(term, 25, 3):
        values |= {name: 1.0 for name in ("albedo", "base_color") if name in values}
        if "axis" in values:  # across the grain and along it, where both sides of the plane of incidence are alike
            values = _resolved(term, values) | {"axis": 0.0 if values["axis"] < 0.5 * np.pi else 0.5 * np.pi}
        dhr = hemisphere.dhr(partial(term, **values), INCIDENCE, streaks=term.grain is not None).max(axis=1)
        amount = next((p for p in term.parameters if p.linear), None)
        if amount is not None and amount.unit == "1/sr":
            dhr = dhr / max(dhr[0], 1e-6)  # a lobe that sends nothing there is taken as it is, a million times
        worst.see(np.maximum(dhr - 1, 0), in_plane(np.array(INCIDENCE), 0.0), values)
    return worst.outcome()


def _resolved(term: Model, values: dict) -> dict:
    """The same with a streak of at most `STREAK`, which the integral's nodes resolve."""
    if term.grain is None:
        return values
    names = term.grain.first, term.grain.second
    wide, narrow = term.grain.widths(*(values[name] for name in names))
    held = np.clip(narrow, wide / STREAK, wide * STREAK)
    inside = zip(names, term.grain.values(wide, held), strict=True)
    return values | {
        name: np.clip(value, term.parameter(name).low, term.parameter(name).high) for name, value in inside
    }


def rotation(term: Model) -> Outcome:
    """Relative change when the surface is turned in its plane."""
    rng, worst = np.random.default_rng(26), Worst()
    theta_i, theta_r = rng.uniform(0, 89.99, 300), rng.uniform(0, 89.99, 300)
    phi = np.round(rng.uniform(0, 360, 300), 3)
    straight, turned = (rows(Geometry.from_degrees(theta_i, turn, theta_r, phi + turn)) for turn in (0.0, -256.5))
    for values in parameter_sets(term, 26):
        f, g = term(straight, **values), term(turned, **values)
        worst.see(np.abs(f - g) / np.maximum(np.maximum(f, g), 1e-200), straight, values)
    return worst.outcome()


def grain(term: Model) -> Outcome:
    """Relative change of a law with an axis when directions and axis are turned together, when all is turned by half a
    turn, and when both widths change places with the axis a quarter of a turn on."""
    rng, worst = np.random.default_rng(29), Worst()
    if "axis" not in term.defaults():
        return worst.outcome()
    theta_i, theta_r = rng.uniform(0, 89.99, 300), rng.uniform(0, 89.99, 300)
    phi_i, phi = np.round(rng.uniform(0, 360, 300), 3), np.round(rng.uniform(0, 360, 300), 3)
    phi[::2] = 180 + np.round(rng.normal(0, 5, 150), 3)  # half of them near a streak
    theta_r[::2] = np.abs(theta_i[::2] + rng.normal(0, 5, 150)) % 89.99
    straight, turned, half = (
        rows(Geometry.from_degrees(theta_i, phi_i + turn, theta_r, phi_i + phi + turn)) for turn in (0.0, 103.5, 180.0)
    )
    for values in parameter_sets(term, 29):
        f = term(straight, **values)
        others = [term(turned, **values | {"axis": (values["axis"] + np.radians(103.5)) % np.pi}), term(half, **values)]
        exchanged = _widths_exchanged(term, values)
        others += [] if exchanged is None else [term(straight, **exchanged)]
        for g in others:
            worst.see(np.abs(f - g) / np.maximum(np.maximum(np.abs(f), np.abs(g)), 1e-200), straight, values)
    return worst.outcome()


def _widths_exchanged(term: Model, values: dict) -> dict | None:
    """The same surface with both widths in the other order; None where the law has one order only."""
    if term.grain is None:
        return None
    names = (term.grain.first, term.grain.second)
    wide, narrow = term.grain.widths(*(values[name] for name in names))
    found = dict(zip(names, term.grain.values(narrow, wide), strict=True))
    if any(not term.parameter(name).low <= value <= term.parameter(name).high for name, value in found.items()):
        return None
    return values | found | {"axis": (values["axis"] + 0.5 * np.pi) % np.pi}


def continuity(term: Model, count: int = 1, points: int = 1500, suspects: int = 4) -> Outcome:
    """The largest jump, of the values beside it, along a parameter or an angle.

    Takes  `count` sets of values beside the defaults and both corners, `points` along each, `suspects` to look at.
    """
    worst, rng = Worst(), np.random.default_rng(27)
    places, look = trial_directions(27, 16, highest=88.0), partial(_see_jump, worst, points=points, suspects=suspects)
    for values in parameter_sets(term, 27, count):
        for p in term.parameters:
            if not p.linear:
                look(partial(_along_parameter, term, values, p, places), values, along=p.name)
        theta_i, phi = rng.uniform(0, 85), rng.uniform(0, 180)
        tilted, turned = partial(_tilted, term, values, theta_i, phi), partial(_turned, term, values, theta_i)
        look(tilted, {**values, "theta_i_deg": theta_i, "phi_deg": phi}, along="theta_r_deg")
        look(turned, {**values, "theta_i_deg": theta_i}, along="phi_deg")
    return worst.outcome()


def _along_parameter(term: Model, values, p, places, share):
    return term(places, **{**values, p.name: within(p, share)}).T


def _tilted(term: Model, values, theta_i, phi, share):
    return term(rows(Geometry.from_degrees(theta_i, 0, 89 * share, phi)), **values)


def _turned(term: Model, values, theta_i, share):
    return term(rows(Geometry.from_degrees(theta_i, 0, 0.7 * theta_i, 180 * share)), **values)


def _see_jump(worst: Worst, function, values, along: str, points: int, suspects: int, zooms: int = 14) -> None:
    """Looks closer and closer, 4-fold each time, where ln f is least like a polynomial of degree 5."""
    share = np.linspace(0, 1, points)
    rough = _roughness(function(share))
    for _ in range(suspects):
        place = int(np.argmax(rough))
        low, high, size, jumps = share[place], share[place + 6], None, []
        rough[max(place - 6, 0) : place + 7] = 0
        for _ in range(zooms):
            inner = np.linspace(low, high, 25)
            f = function(inner)
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
    return np.where(
        np.lib.stride_tricks.sliding_window_view(dark, 7, axis=0).any(-1), 0.0, np.abs(np.diff(ln, 6, axis=0))
    ).max(1)


def gradient(term: Model) -> Outcome:
    """Error of the analytic derivatives against differences, of each and of a tenth of the greatest."""
    worst, geom = Worst(), trial_directions(28, 200, highest=88.0)
    names = [p.name for p in term.parameters if not p.linear]
    if term.gradient is None:
        return worst.outcome()
    for values in parameter_sets(term, 28):
        # a percent beside the values, since defaults may stand on a crease such as that of a mirror lobe
        inside = {p.name: min(max(1.01 * values[p.name], within(p, 0.02)), within(p, 0.98)) for p in term.parameters}
        f, slopes = term(geom, **inside), term.gradient(geom, names, **inside)
        for name, slope in slopes.items():
            slope = np.broadcast_to(slope, f.shape)
            bright = f > 1e-6 * f.max()  # over which the step keeps ln f within a hundredth
            steepest = np.max(np.abs(slope[bright] / f[bright]), initial=0.0)
            step = min(1e-3 * abs(inside[name] - term.parameter(name).origin), 0.01 / (steepest + 1e-9))
            if step > 0:
                expected, whole = _differenced(partial(_moved, term, geom, inside, name), step)
                # the last two bits of f, 5e-16 of it, over the step: all that is left where a parameter hardly shows
                size = np.abs(expected).max() + f.max() / (step * 2e9) + 1e-200
                error = np.abs(slope - expected) / (np.abs(expected) + 0.1 * size)
                worst.see(np.where(whole, error, 0.0), geom, inside, by=name)
    return worst.outcome()


def _moved(term: Model, geom: Geometry, values: dict, name: str, by: float):
    return term(geom, **{**values, name: values[name] + by})


def _differenced(function, step: float):
    """The derivative of function(shift) at 0, by Richardson's rule to sixth order; and where f is not at the edge of a
    lobe, at which a small power has any slope."""
    pairs = [(function(share * step), function(-share * step)) for share in (2.0, 1.0, 0.5)]
    wide, middle, narrow = (
        (ahead - behind) / (2 * share * step) for share, (ahead, behind) in zip((2.0, 1.0, 0.5), pairs, strict=True)
    )
    once, twice = (4 * middle - wide) / 3, (4 * narrow - middle) / 3
    ahead, behind = pairs[0]
    return (16 * twice - once) / 15, (ahead == 0) == (behind == 0)


def condition(term: Model) -> Outcome:
    """Condition number of d ln f/d ln p at the defaults, over a scan in the plane of incidence, over three
    turns of a law with a grain; 0 for one parameter."""
    wanted, scan = {p.name: p.origin for p in term.parameters if p.free}, TURNED_SCAN if term.turns else SCAN
    number = jacobian_condition(lambda values: term(scan, **values), term.defaults(), wanted)
    return Outcome(1, number, six_digits(term.defaults())) if number else Outcome(0, 0.0)


def jacobian_condition(f_of, values: dict, origins: dict) -> float:
    """Of the columns d ln f/d ln(p - origin), each of length 1: how much better one combination is known than all."""
    f = f_of(values)
    if len(origins) < 2 or not np.any(f):
        return 0.0
    columns = []
    for name, origin in origins.items():
        h = 1e-4 * (values[name] - origin)
        ahead, behind = (f_of({**values, name: values[name] + s * h}) for s in (1, -1))
        positive = (f > 1e-100) & (ahead > 1e-100) & (behind > 1e-100)
        columns.append(
            np.where(positive, np.log(np.where(positive, ahead, 1) / np.where(positive, behind, 1)), 0.0)[:, 0]
        )
    matrix = np.stack(columns, 1)
    return float(np.linalg.cond(matrix / np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)))
