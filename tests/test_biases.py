"""Biases: amplitudes whose mean is not 0 are told; the level holds by an exact identity.

Every draw is keyed by a fixed seed; with another one, a sampler without bias is reported with a
probability of at most 1e-6 a call.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from point_sets import centred_latin_hypercube, grid, independent, of_kind
from specrate.numerics.checking.biases import axis_means, log_capital, measured_bias
from specrate.numerics.checking.faults import BIAS_LEVEL, Findings, find_faults
from specrate.numerics.measuring.moments import Moments, update
from specrate.numerics.measuring.probes import amplitudes, frequencies
from specrate.numerics.point_sources.fault_kinds import Fault
from specrate.numerics.streams import stream


def biases(points: np.ndarray, cells: tuple[int, ...] = ()) -> list[Fault]:
    return of_kind(find_faults(points, cells), "bias")


def test_means_along_the_axes_are_the_sums_they_stand_for() -> None:
    points, wanted = stream(45).random((7, 20_000, 3)), [1, 2, 5, 8, 9, 20_000]
    direct = [np.exp(-2j * np.pi * k * points).mean(axis=1) for k in wanted]
    found = axis_means(points, wanted)
    np.testing.assert_allclose(found, np.stack(direct, axis=1), rtol=0, atol=1e-13)


def test_n_rooks_without_jitter_is_biased() -> None:
    """The defect in the wild: variance 0 for f = x, bias 1/(2N)."""
    (fault,) = biases(centred_latin_hypercube(40, 64, 2, stream(25)))
    assert fault.detail == (
        "marginals must be uniform, E exp(-2 pi i 64 x) = 0: got -1.000 on axis 1; "
        "points sit at fixed places of 64 cells, on 2 axes in all"
    )
    assert fault.remedy.startswith("jitter inside the strata, or shift each realisation")
    assert fault.evidence["axes"] == [1, 2]
    for axis, coefficient in zip((1, 2), fault.evidence["coefficients"], strict=True):
        assert (coefficient["axis"], coefficient["frequency"]) == (axis, 64)
        assert coefficient["real"] == pytest.approx(-1)


def test_power_at_stratum_centres_is_29_realisations() -> None:
    """As the docstring of `find_faults` states; the coefficient is -1 every time."""
    points = centred_latin_hypercube(29, 64, 2, stream(26))
    assert biases(points)[0].evidence["axes"] == [1, 2]
    assert not biases(points[:28])


def test_cells_reveal_half_jitter() -> None:
    """Jitter over half of each cell: E exp(-2 pi i 10 x) = -2i/pi, seen at the cells given."""
    R, N = 150, 100
    points = grid(N, 2) + stream(27).random((R, N, 2)) / 20
    for cells in ((10,), ()):  # N^(1/2) is looked at in any case
        (fault,) = biases(points, cells)
        assert fault.evidence["axes"] == [1, 2]
        assert "points prefer fixed places of 10 cells" in fault.detail
        assert {f["frequency"] for f in fault.evidence["coefficients"]} == {10}
        found = [f["imaginary"] for f in fault.evidence["coefficients"]]
        assert found == pytest.approx([-2 / np.pi] * 2, abs=0.02)


def test_a_sloping_density_is_biased_on_its_axis_only() -> None:
    points = independent(400, 64, 2, stream(28))
    points[:, :, 1] **= 1.5
    (fault,) = find_faults(points).faults
    assert fault.evidence["axes"] == [2]
    assert "E exp(-2 pi i 1 x)" in fault.detail
    assert fault.detail.endswith("the density along the axis is not uniform")


def fixed_arrangement(R: int, N: int, rng: np.random.Generator) -> np.ndarray:
    """n-rooks with the same permutation every time: uniform marginals, fixed pairs."""
    ranks = np.stack([np.arange(N), stream(5).permutation(N)], axis=1)
    return (ranks + rng.random((R, N, 2))) / N


def homogeneity(points: np.ndarray) -> tuple[Findings, dict[tuple[int, ...], complex]]:
    """What is found with the amplitudes, and their means."""
    wanted = frequencies(points.shape[1], points.shape[2])
    found = dict(zip(wanted, amplitudes(points, wanted), strict=True))
    return find_faults(points, amplitudes=found), {m: z.mean() for m, z in found.items()}


def test_a_fixed_arrangement_is_not_homogenised() -> None:
    """A coefficient z takes about 20 / |z| realisations, so that 128 show those above 1/6."""
    told, means = homogeneity(fixed_arrangement(128, 16, stream(41)))
    (fault,) = of_kind(told, "not homogenised")
    assert told.faults == (fault,)
    steady = [m for m, z in means.items() if max(abs(z.real), abs(z.imag)) > 1 / 6]
    shown = {tuple(c["frequency"]): c for c in fault.evidence["coefficients"]}
    assert 1 <= len(steady) <= fault.evidence["failing"]
    assert len(shown) == min(fault.evidence["failing"], 8)
    assert len(set(steady) & set(shown)) == min(len(steady), 8)
    for m, c in shown.items():
        assert complex(c["real"], c["imaginary"]) == pytest.approx(means[m])
    assert "measured spectra hold, since a shift leaves them as they are" in fault.detail


def test_one_shift_for_each_realisation_homogenises() -> None:
    """False alarm at most 1e-6; the remedy mends the fault."""
    fixed = fixed_arrangement(128, 16, stream(43))
    assert homogeneity((fixed + stream(44).random((128, 1, 2))) % 1.0)[0].faults == ()


@pytest.mark.parametrize("points", [grid(64, 2) + 1 / 16, stream(29).random((64, 2))])
def test_a_frozen_set_is_told_once(points: np.ndarray) -> None:
    """Equal realisations are not independent: their means are no test of anything else."""
    found = find_faults(np.broadcast_to(points, (40, 64, 2)), cells=(8,))
    kinds = [fault.kind for fault in found.faults]
    assert kinds[0] == "duplicate realisations"
    assert kinds[-1] == "not homogenised"
    assert "bias" not in kinds
    assert found.distinct == 1
    assert "got one point set in all 40" in found.faults[-1].detail


@pytest.mark.parametrize("R", [1, 2, 5, 10])
def test_capital_of_a_fair_coin_has_expectation_one(R: int) -> None:
    """Exact, over all sequences: so the level of the test holds by Markov's inequality."""
    sequences = np.array(list(itertools.product([-1.0, 1.0], repeat=R))).T
    assert np.exp(log_capital(sequences)).mean() == pytest.approx(1, rel=1e-12)


