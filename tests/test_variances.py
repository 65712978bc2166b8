"""Exact variances: the routes against each other, closed forms, Monte Carlo; results by name."""

from fractions import Fraction
from math import pi

import numpy as np
import pytest
import specrate.numerics
from hypothesis import assume, given
from hypothesis import strategies as st
from mpmath import mp
from specrate.numerics.exact_variances.variances import exact_variance, variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.generators import generate
from specrate.numerics.integrands.ball import Ball
from specrate.numerics.integrands.bernoulli import bernoulli
from specrate.numerics.integrands.grammar import CATALOGUE, parse_integrand
from specrate.numerics.measuring.moments import Moments, estimates, shifted, update
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

SAMPLERS = (
    ("random", 2, 16),
    ("regular", 2, 16),
    ("regular:2x8", 2, 16),
    ("jitter", 1, 7),
    ("jitter", 2, 16),
    ("jitter:2x8", 2, 16),
    ("latin-hypercube", 2, 16),
    ("multi-jitter", 1, 7),
    ("multi-jitter", 2, 16),
    ("multi-jitter:3x5", 2, 15),
    ("correlated-multi-jitter", 2, 16),
    ("correlated-multi-jitter:3x5", 2, 15),
    ("jitter", 3, 8),
    ("multi-jitter", 3, 8),
    ("uncorrelated-jitter:1+2", 3, 9),
)
INTEGRANDS = (
    "product:k=1",
    "product:k=3,c=2",
    "bernoulli:k=1",
    "bernoulli:k=2",
    "gaussian:sigma=0.1",
    "gaussian:sigma=0.04",
    "anisotropic-gaussian",
    "box:side=0.3",
    "box:side=1/4",
    "half-space",
    "additive:k=1",
    "polylog",
    "ridge",
)
SPECIAL = {"ridge": "ridge"}
COMBS = ("regular", "correlated-multi-jitter")


def lattice_box(dim):
    half = {1: 5_000, 2: 60, 3: 12}[dim]
    axis = np.arange(-half, half + 1)
    m = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    return m[(m != 0).any(axis=1)]


@pytest.mark.parametrize("text", INTEGRANDS)
@pytest.mark.parametrize(("name", "dim", "n"), SAMPLERS)
def test_variance_lies_between_the_bounds_of_a_lattice_sum(name, dim, n, text):
    """inside <= V <= inside + tail sup P, the tail by Parseval; sup P is 1 with combs, else 2/N.

    N·P_S of the samplers without combs lies below 1 + 2/(n - 1), n >= 2 rows: multi-jitter.
    """
    if dim == 1 and text.startswith("anisotropic"):
        return
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts = sampler.counts_at(n)
    assert counts["N"] == n
    exact = exact_variance(sampler, counts, f)
    m = lattice_box(dim)
    energy = f.coefficient_power(m)
    inside = float(np.sum(energy * np.maximum(power_array(sampler, counts, m), 0)))
    tail = max(0.0, float(f.total(17)) - float(energy.sum()))
    largest = 1.0 if name.startswith(COMBS) else 2 / n
    value = float(exact.value)
    assert exact.method == ("parseval" if name == "random" else SPECIAL.get(text, "product"))
    rounding = 1e-11 * float(f.total(17))
    assert inside - rounding <= value <= inside + tail * largest + rounding
    if text.startswith("gaussian") and dim < 3:
        assert tail * largest < 1e-9 * float(f.total(17))  # the bounds all but meet


@pytest.mark.parametrize("n", [1, 2, 3, 10, 1000])
def test_jitter_on_a_sawtooth(n):
    """1D jitter x B_1: N V = 1/(6N) - 1/(12N^2), the stratum with the jump giving 1/6 - 1/(6N)."""
    sampler, f = parse_sampler("jitter", 1), bernoulli(1, 1, (1,))
    value = exact_variance(sampler, sampler.counts_at(n), f).value
    assert float(n * value) == pytest.approx(1 / (6 * n) - 1 / (12 * n**2), rel=1e-14)


@pytest.mark.parametrize("n", [1, 4, 9])
def test_random_points_have_the_variance_over_n(n):
    sampler = parse_sampler("random", 2)
    for text in ("box:side=0.3", "gaussian", "product:k=2"):
        f = parse_integrand(text, 2)
        value = exact_variance(sampler, sampler.counts_at(n), f).value
        assert float(value) == pytest.approx(float(f.total(17)) / n, rel=1e-14)


@pytest.mark.parametrize("k", [1, 2, 5])
def test_a_shifted_grid_sees_only_multiples_of_its_side(k):
    """1D: V of B_k is its total times n^(-2k)."""
    sampler, f = parse_sampler("regular", 1), bernoulli(1, k, (1,))
    value = exact_variance(sampler, {"N": 6, "n": 6}, f).value
    assert float(value) == pytest.approx(float(f.total(17)) / 6 ** (2 * k), rel=1e-13)


