"""Fitted profiles: recovery, coverage against a straight line, and every way to have no data."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import special
from specrate.numerics.fitting.coverage_truths import TRUTHS, along, difference_jitter
from specrate.numerics.fitting.fit_coverage import LADDER, Budget, rng_of, spectra
from specrate.numerics.fitting.log_log_lines import fit_line
from specrate.numerics.fitting.profile_fits import EstimatedSpectrum, fit_profile
from specrate.numerics.streams import stream

TRUTH = {t.name: t for t in TRUTHS}
JITTER = TRUTH["jitter 1D"]
SIZES = (16, 64, 256, 1024)
NAMES = ("degree", "effective", "gamma", "alpha")


def exact(truth, r, sizes=SIZES, count=16):
    """Spectra without noise."""
    found = []
    for n in sizes:
        m = truth.frequencies(n, count)
        found.append(EstimatedSpectrum(n, r, m, truth.spectrum(n, m)))
    return found


def sound(fitted):
    """Every interval is finite and holds its estimate; a missing one has a reason."""
    intervals = [getattr(fitted, name) for name in NAMES]
    for interval in intervals:
        if interval is not None:
            assert np.isfinite(interval).all()
            assert interval.low <= interval.estimate <= interval.high
            assert interval.low < interval.high
    assert (fitted.reason is None) == (None not in intervals)
    if fitted.outside_model is not None:
        assert intervals == [None] * 4
    return fitted


@pytest.mark.parametrize(
    ("name", "count"),
    [(t.name, 6 if "generic" in t.name else 16) for t in TRUTHS if t.degree],
)
def test_a_spectrum_without_noise_gives_its_profile(name, count):
    """Held by the intervals, and estimated within a quarter of them or nearer."""
    truth = TRUTH[name]
    fitted = sound(fit_profile(exact(truth, 10**4, count=count)))
    for what in NAMES:
        interval, true = getattr(fitted, what), getattr(truth, what)
        assert interval.low < true < interval.high
        assert abs(interval.estimate - true) < (interval.high - interval.low) / 4
    assert fitted.degree.high - fitted.degree.low < 0.6


@pytest.mark.parametrize("degree", [1.0, 2.0, 3.0, 5.0])
@pytest.mark.parametrize("effective", [0.5, 1.0])
def test_a_power_cut_off_at_a_kink_gives_its_degree(degree, effective):
    """The kink is no low order of a smooth spectrum: intervals hold b, estimates may be off."""

    def at(n):
        m = along(round(n**effective), 16)
        return EstimatedSpectrum(
            n, 1000, m, np.minimum(1, (m[:, 0] / (0.4 * n**effective)) ** degree)
        )

    fitted = sound(fit_profile([at(n) for n in SIZES]))
    assert fitted.effective.estimate == pytest.approx(effective, abs=0.05)
    assert fitted.degree.low < degree < fitted.degree.high
    assert fitted.effective.low < effective < fitted.effective.high


@pytest.mark.parametrize("name", ["random 1D", "latin-hypercube 2D, generic"])
def test_white_noise_has_degree_zero_and_nothing_that_needs_a_degree(name):
    fitted = sound(fit_profile(spectra(TRUTH[name], LADDER[3], stream(5))))
    assert fitted.degree.low == 0
    assert fitted.degree.high < 0.3
    assert fitted.gamma.low < 1 < fitted.gamma.high
    assert fitted.effective is None
    assert fitted.alpha is None
    assert "degree 0 is not excluded" in fitted.reason


def missing(intervals, true):
    return sum(not i.low <= true <= i.high for i in intervals)


RUNS, ALLOWED = 40, 13
"""Misses allowed: more, of 40 intervals that hold with 95 %, have probability 6e-9."""


@pytest.mark.parametrize(
    "name", ["jitter 1D", "cloaked lattice, β = 1.5, c = 0.2", "difference jitter 1D"]
)
def test_intervals_hold_the_truth_where_a_straight_line_does_not(name):
    """Power: with N to 4096 a straight line holds b in hardly any run."""
    truth, budget = TRUTH[name], LADDER[3]
    assert special.bdtrc(ALLOWED, RUNS, 0.05) < 1e-8
    samples = [spectra(truth, budget, rng_of(truth, budget, 12, i)) for i in range(RUNS)]
    fits = [sound(fit_profile(values)) for values in samples]
    assert missing([f.degree for f in fits], truth.degree) <= ALLOWED
    assert missing([f.effective for f in fits], truth.effective) <= ALLOWED
    lines = [fit_line(values, truth.effective)[0] for values in samples]
    assert missing(lines, truth.degree) > 2 * ALLOWED


def test_of_few_data_intervals_hold_the_truth_too():
    """At R = 16 and N to 256."""
    truth, budget = TRUTH["box process 1D"], LADDER[1]
    fits = [fit_profile(spectra(truth, budget, rng_of(truth, budget, 12, i))) for i in range(RUNS)]
    assert missing([f.degree for f in fits], 1) <= ALLOWED
    assert missing([f.effective for f in fits], 1) <= ALLOWED


def test_intervals_shrink_with_the_budget():
    fits = [fit_profile(spectra(JITTER, b, stream(2))) for b in LADDER]
    for what in NAMES:
        widths = [getattr(f, what).high - getattr(f, what).low for f in fits]
        assert all(later < earlier for earlier, later in pairwise(widths)), (what, widths)


def test_a_fit_is_the_same_each_time_and_in_any_order():
    values = spectra(JITTER, LADDER[2], stream(1))
    assert fit_profile(values) == fit_profile(values)
    turned = fit_profile(values[::-1])
    assert turned.degree == pytest.approx(fit_profile(values).degree, rel=0.02)


def test_the_sign_of_frequencies_and_copies_of_them_do_not_matter():
    values = spectra(JITTER, LADDER[1], stream(1))
    doubled = [
        EstimatedSpectrum(
            s.n,
            s.realisations,
            np.concatenate([s.frequencies, -s.frequencies]),
            np.tile(s.power, 2),
        )
        for s in values
    ]
    assert fit_profile(doubled).degree == pytest.approx(fit_profile(values).degree, rel=1e-6)
    assert fit_profile(doubled).used == fit_profile(values).used


@pytest.mark.parametrize("r", [1, 10**6, 10**12])
def test_one_realisation_and_very_many(r):
    fitted = sound(fit_profile(spectra(JITTER, Budget(r, (16, 64, 256), 12), stream(4))))
    assert fitted.degree.low < 2 < fitted.degree.high
    assert fitted.effective.low < 1 < fitted.effective.high


@pytest.mark.parametrize("truth", [JITTER, TRUTH["difference jitter 1D"]], ids=lambda t: t.name)
@pytest.mark.parametrize("r", [1, 100])
def test_a_million_points(truth, r):
    """At m = 1 difference jitter has N·P_S = 1.5e-22."""
    fitted = sound(fit_profile(spectra(truth, Budget(r, (100, 10**4, 10**6), 20), stream(r))))
    assert fitted.degree.low < truth.degree < fitted.degree.high
    assert fitted.effective.low < 1 < fitted.effective.high
    assert difference_jitter(10**6, np.array([[1]]))[0] < 1e-21


def test_one_n_leaves_the_effective_exponent_open():
    fitted = sound(fit_profile(spectra(JITTER, Budget(64, (256,), 20), stream(1))))
    assert fitted.degree.low < 2 < fitted.degree.high
    assert fitted.effective is None
    assert fitted.alpha is None
    assert "one N: the effective exponent is not identified" in fitted.reason


def test_one_frequency_leaves_the_degree_open():
    values = [
        EstimatedSpectrum(n, 16, np.array([[1]]), JITTER.spectrum(n, np.array([[1]])))
        for n in (16, 64, 256)
    ]
    fitted = sound(fit_profile(values))
    assert fitted.degree is None
    assert fitted.effective is None
    assert "one |m|" in fitted.reason


def test_two_frequencies_give_wide_intervals():
    m = np.array([[1], [2]])
    values = [EstimatedSpectrum(n, 16, m, JITTER.spectrum(n, m)) for n in (16, 64, 256)]
    fitted = sound(fit_profile(values))
    assert fitted.degree.low < 2 < fitted.degree.high
    assert fitted.degree.high - fitted.degree.low > 0.5
    assert fitted.gamma is None


def test_no_power_at_all_is_a_lattice():
    zero = [EstimatedSpectrum(n, 5, along(n, 8), np.zeros(len(along(n, 8)))) for n in (16, 64)]
    fitted = sound(fit_profile(zero))
    assert "a lattice" in fitted.outside_model


def test_below_the_crossover_there_is_a_degree_and_no_plateau():
    m = np.array([[1], [2], [3], [5]])
    values = [EstimatedSpectrum(n, 500, m, JITTER.spectrum(n, m)) for n in (256, 1024, 4096)]
    fitted = sound(fit_profile(values))
    assert fitted.degree.low < 2 < fitted.degree.high
    assert fitted.effective.low < 1 < fitted.effective.high
    assert fitted.gamma is None
    assert "the data do not show the plateau" in fitted.reason


@st.composite
def odd_spectra(draw):
    """Few or many values of any size, zeros and ties among them, at one or several N."""
    found = []
    dim = draw(st.integers(1, 3))
    power = st.one_of(st.just(0.0), st.floats(0, 5), st.floats(1e-30, 1e30), st.just(1.0))
    for _ in range(draw(st.integers(1, 3))):
        n = draw(st.sampled_from([2, 3, 16, 1000, 10**6]))
        count = draw(st.integers(1, 6))
        component = st.integers(-4 * n, 4 * n).filter(bool)
        m = [[draw(component) for _ in range(dim)] for _ in range(count)]
        values = [draw(power) for _ in range(count)]
        r = draw(st.sampled_from([1, 2, 30, 10**9]))
        found.append(EstimatedSpectrum(n, r, np.array(m), np.array(values)))
    return found


@given(odd_spectra())
def test_nothing_finite_breaks_a_fit(values):
    sound(fit_profile(values))
