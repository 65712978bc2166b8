"""Eq. 17 as a number: three independent routes agree inside their bounds, at any N."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics import radial
from specrate.numerics.balls import exact_number
from specrate.numerics.equation17.radial_estimates import by_mpmath
from specrate.numerics.equation17.radial_integrals import RadialProblem, solve
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError
from specrate.theory.symbolic import sympy

F = Fraction
small = st.fractions(F(1, 8), F(8), max_denominator=8)
problems = st.builds(
    lambda b, s, q, n, e, rho0, cont: RadialProblem(
        b, s, None if q is None else s + q, n, None, e, rho0=rho0, continuous=cont
    ),
    st.one_of(st.just(F(0)), small),
    st.integers(1, 12),
    st.one_of(st.none(), small),
    st.fractions(F(1), F(10) ** 40, max_denominator=1),
    st.fractions(F(0), F(1), max_denominator=12),
    st.fractions(F(1, 1000), F(1000), max_denominator=1000),
    st.booleans(),
)


def agree(first, second) -> bool:
    gap = abs(F(first.value.value) - F(second.value.value))
    return gap <= F(first.value.error_bound) + F(second.value.error_bound)


@given(problems)
def test_closed_form_and_quadrature_agree_inside_their_bounds(problem):
    assert agree(solve(problem, 25), solve(problem, 25, "quadrature"))


@settings(max_examples=10)
@given(problems)
def test_mpmath_agrees(problem):
    """An estimate: 12 digits of the 20 asked for."""
    exact = mp.mpf(solve(problem, 20).value.value)
    assert abs(by_mpmath(problem, 20).value - exact) <= mp.mpf(10) ** -12 * exact


@pytest.mark.parametrize("b", ["1/2", "1", "2", "3"])
@pytest.mark.parametrize("d", [1, 2, 3, 10])
def test_fifty_digits_at_1e30(b, d):
    problem = RadialProblem(F(b), d, F(d + 1), F(10) ** 30, None, F(1, d))
    closed, quadrature = solve(problem, 50), solve(problem, 50, "quadrature")
    assert agree(closed, quadrature)
    assert F(closed.value.error_bound) <= F(closed.value.value) * F(10) ** -49
    with mp.workdps(60):
        value = mp.mpf(closed.value.value)
        assert abs(by_mpmath(problem, 50).value / value - 1) < mp.mpf(10) ** -45


@pytest.mark.parametrize(
    ("arguments", "start"),
    [
        (("2", 2, "3", "1e30"), "1.9999999"),
        (("1000000000001/1000000000000", 1, "2", "log:5000"), "1.15144253986907e-9996"),
        (("1000000", 2, "3", "1e300"), "1.0000010000010000e-450"),
        (("1", 1000, "1001", "1e300"), "8.47895796059076"),
        (("2", 2, "oo", "1e6"), "2.5000"),
    ],
)
def test_stiff_and_extreme_cases(arguments, start):
    """b next to the tie, a step, N beyond every double, a thousand dimensions, the best case."""
    assert radial(*arguments, digits=17).value.value.startswith(start[:8])
    degree, dim, decay, n = arguments
    log_n = F(n[4:]) if n.startswith("log:") else None
    problem = RadialProblem(
        F(degree),
        dim,
        None if decay == "oo" else F(decay),
        None if log_n else F(n),
        log_n,
        F(1, dim),
    )
    assert agree(solve(problem, 17), solve(problem, 17, "quadrature"))


def test_leading_term_is_the_value_at_large_n():
    found = radial("2", 2, "3", "1e30", digits=30)
    assert found.leading is not None
    assert str(found.leading.order) == "N^(-3/2)"
    assert mp.mpf(found.value.value) * mp.mpf(10) ** 45 == pytest.approx(
        float(found.leading.constant), rel=1e-14
    )


def test_rho0_beyond_nu_has_not_begun_to_fall():
    """ρ0 = 1e12 ν: the variance is that of the saturated spectrum, ρ0^s/s + ρ0^s/q over N."""
    problem = RadialProblem(F(2), 2, F(3), F(4), None, F(1, 2), rho0=F(2 * 10**12))
    value = F(solve(problem, 30).value.value)
    assert abs(value * 4 / (F(2 * 10**12) ** 2 * F(3, 2)) - 1) < F(1, 10**20)


def test_a_value_of_one_has_the_logarithm_zero():
    """b = 0, s = 3, q = 3/2: V = 1/s + 1/q = 1, of whose logarithm no digit can be certain."""
    for route in ("closed", "quadrature"):
        found = solve(RadialProblem(F(0), 3, F(9, 2), F(1), None, F(1, 3)), 15, route)
        assert (F(found.value.value), found.log_value) == (1, "0")
    near = solve(RadialProblem(F(0), 3, F(9, 2), 1 - F(1, 10**20), None, F(1, 3)), 15)
    assert float(near.log_value) == pytest.approx(1e-20, rel=1e-14)


def test_powers_of_a_million_digits_stay_powers():
    """A step at ρ0 = 1e12: ρ0^b is never written out, nor is it in the constant."""
    found = radial("1000000", 2, "1000000000", "1e30", rho0="1e12")
    share = F(1, 10**6 + 2) + F(1, 10**9 - 2 - 10**6)  # below ρ0 and beyond, times 10^-3000006
    assert F(found.value.value.partition("e")[0]) == pytest.approx(share * 10**6, rel=1e-14)
    assert found.value.value.endswith("e-3000012")
    assert found.leading is not None
    assert len(str(found.leading.constant)) < 100
    small = radial("2", 2, "3", "1e6", alpha="2", rho0="3").leading
    assert small is not None
    assert str(small.constant) == "27"


@pytest.mark.parametrize(
    "arguments",
    [
        ("-1", 1, "2", "10"),
        ("1", 0, "2", "10"),
        ("1", 2, "2", "10"),
        ("1", 1, "2", "0"),
        ("1", 1, "2", "-5"),
        ("x", 1, "2", "10"),
        ("1", 1, "two", "10"),
        ("1", 1, "2", "log:x"),
        ("1", 1, "2", "log:1e5"),
        ("1e9999", 2, "3", "10"),
        ("1e-9999", 2, "3", "10"),
        ("2", 2, "1e9999", "10"),
        ("1", 1, "2", "1e99999"),
        ("1/0", 1, "2", "10"),
        ("nan", 1, "2", "10"),
    ],
)
def test_bad_numbers_are_refused_in_one_line(arguments):
    with pytest.raises(InputError) as caught:
        radial(*arguments)
    assert "\n" not in str(caught.value)
    assert "got" in str(caught.value)


@pytest.mark.parametrize("digits", [0, -3, 10_001])
def test_digits_have_a_range(digits):
    with pytest.raises(InputError, match="digits"):
        radial("1", 1, "2", "10", digits=digits)


@given(st.fractions(-(10**9), 10**9, max_denominator=10**6))
def test_numbers_are_read_exactly(number):
    assert exact_number(str(number), "x") == number


@pytest.mark.parametrize("decay", ["5", "16/3"])
@pytest.mark.parametrize("alpha", ["1/2", "13", "40"])
def test_without_growth_the_leading_term_is_the_whole(alpha, decay):
    """e = 0: ν stands still, below ρ0 or above it, also at b = q (p = 16/3) with its logarithm."""
    numbers = {"effective": "0", "gamma": "0.3", "alpha": alpha, "rho0": "13", "digits": 30}
    found = radial("7/3", 3, decay, "7", **numbers)
    assert found.leading is not None
    assert (found.leading.order.exponent, found.leading.order.log_power) == (1, 0)
    difference = (found.leading.constant / 7).evalf(40) - sympy.Float(found.value.value, 40)
    assert abs(difference) <= float(found.value.error_bound)
