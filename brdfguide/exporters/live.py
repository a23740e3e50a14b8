"""A surface's law with its numbers left open: the same formulas as GLSL and JavaScript whose parameters are sliders.

Where a formula's further numbers follow from its parameters by arithmetic, the arithmetic is recorded as it is done and
written out; a parameter for which that fails, since its numbers are tables, is held at its value.
"""

import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import field
from math import pi

import numpy as np

from ..models.facts import TOWARD_LIGHT
from ..models.model import Term
from ..models.surface import Surface
from ..records import dataclass
from ._dialect import literal, needed, prefixed
from ._shader import functions
from .exporter import ColouredSurface

NAME = re.compile(r"\b([vd]\d+)\b")
UFUNCS = {"sqrt": "sqrt", "exp": "exp", "log": "log", "cos": "cos", "sin": "sin", "tan": "tan"}
BINARY = {"add": "+", "subtract": "-", "multiply": "*", "divide": "/", "true_divide": "/"}
TOTAL = """const bg_total = ({arguments}) => {{
  let sum = 0;
  if (w < 7) {{
    const count = Math.ceil(top + 12 * w + 14 - bg_first_order(top, w));
    for (let i = 0; i < count && i < 192; i++) sum += bg_order(i, {arguments});
  }} else for (let t = -8.4; t < 8.5; t += 0.6) sum += bg_trapezoid(t, {arguments});
  return sum;
}};"""


class Symbol:
    """A number that is not known yet: what is done with it becomes text. It has no size and compares with nothing."""

    def __init__(self, text: str):
        self.text = text

    def __array_ufunc__(self, ufunc, method, *inputs, **more):
        texts = [_text(each) for each in inputs]
        if method == "__call__" and not more and ufunc.__name__ in UFUNCS:
            return Symbol(f"{UFUNCS[ufunc.__name__]}({texts[0]})")
        if method == "__call__" and not more and ufunc.__name__ in BINARY:
            return Symbol(f"({texts[0]} {BINARY[ufunc.__name__]} {texts[1]})")
        if method == "__call__" and ufunc.__name__ in ("negative", "square"):
            return Symbol(f"(-{texts[0]})" if ufunc.__name__ == "negative" else f"({texts[0]} * {texts[0]})")
        return NotImplemented

    def __neg__(self):
        return Symbol(f"(-{self.text})")

    def __pow__(self, power):
        if power != 2:
            raise TypeError(power)
        return Symbol(f"({self.text} * {self.text})")


def _text(value) -> str:
    if isinstance(value, Symbol):
        return value.text
    if np.size(value) != 1:
        raise TypeError("an array is no number")
    return literal(value)


def _recorded(sign: str, turned: bool) -> Callable:
    def act(self, other):
        one, two = (_text(other), self.text) if turned else (self.text, _text(other))
        return Symbol(f"({one} {sign} {two})")

    return act


for _name, _sign in ((operator.add, "+"), (operator.sub, "-"), (operator.mul, "*"), (operator.truediv, "/")):
    setattr(Symbol, f"__{_name.__name__}__", _recorded(_sign, False))
    setattr(Symbol, f"__r{_name.__name__}__", _recorded(_sign, True))


@dataclass(frozen=True)
class Live:
    """A surface's law in GLSL and JavaScript, its parameters called v0, v1... in the model's order."""

    ids: Mapping[str, str]  # key of a parameter -> v0
    held: frozenset[str]  # keys that cannot be turned
    glsl: str  # uniforms, `vec3 finite(ci, cr, q, p, b)`, b = |i_xy - r_xy|², and `vec3 mirror(ci)`
    javascript: str  # an object: numbers(V, c), finite(V, ci, cr, q, p), mirror(V, ci) of one channel
    numbers: tuple[str, ...]  # names of the further uniforms
    calls: tuple[str, ...] = field(default=(), repr=False)


def live(surface: ColouredSurface) -> Live:
    """The law of a surface of one channel or of three colours, whose terms all state formulas."""
    ids = {key: f"v{place}" for place, key in enumerate(surface.model.parameters)}
    held: set[str] = set()
    further: dict[str, list[str]] = {}
    terms = [_term(surface, term, ids, held, further) for term in surface.model.terms]
    calls = [call for finite, mirror, _ in terms for call in (finite, mirror) if call]
    names = [*ids.values(), *further]
    uniforms = "\n".join(f"uniform vec3 {name};" for name in names)
    bodies = [_sum_glsl([(term[place], *term[2][place]) for term in terms if term[place]]) for place in (0, 1)]
    glsl = f"""{uniforms}
{functions(surface, calls)}
vec3 finite(float ci, float cr, float q, float p, float b) {{ return {bodies[0]}; }}
vec3 mirror(float ci) {{ return {bodies[1]}; }}"""
    return Live(ids, frozenset(held), glsl, _javascript(surface, terms, calls, further), tuple(further), tuple(calls))


