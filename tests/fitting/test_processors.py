"""A ranking does not hang on the processor: with the plainest instructions it has the same words, and nine digits."""

from benchmarks.processors import PLAIN, answer, apart

FILES = ["examples/white_paper.csv"]


def test_the_plainest_instructions_give_the_same_ranking_to_nine_digits():
    models = ("-m", "lambertian+he-torrance")
    for one, other in zip(answer(FILES, {}, *models), answer(FILES, PLAIN, *models), strict=True):
        assert [each for each in apart(one["ranking"], other["ranking"]) if each[0] > 1e-9] == []
        assert one["ranking"] and one["recommended"] == other["recommended"]


def test_a_difference_is_found_wherever_it_is():
    one = {"a": [1.0, {"b": 2.0}], "c": "word", "digest": "x"}
    assert apart(one, {"a": [1.0, {"b": 2.0}], "c": "word", "digest": "y"}) == []
    assert apart(one, {"a": [1.0, {"b": 2.2}], "c": "words", "digest": "x"}) == [
        (abs(2.0 - 2.2) / 2.2, "/a/1/b"),
        (float("inf"), "/c"),
    ]
