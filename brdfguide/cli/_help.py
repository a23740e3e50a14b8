"""Help that fits a screen: commands by purpose, options by group, two real examples at the end."""

import inspect
from math import isfinite

from typer.core import TyperCommand, TyperGroup

from ..errors import InputError

GROUPS = {
    "Answers": ("recommend", "fit", "plan", "roughness"),
    "Look at it": ("inspect", "compare", "preview", "explore", "figures", "evaluate"),
    "Small sums": ("index", "albedo", "gloss", "scatter"),
    "Carry it on": ("numbers", "export", "convert"),
    "Many surfaces": ("collect", "search", "prune-answers"),
    "Catalogues": ("models", "materials", "examples", "schema"),
    "Trust": ("verify", "check", "bench"),
}


class Group(TyperGroup):
    """The commands, each with the first sentence of its docstring, whole."""

    def format_commands(self, ctx, formatter) -> None:
        lines = {name: first_sentence(command.help) for name, command in self.commands.items()}
        for title, names in GROUPS.items():
            rows = [(name, lines.pop(name)) for name in names if name in lines]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)
        if lines:
            with formatter.section("More"):
                formatter.write_dl(sorted(lines.items()))


class Command(TyperCommand):
    """Options under the heading that each names, arguments first; a number is a number, neither infinite nor none, and
    given once."""

    def parse_args(self, ctx, args):
        words = list(args)
        rest = super().parse_args(ctx, args)
        _, _, order = self.make_parser(ctx).parse_args(words)
        twice = [each for place, each in enumerate(order) if each in order[:place] and _is_single(each)]
        if twice:
            raise InputError(f"{twice[0].opts[0]} is given twice, and only one could count")
        for parameter in self.get_params(ctx):
            value = ctx.params.get(parameter.name)
            if isinstance(value, float) and not isfinite(value):
                raise InputError(f"{parameter.opts[0]} {value:g}: wanted a number")
        return rest

    def format_options(self, ctx, formatter) -> None:
        sections: dict[str, list] = {}
        for parameter in self.get_params(ctx):
            row = parameter.get_help_record(ctx)
            if row is not None:
                title = (
                    "Arguments"
                    if parameter.param_type_name == "argument"
                    else getattr(parameter, "rich_help_panel", None) or "Options"
                )
                sections.setdefault(title, []).append(row)
        for title in sorted(sections, key=lambda title: (title != "Arguments", title == "Options")):
            with formatter.section(title):
                formatter.write_dl(sections[title])

    def format_epilog(self, ctx, formatter) -> None:
        if self.epilog:
            with formatter.section("Examples"):
                for line in self.epilog.removeprefix("Examples:").split(" | "):
                    formatter.write(f"  {line.strip()}\n")


def _is_single(parameter) -> bool:
    """Whether an option takes one value: neither a switch nor repeatable."""
    switch = getattr(parameter, "is_flag", False) or getattr(parameter, "count", False)
    return parameter.param_type_name == "option" and not parameter.multiple and not switch


def first_sentence(text: str | None) -> str:
    """Up to the first full stop that ends a line or stands before a capital; `Eq. 3` does not end a sentence."""
    line = inspect.cleandoc(text or "").partition("\n\n")[0].replace("\n", " ")
    head, stop, rest = line.partition(". ")
    while stop and not rest[:1].isupper():
        more, stop, rest = rest.partition(". ")
        head = f"{head}. {more}"
    return head.removesuffix(".")
