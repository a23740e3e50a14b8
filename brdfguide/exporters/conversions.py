"""One shader's numbers as another's, with the error that it costs.

A word names a shader or a law, and numbers by the names that they have there. Some programs call known laws by other
names or mean other numbers by them; `SPELLINGS` reads and writes these:

    arnold              standard-surface
    blender             its own words: roughness, metallic, ior_level, anisotropic, coat_weight ...
    three.js            gltf
    unreal, substance   Unreal's default lit and clear coat, Painter's standard material;   principled: Mitsuba's
    pbrt                a conductor or a body under facets, alpha = √roughness
    glossiness          diffuse, specular and glossiness: glTF's lobe with roughness = 1 - glossiness
    radiance            plastic: albedo (1 - specularity) under Ward's lobe as Radiance bounds it
    any law             blinn, phong, ward, ggx, lambertian+blinn ...: its own parameters

The error is between the two formulas, rms ln over directions.    Source: the shaders' own files; roughness_senses.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from .. import catalog
from ..errors import InputError, NoAnswer, choices
from ..models import get, made_of
from ..models.model import Composite, Model
from ..models.surface import Surface
from ..physics.fresnel import f0, index_from_f0
from ..records import dataclass
from . import _blender, _principled, _substance, _unreal
from ._law_fit import nearest_of_law
from ._node_words import what_it_costs
from ._nodes import choose_node
from ._programs import PROGRAMS, Program, as_words, node_of
from ._shown import seen_of
from .exporter import ColouredSurface, coloured

Numbers = dict[str, float | list[float]]
METAL_F0 = 0.2  # a specular colour above this is a metal's (diamond has 0.17)


@dataclass(frozen=True)
class Spelling:
    """A law under a program's own names."""

    law: str  # an expression of models, or one of ENGINES
    known: tuple[str, ...]  # the names of its numbers; empty: the law's own
    read: Callable[[Numbers], Numbers] = dict
    written: Callable[[Numbers], Numbers] = dict
    law_and_numbers: Callable[[Numbers], tuple[str, Numbers]] | None = None  # in place of `read`, where numbers choose
    program: Program | None = None  # whose own labels and numbers are written

    @property
    def written_as_it_stands(self) -> bool:
        return self.written is dict


@dataclass(frozen=True)
class Converted:
    """A shader's numbers as another's."""

    surface: ColouredSurface  # what was given
    numbers: Numbers
    rms_ln: float
    over: str
    seen: float | None  # S [L*]
    lost: tuple[str, ...]


ENGINES: Mapping[str, Model] = {each.name: each for each in (_unreal.LAW, _substance.LAW, _principled.LAW)}


def _mean(value) -> float:
    return float(np.mean(value))


def _read_pbrt(given: Numbers) -> Numbers:
    of_lobe = {"ggx.alpha": _mean(given.get("roughness", 0.0)) ** 0.5, "ggx.n": given.get("eta", 1.5)}
    of_lobe |= {"ggx.k": given["k"]} if "k" in given else {}
    return of_lobe | {"lambertian.albedo": given.get("reflectance", 0.0)}


def _write_pbrt(found: Numbers) -> Numbers:
    return {
        "reflectance": found["lambertian.albedo"],
        "roughness": _mean(found["ggx.alpha"]) ** 2,
        "eta": found["ggx.n"],
    }


def _read_glossiness(given: Numbers) -> Numbers:
    specular = np.atleast_1d(given.get("specular", 0.04))
    roughness: Numbers = {"roughness": 1 - _mean(given.get("glossiness", 1.0))}
    if specular.max() > METAL_F0:
        return roughness | {"metallic": 1.0, "base_color": specular.tolist()}
    return roughness | {"base_color": given.get("diffuse", 0.0), "ior": float(index_from_f0(_mean(specular)))}


def _write_glossiness(found: Numbers) -> Numbers:
    metal = bool(found["metallic"])
    bare = _mean(found["specular"]) * float(f0(_mean(found["ior"])))
    return {
        "diffuse": 0.0 if metal else found["base_color"],
        "specular": found["base_color"] if metal else bare,
        "glossiness": 1 - _mean(found["roughness"]),
    }


def _read_radiance(given: Numbers) -> Numbers:
    share = _mean(given.get("specularity", 0.0))
    body = (np.atleast_1d(given.get("RGB", 0.5)) * (1 - share)).tolist()
    return {"lambertian.albedo": body, "ward-gmd.rho_s": share, "ward-gmd.alpha": given.get("roughness", 0.1)}


