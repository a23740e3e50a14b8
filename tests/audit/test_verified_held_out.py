"""`verify`: held-out errors of large tables, of spectra and of turned samples."""

import json
from copy import deepcopy

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from brdfguide import models
from brdfguide.audit import verification
from brdfguide.data.formats.format import InputError
from brdfguide.face.functions import fit

from .. import synthetic
from ..data.test_rotation import scans

WARD = models.get("lambertian+ward")


def of_many_directions():
    return synthetic.surface(WARD, synthetic.scan(theta_i=(15, 45, 70), step=0.7), {}, noise=0.03, seed=3)


def of_a_spectrum():
    values = {"lambertian.albedo": np.linspace(0.1, 0.5, 6)}
    return synthetic.surface(WARD, synthetic.scan(theta_i=(15, 45, 70), step=10.0), values, noise=0.03, channels=6)


def of_turns():
    return scans("ggx", [0.0, 45.0, 90.0, 135.0, 160.0], incidences=(15.0, 55.0), alpha=0.2)[::4]


def answered(data, name="lambertian+ward"):
    found = fit(data, [name], timing=False, anyway=True)
    return found.measurement, json.loads(json.dumps(found.document))


def verified(measurement, document):
    return verification.verify(document, verification.readings_of(measurement, document))


@pytest.mark.parametrize(
    ("made", "rows", "channels", "folds"),
    [(of_many_directions, 500, ["1"], 3), (of_a_spectrum, 51, None, 3), (of_turns, None, None, 6)],
)
def test_the_answer_names_what_was_looked_at_and_held_out_errors_follow(made, rows, channels, folds):
    measurement, document = answered(made())
    row, on = document["ranking"][0], document["held_out_on"]
    assert len(row["held_out_fits"]) == folds
    if rows is None:
        assert on is None and [bool(fold["turns_deg"]) for fold in row["held_out_fits"]] == [True] * 4 + [False] * 2
    else:
        assert len(on["rows"]) <= rows and len(on["channels"]) == min(len(measurement.channels), 4)
    honest = verified(measurement, document)
    assert not honest.wrong
    assert {"ranking[0].held_out_rms_ln", "ranking[0].held_out_highest.rms_ln"} <= {e.place for e in honest.derived}
    for change in (_error, _number, _direction if on else _turn):
        changed = deepcopy(document)
        change(changed)
        assert any("held_out" in each.place for each in verified(measurement, changed).wrong)


def _error(document):
    document["ranking"][0]["held_out_rms_ln"] *= 1 + 1e-8


def _number(document):
    document["ranking"][0]["held_out_fits"][1]["values"]["ward.alpha"] *= 1 + 1e-7


def _direction(document):
    rows = document["held_out_on"]["rows"]
    rows[7] = next(row for row in range(rows[-1]) if row not in rows) if len(rows) > 400 else rows[8]


def _turn(document):
    document["ranking"][0]["held_out_fits"][1]["turns_deg"] = [90]


def test_directions_that_the_data_do_not_have_are_refused_in_one_sentence():
    measurement, document = answered(of_many_directions())
    document["held_out_on"]["rows"][-1] = len(measurement.brdf)
    with pytest.raises(InputError, match="held_out_on: found"):
        verified(measurement, document)
