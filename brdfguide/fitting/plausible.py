"""What is known of a surface besides the error of fits: of several that the data leave equal, which it rules out."""

from collections.abc import Mapping, Sequence
from math import isfinite, log, sqrt

import numpy as np

from ..data.metal_or_dielectric import LEAST_METAL, LOW_DEG, MOST_DIELECTRIC
from ..flags import Effect
from ..models import Composite, Model
from ..models.model import Term
from ..physics import fresnel
from ..records import dataclass
from .ranked import BETTER, Row

MOST_NAMED = 3  # in an aside
MOST_RETURNED = 1.2  # of the light; a scale may be that far off (ours)
AT_BOUND = "a parameter at its bound"
NEAR_GROWTH = log(1.5)  # |ln| of a model's rise in the mirror direction over the data's, up to which it is near (ours)
FAR_GROWTH = log(2.5)  # the same, from which on it is far (ours)
_BRIGHTEST = float(fresnel.index_from_f0(MOST_DIELECTRIC)), 0.0  # n and k of a dielectric
_DARKEST = 1.0, 2 * sqrt(LEAST_METAL / (1 - LEAST_METAL))  # of a metal, as those are fitted whose edge is not told


def plausible(rows: Sequence[Row], best: Row, kind: str | None) -> tuple[list[Row], str]:
    """Those of `rows` that may be recommended, and an aside on the others; never none.

    After the verdict "dielectric" a lobe has Fresnel's factor, unless it has a parameter at its bound; where the kind
    is not known, none of the other kind than the best, but a metal where that is a dielectric with a lobe as bright as
    none has. From one incidence none without Fresnel's factor while another that ties has it: nothing else tells how
    its lobe grows. None of whose numbers most are undetermined while another's are not; none that returns more light
    than it gets while another does not; none at a bound while another is inside; none whose rise toward grazing is far
    from the data's while another's is near.
    """
    aside = ""
    if kind == "dielectric":
        if not any(_has_fresnel(row) and _inside(row) for row in rows):
            rows, aside = _sifted(rows, _inside, aside, AT_BOUND)
        rows, aside = _sifted(rows, _has_fresnel, aside, "no Fresnel factor, which a dielectric's lobe has")
    elif kind is None and _only_a_metal_is_as_bright(rows, best):
        rows, aside = _sifted(rows, is_metal, aside, "a lobe as bright as no dielectric's surface")
    elif kind is None:
        rows, aside = _sifted(
            rows,
            lambda row: is_metal(row) == is_metal(best),
            aside,
            "another kind of surface, which these data leave open",
        )
    one_incidence = best.mirror_from_deg is not None and best.growth is None
    if one_incidence and any(row.tied and _has_fresnel(row) for row in rows):
        rows, aside = _sifted(
            rows, _has_fresnel, aside, "no Fresnel factor, and one incidence does not tell how they grow"
        )
    rows, aside = _sifted(rows, _is_determined, aside, "numbers of which most are not determined")
    rows, aside = _sifted(rows, _keeps_energy, aside, "a lobe that returns more light than it gets")
    rows, aside = _sifted(rows, _inside, aside, AT_BOUND)
    if any(growth_error(row) <= NEAR_GROWTH for row in rows):
        rows, aside = _sifted(
            rows, lambda row: growth_error(row) < FAR_GROWTH, aside, "another rise toward grazing than the data"
        )
    return list(rows), aside


def foreseeing(rows: Sequence[Row]) -> tuple[list[Row], str]:
    """Those of `rows` that err at angles left out no more than the least of them, or whose misfit is noise, and an
    aside on the others; never none."""
    least = min((row.held_out.rms_ln for row in rows if row.held_out), default=0.0)

    def foresees(row: Row) -> bool:
        off = any(each.effect is Effect.OF_MISFIT for each in row.fit.warnings)
        return not (off and row.held_out and least < BETTER * row.held_out.rms_ln)

    kept, aside = _sifted(rows, foresees, "", "more error at angles left out")
    return list(kept), aside


def growth_error(row: Row) -> float:
    """|ln| of its rise in the mirror direction over the data's; 0 where that was not measured."""
    if row.growth is None:
        return 0.0
    pairs = [(row.growth["r_mirror"], row.growth["r_mirror_data"])]
    known = [abs(log(one / other)) for one, other in pairs if isfinite(one) and isfinite(other) and min(one, other) > 0]
    return max(known, default=0.0)


