"""The one text of every law: in double precision against the models, compiled as C floats, and through glslang."""

import ctypes
import math
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

from brdfguide import exporters, models
from brdfguide.errors import NoAnswer
from brdfguide.exporters import _dialect, _shader
from brdfguide.exporters._formulas import FORMULAS, SERIES

from .conftest import EXAMPLES, NAMES, WRITTEN, coloured, directions, surface

CASES = WRITTEN | {
    "smooth he-torrance": surface("he-torrance", he_torrance__sigma=0.05, he_torrance__slope=0.05),
    "rough he-torrance": surface("he-torrance", he_torrance__sigma=20.0, he_torrance__slope=0.3, he_torrance__k=3.0),
    "narrow phong-lewis": surface("phong-lewis", phong_lewis__exponent=1e5),
    "narrow ggx": surface("ggx", ggx__alpha=1e-3, ggx__n=1.05),
    "retro lafortune": surface("lafortune", lafortune__tilt=-0.6),
    "steep oren-nayar": coloured("oren-nayar", oren_nayar__albedo=[0.1, 0.5, 0.9], oren_nayar__spread=1.1),
    "coated he-torrance": surface("coated:he-torrance", he_torrance__sigma=0.05, he_torrance__slope=0.05),
    "coated metal": surface(
        "coated:lambertian+beckmann", beckmann__n=0.9, beckmann__k=6.0, coat__depth=0.3, coat__n=1.4
    ),
    "coated lafortune": surface("coated:oren-nayar+lafortune", oren_nayar__spread=0.5, lafortune__exponent=30.0),
    "absorbing beckmann": surface("beckmann", beckmann__alpha=0.9, beckmann__n=1.3, beckmann__k=7.0),
}


COATED = models.coat.MODEL, *(models.coat.over(law) for law in models.every() if law.name != "coupled")


def python_formulas() -> dict:
    """The formulas as Python functions of doubles."""
    names = {name: getattr(math, name) for name in ("log", "sqrt", "acos", "floor", "ceil")}
    names |= {"exp": lambda x: math.exp(min(x, 700.0)), "PI": math.pi, "choose": lambda c, a, b: a if c > 0 else b}

    def total(g, y, u, top, w, high):
        if w < 7:
            count = math.ceil(top + 12 * w + 14 - names["first_order"](top, w))
            return sum(names["order"](i, g, y, u, top, w, high) for i in range(min(192, count)))
        return sum(names["trapezoid"](-8.4 + 0.6 * k, g, y, u, top, w, high) for k in range(29))

    own = [each for law in (*models.every(), *COATED) if law.formula for each in law.formula.functions]
    for name, arguments, text in (*FORMULAS, *SERIES, *own):
        if name == "total":
            names["total"] = total
            continue
        exec(
            (
                f"def {name.replace('lambda', 'lambda_', name == 'lambda')}({arguments}): return "
                f"{text.replace('lambda(', 'lambda_(')}"
            ),
            names,
        )
    return names


def arguments(geom):
    return {"ci": geom.cos_i[:, 0], "cr": geom.cos_r[:, 0], "q": geom.vxy2[:, 0], "p": geom.dot_xy[:, 0]}


@pytest.mark.parametrize("name", CASES)
def test_text_equals_the_model_in_double_precision(name):
    """Within what its erfc allows, 1.5e-7."""
    case, geom = CASES[name], directions(150, most=88.0)
    names = python_formulas()
    given = arguments(geom)
    for column, text in enumerate(_dialect.colour_expressions(case)):
        code = compile(text.replace("lambda(", "lambda_("), name, "eval")
        got = [
            eval(code, names, {key: float(values[row]) for key, values in given.items()}) for row in range(len(geom))
        ]
        np.testing.assert_allclose(got, case.rgb(geom)[:, column], rtol=2e-6, atol=1e-12)


def test_every_law_has_a_formula_or_a_sentence():
    for law in models.every():
        case = surface(law.name)
        if law.formula is None:
            sentence = f"{law.name} (states no formula for shaders|changes as the sample turns)"
            with pytest.raises(NoAnswer, match=sentence):
                exporters.export("glsl", case)
        else:
            assert _dialect.colour_expressions(case) and _dialect.mirror_colours(case), law.name


def test_no_two_laws_mean_different_functions_by_one_name():
    meant = {name: (arguments, text) for name, arguments, text in (*FORMULAS, *SERIES)}
    for law in (*models.every(), *COATED):
        for name, arguments, text in law.formula.functions if law.formula else ():
            assert meant.setdefault(name, (arguments, text)) == (arguments, text), (law.name, name)


@pytest.mark.parametrize("name", [*CASES, *EXAMPLES])
def test_compiled_in_float_it_agrees_to_a_few_ulp(name, of, tmp_path):
    """The body of the GLSL and OSL functions, as C floats: no NaN, no overflow, 1e-4 of the model."""
    geom = directions(4000, seed=2, most=89.0)
    for number, case in enumerate([CASES[name]] if name in CASES else of(name)):
        expressions = _dialect.colour_expressions(case)
        wanted = case.rgb(geom)[:, : len(expressions)]
        got = in_floats(case, expressions, geom, tmp_path / f"law{number}")[:, : len(expressions)]
        assert np.all(np.isfinite(got)), case.name
        np.testing.assert_allclose(got, wanted, rtol=1e-4, atol=3e-6 * wanted.max(), err_msg=case.name)


