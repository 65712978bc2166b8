"""Spectra on arrays in double precision against ball arithmetic: no frequency loses digits."""

from fractions import Fraction
from math import prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.expected_spectra.spectrum_balls import scaled_power_ball
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler
from strategies import block_samplers, catalogue_samplers, shaped_samplers

BOUND = 1e-14
FAR = 1 << 62


def relative_error(sampler, counts, m, power):
    """An upper bound of |found − true|/|true|, in ball arithmetic; 0 where both vanish."""
    exact = certified(lambda: scaled_power_ball(sampler, counts, m), 18)
    if exact == 0:
        assert power == 0
        return 0.0
    found = exact_ball(Fraction(float(power)) * counts["N"])
    return float(abs((found - exact) / exact).upper())


@st.composite
def sizes(draw, exponent):
    """Whole numbers up to about 2^exponent, as often small as large."""
    k = draw(st.integers(0, exponent - 1))
    return draw(st.integers(1 << k, 2 << k))


@st.composite
def entries(draw, counts):
    """One coordinate: zero, low, any size, or on and next to multiples of a count."""
    multiple = st.builds(
        lambda n, k, j: n * k + j,
        st.sampled_from(sorted(counts.values())),
        st.one_of(st.integers(1, 3), sizes(20)),
        st.integers(-2, 2),
    )
    size = draw(st.one_of(st.just(0), st.integers(1, 12), sizes(62), st.integers(1, FAR), multiple))
    return min(size, FAR) * draw(st.sampled_from((-1, 1)))


@st.composite
def cases(draw):
    """A sampler in up to 6 dimensions, counts of up to 1e7 strata per axis, frequencies."""
    dim = draw(st.integers(1, 6))
    drawn = st.one_of(catalogue_samplers(dim), block_samplers(dim), shaped_samplers(dim))
    sampler = draw(drawn)
    if sampler.counts_at is None:
        sampler = parse_sampler("latin-hypercube", dim)
    counts = dict(sampler.counts_at(draw(st.one_of(st.integers(2, 40), sizes(23 * dim)))))
    row = st.lists(entries(counts), min_size=dim, max_size=dim)
    rows = draw(st.lists(row.filter(any), min_size=1, max_size=4))
    return sampler, counts, rows


@given(cases())
def test_any_frequency_has_fourteen_digits(case):
    sampler, counts, rows = case
    for m, power in zip(rows, power_array(sampler, counts, np.array(rows)), strict=True):
        assert relative_error(sampler, counts, m, power) < BOUND, (sampler.name, counts, m)


