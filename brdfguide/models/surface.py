"""A surface: a model with values for it, and the channels that these belong to."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from ..errors import InputError
from ..physics.colour import SRGB_UM
from ..physics.geometry import WAVELENGTH_UM, Geometry
from ..records import dataclass
from . import get
from .model import Composite, Term


@dataclass(frozen=True, eq=False, repr=False)
class Surface:
    """What was fitted, described or typed out, ready to be evaluated, read by an instrument, exported or drawn.

    A value is a float, or (channels,) where each channel has its own; what is not given keeps the model's default.
    Inside angles are radians and lengths micrometres; `Surface.named("ggx", {"alpha": 0.2})` takes degrees.
    """

    model: Composite
    values: Mapping
    channels: tuple[str, ...] = ("brdf",)
    wavelength: np.ndarray | float = WAVELENGTH_UM  # [µm], (channels,) or one for all

    @classmethod
    def named(cls, expression: str, values: Mapping = MappingProxyType({})) -> "Surface":
        """A model such as "lambertian+ggx" with values in people's units, one or three for colours, else its defaults.

        Raises InputError for an unknown model or parameter, and for a value where the law does not hold.
        """
        model = get(expression)
        return cls.of_colours(model, model.defaults() | model.qualified(values))

    @classmethod
    def of_colours(cls, model: Composite, values: Mapping) -> "Surface":
        """Grey where every parameter has one value, red, green and blue where some have three.

        Raises InputError for another number of values.
        """
        counts = {np.size(value) for value in values.values()} - {1}
        if counts - {3}:
            raise InputError(f"a parameter has {max(counts)} values; wanted one, or three for red, green and blue")
        values = {
            key: np.array(value, float) if np.size(value) > 1 else float(np.ravel(value)[0])
            for key, value in values.items()
        }
        if counts:
            return cls(model, values, ("R", "G", "B"), np.array(SRGB_UM))
        return cls(model, values, ("550 nm",), WAVELENGTH_UM)

    @property
    def wavelengths(self) -> np.ndarray:
        """(channels,) [µm]."""
        return np.broadcast_to(np.asarray(self.wavelength, float), (len(self.channels),))

    def brdf(self, geom: Geometry) -> np.ndarray:
        """The finite part [1/sr] at its own wavelengths: (samples, channels) from rows of directions."""
        return self._over_channels(self.model(geom.at(self.wavelength), self.values), geom)

    def mirror(self, geom: Geometry) -> np.ndarray:
        """Reflectance of the ideal specular part at theta_i, dimensionless, in the same shape; 0 if there is none."""
        return self._over_channels(self.model.mirror(geom.at(self.wavelength).where_lit(), self.values), geom)

    def _over_channels(self, f, geom: Geometry) -> np.ndarray:
        return np.broadcast_to(f, (len(geom), len(self.channels))) if geom.shape[1:] == (1,) else f

    def at(self, wavelength) -> "Surface":
        """The same values at other wavelengths [µm]."""
        return replace(self, wavelength=wavelength)

    def with_value(self, key: str, value) -> "Surface":
        """The same but for one value."""
        return replace(self, values={**self.values, key: value})

    def with_values(self, values: Mapping) -> "Surface":
        """The same but for some values in people's units, `alpha` or `ggx.alpha`.

        Raises InputError for an unknown name, a value where the law does not hold, and another number of values than
        channels.
        """
        new = {}
        for key, value in self.model.qualified(values).items():
            if np.size(value) not in (1, len(self.channels)):
                raise InputError(f"{key} has {np.size(value)} values for {len(self.channels)} channels")
            new[key] = np.asarray(value, float) if np.size(value) > 1 else float(np.ravel(value)[0])
        return replace(self, values={**self.values, **new})

    def in_channels(self, channels: tuple[str, ...], wavelength, whose: str = "the measurement") -> "Surface":
        """The same in other channels. Raises InputError where its values belong to another number of them."""
        if len(self.channels) not in (1, len(channels)):
            raise InputError(
                f"{whose} has {len(channels)} channels, the surface's values {len(self.channels)}; wanted the same"
            )
        return replace(self, channels=channels, wavelength=wavelength)

    def of_channels(self, places: Sequence[int] | np.ndarray) -> "Surface":
        """Some of the channels, by their numbers."""
        if len(self.channels) == 1 == len(places) and np.shape(self.wavelength) == (1,):
            return self

        def spread(value):
            return np.broadcast_to(value, (len(self.channels),))[places]

        values = {key: spread(value) if np.ndim(value) else value for key, value in self.values.items()}
        channels = tuple(self.channels[place] for place in places)
        return replace(self, values=values, channels=channels, wavelength=spread(self.wavelength))

    def channel(self, place: int) -> "Surface":
        """One channel by its number, every value a float."""
        one = self.of_channels([place])
        return replace(one, values={key: float(np.ravel(value)[0]) for key, value in one.values.items()})

    @property
    def middle(self) -> "Surface":
        """The channel in the middle, where one has to stand for all."""
        return self.channel(len(self.channels) // 2)

    def values_of(self, term: Term) -> dict:
        """Every value of one term, by the bare names of its parameters."""
        given = {**self.model.start, **self.model.fixed, **self.values}
        return {**term.model.defaults(), **self.model.of_term(term, given)}

    def alone(self, term: Term) -> "Surface":
        """One of its terms without the others."""
        values = {term.key(name): value for name, value in self.values_of(term).items()}
        return replace(self, model=Composite(term.label, (term,)), values=values)

    def __repr__(self) -> str:
        """Model and values as people type them, a line each."""
        lines = [f"{key} = {shown}" for key, shown in self._shown_values()]
        return "\n  ".join([f"{self.model.name} ({', '.join(self.channels)})", *lines])

    def _repr_html_(self) -> str:
        from html import escape  # 2,231 names of signs: only for a notebook

        cells = (f"<td>{escape(key)}</td><td>{escape(shown)}</td>" for key, shown in self._shown_values())
        rows = "".join(f"<tr>{each}</tr>" for each in cells)
        head = f"{escape(self.model.name)} ({escape(', '.join(self.channels))})"
        return f"<table><thead><tr><th colspan=2>{head}</th></tr></thead><tbody>{rows}</tbody></table>"

    def _shown_values(self):
        """(key, value with its unit) of every parameter, in the model's order."""
        given = {**self.model.defaults(), **self.values}
        for key, parameter in self.model.parameters.items():
            numbers = np.ravel(parameter.outside(np.asarray(given[key], float)))
            yield key, " ".join([",".join(f"{number:.4g}" for number in numbers), parameter.outside_unit]).rstrip()