def in_floats(surface, expressions, geom, path) -> np.ndarray:
    """The expressions (samples, 3) as a C compiler's floats give them."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        pytest.skip("no C compiler to run the shader's text with")
    macros = "".join(f"#define {word} {word}f\n" for word in ("exp", "log", "sqrt", "acos", "floor", "ceil"))
    body = "\n".join(f"    out[3 * j + {c}] = {_dialect.prefixed(text)};" for c, text in enumerate(expressions))
    functions = _shader.functions(surface, expressions)
    source = f"#include <math.h>\n{macros}{functions}\nvoid run(int n, const float *a, float *out) {{\n"
    source += (
        f"  for (int j = 0; j < n; j++) {{\n    float ci = a[4 * j], cr = a[4 * j + 1], q = a[4 * j + 2], p = a[4 * "
        f"j + 3];\n{body}\n  }}\n}}\n"
    )
    source = re.sub(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)", r"\1f", source)
    path.with_suffix(".c").write_text(source)
    subprocess.run(
        [compiler, "-O1", "-shared", "-fPIC", "-o", str(path.with_suffix(".so")), str(path.with_suffix(".c")), "-lm"],
        check=True,
    )
    given = np.ascontiguousarray(np.stack(list(arguments(geom).values()), axis=-1), np.float32)
    out = np.zeros((len(geom), 3), np.float32)

    def pointer(array):
        return array.ctypes.data_as(ctypes.c_void_p)

    ctypes.CDLL(str(path.with_suffix(".so"))).run(len(geom), pointer(given), pointer(out))
    return out


@pytest.mark.validate
@pytest.mark.parametrize("name", NAMES)
def test_glsl_compiles(name, of, tmp_path):
    if shutil.which("glslangValidator") is None:
        pytest.skip("apt-get install glslang-tools: compiles the shaders")
    for each in of(name):
        text = exporters.export("glsl", each).content
        own = re.search(r"vec3 (\w+)_brdf", text)[1]
        main = (
            f"in vec3 L; in vec3 V; out vec4 o; void main() {{ o = vec4({own}_brdf(L, V, vec3(0, 0, 1)) + "
            f"{own}_mirror(V.z), 1); }}"
        )
        for version in ("#version 130", "#version 300 es\nprecision highp float;"):
            (tmp_path / "law.frag").write_text(f"{version}\n{text}\n{main}\n")
            run = subprocess.run(["glslangValidator", str(tmp_path / "law.frag")], capture_output=True, text=True)
            assert run.returncode == 0, run.stdout


def test_osl_and_glsl_hold_the_same_functions():
    glsl, osl = (exporters.export(target, WRITTEN["he-torrance"]).content for target in ("glsl", "osl"))

    def functions(text):
        return re.findall(r"^float bg_.*$", text, flags=re.M)

    assert functions(glsl) == functions(osl) and len(functions(glsl)) > 30
    assert osl.count("{") == osl.count("}") and osl.count("(") == osl.count(")")


COMPILE = """
import sys, bpy
sys.path.append(bpy.__path__[0] + f"/{bpy.app.version[0]}.{bpy.app.version[1]}/scripts/addons_core")
import _cycles
for path in sys.argv[1:]:
    print(bool(_cycles.osl_compile(path, path[:-3] + "oso")), path, flush=True)
"""


@pytest.mark.validate
def test_osl_compiler_takes_every_shader(of, tmp_path):
    """Open Shading Language's own compiler, as Blender carries it; the last file is wrong and must be seen to be."""
    python = os.environ.get("BPY_PYTHON")
    if python is None:
        pytest.skip(
            "BPY_PYTHON: an interpreter with the package bpy (Blender 4.5, Python 3.11), whose OSL compiler "
            "reads these exports"
        )
    paths = []
    for each in (each for name in NAMES for each in of(name)):
        paths.append(tmp_path / f"m{len(paths)}.osl")
        paths[-1].write_text(exporters.export("osl", each).content)
    (tmp_path / "wrong.osl").write_text(paths[0].read_text().replace("normalize(", "normalise("))
    run = subprocess.run(
        [python, "-c", COMPILE, *map(str, paths), str(tmp_path / "wrong.osl")], capture_output=True, text=True
    )
    compiled = [line.split()[0] for line in run.stdout.splitlines() if line.endswith(".osl")]
    assert len(paths) > 60 and compiled == ["True"] * len(paths) + ["False"], run.stdout + run.stderr
    assert "normalise" in run.stdout + run.stderr
    assert all(
        (tmp_path / f"m{number}.oso").read_text().startswith("OpenShadingLanguage") for number in range(len(paths))
    )