S = 10**7
NASTY = [
    # Low frequencies: all but the last of 44 digits cancel in the plain sum.
    ("correlated-multi-jitter", {"m": S, "n": S}, (1, 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (0, 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (-3, 4000)),
    ("correlated-multi-jitter:8x16", {"m": 2, "n": S}, (1, 1)),
    ("multi-jitter:8x16", {"m": S, "n": 2}, (1, -1)),
    # Teeth of combs, both, one, and next to them, with the fine sinc² still close to 1.
    ("correlated-multi-jitter", {"m": S, "n": S}, (S, S)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (S, 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (S, 10 * S + 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (S + 1, S - 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (S * S, S * S)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (S * S + 1, 5 * S * S - 1)),
    ("correlated-multi-jitter", {"m": 3, "n": 3}, (9, 18)),
    ("correlated-multi-jitter", {"m": 2, "n": 2}, (2, 1)),
    ("correlated-multi-jitter", {"m": S, "n": S}, (FAR, FAR - 1)),
    ("multi-jitter", {"s": S}, (1, 1, 1)),
    ("multi-jitter", {"s": S}, (S, 1, 2)),
    ("multi-jitter", {"s": S}, (S, S, S)),
    ("multi-jitter", {"s": 2}, (1, 1, 1)),
    ("multi-jitter", {"s": 2}, (3, 5, 0)),
    ("multi-jitter", {"s": S}, (1,) * 12),
    ("jitter", {"n": S}, (1,) * 12),
    ("jitter", {"n": S}, (S, S + 1, 3)),
    ("jitter", {"n": 1}, (5, 0, 7)),
    ("jitter", {"n": 3}, (FAR, 1)),
    ("jitter", {"n": 2}, (1,) * 300),
    ("jitter:4xN", {"n1": 4, "n2": S}, (0, 1)),
    ("jitter:25x40", {"n1": 25 * S, "n2": 40 * S}, (25 * S, 1)),
    ("latin-hypercube", {"N": S**3}, (1,)),
    ("latin-hypercube", {"N": S**3}, (1, 1)),
    ("latin-hypercube", {"N": S**3}, (FAR,)),
    ("latin-hypercube", {"N": 2}, (1, 1, 1)),
    ("latin-hypercube", {"N": 1 << 62}, (FAR, 1, 0)),
    ("latin-hypercube", {"N": (1 << 62) + 1}, (FAR, FAR - 1)),
    ("latin-hypercube", {"N": (1 << 63) - 1}, (FAR,)),
    ("latin-hypercube", {"N": 1 << 63}, (FAR,)),
    ("latin-hypercube", {"N": 10**100}, (1,)),
    ("latin-hypercube", {"N": 10**307}, (1, FAR)),
    ("jitter", {"n": 2}, (1,) * 1000),
    ("regular", {"n": S}, (S, 0, -7 * S)),
    ("regular", {"n": S}, (S, S + 1, S)),
    ("random", {"N": S**3}, (1, FAR)),
    ("box-dpp", {"n": S}, (1, 0, 0)),
    ("box-dpp", {"n": S}, (S - 1, S + 1, FAR)),
    ("box-dpp", {"n": 10**100}, (1, FAR)),
    ("box-dpp:25x40", {"n1": 25 * S, "n2": 40 * S}, (25 * S - 1, 1)),
    ("cloaked:1/3", {"n": 10**200}, (1,)),
    ("cloaked:1/3", {"n": 10**200}, (FAR,)),
    ("cloaked:2", {"n": S}, (1, 1, 1)),
    ("cloaked:2", {"n": 3}, (FAR, FAR - 1)),
    ("difference-jitter", {"N": 10**60}, (1,)),
    ("difference-jitter", {"N": 10**4}, (1,)),
    ("difference-jitter", {"N": 3 * S}, (S,)),
    *[("difference-jitter", {"N": 1000}, (m,)) for m in range(200, 400, 7)],
    ("difference-jitter", {"N": 3}, (FAR,)),
]


@pytest.mark.parametrize(("name", "strata", "m"), NASTY)
def test_nasty_frequencies(name, strata, m):
    sampler = parse_sampler(name, len(m))
    each = prod(strata.values()) if len(strata) > 1 else next(iter(strata.values())) ** len(m)
    counts = {"N": each, **strata}
    power = power_array(sampler, counts, np.array([m]))[0]
    assert relative_error(sampler, counts, m, power) < BOUND


def test_what_is_below_the_smallest_double_is_zero():
    """P_S = π²/(3 N³) of a Latin hypercube at N = 10^200."""
    assert power_array(parse_sampler("latin-hypercube", 1), {"N": 10**200}, np.array([[1]])) == 0


def test_zeros_of_a_grid_are_exact():
    sampler, counts = parse_sampler("regular", 3), {"N": S**3, "n": S}
    m = np.array([(S, S, S), (S, S + 1, S), (0, 1, 0), (0, 0, FAR // S * S), (0, 0, 0)])
    assert power_array(sampler, counts, m).tolist() == [1, 0, 0, 1, 1]


@pytest.mark.parametrize(
    ("name", "dim"), [("correlated-multi-jitter", 2), ("multi-jitter", 3), ("jitter", 1)]
)
def test_tables_and_slabs_are_single_values(name, dim):
    """A box long enough for tables, and for more than one slab of rows."""
    sampler = parse_sampler(name, dim)
    counts = sampler.counts_at(100)
    half = int(50_000 ** (1 / dim)) // 2
    axes = np.meshgrid(*[np.arange(-half, half + 1)] * dim, indexing="ij")
    m = np.stack(axes, axis=-1).reshape(-1, dim)
    found = power_array(sampler, counts, m)
    few = np.random.default_rng(5).integers(0, len(m), 40)
    single = [float(power_array(sampler, counts, m[[i]])[0]) for i in few]
    assert found[few] == pytest.approx(single, rel=BOUND, abs=0)


def test_slabs_of_far_frequencies_are_single_values():
    sampler = parse_sampler("correlated-multi-jitter", 2)
    counts = sampler.counts_at(10**6)
    m = np.random.default_rng(6).integers(-FAR, FAR, (40_000, 2))
    found = power_array(sampler, counts, m)
    for i in (0, 16_383, 16_384, 39_999):
        assert found[i] == pytest.approx(power_array(sampler, counts, m[[i]])[0], rel=BOUND, abs=0)


@pytest.mark.parametrize("dim", [7, 8, 9, 16, 17, 33, 64, 65, 100])
def test_supports_in_many_dimensions(dim):
    """Every row alone and among rows of other supports, at the edges of the supports' codes."""
    sampler = parse_sampler("jitter", dim)
    counts = {"N": 3**dim, "n": 3}
    rng = np.random.default_rng(dim)
    m = rng.integers(1, 9, (60, dim)) * (rng.random((60, dim)) < rng.random((60, 1)))
    m[0], m[1], m[2, -1] = 0, np.arange(dim) == dim - 1, 4
    # 1 − ∏ sinc², which cancels by a digit at most at m_i >= 1 and n = 3.
    plain = 1 - (np.sinc(m / 3) ** 2).prod(axis=1)
    expected = np.where(m.any(axis=1), plain / 3.0**dim, 1)
    assert power_array(sampler, counts, m) == pytest.approx(expected, rel=1e-13, abs=0)


def test_no_frequencies_give_no_values():
    sampler = parse_sampler("jitter", 2)
    assert power_array(sampler, {"N": 4, "n": 2}, np.zeros((0, 2), np.int64)).shape == (0,)


@pytest.mark.parametrize("m", [(FAR + 1, 0), (0, -FAR - 1)])
def test_frequencies_have_a_largest_size(m):
    with pytest.raises(InputError, match=r"must be at most 2\^62 in size: got 4611686018427387905"):
        power_array(parse_sampler("random", 2), {"N": 4}, np.array([m]))


def test_counts_have_a_largest_size():
    with pytest.raises(InputError, match=r"N must be at most 10\^307: got 1"):
        power_array(parse_sampler("random", 1), {"N": 10**307 + 1}, np.array([[1]]))
