"""The least that a model's misfit could come down to, and what follows for the model.

    reducible = 1 - (S/M)²    by another law of its form = 1 - (Q/M)²    beyond any law of its form = (Q² - S²)/M²

M is the model's rms ln; S that of a smooth reciprocal function, Q that of a body and free factors, both as generalised
cross-validation expects them of further values. `describable` finds them.
"""

import numpy as np

from ..finding import Finding
from ..records import dataclass

LIMIT = 0.2  # reducible share below which the data are the limit
RESOLVED = 3.0  # times the noise of a single value, below which a floor is taken to be it (ours)
BEYOND = 0.3  # of the misfit that no law of the form removes, from which on the form is at fault (ours)
NOT_MUTUAL = 0.9  # times S that remains where exchange of light and detector may matter, below which it does


@dataclass(frozen=True)
class Unlike:
    """The factor in which a model differs most from what is free."""

    factor: str
    of: str  # the angle
    at_deg: tuple[float, ...]
    ratio: tuple[float, ...]  # free factor over the model's, 1 on average
    rms_ln: float


@dataclass(frozen=True)
class Floor:
    """Errors as rms ln at the directions looked at."""

    candidate: str
    model: float  # M
    smooth: float  # S
    factored: float | None  # Q; None where it does not come near the best model
    noise: float  # relative standard deviation of single values
    coefficients: float  # effective, of one channel
    stiffness: float  # lambda, the median over channels
    residual: float  # of the smooth function, where it was fitted
    of: tuple[str, ...]  # channels
    directions: int
    unlike: Unlike | None = None
    one_way: float | None = None  # S of a function that need not be reciprocal, where the data are not

    @property
    def reducible(self) -> float:
        """Share of the squared misfit that some smooth reciprocal law would remove."""
        return _removed(self.smooth, self.model)

    @property
    def by_form(self) -> float | None:
        """That another lobe, masking or Fresnel curve in the same form would."""
        return None if self.factored is None else _removed(self.factored, self.model)

    @property
    def beyond_form(self) -> float | None:
        """That no law of the form would, and another smooth law would."""
        return None if self.by_form is None else max(self.reducible - self.by_form, 0.0)

    @property
    def resolves(self) -> bool:
        """Whether what the smooth function leaves may be the noise of single values."""
        return self.smooth < RESOLVED * self.noise

    def findings(self) -> tuple[Finding, ...]:
        """What follows for the model."""
        numbers = (("reducible", round(self.reducible, 3)),)
        if self.one_way is not None and self.one_way < NOT_MUTUAL * self.smooth:
            text = f"a law that is not reciprocal would come to {self.one_way:.2g} in place of {self.smooth:.2g}"
            return (
                Finding("floor-of-reciprocity", text, consequence="what is left is the instrument's", numbers=numbers),
            )
        if self.reducible < LIMIT and self.resolves:
            text = f"no law would do much better than {self.candidate}: the data are the limit"
            return (Finding("at-the-floor", text, numbers=numbers),)
        if self.beyond_form is not None and self.beyond_form > BEYOND:
            text = (
                f"not a surface of this form: no lobe, masking and Fresnel factor over a body removes "
                f"{100 * self.beyond_form:.0f} % of the misfit that another law would"
            )
            return (Finding("not-of-this-form", text, consequence="two layers, diffraction or light sent back"),)
        return ()


def _removed(left: float, model: float) -> float:
    return float(np.clip(1 - (left / model) ** 2, 0.0, 1.0)) if model > 0 else 0.0
