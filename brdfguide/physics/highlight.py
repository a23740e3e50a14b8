"""Roughness from the width of a highlight, while a small lamp moves over a flat sample and the eye stays.

The lobe's half width at half height, in the angle from normal to half vector, is for small alpha

    tan θ½ = alpha √(√2 - 1)   (GGX)        tan θ½ = alpha √(ln 2)   (Beckmann)

from D ∝ 1/(1 + tan²θ/alpha²)² and exp(-tan²θ/alpha²) (Walter et al. 2007, Eqs. 25 and 33), and the lamp moves by twice
the angle that the half vector does.
"""

from math import log, radians, sqrt, tan

from ..errors import InputError

GGX = sqrt(sqrt(2) - 1)  # 0.644
BECKMANN = sqrt(log(2))  # 0.833
WIDEST_DEG = 90.0  # of the lamp; beyond, no lobe of these laws is half as high


def alphas_of_half_width(lamp_deg: float) -> dict[str, float]:
    """GGX's and Beckmann's alpha for a highlight that is half as bright once the lamp has moved by `lamp_deg`.

    Raises InputError outside 0 to 90 degrees.
    """
    if not 0 < lamp_deg <= WIDEST_DEG:
        raise InputError(
            f"--highlight-half-width {lamp_deg:g}: wanted an angle of the lamp above 0 and up to 90 degrees"
        )
    width = tan(radians(lamp_deg / 2))
    return {"ggx": width / GGX, "beckmann": width / BECKMANN}