def _write_radiance(found: Numbers) -> Numbers:
    share = min(_mean(found["ward-gmd.rho_s"]), 0.99)
    body = (np.atleast_1d(found["lambertian.albedo"]) / (1 - share)).tolist()
    return {"RGB": body, "specularity": share, "roughness": found["ward-gmd.alpha"]}


SPELLINGS = {
    "blender": Spelling(
        _blender.BODY, tuple(_blender.DEFAULTS), law_and_numbers=_blender.of_blender, program=PROGRAMS[0]
    ),
    "arnold": Spelling("standard-surface", ()),
    "three.js": Spelling("gltf", ()),
    "pbrt": Spelling("lambertian+ggx", ("reflectance", "roughness", "eta", "k"), _read_pbrt, _write_pbrt),
    "glossiness": Spelling("gltf", ("diffuse", "specular", "glossiness"), _read_glossiness, _write_glossiness),
    "radiance": Spelling("lambertian+ward-gmd", ("RGB", "specularity", "roughness"), _read_radiance, _write_radiance),
}


def spelling(name: str) -> Spelling:
    """A shader, a program or a law by its name. Raises InputError with the nearest names."""
    word = name.strip().lower().replace("_", "-")
    if word in SPELLINGS:
        return SPELLINGS[word]
    if word not in ENGINES and word.isidentifier() and word not in catalog.names("models"):
        raise choices("shader, program or law", name, sorted({*SPELLINGS, *ENGINES, *catalog.names("models")}))
    return Spelling(word, ())


def _model(law: str) -> Composite:
    return made_of([(ENGINES[law], 1)]) if law in ENGINES else get(law)


def read(name: str, given: Mapping[str, Sequence[float]]) -> ColouredSurface:
    """The surface that a shader's numbers mean: one or three numbers each.

    Raises InputError for an unknown shader or name, and for a number where the law does not hold.
    """
    spelt = spelling(name)
    for key in given:
        if spelt.known and key not in spelt.known:
            raise InputError(f"{key} is no number of {name}; there are: {', '.join(spelt.known)}")
    numbers: Numbers = {key: list(value) if len(value) > 1 else value[0] for key, value in given.items()}
    law, numbers = spelt.law_and_numbers(numbers) if spelt.law_and_numbers else (spelt.law, spelt.read(numbers))
    model = _model(law)
    return coloured(Surface.of_colours(model, model.defaults() | model.qualified(numbers)), name)


def convert(surface: ColouredSurface, to: str) -> Converted:
    """The numbers of another shader that come nearest to a surface.

    Raises InputError for an unknown shader, NoAnswer for a mirror where the law has none.
    """
    spelt = spelling(to)
    node = node_of(spelt.law)
    if spelt.program is not None:
        node = spelt.program.node(surface)
        choice = choose_node(node, surface, None)
        lost, values = what_it_costs(node, surface, choice), as_words(spelt.program, node, choice)
    elif node is not None:
        choice = choose_node(node, surface, None)
        lost, values = what_it_costs(node, surface, choice), choice.values
        if spelt.written_as_it_stands:
            names = (p.name for p in node.law.parameters)
            values = {name: values[name] for name in names if node.tells(name, values[name])}
            values = {name: node.law.parameter(name).outside(value) for name, value in values.items()}
    else:
        if surface.has_mirror:
            raise NoAnswer(f"the surface is a mirror; {to} gets finite lobes here")
        model = _model(spelt.law)
        choice = nearest_of_law(model, surface)
        told = (key for key in model.parameters if _tells(model, key, choice.values[key]))
        values = {key: model.parameters[key].outside(choice.values[key]) for key in told}
        lost = ()
        if len(model.terms) == 1:
            values = {key.rpartition(".")[2]: each for key, each in values.items()}
    numbers = spelt.written({name: _plain(value) for name, value in values.items()})
    shown = choice.shown(surface)
    seen = None if shown is None else seen_of(surface, shown)
    return Converted(surface, numbers, choice.rms_ln, choice.over, seen, lost)


def _tells(model: Composite, key: str, value) -> bool:
    """Whether a number is worth writing: one that is fitted, or not its default."""
    p = model.parameters[key]
    return p.free or key in model.free or bool(np.any(np.ravel(value) != p.default))


def _plain(value) -> float | list[float]:
    flat = np.ravel(np.asarray(value, float))
    return float(flat[0]) if np.ptp(flat) == 0 else [float(each) for each in flat]
