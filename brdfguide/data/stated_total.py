"""Total integrated scatter as a file states it, against what its values integrate to."""

import numpy as np

from ..finding import Finding
from ..flags import Effect
from .measurement import Measurement
from .reflectance import Reflectance

LESS = 0.8  # stated over integrated, the least that calibration and coarse steps explain
MORE = 1.25  # and the most (ours)
EDGE_DEG = 10.0  # the outermost directions, whose values stand for those beyond


def total_note(theta_i, totals) -> Finding:
    """A reader's note on the totals that a file states at these incidences [deg], as ("10_deg", 0.2); their mean where
    one is repeated."""
    theta_i, totals = np.asarray(theta_i, float), np.asarray(totals, float)
    angles = np.unique(theta_i)
    means = [float(np.mean(totals[theta_i == angle])) for angle in angles]
    span = f"{min(means):.3g}" if min(means) == max(means) else f"{min(means):.3g}..{max(means):.3g}"
    text = f"total integrated scatter {span}, as the file states it"
    numbers = tuple((f"{angle:g}_deg", mean) for angle, mean in zip(angles, means, strict=True))
    return Finding("tis", text, numbers=numbers)


def total_findings(measurement: Measurement, level: Reflectance | None):
    """Whether the stated totals are those of the values; a doubt where not even the directions that were not measured
    explain the difference."""
    stated = [dict(finding.numbers) for finding in measurement.findings if finding.effect is Effect.STATES_TOTAL]
    if not stated or level is None or level.how != "hemisphere":
        return
    beyond = np.pi * np.cos(np.radians(level.to_deg)) ** 2
    rows = []
    for angle, value, least in zip(level.theta_i_deg, level.values, level.least, strict=True):
        total = stated[0].get(f"{angle:g}_deg")
        if total is not None and total > 0 and value > 0:
            rows.append((angle, total, value, least, value + beyond * _at_edge(measurement, angle, level.to_deg)))
    if not rows:
        return
    off = [row for row in rows if row[1] < LESS * row[3] or row[1] > MORE * row[4]]
    angle, total, value, *_ = max(off or rows, key=lambda row: abs(np.log(row[1] / row[2])))
    says = (
        f"the file states a total integrated scatter of {total:.3g} at theta_i = {angle:g}, the values integrate to "
        f"{value:.3g} within {level.to_deg:.0f} degrees"
    )
    numbers = tuple(
        pair
        for angle, total, value, *_ in rows
        for pair in ((f"stated_{angle:g}_deg", total), (f"at_{angle:g}_deg", value))
    )
    if off:
        where = f"; {len(off)} of {len(rows)} incidences differ by more than the directions left out explain"
        consequence = "values or total are off in scale, or a mirror part stands in the total alone"
        yield Finding("tis-differs", says + where, "warning", consequence, numbers=numbers)
    else:
        yield Finding("tis-agrees", f"{says}: as near as coverage and steps let tell", numbers=numbers)


def _at_edge(measurement: Measurement, angle: float, angular_range: float) -> float:
    """The high values [1/sr] among the outermost directions of an incidence."""
    geom = measurement.geom
    rows = (np.abs(geom.theta_i_deg[:, 0] - angle) < 0.06) & (geom.theta_r_deg[:, 0] > angular_range - EDGE_DEG)
    values = measurement.brdf[rows][measurement.usable[rows]]
    return float(np.percentile(values, 98)) if values.size else 0.0
