"""A surface as the numbers of one shader: which of its settings come into question, and the best of them.

A law of models/ is the shader; its parameters are the node's numbers. A surface of that very law is written as it is.
A mirror beside a finite part becomes a coat of roughness 0, a polished surface a base of roughness 0; mirror and finite
part then count alike.
"""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from functools import partial

import numpy as np

from .. import catalog
from ..models.model import Model, Parameter
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from . import _grained
from ._choice import Choice, best_of, choose, fresnel_index, has_body
from ._directions import judged_over, rms_ln
from ._mirrored import BesideMirror, mirror_at, stacked
from ._refit import Goal, TargetModel
from ._smooth import MIRROR, is_smooth
from .exporter import ColouredSurface

METAL_STARTS = (0.1, 0.5, 0.9)
ALIKE = 0.2  # rms ln within which a polished base is taken before a coat over a base
HIGH_DEG = 60.0  # beyond, laws and shaders part over what lies under a surface
CLEAREST = 2.5  # index of a dielectric at most (diamond has 2.42)
MOST_GRAIN = 0.98  # anisotropy at which the aspect of the widths ends
FAINT = 1e-2  # of a mirror's highest value: below it is not seen beside it
# why a shader's best numbers are far off a body, a lobe under a coat, what lies under a coat that bends light
LACKS = {
    "body": "it takes from the body what the surface above reflects, and the law adds both",
    "lobe": "it takes from the lobe what the coat reflects, and the law adds both",
    "coat": "light is not bent in its coat, so that what lies below grows toward grazing as if it were bare",
}


