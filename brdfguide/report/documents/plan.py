"""`brdfguide plan` as a document, and as a table that the reader takes back once its values are filled in."""

import numpy as np

from ...fitting.planning import MeasurementPlan, PlannedBlock
from .plain import plain

EXPECTED = {  # purpose -> what `expected_before` and `expected_after` are
    "error": "error over all directions over that of a fit to all of them",
    "tell": "how far the two models differ, in noises of one value, over all directions so far",
    "pin": "standard error of the parameter over that of today",
}


def plan_document(found: MeasurementPlan, *, timed: bool) -> dict:
    """What to measure, block after block; times only where the instrument's were said."""
    return plain(
        {
            "schema": "brdfguide/plan/1",
            "purpose": found.purpose,
            "of": list(found.subject),
            "expected": EXPECTED[found.purpose],
            "directions": len(found.geom),
            "measured_before": found.measured,
            "seconds": found.seconds if timed else None,
            "blocks": [_block(each, timed) for each in found.blocks],
        }
    )


def _block(block: PlannedBlock, timed: bool) -> dict:
    return {
        "expected_before": block.before,
        "expected_after": block.after,
        "seconds": block.seconds if timed else None,
        "scans": [{"theta_i_deg": theta, "plane_deg": plane} for theta, plane in block.scans],
        "directions": [
            {"theta_i_deg": theta_i, "theta_r_deg": theta_r, "phi_deg": phi} for theta_i, theta_r, phi in angles(block)
        ],
    }


def angles(block: PlannedBlock) -> list[list[float]]:
    """Incidence, detector and azimuth [deg] of each direction, rounded as they are typed; the mirror side is at 180."""
    columns = (block.geom.theta_i_deg, block.geom.theta_r_deg, np.remainder(block.geom.phi_deg, 360.0))
    return np.round(np.concatenate(columns, axis=1), 3).tolist()


def plan_table(document: dict) -> str:
    """The directions as CSV, a line each, with an empty column for the values."""
    lines = [
        "# a plan by brdfguide: fill in the values [1/sr], and give it to `brdfguide fit` or `brdfguide plan --after`",
        "# quantity: brdf",
        "# mirror-side: phi=180",
        "theta_i_deg,theta_r_deg,phi_r_deg,brdf",
    ]
    for number, block in enumerate(document["blocks"], start=1):
        if len(document["blocks"]) > 1:
            lines.append(f"# block {number}")
        for each in block["directions"]:
            lines.append(f"{each['theta_i_deg']:g},{each['theta_r_deg']:g},{each['phi_deg']:g},")
    return "\n".join(lines) + "\n"
