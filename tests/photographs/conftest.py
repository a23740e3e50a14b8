"""Pictures of a paint and of a white ball at two phases, rendered once."""

import numpy as np
import pytest

from .pictures import Matt, Paint, lamp_at, sphere

PHASES = (40, 110)


@pytest.fixture(scope="session")
def rendered():
    """(surface, phase) -> light (160, 160, 3)."""
    return {
        (name, phase): sphere(surface, lamp_at(phase))
        for name, surface in (("paint", Paint()), ("white", Matt()))
        for phase in PHASES
    }


@pytest.fixture
def shots(tmp_path, rendered):
    """Writes the pictures as float TIFFs, each changed by `change(light, phase)`, and gives the description's path."""
    from .pictures import describe, write_float_tiff

    pytest.importorskip("cv2", reason="float TIFFs need the extra photo")

    def written(change=lambda light, phase: light, phases=PHASES, lamp=lambda phase: "reference", **more):
        rows = []
        for phase in phases:
            for name in ("paint", "white"):
                write_float_tiff(tmp_path / f"{name}_{phase}.tif", np.asarray(change(rendered[name, phase], phase)))
            rows.append((f"paint_{phase}.tif", f"white_{phase}.tif", lamp(phase)))
        return describe(tmp_path, rows, **more)

    return written
