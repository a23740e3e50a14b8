"""Whether a ranking holds an answer that anybody should trust."""

from collections.abc import Sequence
from math import exp, expm1, log

import numpy as np

from ..data.metal_or_dielectric import LEAST_METAL
from ..finding import Finding
from ..flags import Effect
from ..physics import fresnel
from .choosing import trusted
from .index_doubts import index_doubts
from .plausible import is_metal, too_bright_for_a_dielectric
from .ranked import Ranking, Row

MOST_ERROR = log(1.5)  # rms ln: typically 50 % off (ours)
MOST_NOISE = 10.0  # times the scatter of single values, beyond which such an error is the model's (ours)


def distrusted(ranking: Ranking, *, anyway: bool = False) -> Ranking:
    """The same with a warning where no answer can be trusted; unless `anyway`, it takes the answer back.

    That is where even the best model is far off, by `MOST_ERROR` and by `MOST_NOISE` times the noise, and where every
    candidate that was refined ended at a bound.
    """
    row = ranking.recommended
    ranking = ranking.warned(*_no_metal(row), *_no_dielectric(row), *index_doubts(row))
    text = _far_off(trusted(ranking.rows), ranking.noise) or _at_bounds(ranking.rows)
    if not text:
        return ranking
    doubt = Finding("not-to-be-trusted", text, "warning" if anyway else "outside", option="--anyway")
    return ranking.warned(doubt)


def _no_metal(row: Row) -> tuple[Finding, ...]:
    """A doubt about a metal that reflects less than any: the brightest channel counts, since gold is dark in blue."""
    if not is_metal(row):
        return ()
    key = next(key for key in row.fit.model.free if key.endswith(".k"))
    n = row.fit.values[f"{key.removesuffix('.k')}.n"]
    most = float(np.max(fresnel.f0(n, row.fit.values[key])))
    if most >= LEAST_METAL:
        return ()
    text = f"the fitted F0 of {most:.2g} is below any metal's ({LEAST_METAL:g} or more)"
    return (Finding("f0-below-metals", text, "warning", "a dark dielectric, or a wrong scale", "--kind dielectric"),)


def _no_dielectric(row: Row) -> tuple[Finding, ...]:
    """A doubt about a body whose lobe reflects more than any dielectric's."""
    lobe = too_bright_for_a_dielectric(row)
    if lobe is None:
        return ()
    where = f"{lobe.theta_i_deg:.3g} degrees of incidence" if lobe.theta_i_deg else "the normal"
    text = f"its lobe returns {lobe.level:.2g} at {where}, more than any dielectric's surface ({lobe.most:.2g} at most)"
    consequence = "a metal, flakes under a clear coat, or a wrong scale"
    return (Finding("f0-above-dielectrics", text, "warning", consequence, "--kind metal"),)


def _far_off(rows: Sequence[Row], noise: float) -> str:
    least = min(row.rms_ln for row in rows)
    if not least > max(MOST_ERROR, MOST_NOISE * noise):
        return ""
    times = f", {least / noise:.0f} times the noise of a single value" if noise > 0 else ""
    return f"even the best model is typically off by {_words(least)}{times}"


def _words(error: float) -> str:
    """An rms of ln as a percentage, or a factor where that says more."""
    return f"{100 * expm1(error):.0f} %" if error < log(2.0) else f"a factor {exp(min(error, 300.0)):.2g}"


def _at_bounds(rows: Sequence[Row]) -> str:
    refined = [row for row in rows if not _has(row, Effect.UNREFINED)]
    if not all(_has(row, Effect.AT_BOUND) for row in refined):
        return ""
    return "every model that comes near ended at the end of a parameter's range"


def _has(row: Row, effect: Effect) -> bool:
    return any(each.effect is effect for each in row.fit.warnings)
