"""Power sums of factors: against brute sums and each other, their balls at every precision."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp
from specrate.numerics.balls import certified, flint, rational
from specrate.numerics.integrands import parse_integrand, polylog
from specrate.numerics.integrands.gaussian import (
    GaussianFactor,
    _smoothed_images,
    _smoothed_waves,
    _total_images,
    _total_waves,
)
from specrate.numerics.integrands.polylog import PolylogFactor
from specrate.numerics.integrands.protocol import to_mpf
from specrate.numerics.integrands.spline import cosine_sum
from specrate.theory.errors import InputError

ONE_D = [
    "ball",
    "box:side=0.3",
    "box:side=1/3",
    "half-space:side=0.9",
    "bernoulli:k=1",
    "bernoulli:k=2",
    "bernoulli:k=4",
    "product:k=2,c=-3",
    "additive:k=3",
    "polylog:p=2",
    "polylog",
    "polylog:p=3",
    "polylog:p=7.3",
    "gaussian",
    "gaussian:sigma=0.01",
    "gaussian:sigma=1/20",
    "gaussian:sigma=2",
]


def factor_of(text):
    """The one factor of a one-dimensional integrand."""
    ((_, factor),) = parse_integrand(text, 1).parts[0]
    return factor


def at_precision(bits, evaluate):
    """``evaluate()`` with ``bits`` bits in force."""
    before, flint.ctx.prec = flint.ctx.prec, bits
    try:
        return evaluate()
    finally:
        flint.ctx.prec = before


def test_cosine_sum_is_the_zeta_value_and_the_series():
    for k in (1, 2, 5):
        zeta = 2 * flint.arb(2 * k).zeta() / (2 * flint.arb.pi()) ** (2 * k)
        assert zeta.overlaps(flint.arb(cosine_sum(k, flint.fmpq(0))))
    j = np.arange(1, 3000)
    series = np.sum(2 * np.cos(2 * np.pi * j * 0.3) / (2 * np.pi * j) ** 6)
    assert float(flint.arb(cosine_sum(3, flint.fmpq(-7, 10)))) == pytest.approx(series, rel=1e-12)


@pytest.mark.parametrize("text", ONE_D)
def test_power_sums_against_brute_sums(text):
    """Over |m| < M = 2e5: the rest is at most ``c/M`` (total, combs) or ``c n^2/M^3`` (sinc^2)."""
    factor = factor_of(text)
    size = 200_000
    m = np.arange(1, size)
    power = 2 * factor.power(m)
    jump2 = float(np.max(m**2.0 * power)) if "gaussian" not in text else 0.0
    rounding = 1e-12 * float(np.sum(power))
    tail = 2 * jump2 / size + rounding
    smooth_tail = 2 * jump2 * 100**2 / size**3 + rounding
    assert abs(float(factor.power_sum()) - np.sum(power)) < tail
    for n in (1, 2, 7, Fraction(15, 2), Fraction(2, 5), 100):
        brute = np.sum(power * np.sinc(m / float(n)) ** 2)
        assert abs(float(factor.power_sum(count=n)) - brute) < smooth_tail
    for n in (1, 3, 10):
        assert abs(float(factor.power_sum(n)) - np.sum(power[n - 1 :: n])) < tail
        for n2 in (1, 2, 30, 31, 100, Fraction(15, 2)):
            brute = np.sum((power * np.sinc(m / float(n2)) ** 2)[n - 1 :: n])
            assert abs(float(factor.power_sum(n, n2)) - brute) < smooth_tail


@given(
    st.sampled_from([*ONE_D, "polylog:p=6/5", "gaussian:sigma=1e-9", "gaussian:sigma=1e6"]),
    st.sampled_from([1, 2, 3, 50, 1000, 10**20]),
    st.one_of(st.none(), st.integers(1, 40), st.integers(1, 10**60)),
    st.integers(10, 200),
)
def test_balls_hold_the_sum_at_every_precision(text, comb, count, bits):
    """A ball of few bits holds what a thousand bits more give, of which it is an enclosure."""
    factor = factor_of(text)
    coarse, fine = (
        at_precision(b, lambda: factor.power_sum(comb, count)) for b in (bits, 1000 + bits)
    )
    assert coarse.overlaps(fine)
    assert fine.is_exact() or fine.rad() < coarse.rad()


@pytest.mark.parametrize("bits", [30, 300])
@given(
    st.fractions(Fraction(1, 50), Fraction(1, 4), max_denominator=1000),
    st.fractions(Fraction(1, 100), 3, max_denominator=100).filter(lambda h: h.denominator > 1),
)
def test_gaussian_sums_over_waves_and_over_images_are_equal(bits, sigma, step):
    """Two formulas with two truncations.

    Power: with balls of the rounding errors alone, without the bounds of what is cut off, both
    precisions fail.
    """
    waves, images = (
        at_precision(bits, lambda f=f: f(sigma)) for f in (_total_waves, _total_images)
    )
    assert waves.overlaps(images)
    waves, images = (
        at_precision(bits, lambda f=f: f(sigma, step)) for f in (_smoothed_waves, _smoothed_images)
    )
    assert waves.overlaps(images)
    if bits == 300:
        assert waves.rel_accuracy_bits() > 250


def by_polylogarithm(p, step):
    """n²/π² (ζ(p+2) − Re Li_(p+2)(e^(2πi/n))) by the library's own polylogarithm, 400 bits."""

    def evaluate():
        h, s = flint.arb(rational(step)), flint.arb(rational(p + 2))
        sine, cosine = flint.arb.sin_cos_pi_fmpq(rational(2 * step))
        li = flint.acb(cosine, sine).polylog(s).real
        return (s.zeta() - li) / (flint.arb.pi() * h) ** 2

    return at_precision(400, evaluate)


