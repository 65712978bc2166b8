"""Generators: the exact spectrum, every stratum filled once, and the same points from a stream.

The spectrum is compared at every probed frequency by the interval of level 1e-8 over their number:
a correct generator fails a test with a probability below 1e-8. The neighbour that each is tested
against differs by a factor of 1.5 somewhere; 3000 realisations tell that apart with a probability
above 1 - 1e-8, since 1.5 then is more than 10 standard errors.
"""

from fractions import Fraction

import numpy as np
import pytest
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.generators import generate
from specrate.numerics.generators.cloaked import log_stable
from specrate.numerics.generators.unitary_phases import unitary_phases, verblunsky
from specrate.numerics.measuring.moments import Moments, update, variance_interval
from specrate.numerics.measuring.probes import amplitudes, frequencies, strata_of_claim
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

REALISATIONS = 3000

CASES = (
    ("random", 2, 16, "jitter"),
    ("regular", 2, 16, "jitter"),
    ("regular:2x8", 2, 16, "regular"),
    ("jitter", 1, 9, "random"),
    ("jitter", 2, 16, "multi-jitter"),
    ("jitter:2x8", 2, 16, "jitter"),
    ("jitter", 3, 27, "multi-jitter"),
    ("latin-hypercube", 1, 9, "random"),
    ("latin-hypercube", 2, 16, "multi-jitter"),
    ("latin-hypercube", 3, 25, "uncorrelated-jitter:1+2"),
    ("multi-jitter", 2, 16, "correlated-multi-jitter"),
    ("multi-jitter:2x8", 2, 16, "multi-jitter"),
    ("multi-jitter", 3, 27, "jitter"),
    ("correlated-multi-jitter", 2, 16, "multi-jitter"),
    ("correlated-multi-jitter:2x8", 2, 16, "correlated-multi-jitter"),
    ("uncorrelated-jitter:1+2", 3, 25, "latin-hypercube"),
    ("uncorrelated-jitter:2+1", 3, 25, "uncorrelated-jitter:1+2"),
    ("uncorrelated-jitter:2+2", 4, 16, "jitter"),
    ("box-dpp", 1, 9, "jitter"),
    ("box-dpp", 1, 17, "cloaked:1/2"),
    ("box-dpp", 2, 16, "cloaked:1"),
    ("box-dpp:2x3", 2, 6, "random"),
    ("box-dpp", 3, 8, "random"),
    ("cloaked:1/2", 1, 9, "cloaked:1"),
    ("cloaked:1", 2, 16, "jitter"),
    ("cloaked:3/2", 1, 16, "jitter"),
    ("cloaked:2", 2, 16, "cloaked:1/2"),
    ("cloaked:1/10", 1, 9, "cloaked:1/2"),
    ("difference-jitter", 1, 3, "jitter"),
    ("difference-jitter", 1, 16, "cloaked:2"),
)


def outside(name, dim, n, powers):
    """Frequencies whose measured interval misses the named sampler's power, and their number."""
    sampler = parse_sampler(name, dim)
    counts = sampler.counts_at(n)
    assert counts["N"] == n
    exact = np.maximum(power_array(sampler, counts, np.array(list(powers))), 0.0)
    missed = {}
    for (m, moments), predicted in zip(powers.items(), exact, strict=True):
        interval = variance_interval(moments, 1e-8 / len(powers))
        if not interval.low - 1e-15 <= predicted <= interval.high + 1e-15:
            missed[m] = (interval, predicted)
    return missed