@dataclass(frozen=True)
class Node:
    """A shader: its law, and what its numbers are called."""

    law: Model
    roughness: str
    metalness: str
    index: str
    weight: str  # of the lobe on a body; 0: matt; "": the index alone says how high it is
    edge: str  # a metal's edge colour; "": it has none
    coat: str
    coat_roughness: str
    coat_index: str  # "": it is fixed
    matt: Mapping[str, float]  # what makes it a body alone
    under_rough_coat: bool = True  # whether a base stays smooth under a rough coat
    by_schlick: bool = False  # whether F is Schlick's curve
    masked_alike: bool = False  # whether a lobe with a grain is masked by one width
    grain: str = ""  # how long its streaks are; "": it has none
    # roughness, grain -> widths across and along, where MaterialX masks light and view with one width and the law
    # with both
    widths: Callable[..., tuple] | None = None
    coat_mirror: float = 0.0  # what `coat_roughness` is of a coat that is a mirror
    only: Mapping[str, tuple[float, ...]] = field(default_factory=dict)  # the values of a number that a program can set
    lacks: Mapping[str, str] = field(default_factory=lambda: LACKS)  # what keeps it from a body, a lobe, a coat's base

    def target(self, free: tuple[str, ...], **fixed) -> TargetModel:
        """The law with some numbers free and the rest at `fixed` and its defaults."""
        held = {**self.law.defaults(), **fixed}
        parameters = tuple(self._parameter(name, free, fixed) for name in free)
        held = {name: value for name, value in held.items() if name not in free}
        return TargetModel(parameters, partial(self.law, **held), held, broadcasts=True)

    def tells(self, name: str, value) -> bool:
        """Whether a number is worth writing: one of the four that make a surface, or one that is not its default."""
        always = ("base_color", self.metalness, self.roughness, self.index)
        return name in always or bool(np.any(np.ravel(value) != self.law.parameter(name).default))

    def _parameter(self, name: str, free: tuple[str, ...], fixed: Mapping) -> Parameter:
        p = self.law.parameter(name)
        if name == self.coat_roughness and self.coat_mirror == 0:  # a mirror has no lobe to judge by
            return replace(p, low=0.04, log=True, starts=(0.1, 0.3, 0.6))
        if name in (self.weight, self.coat):  # at 0 nothing would be left to judge
            return replace(p, low=1e-4, log=True, starts=(0.1, 1.0))
        if name == self.grain:  # MaterialX's aspect stays as it is beyond, where a search would not come back from
            return replace(p, high=min(p.high, MOST_GRAIN), starts=(0.2, 0.6, 0.9))
        if name != "base_color":
            return replace(p, starts=p.starts or (0.1, 0.5, 1.0)[: 2 + (p.high <= 1)])
        if fixed.get(self.metalness) or self.metalness in free:
            return replace(p, low=1e-3, log=True, starts=METAL_STARTS)
        return replace(p, linear=True)

    def ordinary(self, body: bool, kind: str = "") -> dict[str, TargetModel]:
        """Matt or with a lobe over a body, which is in part a metal's where no dielectric shines so; metal or bare
        dielectric without one, which often look alike."""
        metal = {self.metalness: 1.0}
        edge = (self.edge,) if self.edge else ()
        dielectric = ("base_color", self.roughness, self.index, *self._free_weight())
        if body:
            matt, lobe = self.target(("base_color",), **self.matt), self.target(dielectric)
            in_part = {"metal in part": self.target(("base_color", self.metalness, self.roughness))}
            return {"matt": matt, **({} if kind == "dielectric" else in_part), "dielectric": lobe}
        targets = {
            "metal": self.target(("base_color", *edge, self.roughness), **metal),
            "dielectric": self.target(dielectric[1:], base_color=0.0),
        }
        return _of_its_kind(targets, kind)

    def grained(self, body: bool, axis: float) -> dict[str, TargetModel]:
        """The same with a streak along an azimuth [rad]; round where the node has none."""
        if not self.grain:
            return self.ordinary(body)
        held, edge = {"axis": axis}, (self.edge,) if self.edge else ()
        if body:
            free = ("base_color", self.roughness, self.index, *self._free_weight(), self.grain)
            return {"dielectric": self.target(free, **held)}
        return {
            "metal": self.target(("base_color", *edge, self.roughness, self.grain), **{self.metalness: 1.0, **held})
        }

    def _free_weight(self) -> tuple[str, ...]:
        """The weight of the lobe where the index alone does not carry it."""
        return (self.weight,) if self.weight == "specular" and not self.edge else ()

    def polished(self, body: bool, kind: str = "") -> dict[str, TargetModel]:
        """A base of roughness 0; metal and bare dielectric often look alike."""
        smooth = {self.roughness: 0.0}
        edge = (self.edge,) if self.edge else ()
        free = (self.index, *self._free_weight())
        if body:
            return {"dielectric": self.target(("base_color", *free), **smooth)}
        metal = {self.metalness: 1.0}
        targets = {
            "metal": self.target(("base_color", *edge), **smooth, **metal),
            "dielectric": self.target(free, base_color=0.0, **smooth),
        }
        return _of_its_kind(targets, kind)

    def coated(self, body: bool, n: float | None = None) -> dict[str, TargetModel]:
        """A smooth coat over a body, with or without a lobe, over a metal; a polished base under a rough coat.

        `n`: index of a coat that is known to be there; None: whatever makes the mirror.
        """
        held, coat = self._coat(n)
        mirror = {self.coat_roughness: self.coat_mirror, **held}
        metal = {self.metalness: 1.0}
        haze = (self.coat, self.coat_roughness)
        over_metal = {"metal under a coat": self.target(("base_color", self.roughness, *coat), **metal, **mirror)}
        hazes = n is None and self.under_rough_coat
        if not body:
            hazy = self.target(("base_color", *haze), **metal, **{self.roughness: 0.0})
            hazy_metal = {"polished metal under a haze": hazy} if hazes else {}
            return over_metal | self._coated_lobes(mirror, coat) | hazy_metal
        lobe, polished = ("base_color", self.roughness, self.weight or self.index), {self.roughness: 0.0}
        index = {self.index: 2.5} if self.weight else {}
        hazy = self.target(("base_color", self.index, *haze), **polished)
        return {
            "matt under a coat": self.target(("base_color", *coat), **self.matt, **mirror),
            "dielectric under a coat": self.target((*lobe, *coat), **mirror, **index),
            **({"polished body under a haze": hazy} if hazes else {}),
            **over_metal,
        }

    def _coat(self, n: float | None) -> tuple[dict[str, float], tuple[str, ...]]:
        """What is held of a coat, and what is free."""
        if n is None or not self.coat_index:
            return {}, (self.coat, *((self.coat_index,) if self.coat_index else ()))
        return {self.coat: 1.0, self.coat_index: n}, ()

    def under_rough(self, body: bool, n: float | None) -> dict[str, TargetModel]:
        """A rough coat over a body, or over flakes and metals."""
        held, coat = self._coat(n)
        if body:
            matt = self.target(("base_color", self.coat_roughness, *coat), **self.matt, **held)
            lobe = self.target(("base_color", self.roughness, self.index, self.coat_roughness, *coat), **held)
            return {"matt under a rough coat": matt, "dielectric under a rough coat": lobe}
        free = ("base_color", self.roughness, self.coat_roughness, *coat)
        return {"metal under a rough coat": self.target(free, **{self.metalness: 1.0}, **held)}

    def _coated_lobes(self, mirror: Mapping, coat: tuple[str, ...]) -> dict[str, TargetModel]:
        """Over flakes and metals besides: an edge that dims a lobe toward grazing, a weak lobe."""
        weak = {"base_color": 0.0, **({self.index: 2.5} if self.weight else {}), **mirror}
        free = (self.roughness, self.weight or self.index, *coat)
        found = {"lobe under a coat": self.target(free, **weak)}
        if self.edge:
            free = ("base_color", self.edge, self.roughness, *coat)
            found["edged metal under a coat"] = self.target(free, **{self.metalness: 1.0}, **mirror)
        return found


def node_called(target: str) -> Node:
    """The shader's node of the export target of that name."""
    return catalog.load("exporters", target).NODE


