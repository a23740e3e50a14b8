"""The formulas written out for a language, and a surface as one expression for each colour."""

import re
from math import pi

import numpy as np

from ..models.lafortune import c_xy, c_z
from ._base import Surface, number
from ._formulas import AFTER_SERIES, FORMULAS, HE_TORRANCE

CALL = re.compile(r"\b([a-z_][a-z0-9_]*)\(")
BUILT_IN = {"exp", "log", "sqrt", "acos", "floor", "ceil"}
SERIES_ARGUMENTS = "g, y, u, top, w, high"
PREFIX = "bg_"


def needed(expressions: list[str]) -> list[tuple[str, str, str]]:
    """The formulas that some expressions call, directly or not, in an order that defines before use."""
    everything = (*FORMULAS, *HE_TORRANCE, ("total", SERIES_ARGUMENTS, ""), *AFTER_SERIES)
    wanted = {name for text in expressions for name in CALL.findall(text)}
    for name, _, text in reversed(everything):
        if name in wanted:
            wanted |= set(CALL.findall(text))
            wanted |= {"order", "trapezoid", "first_order"} if name == "total" else set()
    wanted |= set.union(*(set(CALL.findall(text)) for name, _, text in everything if name in wanted), set())
    for name, _, text in reversed(everything):
        if name in wanted:
            wanted |= set(CALL.findall(text))
    return [formula for formula in everything if formula[0] in wanted]


def prefixed(text: str) -> str:
    """Calls of our own functions under a prefix that no renderer uses."""
    named = CALL.sub(lambda call: call[0] if call[1] in BUILT_IN else f"{PREFIX}{call[1]}(", text)
    return re.sub(r"\bPI\b", f"{pi:.9g}", named)


def real(value) -> str:
    """A number as every one of the languages reads it: with a point or an exponent."""
    text = f"{number(np.ravel(value)[0], -1e30, 1e30, 'parameter'):.9g}"
    return text if set(text) & set(".e") else text + ".0"


def colours(surface: Surface) -> list[str]:
    """One expression in ci, cr, q, p for each of red, green and blue; one alone for a grey surface."""
    return _combined(surface, _finite)


def mirror_colours(surface: Surface) -> list[str]:
    """The same for the reflectance of the ideal mirror, in ci."""
    return _combined(surface, _mirror)


def _combined(surface: Surface, term_text) -> list[str]:
    if len(surface.channels) == 1:
        return [_sum(surface, 0, term_text)]
    texts = [_sum(surface, channel, term_text) for channel in range(len(surface.channels))]
    if len(set(texts)) == 1:
        return texts[:1]
    if not surface.colour.mixes:
        return [texts[int(np.argmax(row))] for row in surface.colour.matrix]
    rows = surface.colour.matrix
    return ["most(0.0, " + " + ".join(f"{real(weight)} * ({text})" for weight, text in zip(row, texts) if abs(weight) > 1e-6) + ")" for row in rows]


def _sum(surface: Surface, channel: int, term_text) -> str:
    parts = []
    wavelength = float(np.broadcast_to(surface.wavelength, (len(surface.channels),))[channel])
    for term in surface.model.terms:
        own = {name: np.ravel(value)[channel if np.size(value) > 1 else 0] for name, value in surface.of(term.label).items()}
        text = term_text(term.model.name, own, wavelength)
        parts += [text] if text else []
    return " + ".join(parts) or "0.0"


def _finite(law: str, v: dict, wavelength: float) -> str:
    """One term's BRDF with its numbers."""
    call = lambda *numbers, of="ci, cr, q": f"{law.replace('-', '_')}({', '.join((of, *map(real, numbers)) if of else map(real, numbers))})"  # noqa: E731
    match law:
        case "lambertian":
            return call(v["albedo"], of="")
        case "coupled":
            return call(v["albedo"], of="ci, cr")
        case "oren-nayar":
            return call(v["albedo"], v["spread"], of="ci, cr, p")
        case "eon":
            return call(v["albedo"], v["roughness"], of="ci, cr, p")
        case "phong" | "phong-lewis" | "blinn":
            return call(v["ks"], v["exponent"])
        case "ward" | "ward-duer" | "ward-gmd":
            return call(v["rho_s"], v["alpha"])
        case "lafortune":
            xy, z = float(c_xy(v["tilt"])), float(c_z(v["tilt"]))
            return call(v["ks"], v["exponent"], -xy - 1, xy, z + xy)
        case "cook-torrance" | "beckmann" | "ggx":
            return f"{real(v['scale'])} * {call(v['alpha'], v['n'], v['k'])}"
        case "he-torrance":
            tau = v["sigma"] / v["slope"]
            return f"{real(v['scale'])} * {call(v['sigma'] / wavelength, tau / wavelength, v['slope'], v['n'], v['k'])}"
        case "mirror":
            return ""
    raise KeyError(f"{law} has no formula in exporters/_formulas.py")


def _mirror(law: str, v: dict, wavelength: float) -> str:
    if law == "mirror":
        return f"mirror(ci, {real(v['n'])}, {real(v['k'])}, {real(v['sigma'] / wavelength)})"
    if law == "he-torrance":
        return f"{real(v['scale'])} * he_mirror(ci, {real(v['sigma'] / wavelength)}, {real(v['slope'])}, {real(v['n'])}, {real(v['k'])})"
    return ""
