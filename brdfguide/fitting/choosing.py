"""Which model of a ranking to use, and why: the cheapest of those that the data cannot tell from the best, or that come
close enough to it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from ..data.measurement import Measurement
from ..data.rotation import turned_grain
from ..errors import InputError
from ..finding import Finding
from ..flags import Effect
from ..physics import seen
from . import appearance
from .missed import likelihoods
from .plausible import foreseeing, plausible
from .ranked import REAL, Ranking, Row

ALLOWED = 0.05  # rms ln that closeness to the eye may always cost: typically 5 % (ours)
ALLOWED_SHARE = 0.25  # of the best error, where that is more: the tolerance that its S has as well (ours)
DIFFERENT_SHARE = 0.5  # the same where the best is seen to be clearly different: the eye is then asked first (ours)
SIMPLER = 0.9  # times the fewest numbers of those that tie, up to which another is simpler, as closeness asks (ours)
MANY = 2.0  # times the numbers of another that ties, from which on a model is not for its cost to be preferred (ours)
CHEAPER = 0.8  # times the operations of another, from which on a model is called cheaper
AS_LIKELY = 0.1  # times the probability of the most probable, from which on another is about as probable (ours)
MUCH_LESS = 1.5  # times the error of another with as few numbers, from which on the other is to be preferred (ours)
MUCH_CHEAPER = 4.0  # times fewer operations, from which on such a one may be recommended all the same (ours)


def recommending(ranking: Ranking, measurement: Measurement) -> Ranking:
    """The same with the model to use, why, which come close enough, and how good the best looks."""
    likely = likelihoods(trusted(ranking.rows), measurement) if ranking.metric == "ln" else None
    good = _best_first(ranking.rows, likely)
    best = good[0]
    if ranking.close == "look" and _is_stray_light(best):
        ranking = replace(ranking, close="none")
    grain = best.fit.model.turns and turned_grain(measurement)
    rows = tuple(replace(row, close=_is_close(row, good, ranking.close, grain)) for row in ranking.rows)
    pick, because = picked(rows, ranking.close, ranking.kind, likely)
    doubts = tuple(each for each in ranking.warnings if each.effect is not Effect.OF_LOOKS)
    looks = (_no_look(rows), appearance.too_coarse(best.fit.surface, measurement))
    return replace(
        ranking,
        rows=rows,
        recommended=pick,
        because=because,
        warnings=(*doubts, *(each for each in looks if each)),
    )


def _is_stray_light(row: Row) -> bool:
    """Whether a row is of polished optics, whose scatter people measure that no picture shows."""
    return any(term.model.candidacy and term.model.candidacy.polished for term in row.fit.model.terms)


def _is_close(row: Row, good: Sequence[Row], close: str, grain: bool) -> bool:
    """Whether a row comes close enough to the best of the `good` that can be trusted: `look`, to the eye; `N%`, by its
    error; `none`, never. To the eye none without a grain does where the data show one: it is the turning that is looked
    at."""
    best = good[0]
    if close == "none" or row not in good:
        return False
    if close == "look":
        if grain and not row.fit.model.turns:
            return False
        least = min(each.seen for each in good)
        share = ALLOWED_SHARE if best.seen < seen.NO_MODEL else DIFFERENT_SHARE
        allowed = best.rms_ln + max(ALLOWED, share * best.rms_ln) + 1e-9
        return row is best or (seen.close_enough(row.seen, least) and row.rms_ln <= allowed)
    return row.rms_ln - best.rms_ln <= percent_of(close) / 100


def percent_of(close: str) -> float:
    """The percentage in `1%`. Raises InputError for anything else that is not `look` or `none`."""
    number = close.removesuffix("%").strip()
    try:
        percent = float(number) if close.endswith("%") else -1.0
    except ValueError:
        percent = -1.0
    if not 0 < percent <= 100:
        raise InputError(f"--close {close}: wanted look, none, or a percentage such as 1%")
    return percent


def check_close(close: str) -> None:
    """Raises InputError for what --close does not know."""
    if close not in ("look", "none"):
        percent_of(close)


def picked(
    rows: Sequence[Row], close: str = "none", kind: str | None = None, likely: Mapping[int, float] | None = None
) -> tuple[Row, str]:
    """The cheapest of those that tie with the best trusted one or come close enough to it, and the reason in words.

    Of several that cost alike one that ties, and the simplest. Where closeness does not count, the simplest of those
    that cannot be told apart. Closeness counts for what is simpler than those that tie, and for what is seen to be
    closer than the best. Of those that tie none that is
    systematically off and errs more at angles left out than another; none that what is known of the surface
    (`plausible`; its `kind`) rules out; none that is merely cheaper than another with as few numbers and much less
    error (`_outdone`). Of few directions the most probable is the best (`likely`, `missed.likelihoods`), those about as
    probable tie with it, and nothing else comes close to the eye: neither that nor least error says much of the rest.
    """
    good = _best_first(rows, likely)
    best = good[0]
    if likely:
        as_likely = AS_LIKELY * likely[id(best.fit)]
        equal = [row for row in trusted(rows) if likely[id(row.fit)] >= as_likely]
    else:
        equal = [row for row in good if row.tied] if best.tied else [best]
    near = [row for row in good if row.close and row not in equal and not (likely and close == "look")]
    aside = _passed([row for row in rows[: rows.index(best)] if row not in good])
    if close == "look":
        nearest = min((best, *near), key=lambda row: row.seen)
        farther = [row for row in equal if _seen_farther(row, nearest)]
        equal = [row for row in equal if row not in farther]
        aside += _but_farther([row for row in farther if row is not best], best)
    equal, doubts = foreseeing(equal)
    aside += doubts
    left, doubts = plausible([*equal, *near], best, kind)
    equal, near = ([row for row in group if row in left] for group in (equal, near))
    aside += doubts
    if equal:
        fewest = min(row.fit.free for row in equal)
        near = [row for row in near if row.fit.free <= SIMPLER * fewest]
        equal = [row for row in equal if row.fit.free < MANY * max(fewest, 1)]
    equal, outdone = _outdone(equal)
    near, merely_cheaper = _outdone(near)
    pick = min(equal or near, key=lambda row: (row.fit.free, row.work))
    if close != "none":
        least = min(row.work for row in (*equal, *near))
        cheap = [row for row in (*equal, *near) if CHEAPER * row.work <= least]
        pick = min(cheap, key=lambda row: (row not in equal, row.fit.free, row.rms_ln))
    aside += _but_outdone([row for row in (*outdone, *merely_cheaper) if row.work < CHEAPER * pick.work], pick)
    if likely and pick not in near:
        return pick, _as_likely(pick, best, equal, good) + aside
    return pick, _because(pick, best, equal, near, good, close) + aside


def _because(pick: Row, best: Row, equal: Sequence[Row], near: Sequence[Row], good: Sequence[Row], close: str) -> str:
    """Why a row is recommended: by its error or by what it saves."""
    if pick in near:
        return f"{_close_words(pick, best, close)}{_gain(pick, best)}"
    if pick is not best:
        return f"cannot be told from {best.fit.name} by these data{_gain(pick, best)}"
    if len(equal) > 1:
        others = ", ".join(row.fit.name for row in equal if row is not pick)
        return f"least error, and the simplest of those that cannot be told apart by these data ({others})"
    behind = [row for row in good if row is not pick]
    if not behind:
        return "the only candidate"
    gap = behind[0].rms_ln - pick.rms_ln
    alike = f", and the cheapest of {len(near) + 1} that come close enough" if near else ""
    return f"least error{alike}; {behind[0].fit.name} follows {gap:.2g} behind in rms ln"


def _as_likely(pick: Row, best: Row, equal: Sequence[Row], good: Sequence[Row]) -> str:
    """Why a row is recommended where so few directions were measured that the most probable law is the best."""
    less = [row.fit.name for row in good if row.rms_ln < pick.rms_ln and row not in equal]
    verb = "has less error but is" if len(less) == 1 else "have less error but are"
    but = f"; {', '.join(less)} {verb} less probable, as so few directions say little of more numbers" if less else ""
    if pick is not best:
        first = "least error, and " if pick is min(good, key=lambda row: row.rms_ln) else ""
        return f"{first}about as probable as {best.fit.name} by so few directions{_gain(pick, best)}{but}"
    others = ", ".join(row.fit.name for row in equal if row is not pick)
    simplest = f", and the simplest of those that are about as probable ({others})" if others else ""
    return f"the most probable by so few directions{simplest}{but}"


def _best_first(rows: Sequence[Row], likely: Mapping[int, float] | None) -> list[Row]:
    """Those that can be trusted, by error or, where that is known, by how probable they are."""
    good = trusted(rows)
    return sorted(good, key=lambda row: -likely[id(row.fit)]) if likely else good


def trusted(rows: Sequence[Row]) -> list[Row]:
    """Those without a doubt that forbids to recommend them; all, where none is."""
    return [row for row in rows if not any(each.effect is Effect.FORBIDS for each in row.warnings)] or list(rows)


def _outdone(rows: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """Those that stand, and those that another outdoes: with as few numbers it errs much less, by more than twice the
    standard errors of both, and takes not many times the operations."""

    def outdoes(other: Row, row: Row) -> bool:
        gap = row.rms_ln - other.rms_ln
        return (
            other.fit.free <= row.fit.free
            and row.rms_ln > MUCH_LESS * other.rms_ln
            and gap > REAL * hypot(row.behind_se, other.behind_se)
            and other.work < MUCH_CHEAPER * row.work
        )

    stand = [row for row in rows if not any(outdoes(other, row) for other in rows)]
    return stand, [row for row in rows if row not in stand]


def _seen_farther(row: Row, nearest: Row) -> bool:
    """Whether nine of ten people would see that a row is farther from the data than another."""
    return row.seen >= max(seen.ALIKE, seen.CLEARER * nearest.seen)


def _but_farther(rows: Sequence[Row], best: Row) -> str:
    """An aside on ties that the eye breaks."""
    if not rows:
        return ""
    names = ", ".join(row.fit.name for row in rows)
    return f"; {names} cannot be told from {best.fit.name} by these data, but would be seen to be farther off"


def _but_outdone(rows: Sequence[Row], pick: Row) -> str:
    """An aside on those that would be cheaper than the pick and err much more."""
    if not rows:
        return ""
    least = min(rows, key=lambda row: row.work)
    times, off = pick.work / least.work, 100 * np.expm1(least.rms_ln)
    return f"; {least.fit.name} takes {times:.2g} times fewer operations, but is typically {off:.2g} % off"


def _passed(rows: Sequence[Row]) -> str:
    """An aside on those with less error that cannot be trusted."""
    if not rows:
        return ""
    names, verb = ", ".join(row.fit.name for row in rows), "has" if len(rows) == 1 else "have"
    return f"; {names} {verb} less error but cannot be trusted"


def _gain(pick: Row, best: Row) -> str:
    """What is won by taking another than the best; nothing where only what is known of the surface decides."""
    reasons = []
    if pick.fit.free < best.fit.free:
        fewer = best.fit.free - pick.fit.free
        reasons.append(f"has {fewer} fewer parameter{'s' if fewer > 1 else ''}")
    if pick.work < CHEAPER * best.work:
        reasons.append("is cheaper to evaluate")
    return f", and {' and '.join(reasons)}" if reasons else ""


def _close_words(pick: Row, best: Row, close: str) -> str:
    """Why a pick that the data can tell from the best will do all the same, and what that costs in error."""
    cost = f"typically {100 * np.expm1(pick.rms_ln):.2g} % off instead of {100 * np.expm1(best.rms_ln):.2g} %"
    if close != "look":
        return f"close enough to {best.fit.name}, {cost}"
    looks = "closer than" if _seen_farther(best, pick) else "close enough to"
    return f"looks {looks} {best.fit.name} (S {pick.seen:.2g} against {best.seen:.2g} L*; {cost})"


def _no_look(rows: Sequence[Row]) -> Finding | None:
    """Where even the best is seen to differ."""
    least = min(trusted(rows), key=lambda row: row.seen)
    if not least.seen > seen.NO_MODEL:
        return None
    text = f"no single model looks right: the best, {least.fit.name}, is {least.seen:.2g} L* from the data on a sphere"
    return Finding("no-model-looks-right", text, "warning", "side by side most people will see the difference")
