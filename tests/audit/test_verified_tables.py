"""`verify`: tables of a goniometer that were written beside an answer."""

from copy import deepcopy

import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from brdfguide.audit import verification

from .test_verified_shaders import answer_on

TARGETS = ("csv", "zemax", "lighttools", "merl")


@pytest.fixture(scope="module")
def tabulated(tmp_path_factory):
    return answer_on("lambertian+ggx", {}, ["lambertian+ggx"], TARGETS, tmp_path_factory.mktemp("tabulated"))


def test_tables_are_derived_and_cells_are_left_to_the_digest(tabulated):
    found = verification.verify(tabulated[1], tabulated[0])
    places = {each.place for each in found.derived if each.place.startswith("exports")}
    keys = ("rms_ln", "directions", "measured_rms_ln", "written.azimuths", "written.polars")
    assert not found.wrong and places == {f"exports[{number}].{key}" for number in range(3) for key in keys}


@pytest.mark.parametrize("number", [0, 2])
@pytest.mark.parametrize("key", ["rms_ln", "measured_rms_ln", "directions", "azimuths", "polars"])
def test_a_changed_digit_of_them_is_found(tabulated, number, key):
    document = deepcopy(tabulated[1])
    entry = document["exports"][number]
    at = entry if key in entry else entry["written"]
    at[key] += 1e-6 if key.endswith("rms_ln") else 1
    wrong = {each.place for each in verification.verify(document, tabulated[0]).wrong}
    assert wrong == {f"exports[{number}].{key}" if at is entry else f"exports[{number}].written.{key}"}
