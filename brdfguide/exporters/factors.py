"""Free factors as tables: any model as a body and a lobe of three one-dimensional factors, JSON with GLSL beside it.

    f = ρ/π + exp(d(u) + e(θd) + g(θi) + g(θr)),   u = asinh(tan θh/s)/asinh(tan 1.5/s)

d has 64 values over u in 0..1, e 32 in each colour over θd/90°, g 32 over θ/90°, straight lines between them; ρ is
linear sRGB. It costs what four looks into tables cost. The JSON also holds the cumulative of the lobe's tilt, after
which half vectors may be drawn: ∫ e^d sin θ cos θ dθ, 0 to 1 over the same u. An ideal mirror has no place in it.

Source: Bagher, Snyder and Nowrouzezahrai 2016, "A non-parametric factor microfacet model for isotropic BRDFs".
"""

import json
from math import pi

import numpy as np

from ..bases import factored, smooth
from ..physics.directions import Directions
from ..physics.geometry import Geometry, rows
from ..printable import identifier
from ..records import dataclass
from ._directions import half_width, judged_over, rms_ln
from ._shown import seen_of
from .exporter import ColouredSurface, Export, Exporter, Statement, comment_lines, numbers, refuse_mirror, status_of

TILTS, DIFFERENCES, ANGLES = 64, 32, 32  # values of each table
DIRECTIONS = 6000
HIGHEST_DIFFERENCE = np.radians(88.0)
# what a Gaussian lobe has far out counts as this: of the brightest value, and 1/sr, below what is a body beside a peak
# of a million
DARK, DARKEST = 1e-6, 1e-4
LOWEST_COS = 0.02  # of light and view
ALPHA_PER_HALF_WIDTH = 1.55  # of GGX: 1/√(√2 - 1)
NARROWER = 3.0  # times than alpha that s is
LEAST_LN, MOST_LN = -80.0, 80.0
PHI = 1.2207440846  # of an additive sequence in three dimensions (Roberts 2018)


@dataclass(frozen=True, eq=False)
class Tables:
    """What the files hold."""

    albedo: np.ndarray  # (3,)
    tilt: np.ndarray  # (TILTS,)
    difference: np.ndarray  # (DIFFERENCES, 3)
    angle: np.ndarray  # (ANGLES,)
    scale: float

    @classmethod
    def of(cls, found: factored.Factors) -> "Tables":
        """The factors at even steps, rounded as they are written."""
        tan_h = np.sinh(np.linspace(0, 1, TILTS) * np.arcsinh(np.tan(smooth.STEEPEST) / found.scale)) * found.scale
        right = np.linspace(0, pi / 2, DIFFERENCES), np.linspace(0, pi / 2, ANGLES)
        return cls(
            _rounded(found.albedo, 0.0, 1e3, "albedo"),
            _rounded(found.ln_of_tilt(tan_h), LEAST_LN, MOST_LN, "ln of the tilt's factor"),
            _rounded(found.ln_of_difference(right[0]), LEAST_LN, MOST_LN, "ln of the difference's factor"),
            _rounded(found.ln_of_angle(right[1]), LEAST_LN, MOST_LN, "ln of the angle's factor"),
            found.scale,
        )

    def __call__(self, geom: Geometry) -> np.ndarray:
        """What a reader of the tables has, (samples, 3) [1/sr]."""
        angles = (np.arctan2(np.ravel(sin), np.ravel(cos)) for sin, cos in _angles(geom))
        ln = _between(self.tilt, smooth.tilt_coordinate(geom, self.scale)) + sum(
            _between(self.angle, angle / (pi / 2)) for angle in angles
        )
        difference = smooth.difference_coordinate(geom)
        lobes = [np.exp(ln + _between(self.difference[:, colour], difference)) for colour in range(3)]
        return self.albedo / pi + np.stack(lobes, axis=1)

    @property
    def cumulative(self) -> np.ndarray:
        """Share of the lobe's half vectors up to each tilt, (TILTS,)."""
        theta = np.arctan(
            np.sinh(np.linspace(0, 1, TILTS) * np.arcsinh(np.tan(smooth.STEEPEST) / self.scale)) * self.scale
        )
        density = np.exp(self.tilt - self.tilt.max()) * np.sin(theta) * np.cos(theta)
        steps = 0.5 * (density[1:] + density[:-1]) * np.diff(theta)
        return np.concatenate([[0.0], np.cumsum(steps) / steps.sum()])


def _angles(geom: Geometry):
    return (geom.sin_i, geom.cos_i), (geom.sin_r, geom.cos_r)


def _rounded(values, low: float, high: float, what: str) -> np.ndarray:
    """As nine digits hold them, within what a reader expects."""
    return np.reshape(numbers(np.clip(values, low, high), low, high, what), np.shape(values))


def _between(table: np.ndarray, x) -> np.ndarray:
    """Straight lines between the values of a table over 0..1."""
    return np.interp(np.ravel(x), np.linspace(0, 1, len(table)), table)


