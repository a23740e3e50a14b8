"""A command's options as one frozen request, so that no road through the command can drop one.

A command whose only parameter is a dataclass of this kind is called with it; the parser sees the dataclass' fields, and
those of the groups among them, as if they stood in the command's signature.
"""

from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from inspect import Parameter, Signature, signature
from typing import Any, get_type_hints

from typer import Context

from ..errors import InputError


def spread(command: Callable) -> Callable:
    """`command(request)` as a function of the request's fields; a command with options of its own as it is."""
    kind = get_type_hints(command).get(next(iter(signature(command).parameters)))
    if not _is_request(kind):
        return command

    def called(**given) -> None:
        command(_filled(kind, given))

    called.__doc__ = command.__doc__
    called.__signature__ = Signature(list(_parameters(kind)))  # type: ignore[attr-defined]
    return called


def _parameters(kind: Any) -> Iterator[Parameter]:
    for field, hint in _hinted(kind):
        if _is_request(hint):
            yield from _parameters(hint)
        else:
            default = Parameter.empty if field.default is MISSING else field.default
            yield Parameter(field.name, Parameter.KEYWORD_ONLY, annotation=hint, default=default)


def _filled(kind: Any, given: dict[str, Any]):
    return kind(
        **{
            field.name: _filled(hint, given) if _is_request(hint) else given[field.name]
            for field, hint in _hinted(kind)
        }
    )


def _is_request(hint: Any) -> bool:
    return isinstance(hint, type) and is_dataclass(hint)


def _hinted(kind: Any) -> list[tuple[Field, Any]]:
    hints = get_type_hints(kind, include_extras=True)
    return [(field, hints[field.name]) for field in fields(kind)]


def refuse(context: Context, *names: str, because: str) -> None:
    """Raises InputError for those of the options that were typed: here they could have no effect."""
    typed = [
        _as_typed(context, each) if each.param_type_name == "option" else each.human_readable_name
        for each in context.command.params
        if each.name in names and is_typed(context, each.name)
    ]
    if typed:
        raise InputError(f"{', '.join(typed[:-1])}{' and ' if typed[:-1] else ''}{typed[-1]}: {because}")


def _as_typed(context: Context, option) -> str:
    """The name by which an option was given: of a switch that is off, the one that turns it off."""
    off = option.secondary_opts and context.params.get(option.name) is False
    return (option.secondary_opts if off else option.opts)[0]


def refuse_theme(context: Context) -> None:
    """Raises InputError where a theme was typed and no picture is asked for."""
    refuse(context, "theme", because="without --plot nothing is drawn")


def is_typed(context: Context, name: str) -> bool:
    """Whether the option was given by the user."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"
