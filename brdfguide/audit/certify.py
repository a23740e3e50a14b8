"""A second opinion on a fit: SciPy's least squares goes on from the minimum that ours found, on the same misfit.

    x = argmin Σ r²,   trust-region reflective (Branch, Coleman and Li 1999), from the fitted values

Where SciPy lowers the root mean square by a ten-thousandth or less, it agrees that nothing is left to gain nearby. It
says nothing of minima elsewhere, for which the fit itself tries a grid of starts.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..data.measurement import Measurement
from ..errors import InputError
from ..finding import Finding
from ..fitting import weights
from ..fitting.fit import FitOptions, prepare
from ..fitting.layout import Layout
from ..fitting.objective import Misfit, metric
from ..fitting.residuals import ln_residuals, rms, rms_over_all
from ..fitting.saved import SavedFit
from ..records import dataclass

ENOUGH = 1e-4  # of the rms: to lower it by less is agreement (ours)
SAME = 1e-6  # of the rms ln: two that differ by less are of the same values and data
MOST = 200  # evaluations
TOLERANCE = 1e-12  # of SciPy: on cost, step and gradient


@dataclass(frozen=True)
class Opinion:
    """How far SciPy goes on."""

    model: str
    lower: float  # share of the rms that it takes off
    moved: Mapping[str, float]  # parameter -> standard errors that it moves by, the most of its channels
    evaluations: int

    @property
    def agrees(self) -> bool:
        return self.lower <= ENOUGH

    def finding(self) -> Finding:
        """In words, with the numbers."""
        key = max(self.moved, key=lambda each: self.moved[each])
        gain = f"lowers the error by {100 * self.lower:.2g} %" if self.lower > 0 else "does not lower the error"
        text = f"SciPy's least_squares, from where the fit ended, {gain}; what moves most is {key}, by "
        text += f"{self.moved[key]:.2g} of its standard error"
        numbers = (("lower", self.lower), ("moved_stderr", self.moved[key]), ("evaluations", self.evaluations))
        if self.agrees:
            return Finding("second-opinion", text, consequence="it is a minimum to SciPy too", numbers=numbers)
        hint = "the fit did not end in a minimum, or was made with --robust"
        return Finding("second-opinion", text, "warning", hint, numbers=numbers)


def certify(fit: SavedFit, measurement: Measurement) -> Opinion:
    """SciPy's opinion of a saved fit to a measurement, prepared as for that fit.

    Raises InputError where it is not the measurement that was fitted, or was read or weighed in another way.
    """
    measurement = replace(measurement, solid_angle=measurement.solid_angle or fit.solid_angle)
    surface = fit.surface.in_channels(measurement.channels, measurement.geom.wavelength, measurement.name)
    options = FitOptions(metric=fit.metric, weights=_weighing(fit, measurement))
    data = prepare(measurement, options.weights)
    data = data if fit.missed is None else data.expecting(fit.missed)
    errors = [rms(ln_residuals(surface, data.compared), data.compared_weights)]
    if data.compared is not data.whole:  # of a large table the error of a model near the best is over all
        errors += rms_over_all([surface], data.whole, data.sample_weights)
    if not any(abs(error - fit.rms_ln) <= SAME * fit.rms_ln for error in errors):
        raise InputError(
            f"{measurement.name}: the fitted values have an rms ln of {errors[-1]:.5g} here and "
            f"{fit.rms_ln:.5g} in the fit; wanted the data that it was fitted to, read as it was"
        )
    held = {key: surface.values[key] for key in fit.held}
    model = replace(surface.model, fixed={**surface.model.fixed, **held})
    layout = Layout(model, len(measurement.channels), fit.per_channel)
    if not layout.count:
        raise InputError(f"{surface.model.name}: none of its values was fitted; there is nothing to certify")
    return _opinion(surface.model.name, data.settle.misfit(layout, metric(fit.metric)), layout.encode(surface.values))


def _weighing(fit: SavedFit, measurement: Measurement) -> str:
    """How values were weighed: what says of itself what the fit says. Raises InputError where nothing does."""
    kinds = [each for each in weights.KINDS if each != "stderr" or measurement.stderr is not None]
    for kind in kinds:
        if {each.printed for each in weights.weighing(measurement, kind)} == fit.weighing:
            return kind
    raise InputError(f"{measurement.name}: its values were weighed in another way for the fit; wanted the same data")


def _opinion(name: str, misfit: Misfit, start) -> Opinion:
    from scipy.optimize import least_squares

    layout, (shared, per_channel) = misfit.layout, start
    channels, count = layout.channels, len(layout.shared)

    def split(x):
        return x[:count], x[count:].reshape(channels, -1)

    def residuals(x):
        at_shared, at_channels = split(x)
        return misfit(at_shared, at_channels, False).T.ravel()

    def jacobian(x):
        at_shared, at_channels = split(x)
        _, j_shared, j_per_channel = misfit(at_shared, at_channels, True)
        samples, each = j_shared.shape[1], j_per_channel.shape[2]
        dense = np.zeros((channels, samples, count + channels * each))
        dense[:, :, :count] = j_shared
        for channel in range(channels):
            dense[channel, :, count + channel * each : count + (channel + 1) * each] = j_per_channel[channel]
        return dense.reshape(channels * samples, -1)

    ends = zip(layout.bounds(layout.shared), layout.bounds(layout.per_channel), strict=True)
    low, high = (np.concatenate([a, np.tile(b, channels)]) for a, b in ends)
    begin = np.clip(np.concatenate([shared, per_channel.ravel()]), low, high)
    found = least_squares(
        residuals, begin, jacobian, (low, high), x_scale="jac", max_nfev=MOST,
        xtol=TOLERANCE, ftol=TOLERANCE, gtol=TOLERANCE,
    )  # fmt: skip
    before, after = np.sum(residuals(begin) ** 2), 2 * found.cost
    variance = after / max(len(found.fun) - len(begin), 1)
    stderr = np.sqrt(np.maximum(np.diag(np.linalg.pinv(found.jac.T @ found.jac)) * variance, 1e-300))
    distance = np.abs(found.x - begin) / stderr
    columns = distance[count:].reshape(channels, -1).max(axis=0, initial=0.0)
    moved = dict(
        zip([*layout.shared, *layout.per_channel], [*distance[:count].tolist(), *columns.tolist()], strict=True)
    )
    return Opinion(name, float(max(1 - np.sqrt(after / before), 0.0)) if before > 0 else 0.0, moved, int(found.nfev))
