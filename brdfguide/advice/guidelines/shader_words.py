"""The words of shaders as observations: base colour, roughness, metallic and index, as artists type them.

metallic is 1 or 0: a metal's base colour is its F0, a body's its albedo. What roughness means is said by `in`.
"""

from ...physics import colorchecker as chart
from ...physics import gloss
from ...physics.colour import hex_of
from ..material import Material
from .guideline import Advice, rule

MOST_F0 = 0.9999
NOTICED = 5.0  # of L*: two colours that differ by more cannot both be meant


@rule("5.1")
def base_colour_of_metal(material: Material) -> Advice | None:
    """A metal's base colour is what it reflects at normal incidence."""
    if material.base_color is None or material.kind != "metal" or material.f0 is not None:
        return None
    f0 = tuple(min(each, MOST_F0) for each in material.base_color)
    says = f"F0 = {_several(f0)}, its base colour {_hex(material)}"
    return Advice(says, "base_color of a metal", sets={"f0": f0})


@rule("5.2")
def base_colour_of_body(material: Material) -> Advice | None:
    """What is no metal has its base colour from the body."""
    if material.base_color is None or material.kind == "metal" or material.appearance == "metallic flake":
        return None
    given = material.albedo
    if given is not None and "albedo" not in material.filled_by:
        apart = abs(chart.cie_lightness(_mean(given)) - chart.cie_lightness(_mean(material.base_color)))
        says = f"base_color is {_several(material.base_color)}, diffuse_reflectance {_several(given)}; this one is used"
        return Advice(says, "two colours of one body", conflict=apart > NOTICED)
    says = f"the body's albedo is its base colour {_hex(material)}: linear {_several(material.base_color)}"
    return Advice(says, "base_color", sets={"albedo": material.base_color})


@rule("4.5, 5.2")
def base_colour_of_flakes(material: Material) -> Advice | None:
    """Flakes have the base colour that is seen of them."""
    if material.base_color is None or material.appearance != "metallic flake" or material.albedo is not None:
        return None
    says = f"the flakes send back their base colour {_hex(material)}: linear {_several(material.base_color)}"
    return Advice(says, "base_color of metallic flakes", sets={"albedo": material.base_color})


@rule("5.2")
def roughness_as_typed(material: Material) -> Advice | None:
    """A roughness is read as the program means it."""
    if material.typed_alpha is None:
        return None
    number, sense = material.given["roughness"], material.given.get("in", "openpbr")
    if material.typed_alpha < gloss.LOW:
        return Advice(f"roughness {number:g} in {sense} is a mirror", "roughness", sets={"finish": "mirror"})
    unsaid = "" if "in" in material.given else "; squared as most programs do, say which with `in`"
    return Advice(f"roughness {number:g} in {sense} is alpha = {material.typed_alpha:.3g}{unsaid}", "roughness")


def _hex(material: Material) -> str:
    return hex_of(material.base_color)


def _mean(values) -> float:
    return sum(values) / len(values)


def _several(values) -> str:
    return ", ".join(f"{value:.3g}" for value in values)


RULES = (base_colour_of_metal, base_colour_of_body, base_colour_of_flakes, roughness_as_typed)