def test_a_smooth_integrand_under_jitter_has_its_gradient_as_constant():
    """N V -> E |grad f|^2/(12 n^2): the smooth limit, to the next order 1/n^2."""
    sampler, f = parse_sampler("jitter", 2), bernoulli(2, 6, (1,))
    gradient = 36 * float(bernoulli(2, 5, (1,)).total(17))
    counts = sampler.counts_at(200**2)
    value = counts["N"] * exact_variance(sampler, counts, f).value
    assert float(value) == pytest.approx(gradient / (12 * 200**2), rel=5 * (2 * pi / 200) ** 2)


@pytest.mark.parametrize(
    ("name", "dim", "n", "text"),
    [
        ("jitter", 2, 16, "disk:radius=0.25"),
        ("latin-hypercube", 2, 16, "disk"),
        ("multi-jitter", 2, 25, "disk"),
        ("jitter", 3, 27, "ball"),
        ("correlated-multi-jitter", 2, 16, "box:side=0.3"),
        ("multi-jitter:3x5", 2, 15, "anisotropic-gaussian"),
        ("regular:2x8", 2, 16, "product:k=1"),
        ("uncorrelated-jitter:1+2", 3, 25, "product:k=2"),
        ("multi-jitter", 2, 25, "ridge:k=(1,-1)"),
        ("latin-hypercube", 2, 16, "additive:k=1"),
        ("jitter", 2, 16, "half-space"),
        ("latin-hypercube", 1, 16, "polylog:p=3"),
        ("jitter", 1, 9, "chord"),
    ],
)
def test_monte_carlo(name, dim, n, text):
    """Within 5.5 standard errors and the bound: false alarm 4e-8 for 20 000 normal errors.

    Power: twice the variance, or half of it, is more than 20 standard errors away.
    """
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts, moments = sampler.counts_at(n), Moments()
    exact = exact_variance(sampler, counts, f, box=250_000)
    for part in range(10):
        rng = stream(81, part)
        points = shifted(generate(sampler, counts, 2000, rng), rng.random((2000, dim)))
        moments = update(moments, estimates(f, points) - float(f.mean(17)))
    error = 5.5 * moments.mse_error + float(exact.error_bound)
    assert abs(moments.mse - float(exact.value)) < error
    assert error < 0.3 * float(exact.value)


def test_disk_under_jitter():
    """The value was computed by Gauss rules from the covariogram of the disk."""
    sampler, f = parse_sampler("jitter", 2), Ball(2, Fraction(1, 4))
    exact = exact_variance(sampler, sampler.counts_at(16), f)
    assert exact.method == "covariogram"
    assert float(exact.value) == pytest.approx(0.0039930421893162175, rel=1e-15)


LATTICE = (
    ("jitter", 2, 16, "disk:radius=0.25"),
    ("multi-jitter", 2, 25, "chord"),
    ("latin-hypercube", 3, 9, "ball"),
    ("jitter", 1, 7, "ball"),
    ("jitter:2x8", 2, 16, "gaussian"),
    ("multi-jitter", 2, 16, "product:k=2"),
    ("jitter", 2, 36, "ridge:k=(1,-2)"),
    ("random", 2, 36, "additive"),
    ("uncorrelated-jitter:1+2", 3, 9, "gaussian:sigma=0.2"),
    ("regular", 2, 16, "gaussian"),
    ("regular:2x8", 2, 16, "product:k=2"),
    ("regular", 2, 16, "disk"),
    ("correlated-multi-jitter", 2, 16, "gaussian:sigma=0.08"),
    ("correlated-multi-jitter", 2, 16, "disk:radius=0.4"),
)


@pytest.mark.parametrize(("name", "dim", "n", "text"), LATTICE)
def test_lattice_sums_hold_the_value_of_the_other_routes(name, dim, n, text):
    """Power: the bounds lie within a tenth of the variance."""
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts = sampler.counts_at(n)
    exact = exact_variance(sampler, counts, f)
    witness = exact_variance(sampler, counts, f, method="lattice", box=250_000)
    assert exact.method != witness.method
    assert abs(exact.value - witness.value) <= exact.error_bound + witness.error_bound
    assert witness.error_bound < 0.1 * exact.value
    assert exact.error_bound < 1e-15 * exact.value


@pytest.mark.parametrize("k", [1, 2])
def test_very_many_points(k):
    """N = 1e24 in 2D. On one axis n = 1e12 strata: for k = 1 N V = 1/(6n) - 1/(12n^2)."""
    n = 10**12
    sampler = parse_sampler("jitter", 2)
    counts = sampler.counts_at(n * n)
    assert counts == {"N": n * n, "n": n}
    exact = exact_variance(sampler, counts, bernoulli(2, k, (1,)))
    # k = 2: B_2' = 2 B_1 has E (B_2')^2 = 1/3, hence N V -> 1/(36 n^2)
    wanted = {1: 1 / (6 * n), 2: 1 / (36 * n**2)}[k]
    assert float(exact.value) * n**2 == pytest.approx(wanted, rel=1e-11)
    assert 0 < exact.error_bound < 1e-14 * exact.value


