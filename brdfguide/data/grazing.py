"""Directions near grazing that were extrapolated when a table was made, and no instrument saw."""

from dataclasses import replace

import numpy as np

from ..finding import Finding
from ..flags import Effect
from .measurement import Measurement

MEASURED_DEG = 80.0  # beyond it MERL's cells were extrapolated, and published comparisons leave them out (Ngan 2005)


def extrapolated_finding(measurement: Measurement) -> Finding | None:
    """What a fit leaves out of a table that was extrapolated near grazing; None where --theta-max has decided."""
    if measurement.settled("grazing"):
        return None
    if not any(each.effect is Effect.EXTRAPOLATED for each in measurement.findings):
        return None
    beyond = int(np.count_nonzero(~_measured(measurement)))
    if not 0 < beyond < len(measurement.geom):
        return None
    text = (
        f"{beyond} of {len(measurement.geom)} directions lie beyond {MEASURED_DEG:g} degrees, where such tables were "
        f"extrapolated"
    )
    numbers = (("directions", beyond), ("beyond_deg", MEASURED_DEG))
    return Finding(
        "beyond-80-left-out",
        text,
        consequence="left out of fits",
        option="--theta-max 90",
        numbers=numbers,
        leaves_out=True,
        settles=("grazing",),
    )


def as_measured(measurement: Measurement) -> Measurement:
    """The measurement without what was extrapolated, and a note of that in place of the table's own."""
    finding = extrapolated_finding(measurement)
    if finding is None:
        return measurement
    kept = tuple(each for each in measurement.findings if each.effect is not Effect.EXTRAPOLATED)
    return replace(measurement[_measured(measurement)], findings=kept).noting(finding)


def _measured(measurement: Measurement) -> np.ndarray:
    steepest = np.maximum(measurement.geom.theta_i_deg, measurement.geom.theta_r_deg)[:, 0]
    return steepest <= MEASURED_DEG + 1e-6
