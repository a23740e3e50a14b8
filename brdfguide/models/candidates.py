"""Which sums are worth fitting to a surface, when nothing or only its kind is known: as the laws themselves say."""

from dataclasses import replace
from functools import lru_cache

from .. import catalog, models
from ..errors import InputError, choices
from ..records import dataclass
from . import Composite, Model
from .facts import Candidacy

KINDS = ("metal", "dielectric")
METAL_K = 4.0  # F0 = 0.8 with n = 1, between chromium's 0.66 and silver's 0.96 (Westin et al. 2004, Table 1)


@dataclass(frozen=True)
class Grained:
    """What data tell of a grain."""

    axis: float | None = None  # [rad], held there; None: the data tell it
    one_scan: bool = False  # across the grain, higher than its width allows: the width along it follows from the height


METAL, HEIGHT_FREE, EDGE_FREE = "metal", "height free", "edge free"  # what stands behind a candidate's name in brackets


def of_kind(
    kind: str | None = None, names=None, *, polished: bool = False, beam: bool = False, grain: Grained | None = None
) -> tuple[Composite, ...]:
    """The sums worth fitting to a surface of this kind ("metal", "dielectric"; None: not known), or those in `names`.

    A metal has no subsurface term (Westin et al. 2004, section 3.2.3); a surface of unknown kind gets both sorts. Those
    of polished optics as well where the data are `polished`, with a mirror where the detector saw its `beam`; those
    with a grain where the data tell of a `grain`.
    Raises InputError for an unknown kind or name.
    """
    if kind not in (None, *KINDS):
        raise choices("kind of surface", kind, KINDS)
    if names is not None:
        named_ones = (each for name in names for each in _both_kinds(name, kind))
        return tuple(each if grain is None else with_grain(each, grain) for each in named_ones)
    dielectrics = () if kind == "metal" else tuple(models.get(name) for name in (*_on_bodies(), *_bodies()))
    metals = () if kind == "dielectric" else tuple(as_metal(models.get(name)) for name in _bare(kind))
    if grain and grain.one_scan:
        metals = tuple(bright(each) for each in metals)
    return dielectrics + metals + (of_polish(beam) if polished else ()) + (of_grain(kind, grain) if grain else ())


def of_grain(kind: str | None, grain: Grained) -> tuple[Composite, ...]:
    """The laws with a grain: as a metal, and on a body."""
    laws = [model for model, asks in _asking() if asks.grained]
    bodies = () if kind == "metal" else tuple(models.get(f"lambertian+{law.name}") for law in laws)
    metals = () if kind == "dielectric" else tuple(as_metal(models.get(law.name)) for law in laws)
    metals = tuple(bright(each) for each in metals) if grain.one_scan else metals
    return tuple(with_grain(each, grain) for each in (*bodies, *metals))


def bright(model: Composite) -> Composite:
    """A metal whose index one scan does not tell: k held, and the height free where no grain carries it."""
    freed = {key for key in model.free if key.endswith(".k")}
    free = tuple(key for key in model.free if key not in freed)
    held = replace(model, fixed={**model.fixed, **dict.fromkeys(freed, METAL_K)}, free=free)
    return held if any(term.model.grain for term in model.terms) else with_heights(held)


def with_grain(model: Composite, grain: Grained) -> Composite:
    """The same with what shapes its grain free, as far as the data tell it; an axis that they do not tell is held where
    it is said to lie."""
    held, free = dict(model.fixed), list(model.free)
    for term in model.terms:
        if "axis" not in term.model.defaults() or not term.model.turns:
            continue
        free += [term.key(term.model.grain.second)] if term.model.grain else []
        if grain.axis is None:
            free.append(term.key("axis"))
        else:
            held[term.key("axis")] = grain.axis
    return replace(model, fixed=held, free=tuple(dict.fromkeys(free)))


def of_polish(beam: bool = False) -> tuple[Composite, ...]:
    """The laws of polished optics: alone, on a body, and with a mirror where its `beam` was seen and they have none."""
    laws = [model for model, asks in _asking() if asks.polished]
    names = [pattern.format(law.name) for pattern in ("{}", "lambertian+{}") for law in laws]
    names += [f"{law.name}+mirror" for law in laws if beam and law.mirror is None]
    return tuple(models.get(name) for name in names)