def test_digits_agree():
    sampler, f = parse_sampler("multi-jitter", 2), parse_integrand("gaussian", 2)
    coarse, fine = (exact_variance(sampler, sampler.counts_at(64), f, d) for d in (15, 60))
    assert abs(coarse.value - fine.value) <= coarse.error_bound + fine.error_bound
    assert fine.error_bound < 1e-55 * fine.value


@pytest.mark.parametrize("name", ["jitter", "random"])
@pytest.mark.parametrize(
    "text",
    ["gaussian", "product:k=1", "polylog", "ridge:k=(1,2)", "half-space:side=1/3", "disk", "chord"],
)
def test_enclosures_are_true(name, text):
    """The value to 60 digits lies within the bound of the value to few digits, mpf or text."""
    fine = variance(name, text, 2, "100", digits=60)
    slack = Fraction(fine.value.error_bound)
    assert slack < Fraction(fine.value.value) / 10**58
    sampler, f = parse_sampler(name, 2), parse_integrand(text, 2)
    for digits in (1, 5, 15):
        coarse = variance(name, text, 2, "100", digits=digits)
        gap = abs(Fraction(coarse.value.value) - Fraction(fine.value.value))
        assert gap <= Fraction(coarse.value.error_bound) + slack
        exact = exact_variance(sampler, sampler.counts_at(100), f, digits)
        with mp.workdps(80):
            gap = abs(exact.value - mp.mpf(fine.value.value))
            assert gap <= exact.error_bound + mp.mpf(fine.value.error_bound)
        assert exact.error_bound <= mp.mpf(10) ** -digits * exact.value


@given(
    st.sampled_from([e.name for e in CATALOGUE if e.name != "disk"]),
    st.integers(1, 3),
    st.integers(1, 2000),
)
def test_every_integrand_has_a_variance_under_jitter(text, dim, n):
    """No more than independent points have, and positive: no grid is that fine."""
    assume(text != "chord" or dim < 3)
    found = variance("jitter", text, dim, str(n))
    random = variance("random", text, dim, str(found.n))
    assert random.method == "parseval"
    assert (
        0 < Fraction(found.value.value) <= Fraction(random.value.value) * (1 + Fraction(1, 10**14))
    )
    assert Fraction(found.value.error_bound) < Fraction(found.value.value) / 10**14


def test_result_of_the_public_door():
    found = specrate.numerics.variance("n-rooks", "product:c=1,k=2", 1000, "1e30")
    assert (found.sampler, found.integrand) == ("latin-hypercube", "product:k=2")
    assert (found.dim, found.n, found.n_asked) == (1000, 10**30, "1e30")
    assert found.value.value == "2.48168385747142e-28"
    assert found.method == "product"
    assert found.left_out == ()
    assert found.seconds > 0


def test_what_is_left_out_is_said():
    found = variance("jitter", "bernoulli:k=2,axes=(2,5)", 6, "1000")
    assert found.n == 729
    assert found.n_asked == "1000"
    assert [what for what, _ in found.left_out] == ["N = 1000", "coordinates 1,3..4,6"]
    assert variance("jitter", "gaussian", 2, "100").left_out == ()
    ridge = variance("latin-hypercube", "ridge:k=(0,1,1)", 3, "10")
    assert [what for what, _ in ridge.left_out] == ["coordinates 1"]


def test_zero_is_written_as_zero():
    found = variance("regular", "box:side=0.5", 2, "16")
    assert (found.value.value, found.value.error_bound) == ("0", "0")


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("log:30", "such as 1e300"),
        ("0", "from 1 to 1e4000"),
        ("-4", "from 1 to 1e4000"),
        ("5/2", "from 1 to 1e4000"),
        ("1e4001", "from 1 to 1e4000"),
        ("many", "must be a number"),
    ],
)
def test_numbers_of_points_that_are_none_are_refused(text, rule):
    with pytest.raises(InputError, match=rule) as caught:
        variance("jitter", "gaussian", 2, text)
    assert repr(text) in str(caught.value)


def test_unusable_requests_are_refused():
    with pytest.raises(InputError, match=r"1\.\.4000"):
        variance("jitter", "gaussian", 2, "4", digits=0)
    with pytest.raises(InputError, match="a method must be one of"):
        variance("jitter", "gaussian", 2, "4", method="quadrature")
    with pytest.raises(InputError, match="the method ridge must apply"):
        variance("jitter", "gaussian", 2, "4", method="ridge")
    with pytest.raises(InputError, match="needs a sampler with points: got isotropic"):
        variance("isotropic:2", "gaussian", 2, "4")


def test_what_has_no_exact_variance_is_refused():
    disk = parse_integrand("disk", 2)
    with pytest.raises(InputError, match="with --dim 4"):
        variance("jitter", "ball", 4, "16")
    with pytest.raises(InputError, match=r"at most 2: got chord:radius=0\.3 with --dim 3"):
        variance("jitter", "chord", 3, "8")
    with pytest.raises(InputError, match="with a spectrum: got isotropic"):
        exact_variance(parse_sampler("isotropic:2", 2), {"N": 4}, disk)
    with pytest.raises(InputError, match="one dimension: got 3 and 2"):
        exact_variance(parse_sampler("random", 3), {"N": 4}, disk)