def is_metal(row: Row) -> bool:
    """Whether it is a metal's lobe without a body: k is what was fitted."""
    bodies = any(term.model.is_body for term in row.fit.model.terms)
    return not bodies and any(key.endswith(".k") for key in row.fit.model.free)


def _only_a_metal_is_as_bright(rows: Sequence[Row], best: Row) -> bool:
    """Whether the best returns more than a dielectric can, or has no index to tell by and all that have one do."""
    judged = [best] if is_metal(best) or _has_index(best) else [row for row in rows if _has_index(row)]
    judged = [row for row in judged if not is_metal(row)]
    return bool(judged) and all(too_bright_for_a_dielectric(row) is not None for row in judged)


def _has_index(row: Row) -> bool:
    return any(term.model.has_index for term in row.fit.model.terms)


@dataclass(frozen=True)
class Lobe:
    """What a lobe returns of the light at an incidence, and the most that a dielectric's surface can."""

    theta_i_deg: float  # 0 for all that count as near the normal
    level: float
    most: float


def too_bright_for_a_dielectric(row: Row) -> Lobe | None:
    """What the lobes of one that is no metal return of light, where no dielectric's surface can; None where it can, and
    where no mirror direction was measured.

    At the lowest incidence at which the mirror direction was measured: farther from the normal F0 is a guess, and what
    comes back is not.
    """
    if is_metal(row) or row.mirror_from_deg is None:
        return None
    return lobe_too_bright(row.fit.model, row.fit.values, row.mirror_from_deg)


def lobe_too_bright(model: Composite, values: Mapping, theta_i_deg: float) -> Lobe | None:
    """The same of a sum with these values, from light at this incidence.

    Sum of height x F, a lobe under a coat or with a k left out, median over the channels. Half way (of logarithms) from
    the brightest dielectric to the darkest metal, so that an absolute scale a little off decides nothing; toward
    grazing, where both return all, nothing is decided at all.
    """
    values, level = {**model.defaults(), **values}, np.zeros(1)
    theta = theta_i_deg if theta_i_deg > LOW_DEG else 0.0
    cos = np.cos(np.radians(theta))
    for term in model.terms:
        if term.model.has_index and not term.model.base and not np.any(values[term.key("k")]):
            level = level + _height(term, values) * fresnel.fresnel(cos, values[term.key("n")])
    found = float(np.median(level))
    most, least = (float(fresnel.fresnel(cos, *each)) for each in (_BRIGHTEST, _DARKEST))
    return Lobe(theta, found, most) if found**2 > most * least else None


def _is_determined(row: Row) -> bool:
    """Whether the data tell more than half of what was fitted."""
    loose = {each.subject for each in row.fit.warnings if each.effect is Effect.LOOSENS}
    return 2 * len(loose) <= len(row.fit.stderr)


def _keeps_energy(row: Row) -> bool:
    """Whether its lobes return no more of light at the normal than there is, by more than a scale is off: sum of height
    x F0, median over the channels."""
    values, level = {**row.fit.model.defaults(), **row.fit.values}, np.zeros(1)
    for term in row.fit.model.terms:
        if term.model.has_index and not term.model.base:
            level = level + _height(term, values) * fresnel.f0(values[term.key("n")], values[term.key("k")])
    return float(np.median(level)) < MOST_RETURNED


def _height(term: Term, values: Mapping) -> np.ndarray | float:
    """Of a lobe beside Fresnel's factor; 1 of a mirror, which has none."""
    return values[term.key(term.model.amplitude)] if term.model.amplitude else 1.0


def _inside(row: Row) -> bool:
    return not any(each.effect is Effect.AT_BOUND for each in row.fit.warnings)


def _has_fresnel(row: Row) -> bool:
    lobes = [term.model for term in row.fit.model.terms if term.model.is_lobe and not _beside(term.model)]
    return all(model.has_index or model.base for model in lobes)


def _beside(law: Model) -> bool:
    """Whether a lobe only stands beside that of the surface, as light sent back does."""
    return law.candidacy is not None and law.candidacy.grown == "beside"


def _sifted(rows: Sequence[Row], good, aside: str, has: str) -> tuple[Sequence[Row], str]:
    """Those that are good, unless none is, and an aside on the rest."""
    kept, rest = [row for row in rows if good(row)], [row for row in rows if not good(row)]
    if not kept or not rest:
        return rows, aside
    names = [row.fit.name for row in rest]
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return kept, f"{aside}; {', '.join(names[:MOST_NAMED])}{more} {'has' if len(rest) == 1 else 'have'} {has}"
