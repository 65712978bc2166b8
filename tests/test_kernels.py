"""Kernels against exhaustive enumeration of tiny samplers, and the algebra they are made of."""

from fractions import Fraction
from itertools import product

import exhaustive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.coefficients import element_value
from specrate.numerics.expected_spectra.spectra import power_array, scaled_power
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError
from specrate.theory.kernels import Alphabet, Atom, Kernel
from specrate.theory.samplers import parse_sampler
from specrate.theory.samplers.uncorrelated_jitter import padded
from specrate.theory.shapes import SINC2, TENT, stretched
from specrate.theory.strata import Strata
from specrate.theory.symbolic import Integer
from strategies import frequencies

F = exhaustive.fixed
S = exhaustive.shuffled

CASES = {
    "regular-5": ("regular", 1, {"N": 5, "n": 5}, [F((5,), 0)]),
    "regular-2x3": ("regular:2x3", 2, {"N": 6, "n1": 2, "n2": 3}, [F((2, 3), 0)]),
    "jitter-4": ("jitter", 1, {"N": 4, "n": 4}, [F((4,))]),
    "jitter-2x3": ("jitter:2x3", 2, {"N": 6, "n1": 2, "n2": 3}, [F((2, 3))]),
    "jitter-2x2x2": ("jitter", 3, {"N": 8, "n": 2}, [F((2, 2, 2))]),
    "latin-hypercube-2-2D": ("latin-hypercube", 2, {"N": 2}, [S((2,))] * 2),
    "latin-hypercube-3-2D": ("latin-hypercube", 2, {"N": 3}, [S((3,))] * 2),
    "latin-hypercube-4-2D": ("latin-hypercube", 2, {"N": 4}, [S((4,))] * 2),
    "latin-hypercube-2-3D": ("latin-hypercube", 3, {"N": 2}, [S((2,))] * 3),
    "latin-hypercube-3-3D": ("latin-hypercube", 3, {"N": 3}, [S((3,))] * 3),
    "multi-jitter-3": ("multi-jitter", 1, {"N": 3}, [F((3,))]),
    "multi-jitter-2x2": (
        "multi-jitter",
        2,
        {"N": 4, "s": 2},
        exhaustive.multi_jittered((2, 2)),
    ),
    "multi-jitter-3x3": (
        "multi-jitter",
        2,
        {"N": 9, "s": 3},
        exhaustive.multi_jittered((3, 3)),
    ),
    "multi-jitter-rectangle-2x2": (
        "multi-jitter:2x2",
        2,
        {"N": 4, "m": 2, "n": 2},
        exhaustive.multi_jittered((2, 2)),
    ),
    "multi-jitter-rectangle-2x3": (
        "multi-jitter:2x3",
        2,
        {"N": 6, "m": 2, "n": 3},
        exhaustive.multi_jittered((2, 3)),
    ),
    "orthogonal-array-2x2x2": (
        "multi-jitter",
        3,
        {"N": 8, "s": 2},
        exhaustive.multi_jittered((2, 2, 2)),
    ),
    "correlated-multi-jitter-2x2": (
        "correlated-multi-jitter",
        2,
        {"N": 4, "m": 2, "n": 2},
        exhaustive.correlated_multi_jittered((2, 2)),
    ),
    "correlated-multi-jitter-2x3": (
        "correlated-multi-jitter:2x3",
        2,
        {"N": 6, "m": 2, "n": 3},
        exhaustive.correlated_multi_jittered((2, 3)),
    ),
    "correlated-multi-jitter-4x3": (
        "correlated-multi-jitter:4x3",
        2,
        {"N": 12, "m": 4, "n": 3},
        exhaustive.correlated_multi_jittered((4, 3)),
    ),
    "uncorrelated-jitter-1+2": (
        "uncorrelated-jitter:1+2",
        3,
        {"N": 4, "n1_1": 4, "n2_1": 2},
        [S((4,)), S((2, 2))],
    ),
    "uncorrelated-jitter-2+1+1": (
        "uncorrelated-jitter:2+1+1",
        4,
        {"N": 4, "n1_1": 2, "n2_1": 4, "n3_1": 4},
        [S((2, 2)), S((4,)), S((4,))],
    ),
}


