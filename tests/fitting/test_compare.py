"""Through as many values as parameters any model goes: no such fit is ranked, and none alone is an answer."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.errors import NoAnswer
from brdfguide.fitting.compare import compare
from brdfguide.fitting.fit import FitOptions
from brdfguide.models import candidates
from brdfguide.physics.geometry import in_plane, rows


def measured(count: int, missing: int = 0, channels: int = 1) -> Measurement:
    """Values of a rough paint at some angles, the first of them missing."""
    geom = rows(in_plane(30.0, np.linspace(-20, 60, count)[:, None]))
    value = models.get("lambertian+ggx")(geom, {"ggx.alpha": 0.3}) * np.linspace(1, 1.05, count)[:, None]
    value[:missing] = np.nan
    names = tuple(f"c{channel}" for channel in range(channels))
    um = np.linspace(0.5, 0.6, channels)
    return Measurement(geom.at(um), np.repeat(value, channels, axis=1), names, name="few.csv")


@pytest.mark.parametrize("count, missing", [(1, 0), (2, 0), (30, 29)])
def test_no_more_values_than_parameters_is_no_answer(count, missing):
    with pytest.raises(NoAnswer, match="usable values?, and the models have at least 2 free parameters"):
        compare(measured(count, missing), candidates.of_kind(None, None))


def test_models_with_as_many_parameters_are_left_out_and_named():
    ranked = compare(measured(4), candidates.of_kind(None, None))
    assert max(row.fit.free for row in ranked.rows) == 3
    (note,) = (each for each in ranked.warnings if each.code == "few-values")
    assert "4 usable values" in note.text and "lafortune:2" in note.text and "lambertian+ggx," not in note.text


def test_values_of_every_channel_count_and_so_do_its_parameters():
    model = models.get("lambertian+ggx")  # alpha for all, albedo and n for each channel
    with pytest.raises(NoAnswer, match="6 usable values, and the models have at least 7 free parameters"):
        compare(measured(2, channels=3), [model])
    assert compare(measured(3, channels=3), [model]).rows[0].fit.free == 7


def test_held_parameters_are_not_free():
    model, options = models.get("lambertian+ggx"), FitOptions(fixed={"ggx.alpha": 0.3, "ggx.n": 1.5})
    assert compare(measured(2), [model], options).rows[0].fit.free == 1
    with pytest.raises(NoAnswer, match="1 usable value, and the models have at least 1 free parameter:"):
        compare(measured(1), [model], options)


def test_enough_values_leave_nothing_out():
    ranked = compare(measured(40), candidates.of_kind(None, ("lambertian+ggx",)))
    assert "few-values" not in [each.code for each in ranked.warnings]
