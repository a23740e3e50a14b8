"""GLSL, OSL and C share their functions of floats; what differs is the outside."""

from ._dialect import CALL, needed, prefixed
from .exporter import ColouredSurface

TOTAL = """float bg_total({arguments})
{{
    float sum = 0.0;
    if (w < 7.0) {{
        float count = ceil(top + 12.0 * w + 14.0 - bg_first_order(top, w));
        for (float i = 0.0; i < 192.0; i += 1.0) {{
            if (i < count) {{ sum += bg_order(i, {names}); }}
        }}
    }} else {{
        for (float t = -8.4; t < 8.5; t += 0.6) {{ sum += bg_trapezoid(t, {names}); }}
    }}
    return sum;
}}"""


def functions(surface: ColouredSurface, expressions: list[str]) -> str:
    """Every function that the expressions call, defined before use."""
    choose = "float bg_choose(float c, float a, float b) { return c > 0.0 ? a : b; }"
    lines = [choose]
    for name, arguments, text in needed(surface, expressions):
        floats = ", ".join(f"float {argument}" for argument in arguments.split(", "))
        if name == "total":
            lines.append(TOTAL.format(arguments=floats, names=arguments))
        else:
            lines.append(f"float bg_{name}({floats}) {{ return {prefixed(text)}; }}")
    return "\n".join(lines) if CALL.search(" ".join(expressions)) else ""


def triple(expressions: list[str], kind: str) -> str:
    """A colour of one or three expressions."""
    return f"{kind}({', '.join(prefixed(text) for text in expressions)})"
