"""`verify`: standard errors of a sample that was turned, with what gains of its scans leave open."""

import json
from copy import deepcopy

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mpf

from brdfguide import models
from brdfguide.audit import exact_intervals, verification
from brdfguide.data.measurement import Measurement
from brdfguide.face.functions import fit
from brdfguide.physics.geometry import Geometry, rows


@pytest.fixture(scope="module", params=[(0.1, 1), (0.0, 1), (0.1, 3)], ids=["gains", "no gains", "three channels"])
def turned(request):
    """Twelve scans with gains of their own, and the answer on them."""
    size, channels = request.param
    draw, law = np.random.default_rng(4), models.get("lambertian+ggx")
    turn, theta_i, theta_r = (
        each.ravel() for each in np.meshgrid([0.0, 45.0, 90.0, 135.0], [20.0, 40.0, 60.0], np.arange(-70.0, 71.0, 7.0))
    )
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + np.where(theta_r < 0, 0.0, 180.0)))
    gain = draw.standard_normal((4, 3))[(turn / 45).astype(int), (theta_i / 20 - 1).astype(int)]
    f = law(geom, law.defaults()) * np.exp(size * gain[:, None] + 0.02 * draw.standard_normal((len(turn), channels)))
    data = Measurement(geom.at(np.linspace(0.45, 0.65, channels)), f, tuple(f"{each}" for each in range(channels)))
    found = fit(data, ["lambertian+ggx", "lambertian+ward"], timing=False, anyway=True)
    document = json.loads(json.dumps(found.document))
    return verification.readings_of(found.measurement, document), document, found.ranking.rows[0].fit.ln_scan_gains


def test_they_are_derived(turned):
    readings, document, _ = turned
    found = verification.verify(document, readings)
    places = {each.place for each in found.derived}
    assert not found.wrong
    for key, entry in document["ranking"][0]["parameters"].items():
        if entry.get("fitted"):
            name = f"ranking[0].parameters.{key}.stderr"
            assert name in places or f"{name}[0]" in places


def test_gains_count_in_them(turned, monkeypatch):
    readings, document, gains = turned
    monkeypatch.setattr(exact_intervals, "variances_by_gains", lambda *words: [mpf(0)] * len(words[3]))
    wrong = {each.place for each in verification.verify(document, readings).wrong}
    assert any(".stderr" in each for each in wrong) == (gains > 0)


@pytest.mark.parametrize("key", ["ggx.alpha", "lambertian.albedo"])
def test_a_changed_digit_of_them_is_found(turned, key):
    readings, document = turned[0], deepcopy(turned[1])
    place = next(n for n, row in enumerate(document["ranking"]) if row["candidate"] == "lambertian+ggx")
    entry = document["ranking"][place]["parameters"][key]
    told = entry["stderr"]
    entry["stderr"] = [each * (1 + 1e-5) for each in told] if isinstance(told, list) else told * (1 + 1e-5)
    wrong = {each.place.partition(".stderr")[0] for each in verification.verify(document, readings).wrong}
    assert f"ranking[{place}].parameters.{key}" in wrong