def tables_of(surface: ColouredSurface) -> Tables:
    """The tables closest to a surface, at half vectors as dense as its lobe is narrow."""
    alpha = np.tan(np.radians(0.5 * half_width(surface))) * ALPHA_PER_HALF_WIDTH
    scale = float(min(smooth.SCALE, alpha / NARROWER))
    x, y, z = (np.arange(1, DIRECTIONS + 1)[:, None] * PHI ** -np.arange(1.0, 4.0) % 1).T
    theta_h = np.arctan(np.sinh(x * np.arcsinh(np.tan(smooth.STEEPEST) / scale)) * scale)
    directions = Directions.from_half_difference(theta_h, HIGHEST_DIFFERENCE * y, pi * z)
    geom = rows(Geometry(directions))
    geom = geom[(geom.cos_i[:, 0] > LOWEST_COS) & (geom.cos_r[:, 0] > LOWEST_COS)]
    both = 0.5 * (surface.rgb(geom) + surface.rgb(geom.swapped()))
    value = np.maximum(both, min(DARK * both.max(), DARKEST))
    return Tables.of(factored.fit_factors(factored.Columns(geom, scale), np.log(value)))


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """JSON with the tables, GLSL beside it, and the Statement."""
    lost = refuse_mirror(surface, "factors")
    one_way = any("reciprocity" in term.model.breaks for term in surface.model.terms)
    lost += ("light and view, which this law does not exchange freely, are averaged",) if one_way else ()
    judged, wanted, over = judged_over(surface, geom)  # refuses a black surface, whose logarithm no table holds
    tables = tables_of(surface)
    error = rms_ln(tables(judged), wanted)
    written = {"tilt": TILTS, "difference": 3 * DIFFERENCES, "angle": ANGLES, "albedo": tables.albedo.tolist()}
    statement = Statement(
        "factors", status_of(error, lost), error, len(judged), over, written, lost,
        ("d, e and g may exchange constants: only their sum is the lobe",), surface.colour.how,
        seen_of(surface, tables), tables,
    )  # fmt: skip
    comment = comment_lines(surface, statement)
    return Export(_json(tables, comment), statement, {f"{stem}.glsl": _glsl(tables, identifier(surface.name), comment)})


def _json(tables: Tables, comment: list[str]) -> str:
    document = {
        "schema": "brdfguide/factors/1",
        "comment": comment,
        "formula": "albedo/pi + exp(tilt(u) + difference(theta_d/90) + angle(theta_i/90) + angle(theta_r/90))",
        "u": "asinh(tan(theta_h)/scale)/asinh(tan(1.5)/scale)",
        "scale": tables.scale,
        "albedo": tables.albedo.tolist(),
        "tilt": tables.tilt.tolist(),
        "difference": tables.difference.T.tolist(),
        "angle": tables.angle.tolist(),
        "tilt_cumulative": [float(f"{each:.9g}") for each in tables.cumulative],
    }
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def _glsl(tables: Tables, name: str, comment: list[str]) -> str:
    """`vec3 NAME_brdf(L, V, N)` [1/sr], from GLSL 1.30 and ES 3.0 on; unit vectors, no cosine included."""
    arrays = {
        "tilt": tables.tilt,
        "angle": tables.angle,
        **{f"difference_{colour}": tables.difference[:, place] for place, colour in enumerate("rgb")},
    }
    head = "\n".join("// " + line for line in comment)
    looks = "\n".join(_array(f"{name}_{key}", values) for key, values in arrays.items())
    steepest = float(np.tan(smooth.STEEPEST))
    albedo = ", ".join(f"{each:.9g}" if "." in f"{each:.9g}" else f"{each:.1f}" for each in tables.albedo / pi)
    return f"""{head}

{looks}

vec3 {name}_brdf(vec3 L, vec3 V, vec3 N)
{{
    float ci = dot(N, L), cr = dot(N, V);
    if (ci <= 0.0 || cr <= 0.0) return vec3(0.0);
    vec3 l = L - ci * N, v = V - cr * N;
    float q = dot(l + v, l + v), s = ci + cr;
    float u = asinh(min(sqrt(q) / s, {steepest:.9g}) / {tables.scale:.9g}) / {np.arcsinh(steepest / tables.scale):.9g};
    float d = acos(min(0.5 * sqrt(s * s + q), 1.0)) / 1.57079633;
    float lobe = {name}_tilt_at(u) + {name}_angle_at(acos(min(ci, 1.0)) / 1.57079633)
        + {name}_angle_at(acos(min(cr, 1.0)) / 1.57079633);
    vec3 own = vec3({name}_difference_r_at(d), {name}_difference_g_at(d), {name}_difference_b_at(d));
    return vec3({albedo}) + exp(vec3(lobe) + own);
}}
"""


def _array(name: str, values: np.ndarray) -> str:
    """A table and the function that looks into it."""
    last = len(values) - 1
    texts = ", ".join(text if set(text) & set(".e") else f"{text}.0" for text in (f"{each:.9g}" for each in values))
    return f"""const float {name}[{last + 1}] = float[{last + 1}]({texts});
float {name}_at(float x)
{{
    float y = clamp(x, 0.0, 1.0) * {last}.0;
    int i = min(int(y), {last - 1});
    return mix({name}[i], {name}[i + 1], y - float(i));
}}"""


EXPORTER = Exporter(
    __name__, ".json", "three one-dimensional tables a colour and GLSL that reads them, any model", export
)
