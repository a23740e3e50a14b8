"""Surfaces without a grain get the same bytes whether the program has laws with one or not."""

from functools import lru_cache
from pathlib import Path

import pytest

from benchmarks import without_grain

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
COMMANDS = (
    ("fit", "rough_aluminium.csv", "--json", "--no-timing"),
    ("fit", "smooth_steel.csv", "--no-timing"),
    ("recommend", "rough_plastic.csv", "--no-timing"),
    ("inspect", "white_paper.csv", "--json"),
    ("roughness", "--angle", "60", "--json"),
)
NO_SHADERS = (  # whose numbers to type are of laws that may have a grain
    ("fit", "smooth_steel.csv", "--no-timing", "--no-numbers"),
    ("inspect", "smooth_steel.csv"),
    ("inspect", "rough_plastic.csv"),
)


@pytest.fixture(scope="module")
def without_laws(tmp_path_factory):
    return without_grain.copy_without_grain(tmp_path_factory.mktemp("laws"))


@pytest.fixture(scope="module")
def without_geometry(tmp_path_factory):
    return without_grain.copy_without_grain(tmp_path_factory.mktemp("geometry"), geometry=False)


@lru_cache
def answered(tree: Path, command: tuple[str, ...]) -> str:
    return without_grain.output(tree, *(str(EXAMPLES / each) if each.endswith(".csv") else each for each in command))[0]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_without_laws_of_a_grain_an_isotropic_surface_has_the_same_answer(command, without_laws):
    found = answered(without_grain.ROOT, command)
    assert len(found) > 300 and "-aniso" not in found
    assert answered(without_laws, command) == found


@pytest.mark.parametrize("command", NO_SHADERS, ids=" ".join)
def test_without_a_grains_geometry_too(command, without_geometry):
    found = answered(without_grain.ROOT, command)
    assert len(found) > 300
    assert answered(without_geometry, command) == found


def test_the_copies_know_no_law_with_a_grain(without_laws, without_geometry):
    for tree in (without_laws, without_geometry):
        assert not list(tree.glob("brdfguide/models/*_aniso.py"))
        assert "no model called 'ggx-aniso'" in answered(tree, ("models", "ggx-aniso"))
