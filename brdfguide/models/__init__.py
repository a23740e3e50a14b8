"""Reflectance laws, one term per file; `get("lambertian+ward")` gives their sum.

lambertian+lafortune:2     terms that add up, the second twice
lambertian+ggx:2           lobes of one law with Fresnel's factor share it, and have heights of their own
lambertian+ggx+ggx         lobes with indices and heights of their own
low-smooth:half            a variant of a law, which has a file of its own: low_smooth_half.py
coated:lambertian+flakes   all that follows lies under a clear coat
ggx+coated:lambertian      what stands before is on top: the coat's own rough surface
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from .. import catalog
from ..errors import InputError
from . import coat
from .model import Composite, Model, Term, spelt

MOST_LOBES = 3  # the report's "at most ten coefficients": one diffuse and three lobes of three
COATED = "coated:"
Counted = tuple[Model, int]  # a law and how many lobes of it


def names() -> list[str]:
    """Every term, as typed by users."""
    return catalog.names("models")


def term(name: str) -> Model:
    """One law by its name, or by that of its variant after a colon. Raises InputError with the nearest names."""
    name = name.strip().lower().replace("_", "-")
    if name.startswith(COATED):
        return coat.over(term(name.removeprefix(COATED)))
    name = name.replace(":", "-")
    if name not in names():
        name = next((model.name for model in every() if name in model.aliases), name)
    return catalog.load("models", name).MODEL


@lru_cache
def every() -> tuple[Model, ...]:
    """All laws."""
    return tuple(catalog.load("models", name).MODEL for name in names())


@lru_cache(maxsize=256)  # what is formed of a sum is there for the next file's
def get(expression: str) -> Composite:
    """The sum that `lambertian+lafortune:2` names.

    Raises InputError for an unknown term or lobe count, and for a coat over nothing or over another coat.
    """
    top, coated, below = expression.lower().partition(COATED)
    if not coated:
        return made_of(_counted(expression))
    if COATED in below or (top.strip() and not top.rstrip().endswith("+")):
        raise InputError(f"'{expression}': {COATED} stands once, and all that follows lies under the coat")
    if not below.strip():
        raise InputError(
            f"'{expression}': a coat over nothing; a law follows, as in coated:lambertian or coated:flakes"
        )
    return made_of(_counted(top.rstrip().removesuffix("+")) if top.strip() else [], _counted(below))


def made_of(on_top: Sequence[Counted], under: Sequence[Counted] = ()) -> Composite:
    """The sum of some laws, each with its count of lobes; with those `under` a coat, where there are any.

    A lobe on top of a coat is the coat's own rough surface: it has the coat's index, in place of the mirror.
    """
    if not under:
        return _composite(_labelled(on_top))
    rough = [model for model, _ in on_top if not model.is_body]
    own = Term("coat", coat.ROUGH if rough else coat.MODEL)
    terms = [own]
    for each in _labelled([*on_top, *((coat.over(model), count) for model, count in under)]):
        of_coat = {}
        if each.model.base is not None:
            of_coat = {name: own.key(of) for name, of in coat.OF_COAT.items()}
        elif each.model.has_index:
            of_coat = {"n": own.key("n")}
        terms.append(replace(each, shared={**each.shared, **of_coat}))
    return _composite(terms, free=(own.key("n"),) if any(model.has_index for model in rough) else ())


def _composite(terms, free=()) -> Composite:
    """The terms together; of several lobes with Fresnel's factor each has a height of its own."""
    terms = tuple(terms)
    models = [term.model for term in terms]
    heights = [term.height for term in terms if term.height and models.count(term.model) > 1]
    return Composite(spelt(terms), terms, free=(*free, *heights))


def _counted(expression: str) -> list[Counted]:
    """The law of each word and its count."""
    return [_lobes(word.strip()) for word in expression.split("+")]


def _lobes(word: str) -> tuple[Model, int]:
    """The law and the count of `lafortune:2`, `low-smooth:half` or `low-smooth:half:2`."""
    name, _, last = word.rpartition(":")
    if not name or last[:1].isalpha():
        return term(word), 1
    if not (last.isdecimal() and 1 <= int(last) <= MOST_LOBES):
        raise InputError(f"'{word}': lobes are counted from 1 to {MOST_LOBES}")
    return term(name), int(last)


def _labelled(counted: Sequence[Counted]):
    """Terms with labels of their own: `lafortune.1`, `lafortune.2` where a law occurs twice.

    Those that are counted in one word and have Fresnel's factor share the first one's index: one surface, facets of
    two kinds.
    """
    total: dict[Model, int] = {}
    for model, count in counted:
        total[model.base or model] = total.get(model.base or model, 0) + count
    so_far: dict[Model, int] = {}
    for model, count in counted:
        base = model.base or model
        if total[base] == 1:
            yield Term(base.name, model)
            continue
        first = so_far.get(base, 0) + 1
        for place in range(first, first + count):
            shares = model.has_index and place > first
            shared = {name: f"{base.name}.{first}.{name}" for name in ("n", "k")} if shares else {}
            yield Term(f"{base.name}.{place}", model, shared)
        so_far[base] = first + count - 1
