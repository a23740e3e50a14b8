"""Phong's lobe about the mirror direction, his radiance read as a BRDF.

    f = ks cosⁿα / cos θi,   α from the mirror direction to the detector; 0 where α >= 90°

Phong's shade is a radiance for unit light, so as a BRDF it carries 1/cos θi (Westin et al. 2004, section 4.1).
That makes the lobe grow toward grazing, and makes it neither reciprocal nor bounded in energy. It reproduces
lobes that lie below a surface, as in metallic paint (section 4.5), and fails on rough dielectrics.

Source: Phong 1975, "Illumination for computer generated pictures".
"""

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, ks, exponent) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return ks * np.where(geom.in_front, np.exp(exponent * geom.ln_cos_m), 0.0) / geom.cos_i


def gradient(geom: Geometry, names, *, ks, exponent) -> dict[str, np.ndarray]:
    """df/dn = f ln cos α."""
    lobe = brdf(geom, ks=1.0, exponent=exponent)
    return {"ks": lobe, "exponent": ks * lobe * geom.ln_cos_m}


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter(
            "ks",
            0.5,
            0.0,
            1e6,
            unit="1/sr",
            linear=True,
            per_channel=True,
            meaning="height of the lobe at normal incidence",
        ),
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
    summary="cheap, fixed growth toward grazing, not reciprocal: lobes from below the surface, metallic paint",
    pins=(
        Pin(at(45, 50), {"ks": 0.3, "exponent": 33.0}, f=0.37410689376486643, source="50 digits"),
        Pin(at(70, 10), {"ks": 1.7, "exponent": 2.5}, f=0.87866281524281359, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"exponent": 1e6}),
        Extreme("behind the lobe: negative base", at(60, -60), {"exponent": 3.7}, f=0.0),
        Extreme("lobe underflows", at(10, -70), {"exponent": 1e6}, f=0.0),
    ),
    breaks={
        "reciprocity": "divides by cos θi alone",
        "energy": "1/cos θi sends without bound toward grazing: 1.5 at 85° and 5.3 at 89° for n = 20",
    },
    source="Phong 1975",
    family="Phong",
    about_mirror=True,
    cannot="sends back more light than it gets toward grazing, another share with light and eye exchanged",
    candidacy=Candidacy(10),
    from_facets=lambda facets: {"ks": facets.peak, "exponent": facets.mirror_exponent},
    formula=Formula(
        "phong(ci, cr, q, {ks}, {exponent})",
        (("phong", "ci, cr, q, ks, n", "ks * mirror_lobe(off2(ci, cr, q), n) / ci"),),
    ),
)
