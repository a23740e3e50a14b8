"""The preview's quadrature once more, as passes of WebGL2: constants from `render`, laws from `exporters.live`.

Three passes: `lobe` (f·weight of every half vector at every angle of view, and about the light where a law shines
back), `table` (sky and ground reflected, over angle and roll), `picture` (radiance of every pixel). What is on the
screen is made of pictures by `show`.
"""

import re

import numpy as np

from .. import render

HEAD = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
FLAT = (
    "void main() { vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);"
    " gl_Position = vec4(at, 0.0, 1.0); }"
)


def _vec3(values) -> str:
    return f"vec3({', '.join(f'{each:.9g}' if each % 1 else f'{each:.1f}' for each in np.asarray(values, float))})"


WORLD = f"""
const float PI_ = 3.14159265358979;
const vec3 ZENITH = {_vec3(render.ZENITH)}, HORIZON = {_vec3(render.HORIZON)}, GROUND = {_vec3(render.GROUND)};
const vec3 SUN = {_vec3(render.SUN)};
const float SUN_RADIUS = {render.SUN_RADIUS}, SCALE_HEIGHT = {render.SCALE_HEIGHT};
const int THETAS = {render.THETAS}, ROLLS = {render.ROLLS};
vec3 sky(float height) {{
  return height >= 0.0 ? ZENITH + (HORIZON - ZENITH) * exp(-height / SCALE_HEIGHT) : GROUND;
}}
// angle, sine and cosine: rolls in the first row, angles of view in the second
uniform sampler2D grid;
float theta_of(int k) {{ return texelFetch(grid, ivec2(k, 1), 0).r; }}
float roll_of(int k) {{ return texelFetch(grid, ivec2(k, 0), 0).r; }}
"""
LOBE = """
uniform int rings, spokes, back;
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 side;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int k = at.y / rings, ring = at.y - k * rings, turned = k / THETAS;
  k -= turned * THETAS;
  vec3 view = texelFetch(grid, ivec2(k, 1), 0).rgb;
  float low = log(3.0e-4), high = log(40.0), step_ = (high - low) / float(rings);
  float t = exp(low + step_ * (float(ring) + 0.5)), hz = inversesqrt(1.0 + t * t);
  float phi = 2.0 * PI_ / float(spokes) * (float(at.x) + 0.5 + 0.618 * float(ring));
  vec3 h = vec3(t * hz * cos(phi), t * hz * sin(phi), hz), r = vec3(view.g, 0.0, view.b);
  float cd = dot(h, r);
  vec3 i = 2.0 * cd * h - r;
  light = side = vec4(0.0);
  if (cd <= 0.0 || i.z <= 1.0e-6) return;
  float weight = 4.0 * cd * t * t * hz * hz * hz * step_ * 2.0 * PI_ / float(spokes) * i.z;
  float q = 4.0 * cd * cd * dot(h.xy, h.xy), b = dot(r.xy - i.xy, r.xy - i.xy);
  if (back == 1) {
    weight *= b * b / max(q * q + b * b, 1.0e-30);
    if (turned == 1) { i.xy = -i.xy; float other = b; b = q; q = other; }
  }
  vec3 f = finite(i.z, r.z, q, dot(i.xy, r.xy), b);
  light = vec4(f * weight, r.x * i.z - r.z * i.x);
  side = vec4(i.y, 0.0, 0.0, 0.0);
}"""
TABLE = """
uniform int rings, spokes, back;
uniform sampler2D lights, sides;
out vec4 sum;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 roll = texelFetch(grid, ivec2(at.x, 0), 0).rgb;
  float s = roll.g, c = roll.b;
  vec3 total = vec3(0.0);
  for (int ring = 0; ring < rings * (1 + back); ring++) {
    int row = at.y * rings + (ring < rings ? ring : ring + rings * (THETAS - 1));
    vec3 part = vec3(0.0);
    for (int spoke = 0; spoke < spokes; spoke++) {
      vec4 light = texelFetch(lights, ivec2(spoke, row), 0);
      part += light.rgb * sky(s * light.a + c * texelFetch(sides, ivec2(spoke, row), 0).r);
    }
    total += part;
  }
  sum = vec4(total, 1.0);
}"""
PICTURE = """
uniform float size;
uniform int object;
uniform vec3 sun;
uniform sampler2D around;
out vec4 radiance;
float edge(float t, float span) {
  return clamp(t * span * size + 0.5, 0.0, 1.0) * clamp((1.0 - t) * span * size + 0.5, 0.0, 1.0);
}
vec3 law(vec3 i, vec3 n) {
  float ci = dot(n, i), cr = n.z;
  if (ci <= 0.0 || cr <= 0.0) return vec3(0.0);
  vec3 v = i + vec3(0.0, 0.0, 1.0), w = i - vec3(0.0, 0.0, 1.0);
  v -= n * dot(n, v);
  w -= n * dot(n, w);
  return finite(max(ci, 1.0e-6), max(cr, 1.0e-6), dot(v, v), i.z - ci * cr, dot(w, w)) * ci;
}
// atan of a driver may err by a thousandth; one step of Newton's mends it
float angle(float y, float x) {
  float a = atan(y, x);
  return a + (y * cos(a) - x * sin(a)) / max(length(vec2(x, y)), 1.0e-20);
}
vec3 reflected(vec3 n) {
  float theta = angle(length(n.xy), n.z), up = angle(n.y, abs(n.x));
  float s = 1.0 - pow(max(1.0 - theta / (0.5 * PI_), 0.0), 0.66666667);
  int k = clamp(int(s * float(THETAS - 1)), 0, THETAS - 2);
  if (theta < theta_of(k) && k > 0) k--;
  if (theta > theta_of(k + 1) && k < THETAS - 2) k++;
  float a = clamp((theta - theta_of(k)) / (theta_of(k + 1) - theta_of(k)), 0.0, 1.0);
  int m = clamp(int((asinh(up / (0.5 * PI_) * SINH6) / 6.0 + 1.0) * 0.5 * float(ROLLS - 1)), 0, ROLLS - 2);
  if (up < roll_of(m) && m > 0) m--;
  if (up > roll_of(m + 1) && m < ROLLS - 2) m++;
  float b = clamp((up - roll_of(m)) / (roll_of(m + 1) - roll_of(m)), 0.0, 1.0);
  vec3 one = mix(texelFetch(around, ivec2(m, k), 0).rgb, texelFetch(around, ivec2(m + 1, k), 0).rgb, b);
  vec3 two = mix(texelFetch(around, ivec2(m, k + 1), 0).rgb, texelFetch(around, ivec2(m + 1, k + 1), 0).rgb, b);
  return mix(one, two, a);
}
vec3 of_sun(vec3 n) {
  vec3 to = 2.0 * n.z * n - vec3(0.0, 0.0, 1.0);
  float apart = length(to - sun), far = 2.0 * sin(4.0 * SUN_RADIUS);
  if (apart >= far) return SUN * law(sun, n);
  vec3 across = normalize(cross(sun, vec3(0.0, 1.0, 0.0))), other = cross(across, sun), total = vec3(0.0);
  for (int k = 0; k < 91; k++) {
    float turn = 2.399963 * float(k), off = SUN_RADIUS * sqrt((float(k) + 0.5) / 91.0);
    total += law(normalize(sun + off * (cos(turn) * across + sin(turn) * other)), n);
  }
  return SUN * total / 91.0;
}
vec3 of_mirror(vec3 n) {
  vec3 to = 2.0 * n.z * n - vec3(0.0, 0.0, 1.0);
  vec3 disc = length(to - sun) < 2.0 * sin(0.5 * SUN_RADIUS) ? SUN / (PI_ * SUN_RADIUS * SUN_RADIUS) : vec3(0.0);
  return mirror(clamp(n.z, 1.0e-6, 1.0)) * (sky(to.y) + disc);
}
void main() {
  float x = gl_FragCoord.x / size, y = gl_FragCoord.y / size;
  float radius = object == 0 ? 0.29 : 0.46, centre = object == 0 ? 0.66 : 0.5;
  vec2 s = vec2(x - 0.5, y - centre) / radius;
  float rim = length(s), covered = clamp((1.0 - rim) * radius * size + 0.5, 0.0, 1.0);
  s *= min(1.0, 0.9999 / max(rim, 1.0e-9));
  vec3 n = vec3(s, sqrt(max(1.0 - dot(s, s), 0.0)));
  if (object == 0 && covered == 0.0) {
    float u = (x - 0.08) / 0.84, v = (y - 0.05) / 0.24;
    float tilt = radians(-12.0 + 100.0 * clamp(v, 0.0, 1.0)), bend = radians(50.0 * (u - 0.5));
    n = vec3(sin(bend) * cos(tilt), sin(tilt), cos(bend) * cos(tilt));
    covered = edge(u, 0.84) * edge(v, 0.24);
  }
  vec3 behind = sky(0.9 * (y - 0.66));
  vec3 lit = covered > 0.0 ? reflected(n) + of_sun(n) + of_mirror(n) : vec3(0.0);
  radiance = vec4(mix(behind, lit, covered), 1.0);
}"""
SHOW = f"""
uniform sampler2D one, two;
uniform float wipe;
uniform int mode;
out vec4 colour;
vec3 tone(vec3 radiance) {{
  vec3 x = max(radiance, 0.0) * {render.EXPOSURE};
  x = mix(x, 1.0 - 0.25 / max(x, 0.5), step(0.5, x));
  return mix(12.92 * x, 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}}
float seen(vec3 radiance) {{
  return log(clamp({render.EXPOSURE} * dot(max(radiance, 0.0), vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.5) + 0.002);
}}
void main() {{
  ivec2 at = ivec2(gl_FragCoord.xy * float(textureSize(one, 0).x) / width);
  vec3 a = texelFetch(one, at, 0).rgb, b = texelFetch(two, at, 0).rgb;
  if (mode == 1) {{
    float jnd = clamp((seen(b) - seen(a)) / log(1.02) / 20.0, -1.0, 1.0);
    vec3 full = jnd > 0.0 ? vec3(0.84, 0.37, 0.0) : vec3(0.0, 0.45, 0.7);
    colour = vec4(mix(vec3(0.96), full, abs(jnd)), 1.0);
    return;
  }}
  colour = vec4(tone(gl_FragCoord.x < wipe * width ? a : b), 1.0);
  if (wipe > 0.0 && wipe < 1.0 && abs(gl_FragCoord.x - wipe * width) < 1.0) colour = vec4(1.0);
}}"""


