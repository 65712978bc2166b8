"""Sums of damped waves: the integrals along rays against plain sums and closed forms."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import exact_ball, flint, rational
from specrate.numerics.wave_sums import Envelope, wave_product, wave_sum, waves_of

Q = flint.fmpq
EXAMPLES = 8  # each takes some 100 ms


def trigonometric(sine, angle):
    return (flint.arb.sin_pi_fmpq if sine else flint.arb.cos_pi_fmpq)(2 * angle)


def term(m, waves, envelope):
    """e(m) times the waves, in ball arithmetic."""
    ball, turn = flint.arb(m), 2 * flint.arb.pi()
    exponent = -exact_ball(envelope.power) * ball.log()
    exponent -= (turn * exact_ball(envelope.sigma) * m) ** 2
    for beta, n in envelope.stretched:
        exponent -= (ball / n) ** exact_ball(beta)
    own = (w * trigonometric(s, h * m) / (turn * m) ** q for (q, s, h), w in waves.items())
    return sum(own, flint.arb(0)) * exponent.exp()


def plain_sum(first, last, waves, envelope):
    return sum((term(m, waves, envelope) for m in range(first, last)), flint.arb(0))


turns = st.one_of(
    st.fractions(-3, 3, max_denominator=12),
    st.integers(1, 10**9).map(lambda n: Fraction(1, n)),
)
waves = st.lists(
    st.tuples(st.integers(2, 4), st.booleans(), turns.map(rational), st.integers(-3, 3).map(Q)),
    min_size=1,
    max_size=3,
).map(waves_of)
envelopes = st.builds(
    Envelope,
    st.sampled_from([Fraction(0), Fraction(1, 2), Fraction(7, 4)]),
    st.sampled_from([Fraction(0), Fraction(0), Fraction(1, 100), Fraction(1), Fraction(9)]),
    st.lists(
        st.tuples(st.fractions(Fraction(1, 5), 2, max_denominator=5), st.integers(1, 10**6)),
        max_size=2,
    ).map(tuple),
)


@settings(max_examples=EXAMPLES)
@given(waves, envelopes, st.integers(1, 60), st.integers(1, 9))
def test_differences_are_plain_sums(found, envelope, first, terms):
    with flint.ctx.workprec(80):
        difference = wave_sum(first, found, envelope) - wave_sum(first + terms, found, envelope)
        error = difference - plain_sum(first, first + terms, found, envelope)
        assert error.contains(0)
        assert error.rad() < 1e-18


@pytest.mark.parametrize(
    "envelope",
    [
        Envelope(sigma=Fraction(1, 10)),
        Envelope(power=Fraction(-1), sigma=Fraction(1, 10)),
        Envelope(power=Fraction(3, 2), stretched=((Fraction(2), 3),)),
        Envelope(power=Fraction(5, 4), stretched=((Fraction(7, 4), 2), (Fraction(1), 3))),
    ],
)
@pytest.mark.parametrize("sine", [False, True])
def test_sums_that_end(envelope, sine):
    """Damped by exp(−3.9 m²/10²) or faster: 40 terms are all there is, to 1e-20."""
    found = waves_of([(0, sine, Q(1, 7), Q(2)), (1, False, Q(0), Q(-1))])
    with flint.ctx.workprec(90):
        error = wave_sum(1, found, envelope) - plain_sum(1, 60, found, envelope)
        assert abs(error) < 1e-20


@pytest.mark.parametrize("h", [Q(1, 3), Q(1, 10**6), Q(1, 10**25), Q(1, 2)])
def test_waves_of_powers_are_bernoulli_polynomials(h):
    """Σ cos 2πhm/(2πm)² = B_2(h)/4 and Σ sin 2πhm/(2πm)³ = B_3(h)/12."""
    for q, sine, denominator in ((2, False, 4), (3, True, 12)):
        expected = flint.fmpq_poly.bernoulli_poly(q)(h) / denominator
        with flint.ctx.workprec(150):
            found = wave_sum(1, waves_of([(q, sine, h, Q(1))]), Envelope())
            assert abs(found - flint.arb(expected)) < 1e-40


def test_the_same_sums_damped_by_next_to_nothing():
    """exp(−(m/n)²) with n = 10^40 moves Σ (2πm)^−4 by Σ m²/n² (2πm)^−4, by 1e-83 or so."""
    with flint.ctx.workprec(450):
        damped = wave_sum(
            1, waves_of([(4, False, Q(0), Q(1))]), Envelope(stretched=((Fraction(2), 10**40),))
        )
        moved = flint.arb(Q(1, 1440)) - damped
        expected = flint.arb(Q(1, 24)) / (2 * flint.arb.pi()) ** 2 / flint.arb(10) ** 80
        assert abs(moved / expected - 1) < 1e-20


@pytest.mark.parametrize("s", [Fraction(1), Fraction(1, 2), Fraction(5, 2)])
def test_sums_that_diverge_have_the_right_differences(s):
    """Σ_{3<=m<9} m^−s from ζ(s, 3) − ζ(s, 9), or −ψ(3) + ψ(9)."""
    found = waves_of([(0, False, Q(0), Q(1))])
    with flint.ctx.workprec(80):
        difference = wave_sum(3, found, Envelope(s)) - wave_sum(9, found, Envelope(s))
        assert abs(difference - plain_sum(3, 9, found, Envelope(s))) < 1e-20


@given(waves, waves, st.integers(1, 50))
def test_products_of_waves(first, second, m):
    with flint.ctx.workprec(80):
        both = term(m, first, Envelope()) * term(m, second, Envelope())
        assert abs(term(m, wave_product(first, second), Envelope()) - both) < 1e-18


def test_waves_are_brought_into_half_a_turn():
    assert waves_of([(2, False, Q(2, 3), Q(1)), (2, False, Q(-1, 3), Q(1))]) == {
        (2, False, Q(1, 3)): Q(2)
    }
    assert waves_of([(3, True, Q(2, 3), Q(1))]) == {(3, True, Q(1, 3)): Q(-1)}
    assert waves_of([(3, True, Q(5), Q(1)), (2, False, Q(1), Q(0))]) == {}
