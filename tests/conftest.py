"""Shared by all tests: NumPy raises on overflow, division and invalid; real data where it is present."""

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis.internal.conjecture import providers

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("BRDFGUIDE_DATA", ROOT.parent / "shared" / "data"))


def of_no_module():
    """No numbers out of what has been imported: they would be others after other tests, and on every worker."""
    return providers.Constants()


if hasattr(providers, "_get_local_constants"):
    providers._get_local_constants = of_no_module


@pytest.fixture(autouse=True)
def numpy_raises():
    with np.errstate(over="raise", divide="raise", invalid="raise"):
        yield


@pytest.fixture(scope="session")
def package(tmp_path_factory):
    """The program as it is published: sdist, wheel, and an environment with nothing but the wheel."""
    from .installed import installed

    return installed(tmp_path_factory.mktemp("package"))


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real measurements; tests that need it are skipped where it is absent."""
    if not DATA.is_dir():
        pytest.skip(f"no measurements at {DATA}; set BRDFGUIDE_DATA")
    return DATA
