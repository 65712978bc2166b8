"""The drift test: what it contradicts, and what it never contradicts."""

from fractions import Fraction

import numpy as np
import pytest
from ladders import SIZES, multi_jitter_disk, points
from scipy import special
from specrate.numerics.measuring.drift import DELTAS, _largest_rise, _least_chi2, drift_test
from specrate.numerics.measuring.slopes import RatePoint, ladder_of
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError


@pytest.mark.parametrize("error", [0.05, 0.01, 1e-3, 1e-5])
def test_multi_jitter_on_the_disk_is_never_contradicted(error):
    """Nor at errors that resolve a second term of drift; and its interval holds the limit."""
    result = drift_test(points(multi_jitter_disk(), error), Fraction(3, 2), level=1e-6)
    assert result.verdict == "consistent"
    assert result.low < 1.5 < result.high
    assert -1 < result.a < 0


@pytest.mark.parametrize(
    ("law", "claim", "error"),
    [
        (SIZES**-1.25, 1.5, 0.01),
        (SIZES**-1.0, 1.5, 0.1),
        (SIZES**-1.0, 3, 0.1),
        (SIZES**-1.0 + 100 * SIZES**-3.0, 1.5, 0.02),
    ],
)
def test_too_steep_a_claim_is_contradicted(law, claim, error):
    result = drift_test(points(law, error), claim, level=1e-8)
    assert result.verdict == "contradicted"
    assert result.chi2 > result.threshold
    assert result.fit_chi2 >= result.chi2 * (1 - 1e-6)


def test_power_with_noise():
    """N^-5/4 claimed 3/2 at 3 % errors: contradicted in all of 50 runs at level 1e-6."""
    rng = stream(43)
    for _ in range(50):
        law = SIZES**-1.25 * np.exp(0.03 * rng.standard_normal(5))
        assert drift_test(points(law, 0.03), 1.5, level=1e-6).verdict == "contradicted"


@pytest.mark.parametrize("error", [0.01, 1e-5])
@pytest.mark.parametrize(
    "law",
    [1e4 * SIZES**-3 + 1 / SIZES, 1e8 * SIZES**-3 + 1 / SIZES, SIZES**-3.0, SIZES**-6.0],
)
def test_a_steeper_decay_never_contradicts(law, error):
    assert drift_test(points(law, error), 1, level=1e-6).verdict == "inconclusive"


def test_crossover_is_fitted():
    result = drift_test(points(1e4 * SIZES**-3 + 1 / SIZES, 0.01), 1)
    assert result.a == pytest.approx(1e4, rel=1e-3)
    assert result.delta == pytest.approx(2, rel=1e-3)
    assert result.fit_chi2 < 1e-3


@pytest.mark.parametrize(("error", "spread"), [(0.05, 0.18), (0.01, 0.085), (1e-4, 0.07)])
def test_interval_of_a_pure_law(error, spread):
    """What a ladder from 16 to 4096 can state at level 1e-6, drift included."""
    result = drift_test(points(SIZES**-1.5, error), 1.5, margin=0.25)
    assert result.verdict == "consistent"
    assert 1.5 - spread < result.low < 1.44
    assert 1.55 < result.high < 1.5 + spread
    narrow = drift_test(points(SIZES**-1.5, error), 1.5, margin=0.05)
    assert narrow.verdict == "inconclusive"


@pytest.mark.parametrize("delta", [0.25, 0.5, 1, 2, 4])
@pytest.mark.parametrize("amplitude", [-0.5, -0.2, 0.2, 0.5])
def test_interval_holds_the_exponent_under_any_narrow_drift(delta, amplitude):
    law = SIZES**-1.5 * (1 + amplitude * (SIZES / 16) ** -delta)
    result = drift_test(points(law, 1e-3), 1.5, level=1e-6)
    assert result.chi2 < 1e-12
    assert result.low <= 1.5 <= result.high
    assert result.verdict == "consistent"


def test_interval_against_a_dense_search():
    """Ends of the interval: a plain grid over (delta, A) stays inside and comes within 1e-3."""
    data, level = points(multi_jitter_disk(), 0.02), 1e-4
    result = drift_test(data, 1.5, level=level)
    x, y = np.log(SIZES / 16), np.log(multi_jitter_disk())
    a, delta = np.meshgrid(np.linspace(-0.5, 0.5, 401), np.geomspace(*DELTAS, 81))
    g = np.log1p(a[..., None] * np.exp(-delta[..., None] * x))
    w = 1 / (0.02**2 + 0.01**2)
    dx = x - x.mean()
    rest = (y - g) - (y - g).mean(axis=-1, keepdims=True)
    slope = rest @ dx / (dx @ dx)
    least = w * np.sum((rest - slope[..., None] * dx) ** 2, axis=-1)
    room = special.chdtri(5, level) - least
    reach = np.sqrt(np.where(room > 0, room, np.nan) / (w * dx @ dx))
    low, high = np.nanmin(-slope - reach), np.nanmax(-slope + reach)
    assert low - 1e-3 < result.low <= low + 1e-6
    assert high - 1e-6 <= result.high < high + 1e-3


