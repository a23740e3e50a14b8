"""Roughness from the width of a highlight, as a document."""

from ...physics.highlight import alphas_of_half_width
from .findings import remark_on

TILTED = "subtract the body's light first; Fresnel, shadowing and the cosines tilt the profile, by some 7 % of alpha"


def highlight_document(lamp_deg: float) -> dict:
    """Both alphas of a half width [deg of the lamp]. Raises InputError outside 0 to 90 degrees."""
    return {
        "schema": "brdfguide/roughness-highlight/1",
        "half_width_deg": lamp_deg,
        "half_vector_deg": lamp_deg / 2,
        "alpha": alphas_of_half_width(lamp_deg),
        "warnings": [remark_on("highlight-tilted", TILTED)],
    }
