"""Help that fits a screen: commands by purpose, options by group, two real examples at the end."""

import inspect
import os
from math import isfinite

from typer.core import TyperCommand, TyperGroup

from ..errors import InputError, would_be_lost

GROUPS = {
    "Answers": ("recommend", "fit", "plan", "roughness"),
    "Look at it": ("inspect", "compare", "preview", "explore", "figures", "evaluate"),
    "Small sums": ("index", "albedo", "gloss", "scatter"),
    "Carry it on": ("numbers", "export", "convert"),
    "Many surfaces": ("collect", "search", "prune-answers"),
    "Catalogues": ("models", "materials", "examples", "schema"),
    "Trust": ("verify", "check", "bench"),
}


WRITTEN = ("output", "plot", "report", "residuals", "export")  # options that name files to write


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
    given once; no word is empty; a file that is read is not written."""

    def make_parser(self, ctx):
        parser = super().make_parser(ctx)
        parse = parser.parse_args

        def parse_once(args):
            options, rest, order = parse(args)
            _refuse_twice(order)
            _refuse_empty(order, options)
            return options, rest, order

        parser.parse_args = parse_once  # type: ignore[method-assign]
        return parser

    def parse_args(self, ctx, args):
        rest = super().parse_args(ctx, args)
        parameters = self.get_params(ctx)
        for parameter in parameters:
            value = ctx.params.get(parameter.name)
            if isinstance(value, float) and not isfinite(value):
                raise InputError(f"{parameter.opts[0]} {value:g}: wanted a number")
        if not ctx.params.get("force"):
            _spare_what_is_read(ctx.params, parameters)
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


def _refuse_twice(order) -> None:
    """Raises InputError for an option of one value that was typed more than once."""
    twice = [each for place, each in enumerate(order) if each in order[:place] and _is_single(each)]
    if twice:
        raise InputError(f"{twice[0].opts[0]} is given twice, and only one could count")


def _refuse_empty(order, typed) -> None:
    """Raises InputError for an option or argument of no sign, as of a shell's variable that is not set: it would be
    taken for one that is left out, or for the folder one is in."""
    for each in order:
        value = typed.get(each.name)
        if "" in (value if isinstance(value, list | tuple) else [value]):
            name = each.opts[0] if each.param_type_name == "option" else each.human_readable_name
            raise InputError(f"{name} '': wanted something; of a variable that is not set nothing is left")


def _spare_what_is_read(given, parameters) -> None:
    """Raises InputError where a file that is to be written is one that is read, and would be lost."""
    written = [(each.opts[0], word) for each in parameters if each.name in WRITTEN for word in _files(each, given)]
    if not written:
        return
    read = [word for each in parameters if each.name not in WRITTEN for word in _files(each, given)]
    for option, path in written:
        if any(os.path.samefile(path, each) for each in read):
            raise would_be_lost(f"{option} {path}")


def _files(parameter, given) -> list[str]:
    """The files that are there among the words of an option or argument; of TARGET:FILE the file."""
    value = given.get(parameter.name)
    words = [str(each) for each in (value if isinstance(value, list | tuple) else [value])]
    if parameter.name == "export":
        words = [word.partition(":")[2] for word in words]
    return [word for word in words if os.path.isfile(word)]


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
