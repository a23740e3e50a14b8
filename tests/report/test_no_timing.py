"""Without times nothing in an answer differs from run to run; with them the cost is that of a long batch."""

import numpy as np

from brdfguide import fit
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import ranking
from brdfguide.models import cost
from brdfguide.physics.geometry import in_plane, rows

from .. import surfaces


def measured() -> Measurement:
    theta_i, theta_r, values = surfaces.in_plane_run("satin plastic", 4)
    return Measurement(rows(in_plane(theta_i, theta_r)), values[:, None], ("550 nm",))


def test_pictures_and_documents_are_equal_byte_for_byte_seed_4(tmp_path):
    pages = []
    for name in ("one", "two"):
        answer = fit(measured(), ["lambertian+ggx", "lambertian+ward", "lambertian+phong"], timing=False)
        answer.plot(tmp_path / f"{name}.svg")
        pages.append(((tmp_path / f"{name}.svg").read_bytes(), repr(answer), answer.document))
    assert pages[0] == pages[1]
    assert not any(row.ns_per_sample for row in answer.rows)


def test_a_short_file_is_timed_on_a_long_batch_seed_4(monkeypatch):
    lengths = []

    def noted(evaluators, argument, repeats):
        lengths.append(len(argument()))
        return {key: [1] for key in evaluators}

    monkeypatch.setattr(cost, "interleaved", noted)
    answer = fit(measured(), ["lambertian+ggx"])
    assert lengths == [ranking.TIMED_SAMPLES] and np.isfinite(answer.rows[0].ns_per_sample)
