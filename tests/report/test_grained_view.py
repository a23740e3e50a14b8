"""A grain in the preview: the streak of the sphere, the bow-ties of the disc, and no grain where there is none."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.report import grained_view, render

SIZE = 96


def brushed(**values):
    values = {"alpha_x": 0.35, "alpha_y": 0.06, "axis": 0.0, "n": 1.0, "k": 4.0, **values}
    return ColouredSurface(models.get("ggx-aniso"), {f"ggx-aniso.{name}": value for name, value in values.items()})


@pytest.fixture(autouse=True)
def small_tables(monkeypatch):
    """Tables of a few angles: it is the frames that are tested."""
    for name, count in (("TURNS", 6), ("THETAS", 14), ("ROLLS", 31)):
        monkeypatch.setattr(grained_view, name, count)


@pytest.fixture(scope="module")
def sunlit():
    """What the sun alone makes of it, where it covers: (view, (height, width) radiance)."""
    canvas = grained_view.grained_view(SIZE)
    on = canvas.covered > 0.99
    surface = brushed()
    frame = grained_view.frames(surface, canvas.normal[on], canvas.across[on])
    found = np.full(on.shape, np.nan)
    found[on] = render.sun_of(surface, canvas.normal[on], render.sun_direction("front"), frame)[:, 1]
    return canvas, found


def test_the_highlight_of_the_sphere_is_a_streak_along_a_meridian(sunlit):
    _, radiance = sunlit
    y, x = np.mgrid[0:SIZE, 0:SIZE] / SIZE
    bright = (radiance > 0.3 * np.nanmax(radiance)) & (x < 0.5) & (y < 0.55)
    assert np.ptp(y[bright]) > 2.5 * np.ptp(x[bright])


def test_the_disc_shows_two_bow_ties(sunlit):
    _, radiance = sunlit
    y, x = np.mgrid[0:SIZE, 0:SIZE] / SIZE
    turn = np.arctan2(y - 0.32, x - 0.745)
    disc = (x > 0.5) & (y < 0.55) & np.isfinite(radiance)
    sectors = np.array([np.mean(radiance[disc & (np.round(turn / (np.pi / 6)) == each)]) for each in range(-5, 6)])
    bright = sectors > 0.5 * sectors.max()
    assert 2 <= bright.sum() <= 6 and np.min(sectors) < 0.1 * sectors.max()
    opposite = np.mean([bright[k] == bright[(k + 6) % 11] for k in range(5)])
    assert opposite > 0.5


def test_the_axis_of_the_surface_turns_with_its_frame():
    """Wherever the sample's azimuth 0 lies, the axis lies across the grooves: the same picture."""
    images = [render.render(brushed(axis=axis), 64, "front") for axis in (0.0, 1.0)]
    np.testing.assert_allclose(images[0], images[1], rtol=0.2, atol=0.05)


def test_a_grain_of_ratio_one_looks_as_its_parent_does():
    canvas = grained_view.grained_view(64)
    on = canvas.covered > 0.99
    round_one = brushed(alpha_x=0.2, alpha_y=0.2)
    frame = grained_view.frames(round_one, canvas.normal[on], canvas.across[on])
    parent = ColouredSurface(models.get("ggx"), {"ggx.alpha": 0.2, "ggx.n": 1.0, "ggx.k": 4.0})
    sun = render.sun_direction("side")
    ours = render.sun_of(round_one, canvas.normal[on], sun, frame)
    theirs = render.sun_of(parent, canvas.normal[on], sun)
    np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(
        render._around_grain(round_one, canvas.normal[on], frame),
        render.around_of(parent, canvas.normal[on]),
        rtol=0.1,
        atol=0.02,
    )


def test_only_what_turns_is_drawn_with_a_grain():
    assert grained_view.has_grain(brushed())
    assert not grained_view.has_grain(ColouredSurface(models.get("ggx"), {}))
