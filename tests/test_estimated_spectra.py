"""Estimated spectra: what is refused, which frequencies are kept, what scatter does."""

import numpy as np
import pytest
from specrate.numerics.fitting.estimated_spectra import (
    EstimatedSpectrum,
    cone,
    excess,
    rounding,
    sample_of,
)
from specrate.numerics.measuring.probes import amplitudes
from specrate.theory.errors import InputError


def spectrum(frequencies, power=None, n=16, r=4, dispersion=None):
    m = np.array(frequencies, dtype=np.int64)
    power = np.ones(len(m)) if power is None else np.array(power, dtype=float)
    return EstimatedSpectrum(n, r, m, power, dispersion)


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"n": 1}, "2 <= N"),
        ({"r": 0}, "1 <= realisations"),
        ({"frequencies": [[0, 0]], "power": [1]}, "m != 0"),
        ({"power": [1, -1]}, "0 <= N|F|²"),
        ({"power": [1, np.nan]}, "0 <= N|F|²"),
        ({"power": [1, np.inf]}, "0 <= N|F|²"),
        ({"power": [1]}, "frequencies"),
        ({"dispersion": np.array([1, -1.0])}, "dispersion"),
        ({"dispersion": np.array([1, np.inf])}, "dispersion"),
    ],
)
def test_bad_spectra_are_refused_with_the_rule(change, rule):
    with pytest.raises(InputError, match=rule.replace("|", r"\|")):
        spectrum(**({"frequencies": [[1, 1], [2, 1]]} | change))


def test_real_frequencies_are_refused():
    with pytest.raises(InputError, match="integer"):
        EstimatedSpectrum(16, 4, np.ones((2, 1)), np.ones(2))


@pytest.mark.parametrize(
    ("spectra", "rule"),
    [
        ([], "at least one frequency"),
        ([spectrum(np.zeros((0, 2)))], "at least one frequency"),
        ([spectrum([[1, 0], [1, 1]])], "nonzero coordinates"),
        ([spectrum([[1]]), spectrum([[1, 1]])], "one dimension"),
    ],
)
def test_what_is_no_region_is_refused(spectra, rule):
    with pytest.raises(InputError, match=rule):
        sample_of(spectra)


def test_one_of_each_pair_is_kept():
    sample = sample_of([spectrum([[1, 2], [-1, -2], [1, -2], [3, 1], [3, 1]])])
    assert sorted(map(tuple, np.abs(sample.frequencies).tolist())) == [(1, 2), (1, 2), (3, 1)]


def test_long_lists_are_thinned_evenly():
    m = np.arange(1, 5001)[:, None]
    sample = sample_of([spectrum(m, n=64), spectrum(m[:50], n=16)])
    at_64 = np.sort(sample.frequencies[sample.log_n > 4][:, 0])
    assert at_64.size <= 400
    assert at_64[:5].tolist() == [1, 2, 3, 4, 5]
    assert at_64[-1] == 5000
    assert (sample.log_n < 4).sum() == 50


def test_the_cone_holds_what_is_near_the_diagonal():
    sample = sample_of([spectrum([[1, 1], [4, 1], [5, 1], [1, -3], [40, 1]])])
    assert sorted(cone(sample).frequencies.tolist()) == [[1, -3], [1, 1], [4, 1]]
    assert excess(sample).max() == pytest.approx(np.log(10))


def test_without_a_cone_everything_is_kept():
    sample = sample_of([spectrum([[1, 1], [40, 1], [50, 1]])])
    assert len(cone(sample).power) == 3


def test_scatter_beyond_the_gamma_law_lowers_the_weight():
    m = [[k] for k in range(1, 6)]
    even = sample_of([spectrum(m, r=30, dispersion=np.ones(5))])
    wide = sample_of([spectrum(m, r=30, dispersion=np.full(5, 3.0))])
    unknown = sample_of([spectrum(m, r=30, dispersion=np.full(5, np.nan))])
    narrow = sample_of([spectrum(m, r=30, dispersion=np.full(5, 0.5))])
    assert even.shape.tolist() == unknown.shape.tolist() == narrow.shape.tolist() == [30.0] * 5
    assert wide.shape == pytest.approx(30 / 11)


@pytest.mark.parametrize("n", [16, 1024, 65536])
def test_the_zeros_of_a_grid_are_below_the_rounding(n):
    """A regular grid has N|F|² = N where N divides m, else 0, and rounding knows which."""
    points = (np.arange(n) + 0.3) / n
    frequencies = [1, 2, n // 2 + 1, n - 1, n, 4 * n - 1]
    power = n * np.abs(amplitudes(points.reshape(1, n, 1), [(m,) for m in frequencies])[:, 0]) ** 2
    sample = sample_of([spectrum([[m] for m in frequencies], power, n=n)])
    zero = sample.power <= rounding(sample)
    assert zero.tolist() == [m % n != 0 for m in sample.frequencies[:, 0].tolist()]
    assert rounding(sample).max() < 1e-10
