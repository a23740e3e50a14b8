"""What the azimuths of a table count from, and in which sense.

The one azimuth of a table, beside zeniths of the detector with a sign, may be the light's azimuth on the sample, under
which each scan lies in the plane of incidence, or the plane in which the detector moves. Whatever a grain does, the
mirror direction has the same facets under every turn of the sample, and a plane of the detector that is not the plane
of incidence does not hold it: the values tell them apart. Where a body is all that they show, it is the sample's.
"""

import numpy as np

from ...finding import Finding
from ..columns.facts import Column, facts
from ..columns.vocabulary import senses_of
from ._values import DECODED
from .format import Options

AZIMUTHS = ("phi_i", "phi_r", "dphi", "phi_h")
ELSEWHERE = ("phi_i", "phi_r", "theta_h", "theta_d", "phase", "rotation")  # beside which the azimuth is another
FROM_THE_LIGHT = frozenset(["relative", "difference"])  # words of an azimuth from light to detector
MIRROR_DEG = 3.0  # within which a value is one of the mirror direction
STEEP_DEG = 5.0  # least incidence whose mirror direction is apart from the light's
ALIKE = 2.0  # quotient up to which mirror directions are one
MOST = 64  # azimuths


def counter_clockwise(columns: dict[str, Column], raw: dict[str, np.ndarray], notes: list[Finding]) -> None:
    """Turns the azimuths [deg] in `raw` whose names say that they count clockwise; those that say nothing go along."""
    named = {role: columns[role].sense for role in AZIMUTHS if role in columns and columns[role].sense}
    turned = [role for role, sense in named.items() if sense == "cw"]
    if not turned:
        return
    along = [role for role in AZIMUTHS if role in raw and role not in named] if len(turned) == len(named) else []
    for role in (*turned, *along):
        raw[role] = 0.0 - raw[role]
    text = f"'{columns[turned[0]].name[:40]}' counts clockwise, as its name says: azimuths read with the opposite sign"
    notes.append(Finding("azimuth-clockwise", text))


def role_of_the_azimuth(
    columns: dict[str, Column], raw: dict[str, np.ndarray], values, options: Options, notes: list[Finding]
) -> str:
    """`dphi`, or what a lone azimuth beside signed theta_r is instead: `phi_i`, or `rotation` with --rotation-sense.

    Takes  columns and angles [deg] by role, and values(): what was measured in each row.
    """
    if "dphi" not in columns or "theta_r" not in columns or any(role in raw for role in ELSEWHERE):
        return "dphi"
    name = columns["dphi"].name
    asked = isinstance(options.columns, dict) and {"dphi", "phi_d"} & options.columns.keys()
    if asked or any(senses_of(token.text) & FROM_THE_LIGHT for token in facts(name)[1]):
        return "dphi"
    theta_r, azimuth, theta_i = raw["theta_r"], raw["dphi"], raw.get("theta_i")
    several = 2 <= len(np.unique(azimuth[np.isfinite(azimuth)])) <= MOST
    if theta_i is None or not several or not (np.any(theta_r < 0) and np.any(theta_r > 0)):
        return "dphi"
    how = f"'{name[:40]}' beside theta_r with a sign"
    if options.rotation_sense:
        return "rotation"
    if _quotient(theta_i, theta_r, azimuth, values()) > ALIKE:
        text = f"{how} is the plane of the detector, from the light: not every one of them holds the mirror direction"
        notes.append(Finding("azimuth-of-detector", text, option="--columns"))
        return "dphi"
    text = f"{how} is the light's azimuth on the sample: each scan lies in the plane of incidence"
    consequence = f"--columns dphi={name[:40]} takes it as the detector's"
    notes.append(Finding("azimuth-of-sample", text, consequence=consequence, option="--rotation-sense"))
    return "phi_i"


def _quotient(theta_i, theta_r, azimuth, value) -> float:
    """Greatest over least brightness of the mirror direction over azimuths, the median of the incidences; 1 where none
    tells. Which sign of theta_r that direction has, its brightness says."""
    with np.errstate(invalid="ignore"):
        known = np.isfinite(value) & (value > 0) & (np.abs(theta_i) >= STEEP_DEG)
        sides = [known & (np.abs(side * theta_r - theta_i) <= MIRROR_DEG) for side in (1.0, -1.0)]
    near = max(sides, key=lambda side: value[side].max(initial=0.0))
    peaks = [_peaks(azimuth[here], value[here]) for here in (near & (theta_i == each) for each in np.unique(theta_i))]
    found = [max(each) / min(each) for each in peaks if len(each) > 1]
    return float(np.median(found)) if found else 1.0


def _peaks(azimuth, value) -> list[float]:
    """The brightest value of each azimuth."""
    return [float(value[azimuth == each].max()) for each in np.unique(azimuth)]


def brightness(table, given) -> np.ndarray:
    """What the first column of values holds, in the rows of a table, as a number that grows with the BRDF."""
    column = given.one("value")
    if column is None:
        return np.full(len(table.values), np.nan)
    with np.errstate(all="ignore"):
        return np.asarray(DECODED[column.scale](table.values[:, column.place]), float)
