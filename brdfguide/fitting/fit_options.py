"""The options of a fit."""

from collections.abc import Mapping
from dataclasses import field

from ..records import dataclass


@dataclass(frozen=True)
class FitOptions:
    """What a user may decide about a fit."""

    metric: str = "ln"
    close: str = "look"  # what may be taken in place of the best: look, none, or a percentage such as 1%
    weights: str = "auto"  # auto, none, stderr, sampling
    robust: bool = False
    shape_per_channel: bool = False
    fixed: Mapping[str, float] = field(default_factory=dict)
    start: Mapping[str, float] = field(default_factory=dict)
