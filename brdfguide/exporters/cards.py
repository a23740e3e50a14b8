"""The numbers of a surface as artists type them into their programs, each with its error by that program's own formula.

    Blender     Principled: a body under an index with MaterialX's albedo, F82 metals; alpha = roughness²
    Arnold      Standard Surface, as in MaterialX; Maya, Houdini and 3ds Max have it too
    OpenPBR     as MaterialX generates it; the other published reading is evaluated with the same numbers
    Unreal      default lit, F0 = 0.08 specular; clear coat
    Substance   Painter's standard material: the same base with other facets, its own grain and coat
    glTF        appendix B; three.js, web viewers
    Mitsuba     `principled`
    Radiance    `plastic` and `metal`

A colour is given in linear sRGB and as sRGB hex, which a colour picker takes. What cannot be typed is said.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from functools import partial

import numpy as np

from .. import catalog
from ..errors import NoAnswer
from ..models.surface import Surface
from ..physics.colour import hex_of
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from ._choice import GOOD, Choice, in_order_for
from ._grained import axis_of, tangent_note
from ._node_words import readings, what_it_costs
from ._nodes import Node, choose_node
from ._programs import PROGRAMS, Program, typed_numbers
from ._shown import Shown, off_the_measurement
from .exporter import ColouredSurface, coloured

MEASURED = 20_000  # directions of a measurement, in even steps, over which the error against it is taken


@dataclass(frozen=True)
class Card:
    """What to type into one program, and how far that is from the surface."""

    program: str
    shader: str
    numbers: Mapping[str, float | tuple[float, ...]]  # label -> number, or linear sRGB
    rms_ln: float | None  # None: it cannot be typed there
    cannot: tuple[str, ...] = ()
    formula: str = ""  # whose formula gave the error
    hexes: Mapping[str, str] = field(default_factory=dict)  # label of a colour -> sRGB hex
    model: str = ""  # of the candidates, the one that the numbers are of
    notes: tuple[str, ...] = ()  # what the same numbers show where the shader is read in another way
    measured_rms_ln: float | None = None  # the error against a measurement; None where there is none
    # label -> what the number is in every program: colour, metalness, roughness, index, weight, edge, grain, rotation,
    # coat, coat_roughness, coat_gloss, coat_index, specularity
    roles: Mapping[str, str] = field(default_factory=dict)
    # what the program shows in linear sRGB: (geometry) -> (samples, 3) [1/sr]
    shown: Shown | None = field(default=None, compare=False, repr=False)

    @property
    def off(self) -> float:
        """rms ln; infinite where it cannot be typed."""
        return np.inf if self.rms_ln is None else self.rms_ln


class _Chosen:
    """The numbers of each shader for each candidate, and what they show, found once though two programs share a
    shader."""

    def __init__(self, geom: Geometry | None):
        self.geom = geom
        self.kept: dict[tuple[int, int], tuple[Choice, Shown | None]] = {}

    def of(self, node: Node, surface: ColouredSurface) -> tuple[Choice, Shown | None]:
        key = id(node), id(surface)
        if key not in self.kept:
            choice = choose_node(node, surface, self.geom)
            self.kept[key] = choice, choice.shown(surface)
        return self.kept[key]


def cards(
    surfaces: Sequence[Surface], geom: Geometry | None = None, *, measured: tuple[Geometry, np.ndarray] | None = None
) -> list[Card]:
    """One for each program, in a fixed order, of candidates for one surface, best first: the first that a program holds
    within GOOD, else the one that it holds best; a coat's mirror is not given up.

    Takes  geom, directions to judge over, None: the standard ones; measured, directions and the BRDF [1/sr]
    (samples, channels) there, if there is a measurement: then each error against it is given besides, over at most
    MEASURED of them.    Raises NoAnswer for a surface that reflects nothing, or whose channels carry no colour.
    """
    shown = [each if isinstance(each, ColouredSurface) else coloured(each) for each in surfaces]
    chosen = _Chosen(geom)
    tried = in_order_for(shown, "ggx")
    found = [_best(partial(_card, program, chosen), tried) for program in PROGRAMS]
    found.append(_best(partial(_of_radiance, geom), in_order_for(shown, "beckmann")))
    if measured is None:
        return found
    matrix, measured = shown[0].colour.matrix, _thinned(*measured)
    off = {each: off_the_measurement(each, matrix, *measured) for each in {each.shown for each in found}}
    return [replace(each, measured_rms_ln=off[each.shown]) for each in found]


def _thinned(geom: Geometry, measured: np.ndarray) -> tuple[Geometry, np.ndarray]:
    """As rows, which all programs are evaluated at."""
    if len(measured) > MEASURED:
        taken = np.linspace(0, len(measured) - 1, MEASURED).round().astype(int)
        geom, measured = geom[taken], measured[taken]
    return rows(geom), measured


def _best(make: Callable[[ColouredSurface], Card], surfaces: Sequence[ColouredSurface]) -> Card:
    found = []
    for surface in surfaces:
        found.append(make(surface))
        if found[-1].off <= GOOD:
            break
    return min(found, key=lambda each: each.off)


def _card(program: Program, chosen: _Chosen, surface: ColouredSurface) -> Card:
    node = program.node(surface)
    choice, shown = chosen.of(node, surface)
    numbers, hexes = typed_numbers(program, node, choice)
    streak = _streak(program, node, choice)
    coated = program.coated and np.any(choice.values[node.coat])
    return Card(
        program=program.name,
        shader=program.coated if coated else program.shader,
        numbers=numbers,
        rms_ln=choice.rms_ln,
        cannot=what_it_costs(node, surface, choice),
        formula=program.formula,
        hexes=hexes,
        roles=_roles(program, node, numbers),
        model=surface.model.name,
        notes=streak + (readings(node, choice, surface, chosen.geom) if program.read_twice else ()),
        shown=shown,
    )


def _roles(program: Program, node: Node, numbers: Mapping) -> dict[str, str]:
    """What each label stands for."""
    of_law = {
        "base_color": "colour",
        "specular": "weight",  # where it is not the index
        node.metalness: "metalness",
        node.roughness: "roughness",
        node.weight: "weight",
        node.index: "index",
        node.edge: "edge",
        node.grain: "grain",
        node.coat: "coat",
        node.coat_roughness: "coat_gloss" if node.coat_mirror else "coat_roughness",
        node.coat_index: "coat_index",
    }
    found = {label: of_law[name] for name, label in program.fields.items() if name in of_law and label in numbers}
    return found | ({program.rotation[0]: "rotation"} if program.rotation and program.rotation[0] in numbers else {})


def _streak(program: Program, node: Node, choice: Choice) -> tuple[str, ...]:
    """Where the mesh must lie for a grain to lie as it does on the surface."""
    if not np.any(choice.values[node.grain]):
        return ()
    if program.rotation:
        return (f"the rotation counts from azimuth 0 of the sample, where {program.tangent} lies",)
    return tangent_note(float(np.ravel(choice.values["axis"])[0]), program.tangent)


def _radiances_u(surface: ColouredSurface) -> tuple[str, ...]:
    axis = axis_of(surface)
    return () if axis is None else tangent_note(axis, "u")


def _of_radiance(geom: Geometry | None, surface: ColouredSurface) -> Card:
    name, shader, formula = "Radiance", "plastic or metal", "Radiance's materials"
    try:
        choice, lost = catalog.load("exporters", "radiance").chosen(surface, geom)
    except NoAnswer as refused:
        return Card(name, shader, {}, None, (str(refused),), formula)
    values = choice.values
    rgb = np.broadcast_to(np.ravel(values["albedo"]), (3,)) if "albedo" in values else np.zeros(3)
    numbers: dict[str, float | tuple[float, ...]] = {
        "RGB": tuple(float(each) for each in rgb),
        "specularity": float(np.ravel(values.get("specular", 0.0))[0]),
    }
    widths = {"alpha_x": "roughness along u", "alpha_y": "roughness across u"}
    widths = widths if "alpha_x" in values else {"roughness": "roughness"}
    for key, label in widths.items():
        numbers[label] = float(np.ravel(values.get(key, 0.0))[0])
    roles = {"RGB": "colour", "specularity": "specularity"} | dict.fromkeys(widths.values(), "roughness")
    return Card(
        program=name,
        shader=shader,
        numbers=numbers,
        rms_ln=choice.rms_ln,
        cannot=lost,
        formula=formula,
        hexes={"RGB": hex_of(rgb)},
        roles=roles,
        notes=_radiances_u(surface),
        model=surface.model.name,
        shown=choice.shown(surface),
    )
