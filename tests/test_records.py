"""Records are what `dataclasses.dataclass` makes of the same class."""

import copy
import dataclasses
import inspect
import pickle
from functools import cached_property

import pytest

from brdfguide import records

FROZEN = {"frozen": True}


def made_by(decorator, **how):
    @decorator(**how)
    class Thing:
        """A thing."""

        name: str
        size: float = 1.0
        parts: list = dataclasses.field(default_factory=list)
        said: str = dataclasses.field(default="", compare=False, repr=False)

        @cached_property
        def twice(self):
            return 2 * self.size

    return Thing


@pytest.mark.parametrize(
    "how", [{}, FROZEN, FROZEN | {"eq": False}, FROZEN | {"repr": False}, FROZEN | {"kw_only": True}]
)
def test_a_record_is_called_shown_and_compared_as_a_dataclass_is(how):
    ours, theirs = (made_by(each, **how) for each in (records.dataclass, dataclasses.dataclass))
    assert str(inspect.signature(ours)) == str(inspect.signature(theirs))
    assert [each.name for each in dataclasses.fields(ours)] == [each.name for each in dataclasses.fields(theirs)]
    given = {"name": "a", "size": 2.0}
    one, other = ours(**given), theirs(**given)
    assert vars(one) == vars(other) and dataclasses.asdict(one) == dataclasses.asdict(other)
    assert ("repr" in how) == (repr(one) != repr(other)) and one.twice == 4.0
    assert one.parts is not ours(**given).parts
    for changes in ({}, {"size": 3.0}, {"said": "so"}):
        equal = theirs(**given) == dataclasses.replace(other, **changes)
        assert (ours(**given) == dataclasses.replace(one, **changes)) == equal
    assert (one != other) and copy.copy(one).size == 2.0
    for wrong in ({}, {"nam": "a"}, {"name": "a", "sizes": 1}):
        with pytest.raises(TypeError, match=r"Thing.__init__\(\)"):
            ours(**wrong)
    if how.get("kw_only"):
        with pytest.raises(TypeError):
            ours("a")


def test_a_frozen_record_is_filed_under_its_values_and_keeps_them():
    @records.dataclass(frozen=True)
    class Point:
        """Two numbers."""

        x: float
        y: float = 0.0

        def __post_init__(self):
            if self.x < 0:
                raise ValueError

    class Named(Point):
        """One with attributes of its own."""

    assert len({Point(1.0), Point(1.0), Point(2.0)}) == 2 and repr(Point(1.0)).endswith("Point(x=1.0, y=0.0)")
    named = Named(1.0)
    named.name = "a"  # as of a frozen dataclass
    for one in (Point(1.0), named):
        for change in (lambda one=one: setattr(one, "x", 2.0), lambda one=one: delattr(one, "x")):
            with pytest.raises(dataclasses.FrozenInstanceError, match="field 'x'"):
                change()
    with pytest.raises(ValueError):
        Point(-1.0)

    for decorator in (records.dataclass, dataclasses.dataclass):

        @decorator(frozen=True)
        class Further(Point):
            """One with more fields."""

            z: float = 1.0

        further = Further(1.0, z=3.0)
        assert further.z == 3.0 and further == Further(1.0, 0.0, 3.0) and further != Point(1.0)
        with pytest.raises(dataclasses.FrozenInstanceError):
            further.z = 2.0


@records.dataclass(frozen=True)
class Kept:
    """Something in a file."""

    value: float


def test_a_record_is_pickled():
    assert pickle.loads(pickle.dumps(Kept(1.5))) == Kept(1.5)


def test_a_record_needs_no_keywords():
    @records.dataclass
    class Open:
        """A record that changes."""

        value: float = 1.0

    one = Open()
    one.value = 2.0
    assert one == Open(2.0) and Open.__hash__ is None


def test_nothing_is_compiled_before_the_first_object_is_made():
    ours = made_by(records.dataclass, frozen=True)
    assert not callable(vars(ours)["__init__"])
    ours("a")
    assert callable(vars(ours)["__init__"])