def _term(surface: ColouredSurface, term: Term, ids, held: set[str], further: dict[str, list[str]]):
    """(finite, mirror, (amplitude, whether it differs by channel) of each) with names in place of numbers."""
    formula = term.model.formula
    assert formula is not None
    names = {name: ids[key] for name, key in term.keys.items()}
    coloured = {name for name, key in term.keys.items() if np.size(surface.values.get(key, 0.0)) > 1}
    by_channel = False
    if formula.numbers:
        found = _numbers(surface, term, names, held)
        for name, texts in found.items():
            fresh = f"d{len(further)}"
            further[fresh], names[name] = texts, fresh
            by_channel |= len(set(texts)) > 1
    amplitude = term.model.amplitude
    out, scales = [], []
    for text in (formula.brdf, formula.mirror):
        used = set(re.findall(r"\{(\w+)\}", text))
        factor = amplitude if amplitude in used and text.count(f"{{{amplitude}}}") == 1 else None
        differs = by_channel or bool(coloured & used - {factor})
        filled = {**names, factor: "1.0"} if factor else names
        out.append(text.format(**filled))
        scales.append((names[factor] if factor else None, differs))
    return out[0], out[1], scales


def _numbers(surface: ColouredSurface, term: Term, names: Mapping[str, str], held: set[str]) -> dict[str, list[str]]:
    """Further number -> its text, one for each channel; parameters through which none leads are added to `held`."""
    channels: list[Surface] = [surface.channel(place) for place in range(len(surface.channels))]
    symbols = {name: Symbol(text) for name, text in names.items()}
    free = [name for name in names if _traced(channels[0], term, {name: symbols[name]}) is not None]
    taken = {name: symbols[name] for name in free}
    if _traced(channels[0], term, taken) is None:
        taken = {}
    held |= {term.key(name) for name in names if name not in taken}
    texts: dict[str, list[str]] = {}
    for one in channels:
        for name, value in (_traced(one, term, taken) or {}).items():
            texts.setdefault(name, []).append(value)
    return texts


def _traced(one: Surface, term: Term, symbols: Mapping[str, Symbol]) -> dict[str, str] | None:
    """The formula's further numbers of one channel as texts; None where one of the symbols leads through a table."""
    assert term.model.formula is not None and term.model.formula.numbers is not None
    try:
        found = term.model.formula.numbers(wavelength=float(one.wavelengths[0]), **{**one.values_of(term), **symbols})
        return {name: _text(value) for name, value in found.items()}
    except (TypeError, ValueError, AttributeError):
        return None


def _sum_glsl(parts) -> str:
    texts = []
    for call, amplitude, differs in parts:
        spread = [NAME.sub(rf"\1.{axis}", prefixed(call.replace(TOWARD_LIGHT, "b"))) for axis in "xyz"]
        value = f"vec3({', '.join(spread)})" if differs else f"vec3({spread[0]})"
        texts.append(f"{amplitude} * {value}" if amplitude else value)
    return " + ".join(texts) or "vec3(0.0)"


def _javascript(surface: ColouredSurface, terms, calls: list[str], further: Mapping[str, list[str]]) -> str:
    """An immediately called function, so that its helpers meet no other model's."""
    lines = ["const bg_choose = (c, a, b) => c > 0 ? a : b;"]
    for name, arguments, text in needed(surface, calls) if calls else ():
        if name == "total":
            lines.append(TOTAL.format(arguments=arguments))
        else:
            lines.append(f"const bg_{name} = ({arguments}) => {_mathematics(prefixed(text))};")
    bodies = []
    for place in (0, 1):
        parts = [(term[place], term[2][place][0]) for term in terms if term[place]]
        texts = [f"V.{amplitude} * ({_valued(call)})" if amplitude else _valued(call) for call, amplitude in parts]
        bodies.append(" + ".join(texts) or "0")
    numbers = ", ".join(f"{name}: {_picked([_with_values(text) for text in texts])}" for name, texts in further.items())
    return (
        "(() => {\n" + "\n".join(lines) + "\n"
        f"return {{numbers: (V, c) => ({{{numbers}}}), finite: (V, ci, cr, q, p) => {bodies[0]},"
        f" mirror: (V, ci) => {bodies[1]}}};\n}})()"
    )


def _picked(texts: list[str]) -> str:
    return texts[0] if len(set(texts)) == 1 else f"[{', '.join(texts)}][c]"


def _valued(call: str) -> str:
    return _with_values(prefixed(call))


def _with_values(text: str) -> str:
    return NAME.sub(r"V.\1", _mathematics(text))


def _mathematics(text: str) -> str:
    text = text.replace(f"{pi:.9g}", "Math.PI")
    return re.sub(r"\b(exp|log|sqrt|acos|floor|ceil|cos|sin|tan)\(", r"Math.\1(", text)
