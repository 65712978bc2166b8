"""Ball arithmetic: the digits asked for are certified, and no bound is smaller than the error."""

import signal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball, flint, integrated, spelled
from specrate.theory.errors import InputError


@given(st.fractions(), st.integers(1, 60))
def test_spelled_bound_holds_the_exact_value(number, digits):
    found = spelled(exact_ball(number), digits)
    error = abs(Fraction(found.value) - number)
    assert error <= Fraction(found.error_bound)


def test_certified_raises_the_precision_until_the_digits_stand():
    """1 − cos(1e-40) loses 80 digits to cancellation, and none to the caller."""

    def evaluate():
        return 1 - exact_ball(Fraction(1, 10**40)).cos()

    assert spelled(certified(evaluate, 30), 30).value.startswith("5.0000000000000000000000000000")


def test_certified_restores_the_precision():
    before = flint.ctx.prec
    certified(lambda: flint.arb.pi(), 100)
    assert flint.ctx.prec == before


def test_a_ball_that_never_narrows_is_refused():
    with pytest.raises(InputError, match="no convergence"):
        certified(lambda: flint.arb(0).union(flint.arb(1)), 5)


def test_an_integral_is_a_ball():
    """∫ sin over (0, π) = 2."""
    total = integrated(lambda x, analytic: x.sin(), 0, flint.arb.pi())
    assert total.contains(2)
    assert total.rad() < 1e-13


@pytest.mark.parametrize("error", [KeyboardInterrupt, InputError])
def test_what_an_integrand_raises_is_raised(error):
    """Compiled code goes on past an exception; its value must not come back."""
    calls = 0

    def integrand(x, analytic):
        nonlocal calls
        calls += 1
        if calls == 3:
            raise error("stop")
        return x

    with pytest.raises(error, match="stop"):
        integrated(integrand, 0, 1)
    assert calls == 3


def test_an_interrupt_ends_an_integral_and_its_value_is_not_used():
    calls = 0

    def integrand(x, analytic):
        nonlocal calls
        calls += 1
        if calls == 3:
            signal.raise_signal(signal.SIGINT)
        return x

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        integrated(integrand, 0, 1)
    assert calls == 3
    assert signal.getsignal(signal.SIGINT) is before
