"""Choose a reflectance model for a surface, and its parameters.

    import brdfguide

    paint = brdfguide.read("paint.csv")                          a Measurement
    answer = brdfguide.fit(paint)                                every candidate in its place, as the command shows it
    answer.surface                                               the recommended model with its values, a Surface
    brdfguide.evaluate(answer, 45, [30, 45, 60])                 [1/sr]
    brdfguide.recommend("porcelain")                             from a description instead
    brdfguide.export(answer, "mitsuba", "paint.xml")             a file for a renderer, and what it costs
    brdfguide.compare(answer, "lambertian+ggx ggx.alpha=0.1")    how different the two look, in L*
    brdfguide.preview(answer, "lambertian+ggx ggx.alpha=0.1")    a picture

What goes wrong is an `errors.InputError` or an `errors.NoAnswer`, in one sentence. Nothing is imported before it is
asked for.
"""

__version__ = "0.2.0"

TYPE_CHECKING = False  # true for type checkers and editors; `typing` itself takes longer to import than this file
if TYPE_CHECKING:
    from .data.measurement import Measurement
    from .face.functions import compare, evaluate, export, fit, preview, read, recommend
    from .models.surface import Surface

__all__ = ["Measurement", "Surface", "compare", "evaluate", "export", "fit", "preview", "read", "recommend"]
_MODULES = {"Measurement": "data.measurement", "Surface": "models.surface"}  # of the others: face.functions


def __getattr__(name: str):
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f".{_MODULES.get(name, 'face.functions')}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