def _coats_index(surface: ColouredSurface) -> float | None:
    """Index of the coat of a surface, where it has one that is smooth to the eye."""
    for term in surface.model.terms:
        values = surface.values_of(term)
        if (term.model.is_coat or term.model.is_mirror) and not np.any(values.get("sigma", 0.0)):
            return None if np.any(values.get("k", 0.0)) or np.ptp(values["n"]) > 0 else float(np.mean(values["n"]))
    return None


def _is_coated(law: Model, values: Mapping) -> bool:
    """Whether a law is a coat, or a shader whose own coat has some weight."""
    coat = law.settings.get("coat")
    return law.is_coat or coat is not None and any(np.any(values[name]) for name in coat.fixed)


def _kind(surface: ColouredSurface) -> str:
    """Metal or dielectric by the surface's own index, if it is that of a metal or of something clear."""
    n, k = fresnel_index(surface) or (np.inf, 0.0)
    if np.all(np.asarray(k) > 0):
        return "metal"
    return "dielectric" if np.max(n) <= CLEAREST and not np.any(k) else ""


def _of_its_kind(targets: dict[str, TargetModel], kind: str) -> dict[str, TargetModel]:
    """A metal as a metal alone; something clear as that first."""
    if kind == "metal":
        return {kind: targets[kind]}
    return dict(reversed(targets.items())) if kind == "dielectric" else targets


def choose_node(node: Node, surface: ColouredSurface, geom: Geometry | None) -> Choice:
    """The best of the node's settings for a surface, with its numbers rounded as they will be written."""
    own = own_values(node, surface)
    body = has_body(surface)
    if own is not None:
        own_target = {"own": node.target((), **own)}
        return (
            _with_mirror(node, surface, geom, own_target) if surface.has_mirror else choose(surface, geom, own_target)
        )
    if is_smooth(surface):
        smooth = node.polished(body, _kind(surface))
        return replace(_with_mirror(node, surface, geom, smooth), brdf=None)
    if surface.has_mirror:
        if any(term.model.settings for term in surface.model.terms):  # a shader's own base may be the mirror
            polished = _with_mirror(node, surface, geom, node.polished(body))
            if polished.rms_ln <= ALIKE:
                return polished
        return _with_mirror(node, surface, geom, node.coated(body, _coats_index(surface)))
    axis = _grained.axis_of(surface)
    if axis is not None:
        return choose(surface, geom, node.grained(body, axis))
    rough = node.coat and any(_is_coated(term.model, surface.values_of(term)) for term in surface.model.terms)
    coated = node.under_rough(body, _coats_index(surface)) if rough else {}
    return choose(surface, geom, node.ordinary(body, _kind(surface)) | coated)


def own_values(node: Node, surface: ColouredSurface) -> dict | None:
    """Its values by colour, of a surface of the node's own law; else None."""
    if [term.model.brdf for term in surface.model.terms] != [node.law.brdf]:
        return None
    of_term = surface.values_of(surface.model.terms[0])
    values = {}
    for p in node.law.parameters:
        value = surface.nonlinear(of_term[p.name])
        if value is None or not p.per_channel and np.ptp(value) > 0:
            return None
        if np.any(value > p.high) or not np.all(np.isin(value, node.only.get(p.name, value))):
            return None
        values[p.name] = float(value[0]) if np.ptp(value) == 0 else value
    return values


def _with_mirror(
    node: Node, surface: ColouredSurface, geom: Geometry | None, targets: Mapping[str, TargetModel]
) -> Choice:
    """The best of `targets` for the finite part and for the mirror, which count alike; the worse of both is stated."""
    mirrored = rows(Geometry.from_degrees(MIRROR, 0.0, MIRROR, 180.0))
    reflected = surface.mirror_rgb(mirrored)
    reflected = np.where(reflected >= FAINT * np.max(reflected), reflected, np.nan)
    if np.any(surface.rgb(rows(Geometry.from_degrees(30.0, 0.0, 50.0, 120.0)))):
        finite_geom, finite, over = judged_over(surface, geom)
    else:
        finite_geom, finite, over = mirrored[:0], np.empty((0, 3)), "no finite directions"
    both = BesideMirror(finite_geom, mirrored)
    weights = np.ones(len(both))
    weights[len(finite) :] = max(1.0, len(finite) / len(MIRROR))
    goal = Goal(both, np.concatenate((finite, reflected)), weights)
    beside = {
        name: replace(target, brdf=partial(stacked, node.law, **target.fixed)) for name, target in targets.items()
    }
    words = f"{len(MIRROR)} mirror directions" + (f" and {over}" if len(finite) else "")
    choice = best_of(beside, goal, None, words)
    written = stacked(node.law, both, **{**node.law.defaults(), **choice.values})
    worst = max(rms_ln(written[: len(finite)], finite), rms_ln(written[len(finite) :], reflected))
    return replace(
        choice,
        rms_ln=worst,
        brdf=partial(_law_at, node.law, choice.values),
        mirror=partial(mirror_at, node.law, choice.values),
    )


def _law_at(law: Model, values: Mapping, geom: Geometry) -> np.ndarray:
    return law(geom, **values)
