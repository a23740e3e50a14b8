"""What MaterialX generates from our files, compiled and evaluated by a browser, against the laws of models/."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from brdfguide import exporters
from brdfguide.exporters import coloured
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import Geometry, rows

from .conftest import directions, vectors

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
BASE = {"base_color": [0.8, 0.3, 0.1], "specular_roughness": 0.4}
CASES = {
    ("openpbr", "dielectric"): BASE | {"specular_ior": 1.7, "specular_weight": 0.8},
    ("openpbr", "metal"): BASE | {"base_metalness": 1.0, "specular_color": [0.9, 0.7, 0.5]},
    ("openpbr", "coat"): BASE | {"coat_weight": 0.7, "coat_roughness": 0.3, "coat_color": [0.9, 0.8, 0.7]},
    ("openpbr", "coated metal"): BASE | {"base_metalness": 1.0, "coat_weight": 1.0, "coat_roughness": 0.2},
    ("standard-surface", "dielectric"): BASE | {"specular_ior": 1.7, "specular": 0.8},
    ("standard-surface", "metal"): BASE | {"metalness": 1.0, "specular_color": [0.9, 0.7, 0.5]},
    ("standard-surface", "coat"): BASE | {"coat": 0.7, "coat_roughness": 0.3, "coat_color": [0.9, 0.8, 0.7]},
    ("standard-surface", "coated metal"): BASE | {"metalness": 1.0, "coat": 1.0, "coat_roughness": 0.2},
    ("standard-surface", "sheen"): BASE | {"sheen": 0.5, "sheen_roughness": 0.4},
}
WITHIN = 1e-3  # relative, of float32 and of MaterialX's own clamps
VERTEX = """#version 300 es
out vec3 normalWorld; out vec3 tangentWorld; out vec3 positionWorld;
void main() {
    normalWorld = vec3(0, 0, 1); tangentWorld = vec3(1, 0, 0); positionWorld = vec3(0);
    gl_Position = vec4(vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0, 0, 1);
}"""
PAGE = """<pre></pre><script>
const jobs = JOBS, gl = document.createElement("canvas").getContext("webgl2"), told = {};
gl.getExtension("EXT_color_buffer_float");
gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, 1, 1);
gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
gl.viewport(0, 0, 1, 1);
function run(pixel, cases) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, jobs.vertex], [gl.FRAGMENT_SHADER, pixel]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text); gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return gl.getShaderInfoLog(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program); gl.useProgram(program);
  const at = name => gl.getUniformLocation(program, name);
  gl.uniform1i(at("u_numActiveLightSources"), 1); gl.uniform1i(at("u_lightData[0].type"), 1);
  gl.uniform3f(at("u_lightData[0].color"), 1, 1, 1); gl.uniform1f(at("u_lightData[0].intensity"), 1);
  const out = new Float32Array(4);
  return Object.fromEntries(Object.entries(cases).map(([name, numbers]) => [name, one(numbers)]));
  function one(numbers) {
  for (const [name, [kind, value]] of Object.entries(numbers)) {
    if (kind === "color3" || kind === "vector3") gl.uniform3f(at(name), ...value);
    else if (kind === "float") gl.uniform1f(at(name), value);
    else gl.uniform1i(at(name), value);
  }
  return jobs.directions.map(([light, view]) => {
    gl.uniform3f(at("u_lightData[0].direction"), -light[0], -light[1], -light[2]);
    gl.uniform3f(at("u_viewPosition"), ...view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, out);
    return [...out.slice(0, 3)];
  });
  }
}
for (const [target, pixel] of Object.entries(jobs.pixels)) told[target] = run(pixel, jobs.cases[target]);
document.querySelector("pre").textContent = JSON.stringify(told);
</script>"""


def generated(text: str) -> tuple[str, dict]:
    """The pixel shader of the material in a .mtlx, for WebGL, with one light and no surroundings; its inputs as
    uniforms (name -> (type, value))."""
    mx = pytest.importorskip("MaterialX", reason="pip install materialx")
    from MaterialX import PyMaterialXGenGlsl as glsl
    from MaterialX import PyMaterialXGenShader as shaders

    libraries, document, path = mx.createDocument(), mx.createDocument(), mx.getDefaultDataSearchPath()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), path, libraries)
    mx.readFromXmlString(document, text)
    document.setDataLibrary(libraries)
    generator = glsl.EsslShaderGenerator.create()
    context = shaders.GenContext(generator)
    context.registerSourceCodeSearchPath(path)
    options = context.getOptions()
    options.hwSpecularEnvironmentMethod = shaders.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_NONE
    options.hwMaxActiveLightSources = 1
    options.shaderInterfaceType = shaders.ShaderInterfaceType.SHADER_INTERFACE_COMPLETE
    shaders.HwShaderGenerator.bindLightShader(libraries.getNodeDef("ND_directional_light"), 1, context)
    [material] = document.getMaterialNodes()
    made = generator.generate("it", material, context)
    block = made.getStage(shaders.PIXEL_STAGE).getUniformBlock("PublicUniforms")
    ports = [block[place] for place in range(block.size())]
    numbers = {port.getVariable(): _uniform(port.getType().getName(), port.getValue()) for port in ports}
    # without surroundings MaterialX 1.39.5 leaves out the declaration of what its refraction reads
    pixel = made.getSourceCode(shaders.PIXEL_STAGE)
    pixel = pixel.replace("precision highp float;", "precision highp float;\nuniform bool u_refractionTwoSided;", 1)
    return pixel, {name: each for name, each in numbers.items() if each}


def _uniform(kind: str, value):
    if value is None or kind not in ("float", "color3", "vector3", "boolean", "integer"):
        return None
    data = value.getData()
    return kind, [data[place] for place in range(3)] if kind in ("color3", "vector3") else data


def evaluated(jobs: dict, tmp_path) -> dict:
    """What the browser's shaders give for every job."""
    if not BROWSER:
        pytest.skip("no chromium on this machine")
    page = tmp_path / "page.html"
    page.write_text(PAGE.replace("JOBS", json.dumps({"vertex": VERTEX, **jobs}).replace("</", "<\\/")))
    words = [BROWSER, "--headless", "--no-sandbox", "--disable-background-networking", "--no-first-run"]
    words += ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    words += [f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=4000", "--dump-dom", page.as_uri()]
    run = subprocess.run(words, capture_output=True, text=True, timeout=300)
    found = json.loads(re.search(r"<pre>(.*?)</pre>", run.stdout, re.S)[1] or "{}")
    assert found.keys() == jobs["pixels"].keys(), run.stderr[-2000:]
    for target, each in found.items():
        assert isinstance(each, dict), f"{target}: {each}"
    return found


@pytest.mark.validate
@pytest.mark.browser
def test_compiled_and_evaluated_the_generated_code_is_the_law(tmp_path):
    surfaces = {case: coloured(Surface.named(case[0], values)) for case, values in CASES.items()}
    geom = directions(60, seed=5, most=80.0)
    light, view = vectors(geom)
    jobs = {"directions": np.stack([light, view], axis=1).tolist(), "pixels": {}, "cases": {}}
    for (target, name), each in surfaces.items():
        jobs["pixels"][target], numbers = generated(exporters.export(target, each).content)
        jobs["cases"].setdefault(target, {})[name] = numbers
    found = evaluated(jobs, tmp_path)
    for (target, name), each in surfaces.items():
        shown = np.array(found[target][name]) / geom.cos_i
        np.testing.assert_allclose(shown, each.rgb(geom), rtol=WITHIN, err_msg=f"{target} {name}")


def upward(theta_deg, phi_deg) -> np.ndarray:
    """Unit vectors (directions, 3)."""
    theta, phi = np.radians(theta_deg), np.radians(phi_deg)
    return np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=-1)


