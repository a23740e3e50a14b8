"""Roughness from the dimming of a mirror image, as a document."""

from pathlib import Path

from ...advice.inference import Estimate
from ...advice.mirror_table import inferred_from, read_mirror_table
from ...physics import emergence


def mirror_document(path: Path, wavelength_um: float | None, pupil_mm: float, distance_mm: float) -> dict:
    """What a table of angles and ratios says of sigma and tau. Raises InputError for a table that is none."""
    table, omega = read_mirror_table(path, wavelength_um), emergence.pupil_solid_angle(pupil_mm, distance_mm)
    found = inferred_from(table, omega)
    law = next(each for each in found.laws if each.name == "he-torrance")
    sigma, tau = law.numbers["sigma"].value, law.numbers["tau"].value
    worst = max(law.misses, key=lambda key: abs(law.misses[key]))
    angle, um, ratio = table.rows[int(worst.rpartition(".")[2]) - 1]
    return {
        "schema": "brdfguide/roughness-mirror/1",
        "file": table.name,
        "rows": len(table.rows),
        "sigma_um": _number(law.numbers["sigma"]),
        "tau_um": _number(law.numbers["tau"]),
        "slope": _number(law.numbers["slope"]),
        "emergence_deg": emergence.emergence_angle(sigma, tau, emergence.WAVELENGTH, omega),
        "meets_all": law.meets,
        "worst": {
            "angle_deg": angle,
            "wavelength_nm": 1000 * um,
            "ratio": ratio,
            "of_the_law": law.predicted[worst],
            "missed_by_doubts": abs(law.misses[worst]),
        },
    }


def _number(of: Estimate) -> dict:
    return {"value": of.value, "low": of.low, "high": of.high}