def some_frequencies(dim, number=24):
    """All sizes of support, small and beyond the strata, on and off their multiples."""
    rng = np.random.default_rng(dim)
    small = [m for m in product((0, 1, 2), repeat=dim) if any(m)]
    large = [tuple(int(k) for k in rng.integers(-13, 14, dim)) for _ in range(number)]
    return [m for m in small[: number // 2] + large + [(6,) * dim, (12,) * dim] if any(m)]


@pytest.mark.parametrize("case", CASES)
def test_kernel_is_the_enumerated_spectrum(case):
    name, dim, counts, blocks = CASES[case]
    sampler = parse_sampler(name, dim)
    for m in some_frequencies(dim):
        expected = exhaustive.scaled_power(blocks, m)
        assert float(scaled_power(sampler, counts, m)) == pytest.approx(expected, abs=1e-12), m


def test_padded_rectangle_is_the_enumerated_spectrum():
    """Blocks with strata of their own: a 1 × 6 and a 2 × 3 grid, shuffled against each other."""
    sampler = padded((Integer(1), Strata((2, 3), (1, 1))), (), "1 + 2x3")
    counts = {"N": 6, "n1_1": 6, "n2_1": 2, "n2_2": 3}
    blocks = [S((6,)), S((2, 3))]
    for m in some_frequencies(3):
        expected = exhaustive.scaled_power(blocks, m)
        assert float(scaled_power(sampler, counts, m)) == pytest.approx(expected, abs=1e-12), m


@pytest.mark.parametrize("case", CASES)
def test_power_array_is_scaled_power(case):
    name, dim, counts, _ = CASES[case]
    sampler = parse_sampler(name, dim)
    m = np.array(some_frequencies(dim))
    found = power_array(sampler, counts, m) * counts["N"]
    expected = [float(scaled_power(sampler, counts, tuple(row))) for row in m.tolist()]
    assert found == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("dim", [1, 2, 3, 6])
def test_random_is_white(dim):
    sampler = parse_sampler("random", dim)
    assert scaled_power(sampler, {"N": 7}, (3,) + (0,) * (dim - 1)) == 1
    assert scaled_power(sampler, {"N": 7}, (3,) * dim) == 1


@given(frequencies(4, largest=9))
def test_blocks_of_one_axis_are_a_latin_hypercube(m):
    blocks, whole = (
        parse_sampler("uncorrelated-jitter:1+1+1+1", 4),
        parse_sampler("latin-hypercube", 4),
    )
    counts = {"N": 6} | {f"n{i}_1": 6 for i in range(1, 5)}
    assert float(scaled_power(blocks, counts, m)) == pytest.approx(
        float(scaled_power(whole, counts, m)), rel=1e-13, abs=0
    )


@given(frequencies(3, largest=9))
def test_one_block_is_jitter(m):
    block, whole = parse_sampler("uncorrelated-jitter:3", 3), parse_sampler("jitter", 3)
    counts = {"N": 64, "n": 4, "n1_1": 4}
    assert float(scaled_power(block, counts, m)) == pytest.approx(
        float(scaled_power(whole, counts, m)), rel=1e-13, abs=0
    )


@given(frequencies(2, largest=9))
def test_square_rectangle_is_the_orthogonal_array(m):
    square, whole = parse_sampler("multi-jitter:5x5", 2), parse_sampler("multi-jitter", 2)
    counts = {"N": 25, "m": 5, "n": 5, "s": 5}
    assert float(scaled_power(square, counts, m)) == pytest.approx(
        float(scaled_power(whole, counts, m)), rel=1e-12, abs=0
    )


@pytest.mark.parametrize("counts", [(1,), (2,), (7,), (2, 3), (3, 3), (2, 2, 2)])
def test_box_dpp_counts_the_frequencies_that_a_moved_box_shares(counts):
    """1 − |Λ ∩ (Λ + m)|/N by sets of frequencies."""
    box = set(product(*map(range, counts)))
    dim, names = len(counts), [f"n{i + 1}" for i in range(len(counts))]
    sampler = parse_sampler("box-dpp:" + "x".join(map(str, counts)), dim)
    held = dict(zip(names, counts, strict=True)) if len(set(counts)) > 1 else {"n": counts[0]}
    for m in some_frequencies(dim):
        shared = box & {tuple(a + b for a, b in zip(k, m, strict=True)) for k in box}
        expected = 1 - len(shared) / len(box)
        found = scaled_power(sampler, {"N": len(box), **held}, m)
        assert float(found) == pytest.approx(expected, abs=1e-15), m


@pytest.mark.parametrize("n", [3, 4, 5, 8])
def test_difference_jitter_is_the_sum_over_its_pairs(n):
    """E exp(−2πix(j + u_j − u_(j−1) − k − u_k + u_(k−1))) by how often each u occurs."""
    sampler = parse_sampler("difference-jitter", 1)
    for (m,) in some_frequencies(1):
        total = 0
        for j, k in product(range(n), repeat=2):
            times = np.zeros(n, int)
            for place, sign in ((j, 1), (j - 1, -1), (k, -1), (k - 1, 1)):
                times[place % n] += sign
            total += np.exp(-2j * np.pi * m * (j - k) / n) * np.prod(np.sinc(times * m / n))
        assert float(scaled_power(sampler, {"N": n}, (m,))) == pytest.approx(
            total.real / n, abs=1e-12
        )


@pytest.mark.parametrize(("name", "beta"), [("cloaked:1/2", 0.5), ("cloaked:2", 2.0)])
@pytest.mark.parametrize("dim", [1, 2, 3])
def test_cloaked_lattices_are_independent_points_of_cells(name, beta, dim):
    """1 − |φ|², φ the product of the characteristic functions sinc and exp(−|x|^β/2)."""
    sampler = parse_sampler(name, dim)
    for m in some_frequencies(dim):
        x = np.array(m) / 5
        wave = np.prod(np.sinc(x) * np.exp(-(np.abs(x) ** beta) / 2))
        found = scaled_power(sampler, {"N": 5**dim, "n": 5}, m)
        assert float(found) == pytest.approx(1 - wave**2, abs=1e-12), m


@pytest.mark.parametrize("case", [c for c in CASES if "regular" not in c])
def test_spectra_are_one_far_away(case):
    """No spectrum but that of a grid has a tooth that does not fade."""
    name, dim, counts, _ = CASES[case]
    far = (10**9 + 7,) * dim
    assert float(scaled_power(parse_sampler(name, dim), counts, far)) == pytest.approx(1, abs=1e-9)


A = Alphabet(("N", "n"))
FACTORS = [A.zero(), A.one(), A.comb(A.count("n")), A.sinc2(A.count("n")), A.sinc2(A.count("N"))]
VALUES = {"N": 12, "n": 3}


def value_of(kernel: Kernel, m: int) -> float:
    """A kernel on one axis at m ≠ 0, by its restriction."""
    total = mp.mpf(0)
    for term in kernel.restrict((1,)):
        value = element_value(term.coefficient, VALUES)
        for _, factor in term.factors:
            value *= factor_value(factor, m)
        total += value
    return float(total)


def factor_value(factor, m):
    total = mp.mpf(0)
    for coefficient, atom in factor.terms:
        value = element_value(coefficient, VALUES) * (m == 0 if atom.zero else 1)
        for comb in atom.combs:
            value *= m % int(element_value(comb, VALUES)) == 0
        for count in atom.sincs:
            value *= mp.sincpi(mp.mpf(m) / int(element_value(count, VALUES))) ** 2
        total += value
    return total


factors = st.lists(
    st.tuples(st.sampled_from(FACTORS), st.integers(-3, 3)), min_size=1, max_size=4
).map(lambda parts: sum((f.scaled(c) for f, c in parts[1:]), parts[0][0].scaled(parts[0][1])))


@given(factors, factors, st.integers(-20, 20))
def test_factors_are_closed_under_sum_and_product(f, g, m):
    a, b = factor_value(f, m), factor_value(g, m)
    assert float(factor_value(f + g, m)) == pytest.approx(float(a + b), abs=1e-12)
    assert float(factor_value(f - g, m)) == pytest.approx(float(a - b), abs=1e-12)
    assert float(factor_value(f * g, m)) == pytest.approx(float(a * b), abs=1e-10)


@given(factors, st.integers(-20, 20).filter(bool))
def test_off_zero_keeps_values_away_from_zero(f, m):
    assert float(factor_value(f.off_zero(), m)) == pytest.approx(float(factor_value(f, m)))


@given(factors)
def test_at_zero_is_the_value_at_zero(f):
    expected = factor_value(f, 0)
    at_zero = f.at_zero()
    assert float(expected) == pytest.approx(
        float(at_zero if isinstance(at_zero, int) else element_value(at_zero, VALUES))
    )


@given(factors, factors, st.integers(1, 20))
def test_kernels_are_closed_under_sum_and_product(f, g, m):
    """On an axis; ``single`` moves the value at 0 into the coefficient, so it must not vanish."""
    if f.at_zero() == 0 or g.at_zero() == 0:
        return
    first, second = A.single(0, f), A.single(0, g)
    a, b = value_of(first, m), value_of(second, m)
    assert value_of(first + second, m) == pytest.approx(a + b, abs=1e-10)
    assert value_of(first - second, m) == pytest.approx(a - b, abs=1e-10)
    assert value_of(first * second, m) == pytest.approx(a * b, abs=1e-10)
    assert value_of(first.scaled(3), m) == pytest.approx(3 * a, abs=1e-10)


def test_over_needs_a_factor_that_is_one_at_zero():
    with pytest.raises(ValueError, match="1 at m = 0: got 2"):
        A.over(0, A.one().scaled(2))


def test_a_sinc_on_its_own_teeth_vanishes():
    n = A.count("n")
    assert (A.comb(n) * A.sinc2(n)).off_zero().terms == ()


def test_what_knows_sinc_alone_is_refused_other_shapes():
    n = A.count("n")
    (_, sinc), *_ = A.sinc2(n).terms
    (_, tent), *_ = A.shape(TENT, n).terms
    assert sinc.sincs == (n,)
    with pytest.raises(InputError, match="sinc² and combs alone: got the shape tent"):
        _ = (sinc * tent).sincs


def test_shapes_of_a_kernel():
    half = stretched(Fraction(1, 2))
    assert parse_sampler("cloaked:1/2", 3).kernel.shapes == {SINC2, half}
    assert parse_sampler("box-dpp:2x3", 2).kernel.shapes == {TENT}
    assert parse_sampler("multi-jitter", 3).kernel.shapes == {SINC2}
    assert parse_sampler("random", 3).kernel.shapes == frozenset()


def test_a_stretched_exponential_stays_on_its_own_teeth():
    n, half = A.count("n"), stretched(Fraction(1, 2))
    assert len((A.comb(n) * A.shape(half, n)).off_zero().terms) == 1
    assert (A.comb(n) * A.shape(TENT, n)).off_zero().terms == ()


def test_atoms_multiply():
    n = A.count("n")
    both = Atom(combs=(n,)) * Atom(combs=(n,), shapes=((SINC2, n),), zero=True)
    assert both == Atom(zero=True, combs=(n,), shapes=((SINC2, n),))


@pytest.mark.parametrize(("name", "dim"), [("jitter", 2), ("latin-hypercube", 3), ("random", 2)])
def test_restriction_drops_what_a_support_does_not_see(name, dim):
    sampler = parse_sampler(name, dim)
    terms = sampler.kernel.restrict((1,) + (0,) * (len(sampler.layout.groups) - 1))
    assert 1 <= len(terms) <= 2


def test_at_zero_is_the_formula_at_zero():
    """Σ_m uses the formula for all m; at 0 a sampler's own value is N."""
    for name, dim, counts, _ in CASES.values():
        sampler = parse_sampler(name, dim)
        at_zero = element_value(sampler.kernel.at_zero(), counts)
        if name.startswith(("jitter",)) or (name, dim) == ("multi-jitter", 1):
            assert at_zero == 0
        elif name != "random":
            assert at_zero == pytest.approx(counts["N"], rel=1e-12), name
