"""Derivatives of ln f by ln of a surface's parameters."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting.layout import layout_of
from brdfguide.fitting.ln_slopes import ln_with_slopes

from .. import synthetic


def test_each_channel_is_derived_by_ln_of_its_own_value():
    model = models.get("lambertian+ggx")
    values = {**model.defaults(), "lambertian.albedo": np.array([0.02, 0.2, 0.8])}
    data = synthetic.surface(model, synthetic.scan(step=20.0), values, channels=3)
    layout = layout_of(model, 3)
    at = (*layout.shared, *layout.per_channel).index("lambertian.albedo")
    ln, slopes = ln_with_slopes(layout, synthetic.fitted(model, values, data), data.instrument)
    more = {**values, "lambertian.albedo": values["lambertian.albedo"] * 1.0001}
    there = ln_with_slopes(layout, synthetic.fitted(model, more, data), data.instrument)[0]
    assert slopes[:, :, at] == pytest.approx((there - ln) / np.log(1.0001), rel=1e-3, abs=1e-6)
