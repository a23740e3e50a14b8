"""One generalised cosine lobe of Lafortune, isotropic; several of them are added as `lafortune:2`.

    f = ks max(0, c_xy (i_xy · r_xy) + c_z cos θi cos θr)^n
    (c_xy, c_z) = (-sin t, cos t) / m,   m = cos t for |t| < 45°, else |sin t|;   t is the tilt

Only the direction of (c_xy, c_z) shapes a lobe; its length is left to ks, so that ks is the greatest value of the
lobe and no exponent overflows. A tilt of 45° is Phong's mirror lobe; more makes it rise toward grazing and peak off
the mirror direction, beyond 90° with c_z < 0; less makes it a general diffuser, and a negative tilt sends light back
to where it came from. Two or three lobes follow almost any measurement (Westin et al. 2004, sections 4.2 to 4.5),
but nothing bounds their energy. `lobe` takes coefficients as papers print them.

Source: Lafortune et al. 1997, "Non-linear approximation of reflectance functions".
"""

from functools import lru_cache
from math import pi, sqrt

import numpy as np

from ..physics.geometry import Geometry
from .facts import MIRROR_DEG, Candidacy, Facets, Formula
from .model import Derived, Extreme, Model, Parameter, Pin, at

NARROWEST = 1e4  # exponent of a lobe: 1.35° wide at half height


def brdf(geom: Geometry, *, ks, tilt, exponent) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    above, ln_base = _ln_base(geom, *_coefficients(tilt))
    return ks * np.where(above, np.exp(exponent * ln_base), 0.0)


def gradient(geom: Geometry, names, *, ks, tilt, exponent) -> dict[str, np.ndarray]:
    """df/dn = f ln base; df/dt = f n (dbase/dt)/base, where base turns by -cos θi cos θr/(sin t |sin t|) or by
    -i_xy·r_xy/cos²t."""
    above, ln_base = _ln_base(geom, *_coefficients(tilt))
    lobe = np.where(above, np.exp(exponent * ln_base), 0.0)
    wide = np.abs(tilt) < pi / 4
    if not wide.any():
        sin = np.sin(tilt)
        turned = geom.cos_cos / -(sin * np.abs(sin))
    elif wide.all():
        turned = geom.dot_xy / -(np.cos(tilt) ** 2)
    else:
        sin, cos = np.where(wide, 1.0, np.sin(tilt)), np.cos(tilt)
        turned = np.where(wide, -geom.dot_xy / cos**2, -geom.cos_cos / (sin * np.abs(sin)))
    return {"ks": lobe, "tilt": lobe * turned * np.exp(-ln_base) * (ks * exponent), "exponent": lobe * ln_base * ks}


def c_xy(tilt):
    """Coefficient of the tangential dot product: -1, or -tan(tilt) within 45°."""
    return np.where(np.abs(tilt) < pi / 4, -np.tan(tilt), -np.sign(tilt))


def c_z(tilt):
    """Coefficient of cos θi cos θr: 1 within 45°, else cos(tilt)/|sin(tilt)|."""
    return np.where(
        np.abs(tilt) < pi / 4, 1.0, np.cos(tilt) / np.where(np.abs(tilt) < pi / 4, 1.0, np.abs(np.sin(tilt)))
    )


def _coefficients(tilt):
    """-c_xy - 1, c_xy and c_z + c_xy; the last from the angle off the mirror lobe, where the two cancel."""
    wide, sin = np.abs(tilt) < pi / 4, np.sin(tilt)
    if wide.any():
        xy, length = np.where(wide, -np.tan(tilt), -np.sign(tilt)), np.where(wide, np.cos(tilt), np.abs(sin))
    else:
        xy, length = -np.sign(tilt), np.abs(sin)
    return -xy - 1, xy, -sqrt(2) * np.sin(tilt - pi / 4) / length


def lobe_ln(geom: Geometry, c_xy, c_z, exponent):
    """ln of a lobe as published, (C_xy (i_xy·r_xy) + C_z cos θi cos θr)^n; -inf where the base is not positive."""
    above, ln_base = _ln_base(geom, -c_xy - 1, c_xy, c_z + c_xy)
    return np.where(above, exponent * ln_base, -np.inf)


def lobe(geom: Geometry, c_xy, c_z, exponent):
    """A lobe as published; 0 where the base is not positive, for any exponent."""
    return np.exp(lobe_ln(geom, c_xy, c_z, exponent))