AXIS = float(np.radians(30.0))
GRAINED = {
    ("openpbr", "metal"): ("ggx-aniso", {"alpha_x": 0.3, "alpha_y": 0.1, "n": 1.0, "k": 4.0}),
    ("standard-surface", "metal"): ("ggx-aniso", {"alpha_x": 0.3, "alpha_y": 0.1, "n": 1.0, "k": 4.0}),
    ("gltf-pbr", "metal"): ("ggx-aniso", {"alpha_x": 0.3, "alpha_y": 0.1, "n": 1.0, "k": 4.0}),
    ("gltf-pbr", "body"): ("lambertian+ggx-aniso", {"alpha_x": 0.4, "alpha_y": 0.2, "n": 1.6}),
}


@pytest.mark.validate
@pytest.mark.browser
def test_the_generated_code_has_the_streak_across_the_grain(tmp_path):
    surfaces = {}
    for case, (law, values) in GRAINED.items():
        given = {f"ggx-aniso.{name}": value for name, value in (values | {"axis": AXIS}).items()}
        surfaces[case] = coloured(Surface.named(law, given))
    rng = np.random.default_rng(6)
    ends = np.array([30.0, 210.0, 120.0, 300.0])  # along the streak, and across it
    phi_i, theta_i = np.append(ends + 180, rng.uniform(0, 360, 40)), np.append(np.full(4, 0.5), rng.uniform(0, 75, 40))
    phi_r, theta_r = np.append(ends, phi_i[4:] + rng.uniform(120, 240, 40)), np.append(np.full(4, 25.0), theta_i[4:])
    geom = rows(Geometry.from_degrees(theta_i, phi_i, theta_r, phi_r))
    light, view = upward(theta_i, phi_i), upward(theta_r, phi_r)
    jobs = {"directions": np.stack([light, view], axis=1).tolist(), "pixels": {}, "cases": {}}
    made = {case: exporters.export(case[0], surface) for case, surface in surfaces.items()}
    for (target, name), each in made.items():
        jobs["pixels"][target], numbers = generated(each.content)
        jobs["cases"].setdefault(target, {})[name] = numbers
    found = evaluated(jobs, tmp_path)
    for case, each in made.items():
        shown = np.array(found[case[0]][case[1]]) / geom.cos_i
        along, across = shown[:2, 0], shown[2:4, 0]
        assert along.min() > (2 if case[1] == "metal" else 1.05) * across.max(), case
        np.testing.assert_allclose(shown[:4], surfaces[case].rgb(geom)[:4], rtol=0.1, err_msg=str(case))
        if case[0] == "gltf-pbr":
            np.testing.assert_allclose(shown, each.statement.shown(geom), rtol=WITHIN, err_msg=str(case))