def _both_kinds(name: str, kind: str | None) -> list[Composite]:
    """The candidate of that name; of a shader also the metal, where the kind is not known and no word is behind it."""
    first = named(name, metal=kind == "metal")
    if kind is not None or "(" in name or METAL not in settings(first):
        return [first]
    return [first, set_as(first, METAL)]


def settings(model: Composite) -> list[str]:
    """The words that may stand behind its name for how a shader in it is set."""
    return [word for term in model.terms for word in term.model.settings]


def set_as(model: Composite, word: str) -> Composite:
    """The same with its shaders set as a word says: what it holds and frees there."""
    fixed, free, start = dict(model.fixed), list(model.free), dict(model.start)
    for term in model.terms:
        setting = term.model.settings.get(word)
        if setting is not None:
            fixed |= {term.key(name): value for name, value in setting.fixed.items()}
            free += [term.key(name) for name in setting.free]
            start |= {term.key(name): value for name, value in setting.start.items()}
    return replace(model, fixed=fixed, free=tuple(dict.fromkeys(free)), start=start)


def _is_set(model: Composite, word: str) -> bool:
    """Whether all that the word holds and frees is held and free."""
    for term in model.terms:
        setting = term.model.settings.get(word)
        if setting is not None:
            held = all(model.fixed.get(term.key(name)) == value for name, value in setting.fixed.items())
            return held and all(term.key(name) in model.free for name in setting.free)
    return False


def tried() -> list[tuple[Model, Candidacy]]:
    """The laws that the default ranking tries from the start and what they ask for, cheapest first."""
    return [(model, asks) for model, asks in _asking() if not (asks.grown or asks.polished or asks.grained)]


def grown(how: str) -> list[tuple[Model, Candidacy]]:
    """The laws that it tries where the best so far leaves something: "beside" its terms, or "coated"."""
    return [(model, asks) for model, asks in _asking() if asks.grown == how]


def containing(law: Model) -> list[tuple[Model, Candidacy]]:
    """The laws of which this one is a case."""
    return [(model, asks) for model, asks in _asking() if law.name in asks.contains]


@lru_cache
def _asking() -> tuple[tuple[Model, Candidacy], ...]:
    """The laws with a Candidacy, which their files name; no other is imported."""
    laws = [catalog.load("models", name).MODEL for name in catalog.saying("models", Candidacy.__name__)]
    asking = [(model, model.candidacy) for model in laws if model.candidacy is not None]
    return tuple(sorted(asking, key=lambda each: (each[1].order, each[0].name)))


def substitutes() -> list[Model]:
    """The lobes that may be tried in place of a dearer one, cheapest first."""
    return [model for model, asks in tried() if asks.substitutes]


def _on_bodies():
    """Names of the sums of a body and its lobes."""
    for body, body_asks in tried():
        if body.is_body:
            for lobe, asks in tried():
                if lobe.is_lobe and (body_asks.under is None or lobe.name in body_asks.under):
                    yield from (f"{body.name}+{name}" for name in _one_and_more(lobe, asks))


def _bodies():
    """Names of the bodies without a lobe."""
    return (body.name for body, asks in tried() if body.is_body and asks.bare)


def _bare(kind: str | None):
    """Names of the lobes without a body."""
    for lobe, asks in tried():
        if lobe.is_lobe and (kind == "metal" or asks.bare):
            yield from _one_and_more(lobe, asks)


def _one_and_more(lobe: Model, asks: Candidacy) -> list[str]:
    return [lobe.name, *(f"{lobe.name}:{count}" for count in range(2, asks.lobes + 1))]


