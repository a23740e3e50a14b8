"""Equal directions that were measured more than once: whether their values are those of one surface."""

import numpy as np

from ..finding import Finding
from ..flags import Effect
from .measurement import Measurement
from .noise import estimated_noise

REPEATED = 3.0  # times the scatter between neighbours, by which repeats of one surface differ at most (ours)
MOST_REPEATED = 0.4  # rms of ln by which they differ at most, however neighbours scatter: 50 % (ours)


def repeat_findings(m: Measurement):
    """Equal directions with unequal values, where neighbours differ by far less."""
    noted = next((each for each in m.findings if each.effect is Effect.OF_REPEATS), None)
    if noted is None or m.settled("repeats"):
        return
    spread, scatter = dict(noted.numbers)["rms_ln"], estimated_noise(m).relative or 0.0
    if spread <= min(REPEATED * scatter, MOST_REPEATED):
        return
    text = (
        f"equal directions have values that differ by {np.expm1(spread):.0%} (rms), and neighbours by {scatter:.2g}: "
        f"not one surface, or not all of the directions is said"
    )
    consequence = "no model can be right for both"
    yield Finding("equal-directions-differ", text, "outside", consequence, "--anyway", (("rms_ln", spread),))