SIGNS = re.compile(r"(?<! ) *([=+*/<>(),;{}?:&|]|(?<!-)-(?!-)) *")


def unindented(text: str) -> str:
    """Without indentation and lines of comment: GLSL, JavaScript and CSS need neither."""
    lines = (line.strip() for line in text.split("\n"))
    return "\n".join(line for line in lines if line and not line.startswith("//"))


def squeezed(text: str) -> str:
    """Without spaces about signs, in text that holds no strings."""
    return closed_up(SIGNS, unindented(text))


def closed_up(signs: re.Pattern, text: str) -> str:
    """Without spaces about signs; twice, since of two signs with a space between them the second is passed over."""
    return signs.sub(r"\1", signs.sub(r"\1", text))


def sources() -> dict[str, str]:
    """The shaders by name: `head` before each, `world` where `WORLD` is, and a law, as `exporters.live` writes it, for
    `LAW`.
    """
    texts = {
        "head": HEAD,
        "world": WORLD,
        "flat": FLAT,
        "table": "WORLD\n" + TABLE,
        "show": "uniform float width;\n" + SHOW,
        "lobe": "WORLD\nLAW\n" + LOBE,
        "picture": f"WORLD\nconst float SINH6 = {np.sinh(6):.9g};\nLAW\n" + PICTURE,
    }
    return {name: squeezed(text) + "\n" for name, text in texts.items()}
