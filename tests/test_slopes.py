"""Points and straight-line fits."""

import numpy as np
import pytest
from ladders import MULTI_JITTER_DISK, SIZES, multi_jitter_disk, points
from scipy import special
from specrate.numerics.measuring.slopes import RatePoint, fit_slope
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError


def test_fit_recovers_a_power_law_with_its_logarithm():
    law = 3 * SIZES**-1.5 * np.log(SIZES) ** 2
    fit = fit_slope(points(law, 0.01), log_power=2)
    assert fit.slope.estimate == pytest.approx(-1.5, abs=1e-12)
    assert fit.intercept == pytest.approx(np.log(3), abs=1e-10)
    assert fit.chi2 == pytest.approx(0, abs=1e-12)
    assert [s.estimate for s in fit.local_slopes] == pytest.approx([-1.5] * 4)


def test_fit_weighs_by_the_errors():
    sizes, errors = np.array([10.0, 100, 1000]), np.array([0.01, 0.02, 0.3])
    law = sizes**-1.0 * np.array([1, 1.1, 2])
    data = [RatePoint(*p) for p in zip(sizes, law, errors, strict=True)]
    fit = fit_slope(data, level=0.05)
    line, cov = np.polyfit(np.log(sizes), np.log(law), 1, w=1 / errors, cov="unscaled")
    assert fit.slope.estimate == pytest.approx(line[0])
    assert fit.intercept == pytest.approx(line[1])
    half = 1.959963985 * np.sqrt(cov[0, 0])
    assert fit.slope.high - fit.slope.estimate == pytest.approx(half)
    residual = np.log(law) - np.polyval(line, np.log(sizes))
    assert fit.chi2 == pytest.approx(np.sum((residual / errors) ** 2))


def test_fit_of_local_slopes():
    fit = fit_slope(points(multi_jitter_disk(), 0.01), level=0.3173105)
    assert [s.estimate for s in fit.local_slopes] == pytest.approx(MULTI_JITTER_DISK)
    half = 0.01 * np.sqrt(2) / np.log(4)
    assert [s.high - s.estimate for s in fit.local_slopes] == pytest.approx([half] * 4, rel=1e-5)


def test_fit_interval_covers_at_its_level():
    """2000 fits at level 0.1; the bounds on the misses have probability 1e-7 together."""
    rng, misses = stream(41), 0
    for _ in range(2000):
        noisy = SIZES**-1.5 * np.exp(0.05 * rng.standard_normal(5))
        slope = fit_slope(points(noisy, 0.05), level=0.1).slope
        misses += not slope.low <= -1.5 <= slope.high
    assert special.bdtrik(2.5e-8, 2000, 0.1) - 1 <= misses <= special.bdtrik(1 - 2.5e-8, 2000, 0.1)


def test_a_straight_line_would_contradict_it():
    fit = fit_slope(points(multi_jitter_disk(), 0.01), level=1e-6)
    assert fit.slope.low > -1.5


@pytest.mark.parametrize(
    ("n", "variance", "error"),
    [(1, 1, 0.1), (1e31, 1, 0.1), (4, 0, 0.1), (4, 1, 0), (4, np.inf, 1), (4, 1, np.nan)],
)
def test_unusable_points_are_refused(n, variance, error):
    with pytest.raises(InputError, match="got"):
        RatePoint(n, variance, error)


def test_fewer_than_two_points_or_a_wrong_level_are_refused():
    data = points(SIZES**-1.0, 0.1)
    with pytest.raises(InputError, match="different N"):
        fit_slope([data[0], data[0]])
    with pytest.raises(InputError, match="0 < level < 1"):
        fit_slope(data, level=1)