@settings(deadline=None)
@given(
    low=st.floats(-1, -1e-9),
    high=st.floats(1e-9, 1),
    R=st.integers(1, 6),
)
def test_capital_of_any_two_values_of_mean_zero(low: float, high: float, R: int) -> None:
    """Exact, over all sequences of a variable in [-1, 1] with two values and mean 0."""
    chance = np.array([high, -low]) / (high - low)
    sequences = np.array(list(itertools.product([0, 1], repeat=R))).T
    capital = np.exp(log_capital(np.array([low, high])[sequences]))
    assert np.sum(capital * chance[sequences].prod(axis=0)) == pytest.approx(1, rel=1e-9)


def test_no_valid_test_needs_fewer_than_24() -> None:
    """A fair coin shows ±1 in every one of R realisations with probability 2^(1 - R)."""
    tests = 2 * 5 * 2  # cosine and sine, k = 1, 2, 3, N^(1/2) and N, two axes
    assert BIAS_LEVEL / tests < 2.0 ** (1 - 23)
    needed = math.log(14 * tests / BIAS_LEVEL) / math.log(1.98)
    assert math.ceil(needed) == 29


def test_a_small_bias_shows_in_all_realisations():
    """Means 7 standard errors off: found at 13, not at 4, nor with too few realisations."""
    errors = stream(43).normal(size=2048) / 10
    errors -= errors.mean()
    for mean, count, is_found in ((0.03, 2048, True), (0.009, 2048, False), (0.3, 512, False)):
        fault = measured_bias(16, {"bernoulli:k=1": update(Moments(), errors[:count] + mean)})
        assert (fault is not None) is is_found
    assert measured_bias(16, {"bernoulli:k=1": update(Moments(), np.full(2048, 1e-16))}) is None
