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
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from .. import catalog
from ..errors import NoAnswer
from ..models.surface import Surface
from ..physics.colour import hex_of
from ..physics.geometry import Geometry
from ._choice import GOOD, Choice, in_order_for
from ._grained import axis_of, tangent_note
from ._nodes import Node, choose_node, readings, what_it_costs
from ._programs import PROGRAMS, Program
from ._shown import Shown, off_the_measurement
from .exporter import ColouredSurface, coloured


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
    # what the program shows in linear sRGB: (geometry) -> (samples, 3) [1/sr]
    shown: Shown | None = field(default=None, compare=False, repr=False)

    @property
    def off(self) -> float:
        """rms ln; infinite where it cannot be typed."""
        return np.inf if self.rms_ln is None else self.rms_ln


class _Chosen:
    """The numbers of each shader for each candidate, found once though two programs share a shader."""

    def __init__(self, geom: Geometry | None):
        self.geom = geom
        self.kept: dict[tuple[int, int], Choice] = {}

    def of(self, node: Node, surface: ColouredSurface) -> Choice:
        key = id(node), id(surface)
        if key not in self.kept:
            self.kept[key] = choose_node(node, surface, self.geom)
        return self.kept[key]


def cards(
    surfaces: Sequence[Surface], geom: Geometry | None = None, *, measured: tuple[Geometry, np.ndarray] | None = None
) -> list[Card]:
    """One for each program, in a fixed order, of candidates for one surface, best first: the first that a program holds
    within GOOD, else the one that it holds best; a coat's mirror is not given up.

    Takes  geom, directions to judge over, None: the standard ones; measured, directions and the BRDF [1/sr]
    (samples, channels) there, if there is a measurement: then each error against it is given besides.
    """
    shown = [each if isinstance(each, ColouredSurface) else coloured(each) for each in surfaces]
    chosen = _Chosen(geom)
    tried = in_order_for(shown, "ggx")
    found = [_best(partial(_card, program, chosen), tried) for program in PROGRAMS]
    found.append(_best(partial(_of_radiance, geom), in_order_for(shown)))
    if measured is None:
        return found
    matrix = shown[0].colour.matrix
    return [replace(each, measured_rms_ln=off_the_measurement(each.shown, matrix, *measured)) for each in found]


def _best(make: Callable[[ColouredSurface], Card], surfaces: Sequence[ColouredSurface]) -> Card:
    found = []
    for surface in surfaces:
        found.append(make(surface))
        if found[-1].off <= GOOD:
            break
    return min(found, key=lambda each: each.off)


def _card(program: Program, chosen: _Chosen, surface: ColouredSurface) -> Card:
    node = program.node(surface)
    choice = chosen.of(node, surface)
    numbers, hexes = _typed(program, node, choice)
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
        model=surface.model.name,
        notes=streak + (readings(node, choice, surface, chosen.geom) if program.read_twice else ()),
        shown=choice.shown(surface),
    )


def _typed(program: Program, node: Node, choice: Choice) -> tuple[dict[str, float | tuple[float, ...]], dict[str, str]]:
    """Label -> number or colour, and label -> hex of colours; what keeps the shader's default is left out."""
    numbers: dict[str, float | tuple[float, ...]] = {}
    hexes = {}
    values = program.retyped(choice.values)
    for name, label in program.fields.items():
        if name not in values:
            continue
        value, parameter = np.ravel(values[name]), node.law.parameter(name)
        if label not in program.always and np.all(value == parameter.default):
            continue
        if parameter.per_channel:
            rgb = np.broadcast_to(value, (3,))
            numbers[label] = tuple(float(each) for each in rgb)
            hexes[label] = hex_of(rgb)
        else:
            numbers[label] = float(value[0])
    if program.rotation and np.any(choice.values[node.grain]):
        label, of_a_radian = program.rotation
        turned = float(np.remainder(np.sign(of_a_radian) * np.ravel(choice.values["axis"])[0], np.pi))
        numbers[label] = turned * abs(of_a_radian)
    return numbers, hexes


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
        statement = catalog.load("exporters", "radiance").export(surface, geom).statement
    except NoAnswer as refused:
        return Card(name, shader, {}, None, (str(refused),), formula)
    values = statement.written
    rgb = np.broadcast_to(np.ravel(values["albedo"]), (3,)) if "albedo" in values else np.zeros(3)
    numbers: dict[str, float | tuple[float, ...]] = {
        "RGB": tuple(float(each) for each in rgb),
        "specularity": float(np.ravel(values.get("specular", 0.0))[0]),
    }
    widths = {"alpha_x": "roughness along u", "alpha_y": "roughness across u"}
    widths = widths if "alpha_x" in values else {"roughness": "roughness"}
    for key, label in widths.items():
        numbers[label] = float(np.ravel(values.get(key, 0.0))[0])
    return Card(
        program=name,
        shader=shader,
        numbers=numbers,
        rms_ln=statement.rms_ln,
        cannot=statement.lost,
        formula=formula,
        hexes={"RGB": hex_of(rgb)},
        notes=_radiances_u(surface),
        model=surface.model.name,
        shown=statement.shown,
    )
