"""Whether a fit of He-Torrance found the height of the surface, or only its slope and a height that it must exceed.

Where sigma is much larger than the wavelength the lobe tends to that of facets, whose shape knows sigma/tau alone. Then
every larger sigma with the same slope fits as well, and a single number with a standard error would be false.
"""

from collections.abc import Mapping
from math import exp

import numpy as np

from ...data.measurement import Measurement
from ...finding import Finding
from ...flags import Effect
from ..layout import Layout, to_coordinate
from ..objective import Misfit, metric

SAMPLES = 300  # directions on which the question is asked
LOOSE = 0.25  # standard error of ln sigma from which the question is asked
SURE = 4.0  # rise of the misfit, in units of one residual's variance, that would be noticed: two standard errors
STEPS = 12  # halvings of ln sigma: the bound to 0.1 %


def rough_regime_doubts(
    layout: Layout, measurement: Measurement, shared, per_channel, variance: float, stderr: Mapping
) -> tuple[Finding, ...]:
    """For each term of wave optics: `rough-regime` with a lower bound on sigma, where the data allow any larger one.

    Takes  the coordinates where a fit ended; `variance` of one residual in ln, widened for neighbours and channels that
    err
    together; the standard errors.    Gives  nothing where sigma is found, or is not searched for.
    """
    keys = [f"{term.label}.sigma" for term in layout.model.terms if {"sigma", "slope"} <= term.model.defaults().keys()]
    loose = [
        key for key in keys if key in layout.shared and stderr[key] > LOOSE * exp(shared[layout.shared.index(key)])
    ]
    return tuple(found for key in loose if (found := _bound(layout, measurement, shared, per_channel, variance, key)))


def in_place_of(warnings, found: tuple[Finding, ...]) -> list[Finding]:
    """The warnings, with what `found` says better left out."""
    keys = {finding.subject for finding in found}
    replaced = {Effect.LOOSENS, Effect.AT_BOUND}
    return [each for each in warnings if not (each.effect in replaced and each.subject in keys)] + list(found)


def _bound(layout, measurement, shared, per_channel, variance, key):
    parameter, place = layout.parameters[key], layout.shared.index(key)
    rows = np.unique(np.linspace(0, len(measurement.brdf) - 1, SAMPLES).round().astype(int))
    variance = variance * len(rows) / len(measurement.brdf)  # the thinned rows stand for all of them
    measurement = measurement[rows]
    misfit = Misfit(layout, measurement, metric("ln"), np.ones_like(measurement.brdf))

    def cost(coordinate):
        """Sum of squares at this sigma once the other parameters have made up for it as well as a linear step can."""
        at = shared.copy()
        at[place] = coordinate
        residual, by_shared, by_per_channel = misfit(at, per_channel, True)
        others = np.concatenate([np.delete(by_shared, place, axis=2), by_per_channel], axis=2)
        total = 0.0
        for channel, columns in enumerate(others):
            scale = np.sqrt(np.sum(columns**2, axis=0)) + 1e-300
            made_up, *_ = np.linalg.lstsq(columns / scale, residual[:, channel], rcond=1e-10)
            total += np.sum((residual[:, channel] - columns / scale @ made_up) ** 2)
        return total

    low, high = (float(to_coordinate(parameter, end)) for end in (parameter.low, parameter.high))
    limit = cost(shared[place]) + SURE * variance
    if cost(high) > limit:
        return None
    high = float(shared[place])
    if cost(low) <= limit:
        return None  # nothing is known of sigma at all, which its standard error says
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if cost(middle) <= limit else (middle, high)
    slope = float(np.mean(layout.decode(shared, per_channel)[key.replace("sigma", "slope")]))
    text = (
        f"only sigma/tau is determined: {key} > {exp(high):.2g} um, and any larger one with slope {slope:.3g} fits "
        f"as well"
    )
    return Finding(
        "rough-regime",
        text,
        "warning",
        "do not use sigma or tau by themselves",
        "",
        (("sigma_um_above", exp(high)), ("slope", slope)),
        subject=key,
    )
