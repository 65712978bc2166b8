"""Extrapolation: exponentials removed, errors that hold, swings that are told."""

import random
from math import comb

import pytest
from specrate.numerics.exact_variances.extrapolation import LEAST, extrapolated
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError


@pytest.fixture(autouse=True)
def _digits():
    with mp.workdps(60):
        yield


def exponentials(limit, terms, length):
    """S + Σ a λ^j, and the same with its terms moved by their errors."""
    error = mp.mpf(10) ** -55
    found = [limit + mp.fsum(a * mp.mpf(x) ** j for a, x in terms) for j in range(length)]
    return found, [s + (error if j % 4 < 2 else -error) for j, s in enumerate(found)]


def test_known_numbers_of_exponentials_are_removed_exactly():
    """K of them by 2K + 1 terms; the error stays that of the column before, which is not exact."""
    sequence = exponentials(mp.mpf(2), [(3, 0.5), (-1, 0.3), (7, -0.2)], 17)
    found = extrapolated(*sequence)
    assert abs(found.value - 2) < 1e-40
    assert found.error < 1e-6


def test_powers_of_n_on_a_doubled_ladder():
    """ln 2 by the alternating harmonic sum's means over 2^j terms: unknown powers of 1/n."""
    sums = [mp.fsum(1 / (mp.mpf(2**j) + k) for k in range(1, 2**j + 1)) for j in range(11)]
    found = extrapolated(sums, sums)
    assert abs(found.value - mp.log(2)) <= found.error < 1e-10


def test_a_constant_sequence_has_the_error_of_its_terms():
    error = mp.mpf(10) ** -30
    found = extrapolated([mp.mpf(1)] * 7, [1 + (-1) ** j * error for j in range(7)])
    assert found.value == 1
    assert error <= found.error <= 100 * error


@pytest.mark.parametrize(
    "pattern",
    [[1, -1], [1, 2, 4, 3], [3, 1, 2], [0, 0, 1], [0, 0, 0, 1], [1, 0, 0, 2, 0]],
)
def test_what_swings_for_ever_has_no_limit(pattern):
    """|λ| = 1: the algorithm would give the mean."""
    sequence = [mp.mpf(2) + pattern[j % len(pattern)] for j in range(17)]
    assert extrapolated(sequence, sequence).error == mp.inf


def test_a_swing_beside_decaying_terms_is_told():
    sequence = [1 + mp.mpf(2) ** -j + (-1) ** j * mp.mpf("0.01") for j in range(17)]
    assert extrapolated(sequence, sequence).error == mp.inf


def test_what_diverges_has_no_limit():
    for ratio in ("1.01", "2"):
        sequence = [mp.mpf(ratio) ** j for j in range(17)]
        assert extrapolated(sequence, sequence).error == mp.inf


def test_logarithmic_convergence_is_not_trusted():
    """1/(1 + j): local slopes with a logarithm."""
    sequence = [1 / mp.mpf(20 + j) for j in range(17)]
    found = extrapolated(sequence, sequence)
    assert abs(found.value) <= found.error
    assert found.error > 1e-6


def test_too_few_terms_are_refused():
    with pytest.raises(InputError, match="5 terms or more"):
        extrapolated([mp.mpf(1)] * (LEAST - 1), [mp.mpf(1)] * (LEAST - 1))


CASES, MISSES = 600, 5


def random_case(source):
    """Up to eight exponentials, some with j in front, seen on 9 to 17 terms."""
    limit = mp.mpf(source.gauss(0, 1))
    terms = [
        (
            source.gauss(0, 1) * 10 ** source.uniform(-2, 2),
            source.gauss(0, 1) if source.random() < 0.3 else 0,
            2 ** -source.uniform(0.3, 6),
        )
        for _ in range(source.randint(1, 8))
    ]
    length = source.randint(9, 17)
    exact = [
        limit + mp.fsum((a + b * j) * mp.mpf(x) ** j for a, b, x in terms) for j in range(length)
    ]
    error = mp.mpf(10) ** -source.uniform(20, 50)
    seen = [s + source.uniform(-1, 1) * error for s in exact]
    return limit, extrapolated(seen, [s + (-1) ** (j // 2) * error for j, s in enumerate(seen)])


def test_stated_errors_hold_in_99_of_100_random_cases():
    """At most 5 of 600 limits farther off than stated; the seed is fixed, so no alarm is false.

    Without the factor ten, where 7 of 100 are, 5 or fewer would be seen with probability 1e-12.
    The errors are also of use: the median is below 1e-6.
    """
    source = random.Random(20161)
    found = [random_case(source) for _ in range(CASES)]
    misses = sum(bool(abs(e.value - limit) > e.error) for limit, e in found)
    assert misses <= MISSES
    assert sorted(e.error for _, e in found)[CASES // 2] < 1e-6
    rare = sum(comb(CASES, k) * 0.07**k * 0.93 ** (CASES - k) for k in range(MISSES + 1))
    assert rare < 1e-11
