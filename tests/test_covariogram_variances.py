"""Variances of balls and chords in real space: against lattice sums, closed forms and points."""

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import flint, rational
from specrate.numerics.exact_variances.covariogram_series import mean_deficit
from specrate.numerics.exact_variances.covariogram_variances import (
    MOST_CELLS,
    OutOfReach,
    ball_variance,
)
from specrate.numerics.exact_variances.covariograms import Covariogram
from specrate.numerics.exact_variances.lattice_variances import lattice_variance
from specrate.numerics.generators import generate
from specrate.numerics.integrands.ball import Ball
from specrate.numerics.integrands.chord import Chord
from specrate.numerics.measuring.moments import Moments, estimates, shifted, update
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler
from strategies import catalogue_samplers

NEARLY_HALF = Fraction(1, 2) - Fraction(1, 10**12)
radii = st.one_of(
    st.fractions(Fraction(1, 50), Fraction(49, 100), max_denominator=100),
    st.sampled_from([Fraction(1, 10**9), NEARLY_HALF, Fraction(1, 4)]),
)


def variance(name, f, n, digits=15):
    sampler = parse_sampler(name, f.dim)
    assert sampler.counts_at is not None
    counts = sampler.counts_at(n)
    return ball_variance(sampler, counts, f, digits), counts["N"]


def agrees_with_the_lattice(sampler, counts, f, box):
    """Both are bounded: they overlap. The relative bound of the lattice sum is given back."""
    value, witness = (
        ball_variance(sampler, counts, f, 12),
        lattice_variance(sampler, counts, f, box),
    )
    assert value.overlaps(witness)
    return float(witness.rad() / witness.mid())


def test_jitter_on_a_disk():
    """N = 16, R = 1/4: computed from the covariogram by a 14 x 14 point rule of Gauss."""
    value, _ = variance("jitter", Ball(2, Fraction(1, 4)), 16)
    assert float(value) == pytest.approx(0.0039930421893162175, rel=4e-16)


