"""Estimates of Eq. 17: their errors are what they say, wherever the problem is stiff."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.equation17.radial_estimates import (
    FINEST,
    Estimate,
    by_doubles,
    by_mpmath,
    by_scipy,
)
from specrate.numerics.equation17.radial_integrals import RadialProblem, solve
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError

F = Fraction

scales = st.one_of(
    st.integers(-40, 40).map(lambda k: F(10) ** k),
    st.fractions(F(1, 1000), F(1000), max_denominator=1000),
)
small = st.fractions(F(1, 8), F(8), max_denominator=8)
nudges = st.integers(1, 25).map(lambda k: F(1, 10**k))


@st.composite
def stiff(draw) -> RadialProblem:
    """b anywhere, next to q or a step; any scales; N from 1 to 1e300, or 1e5000 by its log."""
    s, q = draw(st.sampled_from([1, 2, 3, 10, 1000])), draw(st.one_of(small, st.just(F(1, 10**6))))
    nudge = draw(nudges)
    b = draw(st.sampled_from([F(0), q, q + nudge, max(q - nudge, F(0)), F(10**6), draw(small)]))
    log10_n = draw(st.one_of(st.none(), st.sampled_from([F(0), F(30), F(5000), F(-7, 3)])))
    return RadialProblem(
        b,
        s,
        draw(st.sampled_from([None, s + q, s + q])),
        F(10) ** draw(st.integers(0, 300)) if log10_n is None else None,
        log10_n,
        draw(st.sampled_from([F(1, s), F(0), F(1)])),
        draw(scales),
        draw(scales),
        draw(scales),
        draw(st.booleans()),
    )


def misses(problem: RadialProblem, found: Estimate, digits: int = 60) -> float:
    """The true error over the estimated one: honest up to 1."""
    with mp.workdps(digits + 10):
        truth = mp.mpf(solve(problem, digits).value.value)
        return float(abs(found.value - truth) / found.error)


@given(stiff())
def test_doubles_are_honest(problem):
    assert misses(problem, by_doubles(problem)) <= 1


@given(stiff())
def test_scipy_is_honest(problem):
    assert misses(problem, by_scipy(problem)) <= 1


@settings(max_examples=10)
@given(stiff(), st.sampled_from([5, 15, 30]))
def test_mpmath_is_honest_and_has_its_digits(problem, digits):
    found = by_mpmath(problem, digits)
    assert misses(problem, found) <= 1
    assert found.error <= mp.mpf(10) ** (1 - digits) * found.value


@given(stiff())
def test_doubles_estimate_no_more_than_the_input_costs(problem):
    """A few units in the last place of b log(ν/ρ0), log N and the like: no blanket allowance."""
    found = by_doubles(problem)
    logs = abs(mp.log(found.value)) + 700 * (1 + problem.degree + problem.dimension)
    log_n = 12000 if problem.log10_n else 700
    allowed = 2.0**-52 * 200 * (float(logs) + log_n * (1 + float(problem.degree)))
    assert mp.log1p(found.error / found.value) <= allowed


def test_a_step_of_the_logarithm_is_no_step_of_the_value():
    """Left and right of b = q and of ρ0 = ν the values meet: no branch is off."""
    ties = [_problem(b=1 + F(k, 10**9)) for k in (-1, 0, 1)]
    meets = [_problem(rho0=10**3 * (1 + F(k, 10**9))) for k in (-1, 0, 1)]
    for problems in (ties, meets):
        values = [by_doubles(p).value for p in problems]
        assert all(abs(x / y - 1) < 1e-7 for x, y in pairwise(values))
        assert values[0] != values[2]


def _problem(b=2, rho0=1) -> RadialProblem:
    return RadialProblem(F(b), 2, F(3), F(10**6), None, F(1, 2), rho0=F(rho0))


def test_a_coarse_tolerance_is_reported_as_coarse():
    coarse, fine = by_scipy(_problem(), 1e-3), by_scipy(_problem(), FINEST)
    assert coarse.error > 1000 * fine.error
    assert misses(_problem(), coarse) <= 1


@pytest.mark.parametrize("tolerance", [0.0, 1e-15, 1.0, -1.0, float("nan")])
def test_tolerances_have_a_range(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        by_scipy(_problem(), tolerance)


def test_what_no_double_holds_is_refused():
    huge = RadialProblem(F(10) ** 400, 1, F(2), F(10), None, F(1))
    for method in (by_doubles, by_scipy):
        with pytest.raises(InputError, match="double precision"):
            method(huge)
