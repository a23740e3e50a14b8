"""GGX facets with a grain: what it is without one, where its streak lies, and that targets which cannot turn say so."""

import numpy as np
import pytest

from brdfguide import exporters, models
from brdfguide.audit.trials import trial_directions
from brdfguide.errors import NoAnswer
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.physics.geometry import Geometry

ANISO, GGX = models.term("ggx-aniso"), models.term("ggx")


@pytest.mark.parametrize("alpha", [1e-3, 0.05, 0.4, 1.5])
def test_with_both_widths_alike_it_is_ggx_for_any_axis(alpha):
    geom = trial_directions(41)
    for axis in (0.0, 1.3):
        ours = ANISO(geom, alpha_x=alpha, alpha_y=alpha, axis=axis, n=1.7, k=0.4)
        np.testing.assert_allclose(ours, GGX(geom, alpha=alpha, n=1.7, k=0.4), rtol=2e-13)


def test_its_streak_lies_along_the_axis_and_turns_with_it():
    geom = Geometry.from_degrees(0.0, 0.0, 30.0, np.array([25.0, 205.0, 115.0]))
    along, back, across = ANISO(geom, alpha_x=0.3, alpha_y=0.05, axis=np.radians(25.0))
    assert along == pytest.approx(back, rel=1e-12) and along > 100 * across
    turned = Geometry.from_degrees(0.0, 0.0, 30.0, np.array([65.0, 245.0, 155.0]))
    again = ANISO(turned, alpha_x=0.3, alpha_y=0.05, axis=np.radians(65.0))
    np.testing.assert_allclose(again, [along, back, across], rtol=1e-12)


def test_on_the_grain_the_peak_is_as_high_as_that_of_the_mean_width():
    geom = Geometry.from_degrees(20.0, 70.0, 20.0, 250.0)
    grained = float(ANISO(geom, alpha_x=0.2, alpha_y=0.05, axis=0.3))
    assert grained == pytest.approx(float(GGX(geom, alpha=0.1)), rel=0.01)


def test_under_a_coat_too_a_target_without_a_grain_refuses_it():
    for name in ("ggx-aniso", "coated:ggx-aniso"):
        surface = ColouredSurface(models.get(name), {"ggx-aniso.alpha_y": 0.05})
        with pytest.raises(NoAnswer, match="ggx-aniso changes as the sample turns: it has a grain"):
            exporters.export("lighttools", surface)
