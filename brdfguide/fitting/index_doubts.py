"""What a fitted index of refraction is not: one that no dielectric has, or one that changes with colour as none does.

A free height beside Fresnel's factor leaves n to say how fast the lobe rises toward grazing, and nothing else; without
one n carries the lobe's level. Either may end where no substance is. The fit is no worse for it, but n is no index.
"""

import numpy as np

from ..data.metal_or_dielectric import LOW_DEG, MOST_DIELECTRIC
from ..finding import Finding
from ..flags import Effect
from ..models.model import Term
from ..physics import fresnel
from .plausible import is_metal, too_bright_for_a_dielectric
from .ranked import REAL, Row

LEAST_INDEX = 1.3  # of ice; water has 1.33, and what has less is a gas, a foam or an aerogel
MOST_INDEX = float(fresnel.index_from_f0(MOST_DIELECTRIC))
MOST_DISPERSION = 1.2  # times, over the visible spectrum: rutile's index has 1.15, glass's 1.02 (ours)


def index_doubts(row: Row) -> tuple[Finding, ...]:
    """Doubts about every index that was fitted without a k; none about one that is at a bound or not determined."""
    if is_metal(row):
        return ()
    told = (term for term in row.fit.model.terms if term.model.has_index and _is_told(row, term.key("n")))
    found = {term.key("n"): (_out_of_range(row, term) or _by_channel(row, term)) for term in told}
    return tuple(each for each in found.values() if each)


def _is_told(row: Row, key: str) -> bool:
    """Whether it was fitted, and is neither at a bound nor undetermined."""
    doubted = (each.subject == key and each.effect in (Effect.AT_BOUND, Effect.LOOSENS) for each in row.fit.warnings)
    return key in row.fit.stderr and not any(doubted)


def _out_of_range(row: Row, term: Term) -> Finding | None:
    """Where all that it may be, in the middle of the channels, is no substance's."""
    key = term.key("n")
    n, doubt = np.atleast_1d(row.fit.values[key]), REAL * np.atleast_1d(row.fit.stderr[key])
    middle = float(np.median(n))
    if np.median(n + doubt) < LEAST_INDEX:
        text = f"{key} of {middle:.3g} is below any solid's or liquid's ({LEAST_INDEX:g})"
        means = "the lobe is weaker than a dielectric's surface: a scale too low, or light that the law does not lose"
        return _finding(key, text, means, n)
    if not np.median(n - doubt) > MOST_INDEX or too_bright_for_a_dielectric(row):  # which is said by itself
        return None
    text = f"{key} of {middle:.3g} is above any dielectric's ({MOST_INDEX:g})"
    if _height(row, term) is not None:
        means = "beside a free height it only says that the lobe hardly rises toward grazing: it is no index"
        return _finding(key, text, means, n)
    lowest = row.mirror_from_deg
    where = f", and from {lowest:.3g} degrees of incidence on" if lowest is not None and lowest > LOW_DEG else ": from"
    return _finding(key, f"{text}{where} a metal's lobe looks alike", "a metal is as likely", n, "--kind")


def _by_channel(row: Row, term: Term) -> Finding | None:
    """Where it changes between channels as no dielectric's does: beyond its doubts a coloured lobe, within them one
    index in all channels does as well."""
    key = term.key("n")
    n, stderr = np.atleast_1d(row.fit.values[key]), np.atleast_1d(row.fit.stderr[key])
    if np.size(n) < 2 or not np.max(n) > MOST_DISPERSION * np.min(n):
        return None
    weight = 1 / np.maximum(np.broadcast_to(stderr, n.shape), 1e-12) ** 2
    one = float(np.sum(weight * n) / np.sum(weight))
    ends = f"{np.min(n):.3g} to {np.max(n):.3g}"
    if np.sum(weight * (n - one) ** 2) <= len(n) - 1 + REAL * np.sqrt(2 * (len(n) - 1)):
        text = f"{key} of the channels, {ends}, differs by no more than its doubts: a dielectric has one"
        command = f"-m '{row.fit.name}' --fix {key}={one:.3g}"
        return _finding(key, text, f"{one:.3g} in all does about as well: {command}", n, "--fix")
    height = _height(row, term)
    f0 = fresnel.f0(n) * (1.0 if height is None else height)
    text = f"{key} changes from {ends} between channels, as no dielectric's does"
    return _finding(key, text, f"its lobe is coloured: F0 {np.min(f0):.2g} to {np.max(f0):.2g}", n)


def _height(row: Row, term: Term) -> np.ndarray | None:
    """The free height beside Fresnel's factor; None where there is none."""
    height = term.key(term.model.amplitude or "")
    return np.atleast_1d(row.fit.values[height]) if height in row.fit.stderr else None


def _finding(key: str, text: str, means: str, n: np.ndarray, option: str = "") -> Finding:
    numbers = (("least", float(np.min(n))), ("most", float(np.max(n))))
    return Finding("no-index", text, "warning", means, option, numbers, key)