@pytest.mark.parametrize(("name", "dim", "n", "neighbour"), CASES)
def test_spectrum(name, dim, n, neighbour):
    sampler = parse_sampler(name, dim)
    points = generate(sampler, sampler.counts_at(n), REALISATIONS, stream(71, n, dim))
    wanted = frequencies(n, dim, strata_of_claim(sampler, n))
    found = np.abs(amplitudes(points, wanted))
    powers = {m: update(Moments(), row) for m, row in zip(wanted, found, strict=True)}
    assert outside(name, dim, n, powers) == {}
    other = parse_sampler(neighbour, dim)
    if other.counts_at(n)["N"] == n:
        own, wrong = (
            power_array(s, s.counts_at(n), np.array(wanted)) + 1e-9 for s in (sampler, other)
        )
        assert np.max(np.abs(np.log(own / wrong))) > np.log(1.5)
        assert outside(neighbour, dim, n, powers)


def test_every_neighbour_but_none_is_compared():
    """The power above is not vacuous: each neighbour has realisations of as many points."""
    for _, dim, n, neighbour in CASES:
        assert parse_sampler(neighbour, dim).counts_at(n)["N"] == n


def test_traces_of_unitary_matrices():
    """E |tr U|⁴ = 2 for N >= 2, where |tr U|² is nearly exponential (Diaconis, Shahshahani 1994).

    Beyond pairs of points; for independent ones it is 2N² − N. As E |tr U|^8 = 24, of 10 000 values
    the mean has a standard error of 0.045: it is not within 0.36, 8 of them, with a probability
    below 1e-10 (1e-15 by the central limit, more by the skewness).
    """
    phases = unitary_phases(8, 10_000, stream(76))
    fourth = np.abs(np.exp(2j * np.pi * phases).sum(axis=1)) ** 4
    assert fourth.mean() == pytest.approx(2, abs=0.36)


def test_unitary_phases_are_those_of_their_coefficients():
    """Zeros of the last orthogonal polynomial of Szegő's recursion, N = 7."""
    alphas = verblunsky(7, 1, stream(77, 1))[0]
    phases = unitary_phases(7, 1, stream(77, 1))[0]
    z = np.exp(2j * np.pi * phases)
    phi, star = np.ones_like(z), np.ones_like(z)
    for alpha in alphas:
        phi, star = z * phi - np.conj(alpha) * star, star - alpha * z * phi
    last = z * phi / star  # conj of the last coefficient, of modulus 1, the same for all
    assert np.abs(last) == pytest.approx(1, abs=1e-12)
    assert last == pytest.approx(np.full(7, last[0]), abs=1e-11)
    assert (np.diff(phases) > 0).all()


@pytest.mark.parametrize("beta", [Fraction(1, 10), Fraction(1, 2), Fraction(1), Fraction(2)])
def test_stable_numbers_have_their_characteristic_function(beta):
    """E cos tS = exp(−|t|^β): of 20 000 cosines the mean is within 6.5 standard errors but with
    probability 1e-10. At t = 2 β = 1/2 and 1 differ by 0.1, 20 of them."""
    size, sign = log_stable(beta, (20_000,), stream(78))
    values = sign * np.exp(np.minimum(size, 500))
    for t in (0.25, 1.0, 2.0):
        wave = np.cos(t * values)
        assert wave.mean() == pytest.approx(np.exp(-(t ** float(beta))), abs=6.5 / np.sqrt(40_000))


@pytest.mark.parametrize(("name", "dim", "n"), [("box-dpp", 2, 289), ("box-dpp", 1, 4097)])
def test_determinantal_points_have_a_largest_number(name, dim, n):
    sampler = parse_sampler(name, dim)
    with pytest.raises(InputError, match=f"drawn up to N = .* with --dim {dim}: got {n}"):
        generate(sampler, sampler.counts_at(n), 1, stream(0))


def test_determinantal_points_come_in_any_number_of_realisations():
    sampler = parse_sampler("box-dpp", 2)
    for replicates in (0, 1, 405):  # more than are drawn together
        points = generate(sampler, sampler.counts_at(36), replicates, stream(79))
        assert points.shape == (replicates, 36, 2)


