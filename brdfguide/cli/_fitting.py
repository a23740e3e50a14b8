"""Options about what is fitted and how, shared by the commands that fit."""

from re import split
from typing import Annotated

from typer import Option

from ..errors import InputError
from ..records import dataclass

PANEL = "Fit"
ModelsOption = Annotated[
    list[str] | None,
    Option(
        "--models",
        "-m",
        help="Models to try, e.g. lambertian+ggx; repeat or separate by commas.",
        rich_help_panel=PANEL,
    ),
]


@dataclass(frozen=True, eq=False, kw_only=True)
class Fitting:
    """Which models are fitted, and how."""

    models: ModelsOption = None
    kind: Annotated[
        str | None, Option("--kind", help="metal or dielectric, where you know it.", rich_help_panel=PANEL)
    ] = None
    metric: Annotated[
        str,
        Option(
            "--metric",
            help="ln, cube-root, relative or cosine; seen orders fits in ln by how they look.",
            rich_help_panel=PANEL,
        ),
    ] = "ln"
    close: Annotated[
        str,
        Option(
            "--close",
            help="What may stand in for the best: look (as good to the eye), N% (of error), none (only ties).",
            rich_help_panel=PANEL,
        ),
    ] = "look"
    weights: Annotated[
        str,
        Option(
            "--weights",
            help="By standard errors, and every incidence alike: auto, stderr, sampling or none.",
            rich_help_panel=PANEL,
        ),
    ] = "auto"
    robust: Annotated[bool, Option("--robust", help="Let outliers count little.", rich_help_panel=PANEL)] = False
    per_channel_shape: Annotated[
        bool, Option("--per-channel-shape", help="Free the shape for each channel.", rich_help_panel=PANEL)
    ] = False
    fix: Annotated[
        list[str] | None, Option("--fix", help="Hold a parameter, e.g. ggx.n=1.5; repeatable.", rich_help_panel=PANEL)
    ] = None
    start: Annotated[
        list[str] | None,
        Option("--start", help="Begin here too, e.g. ggx.alpha=0.1; repeatable.", rich_help_panel=PANEL),
    ] = None

    def options(self):
        """What they say, as `fitting.fit.Options`. Raises InputError for a word that is no name=number."""
        from ..fitting.choosing import check_close
        from ..fitting.fit import FitOptions

        check_close(self.close)
        return FitOptions(
            metric=self.metric,
            close=self.close,
            weights=self.weights,
            robust=self.robust,
            shape_per_channel=self.per_channel_shape,
            fixed=assignments(self.fix, "--fix"),
            start=assignments(self.start, "--start"),
        )


def expressions(models: list[str] | None) -> tuple[str, ...] | None:
    """`a,b+c` and repeated options as one row of names; a comma in brackets divides nothing."""
    if models is None:
        return None
    return tuple(word.strip() for each in models for word in split(r",(?![^(]*\))", each) if word.strip())


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