def as_metal(model: Composite) -> Composite:
    """The same sum with Fresnel's factor of a metal: n held at 1, k free in each channel.

    F0 = k²/(4 + k²) then is the amplitude, between 0 and 1, and F rises to 1 at grazing as it must. Of lobes that share
    it the first is as high as F0 makes it, the others in proportion. One that is a coat's own surface has the coat's n
    and stays what a coat is.
    """
    if METAL in settings(model):
        model = set_as(model, METAL)
    held: dict[str, float] = {}
    freed: dict[str, str] = {}  # k -> the height of the first lobe that has it
    for term in model.terms:
        if term.model.has_index and term.key("n").removesuffix("n") == term.key("k").removesuffix("k"):
            held[term.key("n")] = 1.0
            freed.setdefault(term.key("k"), term.key(term.model.amplitude or ""))
    return replace(
        model,
        fixed={**model.fixed, **held},
        free=(*(key for key in model.free if key not in freed.values()), *freed),
        start={**model.start, **dict.fromkeys(freed, METAL_K)},
    )


def with_heights(model: Composite) -> Composite:
    """The same sum with a free amplitude beside Fresnel's factor in every lobe that stands alone, each channel its own.

    Where n or k alone carries the level of a lobe, its rise toward grazing is tied to it.
    """
    return replace(model, free=(*model.free, *(height for height in heights(model) if height not in model.free)))


def with_edge(model: Composite) -> Composite:
    """The same metal with n free beside k, each channel its own: F at 82 degrees, its edge, is no longer F0's to tell.

    Every pair of F0 and an edge that an interface can have is one pair of n and k (Gulbrandsen 2014, "Artist friendly
    metallic Fresnel", JCGT 3(4)); the edge at 82 degrees is that of Hoffman 2019, "Fresnel equations considered
    harmful".
    """
    freed = [term.key("n") for term in model.terms if term.model.has_index]
    held = {key: value for key, value in model.fixed.items() if key not in freed}
    return replace(model, fixed=held, start={**model.start, **dict.fromkeys(freed, 1.0)})


def without_edge(model: Composite) -> Composite:
    """The same metal with n held at 1."""
    held = {term.key("n"): 1.0 for term in model.terms if term.model.has_index}
    return replace(model, fixed={**model.fixed, **held})


def has_edge(model: Composite) -> bool:
    """Whether n and k are both free."""
    return any(key.endswith(".k") and f"{key.removesuffix('k')}n" not in model.fixed for key in model.free)


def heights(model: Composite) -> list[str]:
    """The amplitudes beside Fresnel's factor of lobes that stand alone; several of one law have theirs free anyway."""
    laws = [term.model for term in model.terms]
    return [term.height for term in model.terms if term.height and laws.count(term.model) == 1]


@lru_cache(maxsize=256)
def candidate_label(model: Composite) -> str:
    """The name a candidate is shown under: `ggx (metal)` where k is what is fitted, `ggx (metal, edge free)` where n is
    too, `ggx (height free)` where a lobe that stands alone has an amplitude beside Fresnel's factor.
    """
    notes = [METAL] if any(key.endswith(".k") for key in model.free) else []
    notes += [word for word in settings(model) if word not in notes and _is_set(model, word)]
    notes += [EDGE_FREE] if has_edge(model) else []
    notes += [HEIGHT_FREE] if set(heights(model)).intersection(model.free) else []
    return model.name + (f" ({', '.join(notes)})" if notes else "")


@lru_cache(maxsize=256)
def named(label: str, *, metal: bool = False) -> Composite:
    """The candidate that is shown under this name; a `metal` also where the name does not say so.

    Raises InputError for an unknown law and for other words in brackets.
    """
    expression, _, words = label.strip().removesuffix(")").partition("(")
    notes = [word.strip() for word in words.split(",") if word.strip()]
    model = models.get(expression.strip())
    known = list(dict.fromkeys((METAL, EDGE_FREE, HEIGHT_FREE, *settings(model))))
    for note in notes:
        if note not in known:
            wanted = ", ".join(f"({word})" for word in known[:-1])
            raise InputError(f"'{label}': found ({note}); wanted {wanted} or ({known[-1]})")
    model = as_metal(model) if metal or METAL in notes else model
    if EDGE_FREE in notes:
        if not any(key.endswith(".k") for key in model.free):
            raise InputError(f"'{label}': found (edge free); wanted (metal, edge free), of a law with Fresnel's factor")
        model = with_edge(model)
    for word in notes:
        model = set_as(model, word)
    return with_heights(model) if HEIGHT_FREE in notes else model