def _ln_base(geom: Geometry, rest, c_xy, both):
    """Where the base is positive, and its logarithm (0 elsewhere).

    base - 1 = (-c_xy - 1) + ½ c_xy d² + (c_z + c_xy) cos θi cos θr,   d the chord from the mirror direction
    """
    excess = rest + (0.5 * c_xy) * geom.mirror_distance2 + both * geom.cos_cos
    above = excess > -1.0
    return above, np.log1p(np.where(above, excess, 0.0))


def from_facets(facets: Facets) -> dict:
    """The one lobe that grows toward grazing as the facets do, as near as it can."""
    exponent = min(facets.mirror_exponent, NARROWEST)
    tilt, height = _following(facets.growth, exponent)
    height *= exponent / facets.mirror_exponent  # the same light in a lobe that may be wider
    return {"ks": tuple(each * height for each in facets.peak), "tilt": tilt, "exponent": exponent}


@lru_cache(maxsize=256)
def _following(growth: tuple[float, ...], exponent: float) -> tuple[float, float]:
    """(tilt, ks over the peak at the normal) of the one lobe whose mirror values follow `growth` best in ln."""
    c2 = np.cos(np.radians(MIRROR_DEG)) ** 2
    tilt = np.radians(np.linspace(45.0, 85.0, 161))[:, None]
    ln_lobe = exponent * np.log(1 - c2 + c2 / np.tan(tilt))
    miss = np.log(growth) - ln_lobe
    best = int(np.argmin(np.var(miss, axis=1)))
    return float(tilt[best, 0]), float(np.exp(miss[best].mean()))


def beyond_facets(*, tilt, **_) -> str:
    """What one lobe of facets cannot hold of it."""
    return "a lobe back toward the light has no counterpart" if np.any(np.less(tilt, 0)) else ""


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter(
            "ks", 0.2, 0.0, 1e6, unit="1/sr", linear=True, per_channel=True, meaning="greatest value of the lobe"
        ),
        Parameter(
            "tilt",
            pi / 4,
            -1.5,
            0.9 * pi,
            unit="rad",
            meaning="45°: mirror lobe; more: rises toward grazing; negative: back to the light",
            starts=(0.1, pi / 4, 1.0, -pi / 4),
        ),
        Parameter(
            "exponent",
            10.0,
            0.3,
            NARROWEST,
            log=True,
            meaning="n: narrowness",
            starts=(1.0, 4.0, 20.0, 100.0, 600.0, 4000.0),
        ),
    ),
    gradient=gradient,
    derived=(
        Derived("c_xy", lambda ks, tilt, exponent: c_xy(tilt), meaning="coefficient of the tangential dot product"),
        Derived("c_z", lambda ks, tilt, exponent: c_z(tilt), meaning="coefficient of cos θi cos θr"),
    ),
    summary="flexible: off-specular peaks, growth toward grazing, retro-reflection; many numbers, energy unbounded",
    pins=(
        Pin(at(45, 50), {"ks": 0.3, "tilt": 0.9, "exponent": 33.0}, f=0.010107660475553459, source="50 digits"),
        Pin(at(70, -40), {"ks": 1.7, "tilt": -0.5, "exponent": 2.5}, f=0.45837377613889039, source="50 digits"),
    ),
    extremes=(
        Extreme(
            "mirror lobe, largest exponent, 0.01° from grazing",
            at(89.99, 89.99),
            {"ks": 0.2, "exponent": 1e4},
            f=0.2,
        ),
        Extreme("negative base", at(80, -70), {"exponent": 3.7}, f=0.0),
        Extreme("rising lobe, largest exponent: underflows", at(5, 5), {"tilt": 1.0, "exponent": 1e4}, f=0.0),
    ),
    breaks={"energy": "a lobe tilted beyond 45° rises toward grazing without a bound on what it sends"},
    source="Lafortune et al. 1997",
    family="Lafortune",
    about_mirror=True,
    cannot="nothing bounds its energy; it only follows a measurement, "
    "so its start values are a shape, not a prediction",
    candidacy=Candidacy(60, lobes=2),
    from_facets=from_facets,
    beyond_facets=beyond_facets,
    formula=Formula(
        "lafortune(ci, cr, q, {ks}, {exponent}, {rest}, {c_xy}, {both})",
        (
            ("lafortune2", "ks, n, less", "choose(1.0 - less, ks * exp(n * ln1m(less)), 0.0)"),
            (
                "lafortune",
                "ci, cr, q, ks, n, c1, c2, c3",
                "lafortune2(ks, n, -(c1 + 0.5 * c2 * off2(ci, cr, q) + c3 * ci * cr))",
            ),
        ),
        numbers=lambda *, tilt, **_: {
            "rest": -c_xy(tilt) - 1,
            "c_xy": c_xy(tilt),
            "both": c_z(tilt) + c_xy(tilt),
        },
    ),
)
