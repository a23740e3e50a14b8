from brdfguide.numerics import pareto


def test_front_holds_those_that_none_beats_in_both():
    points = {"cheap": (1.0, 9.0), "good": (9.0, 1.0), "middle": (5.0, 5.0), "poor": (6.0, 6.0), "slow": (20.0, 1.0)}
    unbeaten = pareto.on_front(list(points.values()))
    assert {name for name, best in zip(points, unbeaten, strict=True) if best} == {"cheap", "good", "middle"}


def test_equal_points_stand_on_the_front_together():
    assert pareto.on_front([(1.0, 2.0), (1.0, 2.0), (2.0, 2.0)]) == [True, True, False]
    assert pareto.on_front([]) == []
