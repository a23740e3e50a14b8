"""Dataclasses of which nothing is compiled before the first object is made.

`dataclasses.dataclass` compiles up to six functions for each class as the class is defined: of the fifty that answer a
described surface that was a seventh of all instructions. Here one is compiled, `__init__`, when it is first wanted; the
others are the same few closures for all. Otherwise such a class is what `dataclasses.dataclass` makes, but for `order`,
`slots`, and fields that `__init__` does not take.
"""

import dataclasses
from operator import attrgetter
from types import MethodType

TYPE_CHECKING = False  # true for type checkers and editors
if TYPE_CHECKING:
    from dataclasses import dataclass
else:

    def dataclass(cls=None, /, *, frozen=False, eq=True, repr=True, kw_only=False):
        """As `dataclasses.dataclass` with these keywords."""

        def made(cls):
            below = frozen and any(_is_frozen(base) for base in cls.__bases__)  # to be frozen by the same means
            dataclasses.dataclass(init=False, repr=False, eq=False, frozen=below, kw_only=kw_only)(cls)
            cls.__dataclass_params__.frozen, given = frozen, vars(cls)
            own = {"__init__": _Init(cls)}
            if repr:
                own["__repr__"] = _repr
            if eq:
                own |= _comparison(cls, frozen)
            if frozen:
                own |= _frozen(cls)
            for name, value in own.items():
                if given.get(name) is None:
                    setattr(cls, name, value)
            return cls

        return made if cls is None else made(cls)


def _is_frozen(cls: type) -> bool:
    return getattr(getattr(cls, "__dataclass_params__", None), "frozen", False)


class _Factory:
    """Stands in a signature for what is made anew."""

    def __repr__(self) -> str:
        return "<factory>"


_FACTORY = _Factory()


class _Init:
    """Stands for `__init__` until somebody asks for it."""

    def __init__(self, owner: type):
        self.owner = owner

    def __get__(self, one, _=None):
        function = _compiled(self.owner)
        type.__setattr__(self.owner, "__init__", function)
        return function if one is None else MethodType(function, one)


def _compiled(owner):
    """`__init__` of a class from its fields."""
    known: dict = {"FACTORY": _FACTORY}
    first, named, lines = ["self"], ["*"], []
    for each in dataclasses.fields(owner):
        name, default = each.name, ""
        value = name
        if each.default is not dataclasses.MISSING:
            known[f"default_{name}"], default = each.default, f"=default_{name}"
        elif each.default_factory is not dataclasses.MISSING:
            known[f"make_{name}"], default = each.default_factory, "=FACTORY"
            value = f"make_{name}() if {name} is FACTORY else {name}"
        (named if each.kw_only else first).append(name + default)
        lines.append(f" _own[{name!r}] = {value}")
    if hasattr(owner, "__post_init__"):
        lines.append(" self.__post_init__()")
    words = ", ".join(first + named if len(named) > 1 else first)
    exec("\n".join([f"def __init__({words}):", " _own = self.__dict__", *lines]), known)
    function = known["__init__"]
    function.__qualname__, function.__module__ = f"{owner.__qualname__}.__init__", owner.__module__
    function.__annotations__ = {each.name: each.type for each in dataclasses.fields(owner)} | {"return": None}
    return function


def _repr(self) -> str:
    shown = (f"{each.name}={getattr(self, each.name)!r}" for each in dataclasses.fields(self) if each.repr)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _comparison(cls, frozen: bool) -> dict:
    """Equality by the values of fields, and with it what such an object is filed under."""
    names = [each.name for each in dataclasses.fields(cls) if each.compare]
    values = attrgetter(*names) if len(names) > 1 else lambda self: tuple(getattr(self, name) for name in names)

    def __eq__(self, other):
        return values(self) == values(other) if type(other) is type(self) else NotImplemented

    def __hash__(self):
        return hash(values(self))

    return {"__eq__": __eq__, "__hash__": __hash__ if frozen else None}


def _frozen(cls) -> dict:
    """Fields are set once; a subclass may have other attributes."""
    names = cls.__dataclass_fields__

    def __setattr__(self, name, value):
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self, name):
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}
