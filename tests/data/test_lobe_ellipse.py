"""The ellipse of a lobe is looked for in its brightest directions alone."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.lobe_ellipse import lobe_ellipse
from brdfguide.data.measurement import Measurement
from brdfguide.physics.geometry import Geometry, rows


def test_the_ellipse_of_a_round_lobe_is_round_and_forms_no_azimuths_of_all_directions():
    """Of a million directions they would stay as long as the measurement."""
    grid = np.meshgrid([10.0, 25, 40, 55], np.arange(1, 80, 3.0), np.arange(120, 241, 8.0))
    geom = rows(Geometry.from_degrees(grid[0].ravel(), 0.0, grid[1].ravel(), grid[2].ravel()))
    measurement = Measurement(geom, models.get("ggx")(geom, {"ggx.alpha": 0.2}))
    ellipse = lobe_ellipse(measurement)
    assert ellipse.incidences == 4 and ellipse.ratio == pytest.approx(1.0, abs=0.1)
    assert not {"v_xy", "cos_cos", "ln_sec2_h"} & vars(geom.directions).keys()