def test_false_alarms_stay_below_the_level():
    """4000 true claims with drift at its bound: alarms exceed the rate 1e-2 by chance 1e-7.

    Only the chi^2 that decides is computed. Power: with no drift allowed every run alarms.
    """
    rng, alarms, runs, level = stream(47), 0, 4000, 1e-2
    law = SIZES**-1.5 * (1 - 0.5 * (SIZES / 16) ** -0.25)
    threshold = special.chdtri(5, level)
    for _ in range(runs):
        noisy = law * np.exp(0.02 * rng.standard_normal(5))
        ladder, _ = ladder_of(points(noisy, 0.02), 0, 3)
        alarms += _least_chi2(ladder, 1.5, 0.5) > threshold
    assert alarms <= special.bdtrik(1 - 1e-7, runs, level)
    assert alarms < level * runs


def test_a_pure_law_alarms_seldom_at_any_level():
    """100 runs of N^-3/2 at level 0.1: the chance of more than 30 alarms is below 1e-7."""
    rng, alarms = stream(48), 0
    for _ in range(100):
        noisy = SIZES**-1.5 * np.exp(0.02 * rng.standard_normal(5))
        alarms += drift_test(points(noisy, 0.02), 1.5, level=0.1).verdict == "contradicted"
    assert alarms <= 30


def test_drift_is_what_saves_a_true_law():
    law = SIZES**-1.5 * (1 - 0.5 * (SIZES / 16) ** -0.25)
    strict = drift_test(points(law, 0.02), 1.5, level=1e-2, rising_drift=0)
    assert strict.verdict == "contradicted"
    assert strict.chi2 > 10 * strict.threshold


def test_least_chi2_without_drift_is_antitonic_regression():
    """Rising values and no drift allowed: the least chi^2 is that about their weighted mean."""
    law = SIZES**-1.0
    result = drift_test(points(law, 0.1), 1.5, rising_drift=0)
    y = 0.5 * np.log(SIZES)
    assert result.chi2 == pytest.approx(np.sum((y - y.mean()) ** 2) / 0.01, rel=1e-6)


def test_largest_rise_bounds_every_drift():
    x = np.log(SIZES / 16)
    rise = _largest_rise(x, 0.5)
    assert rise[0, 4] == pytest.approx(np.log(2), rel=1e-6)
    for delta in np.geomspace(*DELTAS, 37):
        for amplitude in (-0.5, -0.1, 0.0, 3.0):
            course = np.log1p(amplitude * np.exp(-delta * x))
            steps = course[None, :] - course[:, None]
            assert np.all(np.triu(steps - rise, 1) <= 1e-5)


def test_fewer_than_three_points_decide_nothing():
    for count in (1, 2):
        few = points(SIZES[:count] ** -1.0, 0.001, SIZES[:count])
        assert drift_test(few, 3).verdict == "inconclusive"
    assert drift_test(points(SIZES[:1], 0.1, SIZES[:1]), 1).low is None


def test_logarithms_belong_to_the_claim():
    law = SIZES**-2.0 * np.log(SIZES)
    assert drift_test(points(law, 0.01), 2, 1).verdict == "consistent"
    assert drift_test(points(law, 1e-3), 2.5, 1).verdict == "contradicted"


def test_order_of_the_points_and_scale_are_irrelevant():
    data = points(multi_jitter_disk(), 0.01)
    scaled = points(1e-30 * multi_jitter_disk(), 0.01)
    result, other = drift_test(data, 1.5), drift_test(scaled[::-1], 1.5)
    assert other.verdict == result.verdict
    assert other.low == pytest.approx(result.low, abs=1e-6)
    assert drift_test(data, 1.5) == result


def test_unusable_requests_are_refused():
    data = points(SIZES**-1.0, 0.1)
    with pytest.raises(InputError, match="different N"):
        drift_test([data[0], data[0]], 1)
    with pytest.raises(InputError, match="0 < level < 1"):
        drift_test(data, 1, level=0)
    with pytest.raises(InputError, match="rising_drift"):
        drift_test(data, 1, rising_drift=1)


def test_a_claim_beside_the_interval_is_never_consistent():
    """N^-3/2 to 1 %: 1.4 is within the margin of every exponent allowed, and yet not among them."""
    points = [RatePoint(n, n**-1.5, 0.002) for n in (16, 64, 256, 1024, 4096)]
    assert drift_test(points, 1.5).verdict == "consistent"
    for exponent in (1.3, 1.4, 1.62, 1.7):
        found = drift_test(points, exponent)
        assert found.low is not None
        assert not found.low <= exponent <= found.high
        assert found.verdict != "consistent"
