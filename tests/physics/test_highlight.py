"""The half width of a highlight and its alpha: against the laws' own profiles, and against what was measured."""

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.physics.highlight import alphas_of_half_width


@pytest.mark.parametrize("alpha", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("law", ["ggx", "beckmann"])
def test_the_facets_are_half_as_many_at_the_half_width(law, alpha):
    theta = np.linspace(0, np.radians(40), 200_001)
    tan2 = np.tan(theta) ** 2 / alpha**2
    profile = 1 / (1 + tan2) ** 2 if law == "ggx" else np.exp(-tan2)
    half = np.degrees(theta[np.argmax(profile < 0.5)])
    assert alphas_of_half_width(2 * half)[law] == pytest.approx(alpha, rel=1e-3)


def test_the_lamp_that_moves_by_7_9_degrees_says_alpha_0_107():
    assert alphas_of_half_width(7.9) == pytest.approx({"ggx": 0.1073, "beckmann": 0.0829}, abs=5e-4)


@pytest.mark.parametrize("angle", [0, -3, 91, float("nan")])
def test_what_is_no_half_width_is_refused(angle):
    with pytest.raises(InputError, match="above 0 and up to 90"):
        alphas_of_half_width(angle)
