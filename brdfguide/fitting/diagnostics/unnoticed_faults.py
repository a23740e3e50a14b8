"""What faults of the instrument that nobody would notice may have done to fitted numbers."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ...numerics.least_squares import Minimum
from ..layout import Layout
from ..objective import Misfit
from .standard_errors import in_units


def with_faults(layout: Layout, values: Mapping, stderr: dict, best: Minimum, misfit: Misfit) -> dict:
    """Standard errors of the free parameters with those by faults at their standard deviations, as far as any is known.

    (JᵀJ)⁻¹ Jᵀ δr for each fault, all values erring together, and these squared and summed: δr is what the fault changes
    in the residuals at the minimum, by its values and by its directions.
    """
    measurement = misfit.measurement
    if not measurement.otherwise:
        return stderr
    here, *slopes = best.at_minimum
    shared, per_channel = 0.0, 0.0
    for fault in measurement.otherwise:
        there = replace(misfit, measurement=measurement.under(fault))(best.shared, best.per_channel, False)
        change = np.where(np.isfinite(there), there - here, 0.0)
        moved, per_channel_moved = best.normal.influence(change, *slopes)
        shared = shared + moved.sum(axis=0) ** 2
        per_channel = per_channel + per_channel_moved.sum(axis=1) ** 2
    by_faults = in_units(layout, values, shared, per_channel)
    return {key: np.hypot(error, by_faults[key]) for key, error in stderr.items()}
