"""Lewis's Phong lobe: without 1/cos θi, reciprocal and bounded in energy.

    f = ks (n + 2)/(2π) cosⁿα,   α from the mirror direction to the detector; 0 where α >= 90°

ks is the share of light sent into the lobe at normal incidence, and the most it sends anywhere. The lobe does not
grow toward grazing at all, so it darkens there: for coats and for lobes seen through a smooth interface.

Source: Lewis 1993, "Making shaders more physically plausible".
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, ks, exponent) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return ks * (exponent + 2) / (2 * pi) * np.where(geom.in_front, np.exp(exponent * geom.ln_cos_m), 0.0)


def gradient(geom: Geometry, names, *, ks, exponent) -> dict[str, np.ndarray]:
    """df/dn = f (ln cos α + 1/(n + 2))."""
    lobe = brdf(geom, ks=1.0, exponent=exponent)
    return {"ks": lobe, "exponent": ks * lobe * (geom.ln_cos_m + 1 / (exponent + 2))}


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter("ks", 0.1, 0.0, 1.0, linear=True, per_channel=True, meaning="share of the light sent into the lobe"),
        Parameter(
            "exponent",
            20.0,
            0.1,
            1e6,
            log=True,
            meaning="n: the lobe halves at acos(0.5^(1/n)) from the mirror",
            starts=(3.0, 10.0, 50.0, 300.0, 3000.0),
        ),
    ),
    gradient=gradient,
    summary="cheap, reciprocal, no growth toward grazing: coats, flakes below a coat",
    pins=(
        Pin(at(45, 50), {"ks": 0.3, "exponent": 33.0}, f=1.4735636144397104, source="50 digits"),
        Pin(at(70, 10), {"ks": 0.7, "exponent": 2.5}, f=0.088624887371715123, source="50 digits"),
    ),
    extremes=(
        Extreme(
            "narrowest lobe, 0.01° from grazing",
            at(89.99, 89.99),
            {"ks": 1.0, "exponent": 1e6},
            f=159155.26140178152,
        ),
        Extreme("behind the lobe: negative base", at(60, -60), {"exponent": 3.7}, f=0.0),
        Extreme("lobe underflows", at(10, -70), {"exponent": 1e6}, f=0.0),
    ),
    source="Lewis 1993",
    family="Phong",
    about_mirror=True,
    cannot="does not brighten toward grazing at all; shows no mirror image",
    candidacy=Candidacy(20, substitutes=True),
    from_facets=lambda facets: {"ks": facets.f0, "exponent": facets.mirror_exponent},
    formula=Formula(
        "phong_lewis(ci, cr, q, {ks}, {exponent})",
        (("phong_lewis", "ci, cr, q, ks, n", "ks * (n + 2.0) / (2.0 * PI) * mirror_lobe(off2(ci, cr, q), n)"),),
    ),
)
