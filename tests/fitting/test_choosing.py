"""Which model is recommended: ties by the data, closeness to the eye or by a percentage, and what is said of it."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.finding import Finding
from brdfguide.fitting import choosing, fit, ranking
from brdfguide.fitting.fit import FitOptions
from brdfguide.fitting.ranked import Row

from .. import synthetic
from .test_ranking import Cost, as_fit, plastic

LOBES = ("lambertian+he-torrance", "lambertian+ggx", "lambertian+ward")
ORDER = {"lambertian+he-torrance": 3.0, "lambertian+ggx": 2.0, "lambertian+ward": 1.0}
COST = {"lambertian+he-torrance": 600.0, "lambertian+ggx": 100.0, "lambertian+ward": 40.0}


def rows(errors, seen, tied=(True, False, False), cost=None) -> list[Row]:
    """Three rows in order of error, each dearer than the next."""
    names = sorted(LOBES, key=lambda name: -(cost or COST)[name])
    return [
        Row(
            replace(as_fit(np.full((4, 1), error), name, free=4 - place), rms_ln=error),
            place + 1,
            tie,
            error,
            {},
            {"ln": error, "seen": s},
            error - errors[0],
            0.01,
            1.0,
            Cost(COST[name]),
        )
        for place, (name, error, s, tie) in enumerate(zip(names, errors, seen, tied, strict=True))
    ]


def recommended(rows, close):
    made = ranking.Ranking(tuple(rows), rows[0], "", "ln", 0.0, {}, close=close)
    return choosing.recommending(made, plastic())


def test_what_looks_alike_may_be_cheaper():
    found = recommended(rows((0.05, 0.10, 0.30), (1.0, 2.0, 6.0)), "look")
    assert found.recommended.fit.name == "lambertian+ggx"
    assert [row.close for row in found.rows] == [True, True, False]
    assert (
        "looks close enough to lambertian+he-torrance (S 2 against 1 L*; typically 11 % off instead of 5.1 %)"
        in found.because
    )
    assert "has 1 fewer parameter and is cheaper" in found.because


def test_within_a_quarter_of_the_best_is_close_where_all_differ():
    found = recommended(rows((0.05, 0.10, 0.30), (5.0, 6.2, 6.3)), "look")
    assert found.recommended.fit.name == "lambertian+ggx" and not found.rows[2].close


def test_what_is_seen_to_differ_is_not_close():
    found = recommended(rows((0.05, 0.10, 0.30), (1.0, 2.6, 6.0)), "look")
    assert found.recommended.fit.name == "lambertian+he-torrance" and "least error" in found.because


def test_what_looks_alike_but_misses_by_far_more_is_not_close():
    found = recommended(rows((0.10, 0.14, 0.16), (1.0, 1.5, 2.0)), "look")
    assert [row.close for row in found.rows] == [True, True, False]
    assert found.recommended.fit.name == "lambertian+ggx"


def test_what_is_seen_to_be_closer_goes_before_less_error():
    """Whether simpler or not; and where the best looks different, also for half as much error again."""
    found = recommended(rows((0.22, 0.24, 0.26), (7.9, 5.3, 5.2)), "look")
    assert found.recommended.fit.name == "lambertian+ward"
    assert found.because.startswith("looks closer than lambertian+he-torrance (S 5.2 against 7.9 L*; typically")
    assert recommended(rows((0.22, 0.30, 0.60), (7.9, 5.2, 5.2)), "look").recommended.rms_ln == 0.22
    assert recommended(rows((0.22, 0.30, 0.60), (8.1, 5.2, 5.2)), "look").recommended.rms_ln == 0.30
    assert recommended(rows((0.22, 0.24, 0.26), (2.4, 1.1, 1.0)), "look").recommended.rms_ln == 0.26, "as cheaper"
    metrology = recommended(rows((0.22, 0.24, 0.26), (7.9, 5.3, 5.2)), "none")
    assert metrology.recommended.fit.name == "lambertian+he-torrance"


def test_metrology_takes_ties_alone():
    found = recommended(rows((0.05, 0.051, 0.052), (1.0, 1.0, 1.0)), "none")
    assert found.recommended.fit.name == "lambertian+he-torrance" and not any(row.close for row in found.rows)
    tied = recommended(rows((0.05, 0.051, 0.052), (1.0, 1.0, 1.0), tied=(True, True, False)), "none")
    assert tied.recommended.fit.name == "lambertian+ggx" and "cannot be told from" in tied.because


def test_a_percentage_of_error_is_close_whatever_it_looks_like():
    found = recommended(rows((0.05, 0.058, 0.062), (1.0, 9.0, 9.0)), "1%")
    assert found.recommended.fit.name == "lambertian+ggx"
    assert found.because.startswith("close enough to lambertian+he-torrance, typically 6 % off instead of 5.1 %")


def test_the_answer_says_whether_it_was_a_tie_or_closeness():
    tie = recommended(rows((0.05, 0.06, 0.30), (1.0, 2.0, 6.0), tied=(True, True, False)), "look")
    assert "cannot be told from lambertian+he-torrance by these data" in tie.because


def test_of_those_that_cost_alike_the_one_that_ties_is_taken(monkeypatch):
    monkeypatch.setitem(COST, "lambertian+he-torrance", 110.0)
    tie = recommended(rows((0.05, 0.06, 0.09), (1.0, 2.0, 2.4), tied=(True, False, False), cost=ORDER), "look")
    assert tie.recommended.fit.name == "lambertian+ward"
    monkeypatch.setitem(COST, "lambertian+ward", 95.0)
    tie = recommended(rows((0.05, 0.06, 0.09), (1.0, 2.0, 2.4), tied=(True, False, False), cost=ORDER), "look")
    assert tie.recommended.fit.name == "lambertian+he-torrance"


def test_of_as_many_numbers_what_errs_much_less_goes_before_what_is_merely_cheaper():
    best, *near = rows((0.018, 0.027, 0.068), (0.1, 0.5, 1.6))
    assert recommended([best, *near], "look").recommended.fit.name == "lambertian+ward", "it has a number less"
    near = [replace(row, fit=replace(row.fit, free=3)) for row in near]
    found = recommended([best, *near], "look")
    assert found.recommended.fit.name == "lambertian+ggx"
    assert "; lambertian+ward takes 2.5 times fewer operations, but is typically 7 % off" in found.because


def test_what_is_many_times_cheaper_may_err_much_more_and_so_may_what_noise_leaves_open(monkeypatch):
    best, *near = rows((0.018, 0.027, 0.068), (0.1, 0.5, 1.6))
    near = [replace(row, fit=replace(row.fit, free=3)) for row in near]
    assert recommended([best, *near], "look").recommended.fit.name == "lambertian+ggx"
    vague = [replace(row, behind_se=0.015) for row in near]
    assert recommended([best, *vague], "look").recommended.fit.name == "lambertian+ward"
    monkeypatch.setitem(COST, "lambertian+ward", 20.0)
    near = [replace(row, cost=Cost(COST[row.fit.name])) for row in near]
    assert recommended([best, *near], "look").recommended.fit.name == "lambertian+ward"


def test_the_eye_breaks_a_tie_that_the_data_leave():
    tie = recommended(rows((0.05, 0.06, 0.07), (4.0, 5.9, 6.1), tied=(True, True, True)), "look")
    assert tie.recommended.fit.name == "lambertian+ggx"
    assert (
        "; lambertian+ward cannot be told from lambertian+he-torrance by these data, but would be seen" in tie.because
    )
    metrology = recommended(rows((0.05, 0.06, 0.07), (4.0, 5.9, 6.1), tied=(True, True, True)), "none")
    assert metrology.recommended.fit.name == "lambertian+ward"


def test_what_cannot_be_trusted_is_never_close():
    made = rows((0.05, 0.08, 0.10), (1.0, 1.0, 2.0))
    made[1] = replace(made[1], warnings=(Finding("imitates", "spikes", "warning"),))
    found = recommended(made, "look")
    assert not found.rows[1].close and found.recommended.fit.name == "lambertian+ward"


def test_where_even_the_best_is_seen_to_differ_it_is_said():
    found = recommended(rows((0.05, 0.10, 0.30), (8.1, 9.0, 20.0)), "look")
    assert "no single model looks right: the best, lambertian+he-torrance, is 8.1 L*" in found.warnings[0].text
    assert not recommended(rows((0.05, 0.10, 0.30), (7.9, 9.0, 20.0)), "look").warnings


def test_recommending_twice_says_nothing_twice():
    found = recommended(rows((0.05, 0.10, 0.30), (8.1, 9.0, 20.0)), "look")
    assert choosing.recommending(found, plastic()).warnings == found.warnings


@pytest.mark.parametrize("close", ["1", "0%", "-3%", "200%", "alike", "%", ""])
def test_other_words_are_refused(close):
    with pytest.raises(InputError, match="wanted look, none, or a percentage such as 1%"):
        choosing.check_close(close)


@pytest.mark.parametrize("close", ["look", "none", "1%", "0.5%"])
def test_known_words_are_taken(close):
    choosing.check_close(close)


# --- order by look ---------------------------------------------------------------------------------------


def test_the_metric_seen_orders_the_fits_of_ln():
    data = plastic(synthetic.hemisphere(400), noise=0.05, seed=3)
    found = {}
    for metric in ("ln", "seen"):
        options = FitOptions(metric=metric)
        found[metric] = ranking.rank(fit.fit_all(map(models.get, LOBES), data, options), data, options)
    errors = {name: {row.fit.name: row.rms_ln for row in each.rows} for name, each in found.items()}
    assert errors["ln"] == errors["seen"], "the loss stays ln"
    order = [row.seen for row in found["seen"].rows]
    assert order == sorted(order) and found["seen"].seen_weights == "neighbours"


def test_a_winner_to_the_eye_is_the_one_in_ln_unless_a_quarter_is_between_them():
    data = plastic(noise=0.05, seed=3)
    fits = fit.fit_all(map(models.get, ("lambertian+ggx", "lambertian+beckmann")), data)
    assert ranking.rank(fits, data).winners["seen"] == "lambertian+ggx"
