"""Assertions on designs: wrong and faulty samplers fail with their witness, right ones pass."""

import sys

import numpy as np
import pytest
from specrate.numerics import testing
from specrate.numerics.testing import assert_design, word_of
from specrate.theory.errors import InputError


def right(n, dim, rng):
    """Jitter on the line."""
    return (np.arange(n)[:, None] + rng.random((n, dim))) / n


def wrong(n, dim, rng):
    return rng.random((n, dim))


class Holder:
    @staticmethod
    def inside(n, dim, rng):
        return rng.random((n, dim))


def test_a_correct_sampler_passes():
    """False alarm 1e-5: the level of a check; the seed is fixed."""
    assert assert_design(right, 1, ["jitter"], budget=20)["verdict"] == "consistent"


def test_a_wrong_sampler_fails_with_its_witness():
    with pytest.raises(AssertionError) as raised:
        assert_design(wrong, 1, ["jitter"], budget=20)
    first, second = str(raised.value).splitlines()[:2]
    assert first == "wrong in 1D is contradicted"
    assert second.startswith("claim jitter FAILS: N P_S(m) at m = (1), N = 16: measured [")


def test_a_local_function_is_drawn_in_this_process():
    calls = []

    def local(n, dim, rng):
        calls.append(n)
        return right(n, dim, rng)

    assert word_of(local) is None
    found = assert_design(local, 1, ["jitter"], budget=20)
    assert found["verdict"] == "consistent"
    assert set(calls) >= set(map(int, found["plan"]["frequencies"]))


def test_a_lambda_fails_with_its_witness():
    with pytest.raises(AssertionError, match=r"lambda> in 1D is contradicted\nclaim jitter FAILS"):
        assert_design(lambda n, dim, rng: rng.random((n, dim)), 1, ["jitter"], budget=20)


def test_a_claimed_rate_is_judged_in_this_process():
    """Independent points against N^-3, on a ladder of five N."""
    with pytest.raises(AssertionError, match=r"claim axis/best ~ 3 FAILS: chi\^2 of the exponent"):
        assert_design(lambda n, dim, rng: rng.random((n, dim)), 1, ["axis/best ~ 3"], budget=20)


@pytest.mark.parametrize(
    ("sampler", "line"),
    [
        (lambda n, dim, rng: np.random.random((n, dim)), "fault global random state"),
        (lambda n, dim, rng: rng.random((n, dim)) + 0.5, "fault outside: coordinates must lie"),
        (lambda n, dim, rng: rng.random((n, dim + 1)), "fault shape: a realisation must have"),
        (lambda n, dim, rng: (right(n, dim, rng) * n // 1) / n, "fault quantised coordinates"),
    ],
)
def test_faults_fail(sampler, line):
    with pytest.raises(AssertionError) as raised:
        assert_design(sampler, 1, ["jitter"], budget=20)
    assert any(x.startswith(line) for x in str(raised.value).splitlines())


def test_undecided_fails_only_if_strict():
    few = {"budget": 1e-9, "seed": 3}
    assert assert_design("jitter", 2, ["jitter"], **few)["verdict"] == "inconclusive"
    with pytest.raises(AssertionError, match="jitter in 2D is inconclusive\nclaim jitter is undec"):
        assert_design("jitter", 2, ["jitter"], **few, strict=True)


def test_words_are_taken_as_a_check_takes_them():
    with pytest.raises(AssertionError, match="random in 1D is contradicted"):
        assert_design("random", 1, ["jitter"], budget=20)


def test_names_by_which_another_interpreter_finds_a_function():
    assert word_of(right) == f"py:{__name__}:right"
    assert word_of(Holder.inside) == f"py:{__name__}:Holder.inside"
    assert word_of(lambda n, dim, rng: rng.random((n, dim))) is None
    assert word_of(Holder()) is None


def test_a_module_that_cannot_be_imported_is_named_by_its_file(monkeypatch):
    monkeypatch.setitem(sys.modules, "unfindable", sys.modules[__name__])
    monkeypatch.setattr(right, "__module__", "unfindable")
    assert word_of(right) == f"py:{__file__}:right"


def test_what_cannot_be_checked_is_refused():
    with pytest.raises(InputError, match="a claim is"):
        assert_design(lambda n, dim, rng: rng.random((n, dim)), 1, ["no such claim"])
    with pytest.raises(InputError, match="positive number of seconds"):
        assert_design(lambda n, dim, rng: rng.random((n, dim)), 1, ["random"], budget=0)


@pytest.mark.parametrize("claims", [["jitter"], []])
def test_a_check_that_measured_nothing_fails_in_one_line(claims):
    """A billionth of a second is over before the child's interpreter runs."""
    with pytest.raises(AssertionError) as raised:
        assert_design(right, 1, claims, budget=1e-9)
    told = str(raised.value)
    rule = "right in 1D must be measured within a budget of 1e-09 s: got nothing, "
    assert told == rule + "the sampler was being loaded when the budget was spent"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((right, 1, "jitter"), "claims must be a list of texts: got 'jitter'"),
        ((right, 1, ["jitter", 3]), "claims must be a list of texts: got ['jitter', 3]"),
        ((lambda n, dim, rng: rng, "1", ["jitter"]), "must be a whole number: got '1'"),
        ((right, "2", ["jitter"]), "the dimension must be a whole number: got '2'"),
        ((right, 0, ["jitter"]), "the dimension must be at least 1: got 0"),
        (
            (None, 1, ["jitter"]),
            "a sampler must be a function, a word or a list of words: got None",
        ),
        (([right], 1, ["jitter"]), "a sampler must be a function, a word or a list of words: got"),
    ],
)
def test_arguments_of_another_type_are_refused(arguments, told):
    with pytest.raises(InputError) as raised:
        assert_design(*arguments)
    assert told in str(raised.value)


def test_strategies_are_offered_here_too():
    assert {"layouts", "integrands", "counts"} <= set(testing.__all__)
