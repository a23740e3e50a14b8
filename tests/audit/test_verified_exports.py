"""`verify`: what an answer says of files that hold its law as it is."""

import json
from copy import deepcopy

import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from brdfguide import exporters, models
from brdfguide.audit import verification
from brdfguide.face.functions import fit
from brdfguide.report.documents.plain import plain

from .. import synthetic


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """A lobe with an angle among its numbers, written exactly and as a table, and the answer on it."""
    model, folder = models.get("lambertian+lafortune"), tmp_path_factory.mktemp("exported")
    data = synthetic.surface(model, synthetic.scan(theta_i=(15, 45, 70), step=10.0), {}, noise=0.03, seed=3)
    found = fit(data, ["lambertian+lafortune"], timing=False)
    surface = exporters.coloured(found.ranking.recommended.fit.surface)
    told = [
        exporters.export_to(f"{target}:{folder / target}", surface, data.geom, measured=data.brdf)[1]
        for target in ("glsl", "osl", "merl")
    ]
    document = json.loads(json.dumps(found.document | {"exports": plain(told)}))
    return verification.readings_of(found.measurement, document), document


def test_exact_ones_hold_and_others_are_left_to_the_digest(exported):
    found = verification.verify(exported[1], exported[0])
    places = {each.place for each in found.derived if each.place.startswith("exports")}
    assert not found.wrong and {place[:10] for place in places} == {"exports[0]", "exports[1]"}
    assert {"exports[0].written.lafortune.tilt[0]", "exports[1].directions", "exports[1].measured_rms_ln"} <= places


@pytest.mark.parametrize("key", ["lafortune.tilt", "lafortune.exponent", "directions", "rms_ln", "measured_rms_ln"])
def test_a_changed_digit_of_them_is_found(exported, key):
    document = deepcopy(exported[1])
    entry = document["exports"][1]
    at = entry if key in entry else entry["written"]
    at[key] = at[key] * (1 + 1e-8) + (key == "directions") + 1e-9
    wrong = {each.place.removesuffix("[0]") for each in verification.verify(document, exported[0]).wrong}
    assert wrong == {f"exports[1].{key}" if at is entry else f"exports[1].written.{key}"}