@given(st.fractions(Fraction(11, 10), 12, max_denominator=50), st.fractions(Fraction(1, 1000), 2))
def test_polylogarithm_sums_against_polylogarithms(p, step):
    found = certified(lambda: PolylogFactor(p).power_sum(count=1 / step), 15)
    if step.denominator == 1:
        assert found.is_zero()
    else:
        assert by_polylogarithm(p, step).overlaps(found)


@pytest.mark.parametrize(
    "p", [Fraction(6, 5), Fraction(5, 2), Fraction(3), Fraction(4), Fraction(9)]
)
@pytest.mark.parametrize("step", [Fraction(1, 2), Fraction(2, 5), Fraction(1, 10)])
def test_what_a_short_expansion_leaves_out_is_in_the_ball(monkeypatch, p, step):
    """The fewest terms that the bound allows: power is shown by a radius above the rounding."""
    monkeypatch.setattr(polylog, "_count_of_terms", lambda s, x: int((s + 1) // 2 + 1))
    found = at_precision(100, lambda: PolylogFactor(p).power_sum(count=1 / step))
    assert by_polylogarithm(p, step).overlaps(found)
    assert found.rad() > flint.arb("1e-20") * found


@pytest.mark.parametrize("text", ONE_D)
def test_power_sums_have_the_digits_that_are_asked_for(text):
    factor = factor_of(text)
    for comb, count in ((1, None), (1, 2), (1, 10**60), (1000, None), (3, 10**20), (50, 7)):
        short, long = (
            certified(lambda c=comb, n=count: factor.power_sum(c, n), digits) for digits in (18, 70)
        )
        assert short.contains(long) or abs(short - long) < short.rad() * flint.arb("1.000001")


@pytest.mark.parametrize(
    ("text", "roughness"),
    [
        ("bernoulli:k=2", lambda: 8 * mp.zeta(2) / (2 * mp.pi) ** 4),
        ("bernoulli:k=3", lambda: 72 * mp.zeta(4) / (2 * mp.pi) ** 6),
        ("polylog:p=6", lambda: 2 * mp.zeta(4)),
        ("gaussian", lambda: _gaussian_roughness(mp.mpf(1) / 10)),
        ("gaussian:sigma=0.02", lambda: _gaussian_roughness(mp.mpf(1) / 50)),
    ],
)
def test_huge_n_against_the_asymptotic_deficit(text, roughness):
    """``total - sinc2_sum(n) ~ pi^2/(3 n^2) sum m^2 |fhat|^2``, the rest smaller by n^-1."""
    factor, n = factor_of(text), 10**20
    deficit = certified(lambda: factor.power_sum() - factor.power_sum(count=n), 30)
    with mp.workdps(40):
        found = to_mpf(deficit) * n**2 * 3 / mp.pi**2
        assert mp.almosteq(found, roughness(), rel_eps=mp.mpf(10) ** -17)


def _gaussian_roughness(s):
    """``sum m^2 |fhat|^2`` by its own terms."""
    terms = (m**2 * mp.exp(-((2 * mp.pi * s * m) ** 2)) for m in range(1, 400))
    return 4 * mp.pi * s**2 * mp.fsum(terms)


def test_huge_n_of_a_jump():
    """Two unit jumps: ``total - sinc2_sum(n) = E |Delta| = 1/(3 n)`` for 1/n below the side."""
    factor, n = factor_of("box"), 10**20
    deficit = certified(lambda: factor.power_sum() - factor.power_sum(count=n), 50)
    assert (3 * n * deficit).overlaps(flint.arb(1))
    assert deficit.rel_accuracy_bits() > 166


@pytest.mark.parametrize("n", [1, 3, 10**6])
def test_jittered_variance_of_bernoulli_polynomials_in_closed_form(n):
    """Randomly shifted 1D jitter: N V = sigma^2 - tau, k = 2: 1/36N^2 - 1/30N^3 + 1/90N^4."""
    for text, terms in (
        ("bernoulli:k=1", {1: 6, 2: -12}),
        ("bernoulli:k=2", {2: 36, 3: -30, 4: 90}),
    ):
        factor = factor_of(text)
        exact = sum(Fraction(1, c * n**p) for p, c in terms.items())
        found = certified(lambda f=factor: f.power_sum() - f.power_sum(count=n), 40)
        assert at_precision(200, lambda b=found, e=exact: (b - rational(e)).contains(0))
        assert found.rel_accuracy_bits() > 133


def test_extreme_counts_stay_finite():
    gaussian, box = GaussianFactor(Fraction(1, 10)), factor_of("box")
    tiny = gaussian.power_sum(10**300)
    assert abs(tiny) < flint.arb("1e-1000")
    exact = certified(lambda: gaussian.power_sum(10**300), 15)
    assert exact.log().overlaps(
        (4 * flint.arb.pi() / 100).log() - (2 * flint.arb.pi() / 10) ** 2 * flint.arb(10) ** 600
    )
    assert gaussian.power_sum(count=10**300).overlaps(gaussian.power_sum())
    assert box.power_sum(count=10**300).overlaps(box.power_sum())


def test_sums_that_vanish_are_exactly_zero():
    for text in ONE_D:
        assert factor_of(text).power_sum(count=1).is_zero()
        assert factor_of(text).power_sum(6, 3).is_zero()
    assert factor_of("box:side=1/3").power_sum(3).is_zero()
    assert not factor_of("box:side=1/3").power_sum(2).contains(0)


@pytest.mark.parametrize("n", [0, -3, Fraction(-1, 2)])
def test_counts_must_be_positive(n):
    for text in ("box", "gaussian", "polylog"):
        with pytest.raises(InputError, match="0 < n"):
            factor_of(text).power_sum(count=n)
