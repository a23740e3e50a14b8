"""What follows from one object alone, formed once for each."""

from collections.abc import Callable
from dataclasses import fields
from functools import cached_property, wraps
from typing import Any


class KeepsFormed:
    """A frozen dataclass that keeps what functions form from it; a copy begins anew, a pickle carries the fields."""

    @cached_property
    def _formed(self) -> dict[Callable, Any]:
        return {}

    def formed(self, function: Callable) -> Any:
        """`function(self)`, called once."""
        if function not in self._formed:
            self._formed[function] = function(self)
        return self._formed[function]

    def __getstate__(self) -> dict:
        return {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]


def formed(function: Callable) -> Callable:
    """A function of one Source, called once for each: what a law forms from the directions alone, say."""
    return wraps(function)(lambda of: of.formed(function))
