"""Values at points where straightforward double precision fails, for `check`; computed at 400 digits.

The points are rows of references.csv, which `python -m tests.models.stiff` prints. QUANTITIES says which of our
functions a value belongs to, as quantity(geometry, values); the others are the BRDF of the model that is named.
"""

import csv
from pathlib import Path

from ..models import lafortune, oren_nayar, term
from ..physics import fresnel, microfacet
from ..physics.geometry import Geometry
from ..records import dataclass

RTOL = 1e-12  # ours come within 1e-14
TABLE = Path(__file__).with_name("references.csv")


@dataclass(frozen=True)
class Reference:
    """One value: of what, where [deg], with which parameters."""

    model: str
    quantity: str
    angles: tuple[float, float, float, float]  # theta_i, phi_i, theta_r, phi_r
    values: dict[str, float]
    right: float
    why: str

    @property
    def geom(self) -> Geometry:
        return Geometry.from_degrees(*self.angles)


QUANTITIES = {
    "fresnel": lambda geom, v: fresnel.fresnel(geom.cos_i, **v),
    "one_minus_fresnel": lambda geom, v: fresnel.one_minus_fresnel(geom.cos_i, **v),
    "index_from_f0": lambda geom, v: fresnel.index_from_f0(**v),
    "index_minus_one": lambda geom, v: fresnel.index_minus_one(**v),
    "davies_ln": lambda geom, v: fresnel.davies_ln(1.0, geom.cos_i, **v),
    "davies_scattered": lambda geom, v: fresnel.davies_scattered(1.0, geom.cos_i, **v),
    "lafortune_lobe": lambda geom, v: lafortune.lobe(geom, **v),
    "lafortune_lobe_ln": lambda geom, v: lafortune.lobe_ln(geom, **v),
    "oren_nayar_qualitative": lambda geom, v: oren_nayar.qualitative(geom, **v),
    "ggx_distribution": lambda geom, v: microfacet.ggx(geom, **v),
    "beckmann_distribution": lambda geom, v: microfacet.beckmann(geom, **v),
}


def our_value(reference: Reference, model=None) -> float:
    """Our value there; of `model` where the quantity is a BRDF."""
    of_quantity = QUANTITIES.get(reference.quantity)
    if of_quantity is not None:
        return float(of_quantity(reference.geom, reference.values))
    return float((model or term(reference.model))(reference.geom, **reference.values))


def _rows():
    with TABLE.open(newline="") as file:
        for model, quantity, *numbers, values, right, why in list(csv.reader(file))[1:]:
            theta_i, phi_i, theta_r, phi_r = map(float, numbers)
            pairs = (word.split("=") for word in values.split())
            named = {name: float(value) for name, value in pairs}
            yield Reference(model, quantity, (theta_i, phi_i, theta_r, phi_r), named, float(right), why)


REFERENCES = tuple(_rows())
