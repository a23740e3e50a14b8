"""Options about what is fitted and how, shared by the commands that fit."""

from typing import Annotated

from typer import Option

from ..errors import InputError

FIT = "Fit"
ModelsOption = Annotated[list[str] | None, Option("--models", "-m", help="Models to try, e.g. lambertian+ggx; repeat or separate by commas.", rich_help_panel=FIT)]
KindOption = Annotated[str | None, Option("--kind", help="metal or dielectric, where you know it.", rich_help_panel=FIT)]
MetricOption = Annotated[str, Option("--metric", help="ln, cube-root, relative or cosine.", rich_help_panel=FIT)]
WeightsOption = Annotated[str, Option("--weights", help="By standard errors, and every incidence alike: auto, stderr, sampling or none.", rich_help_panel=FIT)]
RobustOption = Annotated[bool, Option("--robust", help="Let outliers count little.", rich_help_panel=FIT)]
PerChannelOption = Annotated[bool, Option("--per-channel-shape", help="Free the shape for each channel.", rich_help_panel=FIT)]
FixOption = Annotated[list[str] | None, Option("--fix", help="Hold a parameter, e.g. ggx.n=1.5; repeatable.", rich_help_panel=FIT)]
StartOption = Annotated[list[str] | None, Option("--start", help="Begin here too, e.g. ggx.alpha=0.1; repeatable.", rich_help_panel=FIT)]


def fit_options(metric, weights, robust, per_channel_shape, fix, start):
    """What the options say, as `fitting.Options`."""
    from ..fitting import Options

    return Options(metric, weights, robust, per_channel_shape, assignments(fix, "--fix"), assignments(start, "--start"))


def expressions(models: list[str] | None) -> list[str] | None:
    """`a,b+c` and repeated options as one list."""
    return None if models is None else [word.strip() for each in models for word in each.split(",") if word.strip()]


def assignments(words: list[str] | None, option: str) -> dict[str, float]:
    """`name=value` pairs. Raises InputError for anything else."""
    pairs = {}
    for word in words or ():
        name, equals, value = word.partition("=")
        try:
            pairs[name.strip()] = float(value)
        except ValueError:
            equals = ""
        if not equals:
            raise InputError(f"{option} {word}: wanted name=number, such as ggx.alpha=0.2")
    return pairs
