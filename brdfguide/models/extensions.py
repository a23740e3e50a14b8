"""What one more number or term a sum may be given, as the laws themselves say, and where it would begin.

A sum grows by one of these: heights beside Fresnel's factor, one more lobe of a law that it has, an index for each
lobe, a law that contains one that it has, a coat, a lobe beside the others.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from .. import models
from ..physics.fresnel import f0
from ..records import dataclass
from . import MOST_LOBES, Composite, Counted, Model
from .candidates import as_metal, containing, grown, has_edge, heights, with_edge, with_heights
from .model import Parameter, Term, counted

# where a second lobe begins: widths of the first and of the new one, in those of the first alone; ours, after the
# shapes that two lobes took on measured tables
SPLITS = ((1.0, 1 / 3), (1.0, 3.0), (1.5, 1 / 3), (0.7, 4.0))
REVIVED = (0.1, 1 / 3, 3.0, 10.0)  # widths, in those of the brightest, of a lobe that ended at nothing
NOTHING = 1e-6  # of the brightest lobe's height
EDGE_INDICES = (0.2, 1.0, 3.0)  # of metals, with k for the same F0
SLOPE_INDEX = 1.5  # of a dielectric whose height is no longer n's to carry


@dataclass(frozen=True, eq=False)
class Extension:
    """A sum with one thing more than another has."""

    adds: str  # in words
    model: Composite
    starts: tuple[Mapping, ...] = ()  # values to begin at; none: those of a grid
    levels: bool = True  # whether the amplitudes of the starts are still to be solved for


def extensions(model: Composite, values: Mapping, kind: str | None = None) -> Iterator[Extension]:
    """Every one of a sum with these values, for a surface of this kind (None: not known)."""
    yield from _heights(model, values)
    yield from edges(model, values)
    yield from _lobes(model, values)
    yield from _indices(model, values)
    yield from _general(model, values)
    yield from _coats(model, values, kind)
    yield from _beside(model, values)


def _heights(model: Composite, values: Mapping) -> Iterator[Extension]:
    """Heights that n carried until now."""
    freed = with_heights(model)
    if freed.free == model.free or has_edge(model):
        return
    starts = [dict(values)]
    if not is_metallic(model):
        ordinary = {term.key("n"): np.full_like(values[term.key("n")], SLOPE_INDEX) for term in _indexed(model)}
        starts.append({**values, **ordinary})
    yield Extension("a height of its own beside Fresnel's factor, for each channel", freed, tuple(starts))


def edges(model: Composite, values: Mapping) -> Iterator[Extension]:
    """F at 82 degrees of a metal, which F0 carried until now; not beside a height of its own."""
    if not is_metallic(model) or has_edge(model) or set(heights(model)).intersection(model.free):
        return
    adds = "an edge of its own in Fresnel's curve, F at 82 degrees, for each channel"
    yield Extension(adds, with_edge(model), edge_starts(model, values))


def edge_starts(model: Composite, values: Mapping) -> tuple[dict, ...]:
    """Values of a metal with an edge of its own that have the F0 of these, and another edge each."""
    starts = []
    for n in EDGE_INDICES:
        start = dict(values)
        for term in _indexed(model):
            normal = f0(values[term.key("n")], values[term.key("k")])
            k2 = (normal * (n + 1) ** 2 - (n - 1) ** 2) / np.maximum(1 - normal, 1e-6)
            start |= {term.key("n"): np.full_like(normal, n), term.key("k"): np.sqrt(np.maximum(k2, 1e-4))}
        starts.append(start)
    return tuple(starts)


def _lobes(model: Composite, values: Mapping) -> Iterator[Extension]:
    """One more lobe of a law that has a width."""
    on_top, under = counted(model.terms)
    laws = [law for law, _ in (*on_top, *under)]
    for part in (on_top, under):
        for place, (law, count) in enumerate(part):
            if not law.is_lobe or width_of(law) is None or count >= MOST_LOBES or laws.count(law) > 1:
                continue
            more = [*part[:place], (law, count + 1), *part[place + 1 :]]
            longer = _alike(model, more if part is on_top else on_top, more if part is under else under)
            words = ("a second lobe", "a third lobe")[count - 1]
            yield Extension(words, longer, tuple(_split(longer, model, values, law)))


def _split(longer: Composite, model: Composite, values: Mapping, law: Model) -> Iterator[dict]:
    """Starts of a sum with one lobe more: the last of a law divided into a narrower and a wider one."""
    carried = _carried(longer, model, values)
    *_, last, new = [term for term in longer.terms if (term.model.base or term.model) is law]
    parameter = width_of(law)
    assert parameter is not None
    width = carried[last.key(parameter.name)]
    for kept, added in SPLITS:
        at = {
            term.key(parameter.name): np.clip(width * factor, parameter.low, parameter.high)
            for term, factor in ((last, kept), (new, added))
        }
        others = {p.name: carried.get(last.key(p.name)) for p in law.parameters if new.key(p.name) not in carried}
        rest = {new.key(name): value for name, value in others.items() if value is not None}
        yield {**carried, **rest, **at}


def revived(model: Composite, values: Mapping) -> tuple[dict, ...]:
    """Starts with every lobe of a repeated law alive, where one of them ended at nothing: beside the brightest of its
    kind, narrower and wider. None where none did."""
    starts = list[dict]()
    on_top, under = counted(model.terms)
    for law, count in (*on_top, *under):
        parameter, height = width_of(law), law.amplitude
        terms = [term for term in model.terms if _is(term, law)]
        if count < 2 or not parameter or not height or any(term.key(height) not in values for term in terms):
            continue
        heights = [float(np.max(values[term.key(height)])) for term in terms]
        brightest = terms[int(np.argmax(heights))]
        for term, size in zip(terms, heights, strict=True):
            if size > NOTHING * max(heights):
                continue
            width = values[brightest.key(parameter.name)]
            for times in REVIVED:
                alive = {term.key(parameter.name): np.clip(width * times, parameter.low, parameter.high)}
                starts.append({**values, **alive})
    return tuple(starts)


def _indices(model: Composite, values: Mapping) -> Iterator[Extension]:
    """An index for each of some lobes that share one. Those of a metal share what the metal is."""
    on_top, under = counted(model.terms)
    shared = [law for law, count in (*on_top, *under) if law.has_index and count > 1]
    if not shared or is_metallic(model) or any(term.model.is_coat for term in model.terms):
        return
    apart = _alike(model, [each for part in on_top for each in _apart(*part)], under)
    owners = {term.label: term for term in model.terms}
    own = {term.key("n"): values[owners[term.label].key("n")] for term in _indexed(apart)}
    yield Extension("an index of its own for each lobe", apart, ({**_carried(apart, model, values), **own},), False)


def _apart(law: Model, count: int) -> list[Counted]:
    return [(law, 1)] * count if law.has_index else [(law, count)]


def _general(model: Composite, values: Mapping) -> Iterator[Extension]:
    """A law in place of one that it contains."""
    on_top, under = counted(model.terms)
    for law in dict.fromkeys(law for law, _ in (*on_top, *under)):
        for wider, asks in containing(law):
            if wider.is_body and not any(lobe.is_lobe for lobe, _ in (*on_top, *under)):
                continue  # a body by itself is tried from the start
            parts = [[(wider if each is law else each, count) for each, count in part] for part in (on_top, under)]
            longer = _alike(model, *parts)
            start = _carried(longer, model, values, {wider: law})
            given = {
                term.key(name): value
                for term in longer.terms
                if (term.model.base or term.model) is wider
                for name, value in asks.contains[law.name].items()
            }
            yield Extension(asks.adds, longer, ({**start, **given},), False)


def _coats(model: Composite, values: Mapping, kind: str | None) -> Iterator[Extension]:
    """A clear coat: over the body, the lobes its surface; over what is made for it, in place of the lobes; over all."""
    if any(term.model.is_coat for term in model.terms):
        return
    on_top, _ = counted(model.terms)
    bodies, lobes = ([each for each in on_top if each[0].is_body is body] for body in (True, False))
    if kind == "metal":
        if all(law.has_index for law, _ in lobes):
            over = _alike(model, [], lobes)
            yield Extension("a clear coat over it", over, (_carried(over, model, values),))
        return
    if bodies and lobes and all(law.has_index for law, _ in lobes):
        rough = models.made_of(lobes, bodies)
        index = {rough.terms[0].key("n"): float(np.clip(np.mean(values[_indexed(model)[0].key("n")]), 1.2, 2.0))}
        words = "a coat that darkens the body and has the lobe for its surface"
        yield Extension(words, rough, ({**_carried(rough, model, values), **index},))
        for law, _ in grown("coated"):
            over = models.made_of(lobes, [*bodies, (law, 1)])
            start = {**_carried(over, model, values), **index}
            words = f"{law.name} under a coat that has the lobe for its surface"
            yield Extension(words, over, tuple(_of_each_width(over, law, start)))
    if lobes:
        for law, asks in grown("coated"):
            yield Extension(asks.adds, models.made_of([], [*bodies, (law, 1)]))


def _beside(model: Composite, values: Mapping) -> Iterator[Extension]:
    """A lobe of another kind beside those that there are."""
    on_top, under = counted(model.terms)
    for law, asks in grown("beside"):
        if law not in [each for each, _ in on_top]:
            longer = _alike(model, [*on_top, (law, 1)], under)
            starts = _of_each_width(longer, law, _carried(longer, model, values))
            yield Extension(asks.adds, longer, tuple(starts))


def _of_each_width(model: Composite, law: Model, start: Mapping) -> Iterator[dict]:
    """A start for each width that a law in a sum is to begin with; as it is for one without."""
    parameter, term = width_of(law), next(term for term in model.terms if _is(term, law))
    if parameter is None:
        yield dict(start)
        return
    for width in parameter.starts:
        yield {**start, term.key(parameter.name): width}


def width_of(law: Model) -> Parameter | None:
    """The parameter that makes a lobe wide or narrow; None for a law without one."""
    shapes = (p for p in law.parameters if p.free and p.log and not p.per_channel and not p.linear)
    return next(shapes, None)


def _alike(model: Composite, on_top: Sequence[Counted], under: Sequence[Counted]) -> Composite:
    """Those laws together, as a metal, with a free edge and free heights where the sum is and has."""
    longer = models.made_of(on_top, under)
    longer = as_metal(longer) if is_metallic(model) else longer
    longer = with_edge(longer) if has_edge(model) else longer
    return with_heights(longer) if set(heights(model)).intersection(model.free) else longer


def _carried(longer: Composite, model: Composite, values: Mapping, of: Mapping[Model, Model] | None = None) -> dict:
    """The values of a sum in another that has its terms: of each law in order, or of the law that it stands for."""
    of, used, found = of or {}, set(), {}
    for term in longer.terms:
        law = term.model.base or term.model
        source = next((each for each in model.terms if each.label not in used and _is(each, of.get(law, law))), None)
        if source is not None:
            used.add(source.label)
            known = source.keys
            found.update({key: values[known[name]] for name, key in term.keys.items() if known.get(name) in values})
    return {key: value for key, value in found.items() if key not in longer.fixed}


def _is(term: Term, law: Model) -> bool:
    return (term.model.base or term.model) is law


def _indexed(model: Composite) -> list[Term]:
    return [term for term in model.terms if term.model.has_index]


def is_metallic(model: Composite) -> bool:
    """Whether k is what is fitted."""
    return any(key.endswith(".k") for key in model.free)
