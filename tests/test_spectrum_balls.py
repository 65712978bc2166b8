"""Spectra in ball arithmetic: the ball holds what mpmath finds by another route."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, flint
from specrate.numerics.expected_spectra.coefficients import element_value
from specrate.numerics.expected_spectra.spectra import scaled_power
from specrate.numerics.expected_spectra.spectrum_balls import element_ball, scaled_power_ball
from specrate.numerics.integrands.protocol import mp
from specrate.theory.kernels import Alphabet
from specrate.theory.samplers import parse_sampler
from strategies import every_sampler, frequencies


def distance(ball, number):
    """|ball − number| over |number|, as an upper bound."""
    other = flint.arb(mp.nstr(number, mp.dps, strip_zeros=False))
    return float(abs((ball - other) / other).upper())


@given(every_sampler().filter(lambda s: s.counts_at is not None and s.dim <= 5), st.data())
def test_both_witnesses_agree(sampler, data):
    counts = sampler.counts_at(data.draw(st.integers(2, 10**6)))
    m = data.draw(frequencies(int(sampler.dim)))
    with mp.workdps(40), flint.ctx.workprec(160):
        ball = certified(lambda: scaled_power_ball(sampler, counts, m), 35)
        found = scaled_power(sampler, counts, m)
        assert ball == 0 if found == 0 else distance(ball, found) < 1e-33


def test_between_teeth_the_ball_is_exactly_zero():
    sampler, counts = parse_sampler("regular", 2), {"N": 49, "n": 7}
    assert scaled_power_ball(sampler, counts, (7, 3)) == 0
    assert scaled_power_ball(sampler, counts, (7, -14)) == 49


def test_counts_may_have_more_digits_than_the_precision():
    counts = {"N": 10**84, "s": 10**7}
    sampler, m = parse_sampler("multi-jitter", 12), (1,) + (0,) * 11
    ball = certified(lambda: scaled_power_ball(sampler, counts, m), 20)
    with mp.workdps(25), flint.ctx.workprec(120):
        assert distance(ball, mp.pi**2 / 3 * mp.mpf(10) ** -168) < 1e-18


def test_elements_with_pi():
    alphabet = Alphabet(("N", "n"))
    n_points, n = alphabet.count("N"), alphabet.count("n")
    element = (n.field.gens[0] * n_points - n**2) / (3 * n + 1)
    counts = {"N": 8, "n": 2}
    with mp.workdps(40), flint.ctx.workprec(160):
        assert distance(element_ball(element, counts), element_value(element, counts)) < 1e-38


@pytest.mark.parametrize("m", [(1 << 62, 1), (-(10**30) + 1, 10**30)])
def test_sines_keep_their_digits_at_far_frequencies(m):
    """N·P_S of jitter against 1 − ∏ sinc² at 200 digits."""
    sampler, counts = parse_sampler("jitter", 2), {"N": 49, "n": 7}
    ball = certified(lambda: scaled_power_ball(sampler, counts, m), 30)
    with mp.workdps(200):
        expected = 1 - mp.fprod((mp.sin(mp.pi * k / 7) / (mp.pi * k / 7)) ** 2 for k in m)
        with flint.ctx.workprec(300):
            assert distance(ball, expected) < 1e-29
