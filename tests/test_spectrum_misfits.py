"""Spectra outside the model of one saturating power: what is found, and what is not."""

import numpy as np
import pytest
from specrate.numerics.fitting.coverage_truths import TRUTHS, along, generic
from specrate.numerics.fitting.fit_coverage import LADDER, frequencies, spectra
from specrate.numerics.fitting.profile_fits import EstimatedSpectrum, fit_profile
from specrate.numerics.fitting.spectrum_misfits import FALSE_ALARM
from specrate.numerics.streams import stream


def drawn(mean, truth_frequencies, budget, seed):
    rng, found = stream(seed), []
    for n in budget.sizes:
        m = truth_frequencies(n, budget.frequencies)
        r = budget.realisations
        found.append(EstimatedSpectrum(n, r, m, mean(n, m) * rng.gamma(r, 1 / r, len(m))))
    return found


def on_two(n, count):
    return generic(n, max(4, round(0.45 * count)))


def net(degree):
    """N·P_S falls with ∏ |m_i|/N, as that of a scrambled net does with its resolution."""
    return lambda n, m: -np.expm1(-((np.abs(m).prod(axis=1) / n) ** degree))


def logarithmic(power):
    """(|m|/N)² (log N)^power."""
    return lambda n, m: -np.expm1(-((m[:, 0] / n) ** 2) * np.log(n) ** power)


@pytest.mark.parametrize("place", [2, 4])
@pytest.mark.parametrize("degree", [1, 3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_degree_in_the_product_of_frequencies_is_found(degree, place, seed):
    fitted = fit_profile(drawn(net(degree), on_two, LADDER[place], seed))
    assert fitted.outside_model is not None
    assert "product of the frequencies" in fitted.outside_model
    assert fitted.degree is None


@pytest.mark.parametrize("power", [-2, 1, 3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_logarithms_are_found(power, seed):
    """With R = 4096 and N to 16384; fewer do not show the first power of a logarithm."""
    fitted = fit_profile(drawn(logarithmic(power), along, LADDER[4], seed))
    assert fitted.outside_model is not None
    assert "logarithms" in fitted.outside_model
    assert fitted.outside_model.count("-") == (power < 0)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_bragg_peaks_are_found(seed):
    def mean(n, m):
        return np.where(m[:, 0] % n == 0, 0.9 * n, -np.expm1(-3 * (m[:, 0] / n) ** 2))

    def with_peaks(n, count):
        return np.unique(np.concatenate([along(n, count), [[n], [2 * n], [3 * n]]]), axis=0)

    fitted = fit_profile(drawn(mean, with_peaks, LADDER[2], seed))
    assert fitted.outside_model is not None


def test_a_rise_towards_low_frequencies_is_found():
    def mean(n, m):
        return 1 + n / m[:, 0]

    assert fit_profile(drawn(mean, along, LADDER[3], 1)).outside_model is not None


@pytest.mark.parametrize("truth", [pytest.param(t, id=t.name) for t in TRUTHS])
@pytest.mark.parametrize("budget", LADDER[:3], ids=lambda b: f"R{b.realisations}")
def test_spectra_with_a_profile_are_not_reported(truth, budget):
    """33 fits: a false alarm has probability 33 × 1e-6 at most, were the bound attained."""
    assert FALSE_ALARM == 1e-6
    fitted = fit_profile(spectra(truth, budget, stream(11)))
    assert fitted.outside_model is None
    assert fitted.used > 0


def test_smooth_direction_dependence_is_no_degree_in_the_product():
    """An amplitude that varies by a factor of three with direction."""

    def mean(n, m):
        square = (m.astype(float) ** 2).sum(axis=1) / n
        angle = m.astype(float).prod(axis=1) / (m.astype(float) ** 2).sum(axis=1)
        return -np.expm1(-square * (2 + 2 * angle))

    for seed in range(3):
        assert fit_profile(drawn(mean, on_two, LADDER[2], seed)).outside_model is None


def test_on_two_coordinates_are_the_frequencies_of_the_ladder():
    truth = next(t for t in TRUTHS if "generic" in t.name)
    assert np.array_equal(on_two(64, 24), frequencies(truth, LADDER[4], 64))