@pytest.mark.parametrize("exponent", [6, 30, 300])
@pytest.mark.parametrize("digits", [15, 50])
def test_jitter_on_a_disk_at_any_n(exponent, digits):
    """N Var n/(2R) = E |t| - E |t|³/(24 R² n²) - ..., t the difference in the unit square.

    E |t|³ < 1, and all later terms together are below the rest of that bound.
    """
    n = 10 ** (exponent // 2)
    value, size = variance("jitter", Ball(2, Fraction(1, 4)), 10**exponent, digits)
    assert value.rel_accuracy_bits() > 3.32 * digits
    with flint.ctx.workprec(300):
        square = (2 + flint.arb(2).sqrt() + 5 * flint.arb(1).asinh()) / 15
        gap = square - value * size * n * 2
        error = square * flint.arb(10) ** -digits
        assert gap > -error
        assert gap < flint.arb(16) / (24 * n**2) + error


@pytest.mark.parametrize("name", ["latin-hypercube", "multi-jitter", "correlated-multi-jitter"])
def test_digits_agree(name):
    """Each precision is a computation of its own: the balls overlap."""
    n = 36 if name.startswith("correlated") else 10**20
    for f in (Ball(2, Fraction(3, 10)), Chord(2, Fraction(3, 10))):
        coarse, fine = (variance(name, f, n, digits)[0] for digits in (8, 40))
        assert coarse.overlaps(fine)
        assert fine.rel_accuracy_bits() > 3.32 * 40


@settings(max_examples=10)  # teeth by the hundred
@given(data=st.data(), radius=radii)
def test_planar_samplers_agree_with_lattice_sums(data, radius):
    sampler = data.draw(catalogue_samplers(2))
    assert sampler.counts_at is not None
    counts = sampler.counts_at(data.draw(st.integers(1, 40)))
    f = data.draw(st.sampled_from([Ball, Chord]))(2, radius)
    try:
        agrees_with_the_lattice(sampler, counts, f, 40_000)
    except OutOfReach:
        assume(False)


@pytest.mark.parametrize(
    ("name", "f", "n", "bound"),
    [
        ("random", Ball(3, Fraction(3, 10)), 5, 1e-11),
        ("jitter", Ball(2, Fraction(49, 100)), 1, 1e-7),
        ("jitter", Ball(2, Fraction(49, 100)), 4, 1e-6),
        ("jitter", Ball(2, Fraction(49, 100)), 9, 1e-6),
        ("jitter:2x8", Ball(2, Fraction(1, 10)), 16, 1e-5),
        ("jitter", Ball(3, Fraction(49, 100)), 8, 1e-4),
        ("jitter", Ball(3, Fraction(1, 5)), 8, 1e-4),
        ("jitter", Chord(1, Fraction(49, 100)), 3, 1e-11),
        ("jitter", Chord(2, Fraction(49, 100)), 4, 1e-8),
        ("regular", Ball(2, Fraction(3, 10)), 16, 0.05),
        ("regular:2x8", Ball(2, Fraction(3, 10)), 16, 0.05),
        ("regular", Chord(1, Fraction(3, 10)), 5, 1e-6),
        ("latin-hypercube", Ball(2, Fraction(49, 100)), 3, 1e-5),
        ("latin-hypercube", Ball(3, Fraction(45, 100)), 2, 1e-4),
        ("multi-jitter", Ball(2, Fraction(45, 100)), 4, 1e-5),
        ("multi-jitter:3x5", Ball(2, Fraction(49, 100)), 15, 1e-4),
        ("multi-jitter", Ball(3, Fraction(3, 10)), 8, 1e-3),
        ("uncorrelated-jitter:1+2", Ball(3, Fraction(3, 10)), 4, 1e-3),
        ("uncorrelated-jitter:1+1+1", Ball(3, Fraction(3, 10)), 6, 1e-3),
        ("uncorrelated-jitter:2+1", Ball(3, Fraction(1, 4)), 16, 1e-3),
        ("correlated-multi-jitter", Ball(2, Fraction(45, 100)), 9, 0.05),
        ("correlated-multi-jitter:3x5", Ball(2, Fraction(3, 10)), 15, 0.05),
        ("correlated-multi-jitter", Chord(2, Fraction(3, 10)), 4, 1e-3),
    ],
    ids=str,
)
def test_small_n_agrees_with_lattice_sums(name, f, n, bound):
    """Triangles that wrap round the torus and cells that cross the diameter, at few strata."""
    sampler = parse_sampler(name, f.dim)
    assert sampler.counts_at is not None
    counts = sampler.counts_at(n)
    assert counts["N"] == n
    assert agrees_with_the_lattice(sampler, counts, f, 100_000 if f.dim < 3 else 200_000) < bound


def test_latin_hypercube_leaves_what_is_not_additive():
    """N Var → π R² - 32 R³/3 + π² R⁴ (disk), with an error (ln N)/N² per axis from the axes."""
    r = flint.arb(3) / 10
    value, size = variance("latin-hypercube", Ball(2, Fraction(3, 10)), 10**30)
    limit = flint.arb.pi() * r**2 - 32 * r**3 / 3 + flint.arb.pi() ** 2 * r**4
    assert abs(value * size / limit - 1) < 1e-14


def test_lines_under_jitter_have_a_logarithm():
    """Chords of the disk: Var = (R/(3 N³))(ln(8 R N) + 1/12)(1 + O(N^-2))."""
    r, n = flint.arb(3) / 10, 10**8
    value, _ = variance("jitter", Chord(1, Fraction(3, 10)), n)
    wanted = r / 3 * ((8 * r * n).log() + flint.arb(1) / 12)
    assert abs(value * flint.arb(n) ** 3 / wanted - 1) < 1e-14


@pytest.mark.parametrize(
    ("name", "limit"),
    [("jitter", "0.521405433164720678"), ("multi-jitter", "0.521405433164720678")],
)
def test_multi_jitter_tends_to_jitter_on_the_boundary(name, limit):
    """N^1.5 Var → 2R times the mean distance in the unit square; for multi-jitter to 3/√n."""
    value, size = variance(name, Ball(2, Fraction(3, 10)), 10**24)
    scaled = value * size * flint.arb(size).sqrt() / (2 * flint.arb(3) / 10)
    assert abs(scaled - flint.arb(limit)) < 1e-9


@pytest.mark.parametrize("n", [10**3, 10**6])
def test_a_tiny_disk_is_seen_by_one_point(n):
    """N Var = V - E C(h), and E C is below N V²: the density of h at 0 times ∫ C."""
    with flint.ctx.workprec(200):
        value, size = variance("jitter", Ball(2, Fraction(1, 10**9)), n, 40)
        volume = flint.arb.pi() / 10**18
        assert volume - size * volume**2 < value * size
        assert value * size < volume - size * volume**2 * (1 - flint.arb(10) ** -5)


def test_a_disk_that_touches_its_translates():
    """Near the touching points J(z) = (2 (1 - z))^{3/2}/3, and 1 - z runs over s in [0, w/(2R)].

    The four images of the triangle take 4 ∫ (1 - s/w)/w (2s)^{3/2}/3 ds = (8/3) √2 (2/5 - 2/7)
    w^{3/2} from N Var/(4R²) = E (J(0) - J), up to a relative O(w) and, as R < 1/2, O(10^-12/w).
    """
    n = 10**4
    value, size = variance("jitter", Ball(2, NEARLY_HALF), n**2)
    width = rational(1 / (n * 2 * NEARLY_HALF))
    taken = mean_deficit(Covariogram(2, 0), [width, width]) - value * size
    wanted = flint.arb(2).sqrt() * 8 / 3 * (flint.arb(2) / 5 - flint.arb(2) / 7)
    assert abs(taken * flint.arb(n) ** 1.5 / wanted - 1) < 3 / flint.arb(n)


def test_monte_carlo():
    """jitter 2 x 2 on a disk that all but fills the cell: 5.5 standard errors, false alarm 4e-8.

    Power: the variance without the images of the triangles is more than 30 errors away.
    """
    f = Ball(2, Fraction(49, 100))
    sampler = parse_sampler("jitter", 2)
    counts, moments = {"N": 4, "n": 2}, Moments()
    for part in range(10):
        rng = stream(91, part)
        points = shifted(generate(sampler, counts, 4000, rng), rng.random((4000, 2)))
        moments = update(moments, estimates(f, points) - float(f.mean(17)))
    error = 5.5 * moments.mse_error
    assert abs(moments.mse - float(ball_variance(sampler, counts, f, 15))) < error
    assert error < 0.1 * moments.mse


@settings(max_examples=10)  # cells of three dimensions
@given(radius=radii, n=st.integers(1, 10**12), digits=st.sampled_from([10, 30]), data=st.data())
def test_three_dimensions_at_two_precisions(radius, n, digits, data):
    names = ["jitter", "latin-hypercube", "uncorrelated-jitter:1+2", "random"]
    sampler = parse_sampler(data.draw(st.sampled_from(names)), 3)
    assert sampler.counts_at is not None
    counts, f = sampler.counts_at(n), Ball(3, radius)
    coarse, fine = (ball_variance(sampler, counts, f, d) for d in (5, digits))
    assert coarse.overlaps(fine)
    assert 0 < fine * counts["N"] < f.total(20) * (1 + flint.arb(2) / counts["N"])


def test_out_of_reach():
    for dim in (1, 4):
        with pytest.raises(OutOfReach, match=rf"2 or 3 dimensions .*: got {dim}"):
            variance("jitter", Ball(dim, Fraction(1, 4)), 16)
    with pytest.raises(OutOfReach, match=f"at most {MOST_CELLS}"):
        variance("correlated-multi-jitter", Ball(2, Fraction(1, 4)), 10**8)
    with pytest.raises(OutOfReach, match="points within the ball's diameter"):
        variance("regular", Ball(2, Fraction(1, 4)), 10**8)
    with pytest.raises(OutOfReach, match="one comb and one sinc²"):
        variance("box-dpp", Ball(2, Fraction(1, 4)), 16)
    with pytest.raises(InputError, match="must be 2: got 3"):
        ball_variance(parse_sampler("random", 3), {"N": 4}, Ball(2, Fraction(1, 4)), 15)