def occupied(points, strata):
    """Whether each realisation has one point in every cell of a grid over the given axes."""
    cells = np.floor(points * np.array(strata)).astype(int)
    numbers = np.ravel_multi_index(tuple(np.moveaxis(cells, -1, 0)), strata)
    return np.array_equal(
        np.sort(numbers, axis=1), np.broadcast_to(np.arange(np.prod(strata)), numbers.shape)
    )


STRATA = (
    ("regular:3x5", 2, 15, [((1, 2), (3, 5))]),
    ("jitter:3x5", 2, 15, [((1, 2), (3, 5))]),
    ("jitter", 3, 64, [((1, 2, 3), (4, 4, 4))]),
    ("latin-hypercube", 3, 17, [((1,), (17,)), ((2,), (17,)), ((3,), (17,))]),
    ("multi-jitter:3x5", 2, 15, [((1, 2), (3, 5)), ((1,), (15,)), ((2,), (15,))]),
    ("multi-jitter", 3, 27, [((1, 2, 3), (3, 3, 3)), ((1,), (27,)), ((3,), (27,))]),
    ("multi-jitter", 1, 7, [((1,), (7,))]),
    ("correlated-multi-jitter:3x5", 2, 15, [((1, 2), (3, 5)), ((1,), (15,)), ((2,), (15,))]),
    ("uncorrelated-jitter:1+2", 3, 25, [((1,), (25,)), ((2, 3), (5, 5))]),
    ("uncorrelated-jitter:2+2", 4, 36, [((1, 2), (6, 6)), ((3, 4), (6, 6))]),
    ("box-dpp", 1, 20, []),
    ("box-dpp", 2, 9, []),
    ("cloaked:1/10", 2, 9, []),
    ("difference-jitter", 1, 20, []),
)


@pytest.mark.parametrize(("name", "dim", "n", "grids"), STRATA)
def test_each_stratum_holds_one_point(name, dim, n, grids):
    sampler = parse_sampler(name, dim)
    points = generate(sampler, sampler.counts_at(n), 50, stream(72))
    assert points.shape == (50, n, dim)
    assert points.min() >= 0
    assert points.max() < 1
    for axes, strata in grids:
        assert occupied(points[:, :, [a - 1 for a in axes]], strata)


def test_random_and_jitter_do_not_stratify_what_they_should_not():
    """Chance that 50 realisations of 16 random values fill 16 strata: below 1e-200."""
    for name in ("random", "jitter"):
        sampler = parse_sampler(name, 2)
        points = generate(sampler, sampler.counts_at(16), 50, stream(73))
        assert not occupied(points[:, :, :1], (16,))


def test_the_shuffle_of_a_column_is_shared_only_by_correlated_multi_jitter():
    """Kensler: the substrata of all columns are in one order, those of multi-jitter are not."""
    orders = {}
    for name in ("multi-jitter", "correlated-multi-jitter"):
        sampler = parse_sampler(name, 2)
        points = generate(sampler, sampler.counts_at(36), 20, stream(74))
        cells = np.floor(points * 6).astype(int)
        fine = np.floor(points[:, :, 0] * 36).astype(int) % 6
        table = np.empty((20, 6, 6), int)
        rows = np.arange(20)[:, None]
        table[rows, cells[:, :, 0], cells[:, :, 1]] = fine
        orders[name] = np.all(table == table[:, :1], axis=(1, 2))
    assert orders["correlated-multi-jitter"].all()
    assert not orders["multi-jitter"].any()


@pytest.mark.parametrize(("name", "dim", "n", "grids"), STRATA)
def test_points_are_those_of_their_stream(name, dim, n, grids):
    sampler = parse_sampler(name, dim)
    first, again, other = (
        generate(sampler, sampler.counts_at(n), 4, stream(75, k)) for k in (0, 0, 1)
    )
    np.testing.assert_array_equal(first, again)
    assert not np.isin(other, first).any()


def test_a_free_profile_has_no_points():
    with pytest.raises(InputError, match="must have a generator: got isotropic"):
        generate(parse_sampler("isotropic:2", 2), {"N": 4}, 1, stream(0))
