"""Decisions on one number, and the accounts of false alarms."""

from dataclasses import replace
from math import inf

import pytest
from specrate.numerics.checking.checks import LOOKS as CHECK_LOOKS
from specrate.numerics.checking.checks import MOST, _bias_level, run_check
from specrate.numerics.checking.faults import COINCIDENCE_LEVEL
from specrate.numerics.checking.judgements import FIRST
from specrate.numerics.checking.verdicts import (
    ENOUGH,
    FALSE_ALARM,
    LEAST,
    LOOKS,
    MARGIN,
    Comparison,
    budget_needed,
    compare,
    comparisons,
    overall_outcome,
    spectrum_predictions,
    variance_predictions,
)
from specrate.numerics.expected_spectra.spectra import scaled_power
from specrate.numerics.measuring.measurements import Measurement, grow
from specrate.numerics.measuring.moments import Interval, Moments, update
from specrate.numerics.measuring.probes import probe
from specrate.numerics.point_sources.catalogue_source import CatalogueSource
from specrate.theory.samplers import parse_sampler


@pytest.mark.parametrize(
    ("measured", "predicted", "bound", "replicates", "outcome"),
    [
        ((1, 0.9, 1.1), 1, 0, LEAST, "holds"),
        ((1, 0.9, 1.1), 1.1, 0, LEAST, "holds"),
        ((1, 0.9, 1.1), 1.11, 0, LEAST, "fails"),
        ((1, 0.9, 1.1), 0.89, 0, LEAST, "fails"),
        ((1, 0.9, 1.1), 1.11, 0.02, LEAST, "holds"),
        ((1, 0.9, 1.1), 0.89, 0.02, LEAST, "holds"),
        ((1, 0.9, 1.1), 2, 0, LEAST - 1, "open"),
        ((1, 0.7, 1.1), 1, 0, LEAST, "open"),
        ((1, 0.9, 1.3), 1, 0, LEAST, "open"),
        ((1, 1 / (1 + MARGIN), 1 + MARGIN), 1, 0, LEAST, "holds"),
        ((1, 0.5, inf), 1, 0, LEAST, "open"),
        ((1, 0.5, inf), 0.4, 0, LEAST, "fails"),
        ((0, 0, 0), 0, 0, LEAST, "holds"),
        ((0, 0, 0), 1, 0, LEAST, "fails"),
        ((1e-31, 1e-32, 1e-30), 0, 0, LEAST, "holds"),
        ((1e-3, 1e-4, 1e-2), 0, 0, LEAST, "fails"),
        ((1e-3, 1e-4, 1e-2), 0, 0, LEAST - 1, "open"),
        ((1e-3, 0, 1e-2), 0, 0, LEAST, "open"),
    ],
)
def test_compare(measured, predicted, bound, replicates, outcome):
    assert compare(Interval(*measured), predicted, bound, replicates) == outcome


def test_what_was_not_seen_fails_from_above_only():
    """A rare large value that was not drawn makes a variance look small, never large."""
    assert compare(Interval(1, 0.9, 1.1), 2, 0, LEAST, seen=False) == "open"
    assert compare(Interval(1, 0.9, 1.1), 1, 0, LEAST, seen=False) == "open"
    assert compare(Interval(1, 0.9, 1.1), 0.5, 0, LEAST, seen=False) == "fails"


def outcomes(*found):
    return [Comparison("spectrum", (1,), 4, Interval(1, 0.5, 2), 1.0, 0.0, o) for o in found]


def test_one_failure_fails_and_all_must_hold():
    assert overall_outcome([]) == "open"
    assert overall_outcome(outcomes("holds", "holds")) == "holds"
    assert overall_outcome(outcomes("holds", "open")) == "open"
    assert overall_outcome(outcomes("holds", "open", "fails")) == "fails"


def test_budget_grows_with_the_replicates_that_are_missing():
    (wide,) = outcomes("open")  # half-width 3/4 is to become 1/4
    assert budget_needed([wide], 2.0, {wide.n: 128}) == pytest.approx(1.5 * 2.0 * ENOUGH / 128)
    assert budget_needed([wide], 2.0, {wide.n: 8 * ENOUGH}) == pytest.approx(1.5 * 2.0 * 3**2)
    assert budget_needed([], 2.0, {}) == pytest.approx(3.0)
    rare = replace(wide, measured=Interval(1.0, 0.1, 1e300))
    assert budget_needed([rare], 2.0, {wide.n: ENOUGH}) == pytest.approx(1.5 * 2.0 * 100)


def test_holding_is_judged_at_the_equivalence_level():
    """The wide interval of contradictions need not lie within the margin, the narrow one must."""
    wide, near, far = Interval(1.0, 0.6, 1.6), Interval(1.0, 0.9, 1.1), Interval(1.2, 1.05, 1.3)
    assert compare(wide, 1.0, 0.0, 512) == "open"
    assert compare(wide, 1.0, 0.0, 512, narrow=near) == "holds"
    assert compare(wide, 1.0, 0.0, 512, narrow=far) == "open"
    assert compare(wide, 2.0, 0.0, 512, narrow=near) == "fails"


def test_looks_cover_all_rounds_and_the_last_word():
    rounds = (MOST // FIRST).bit_length()
    assert rounds + 1 <= LOOKS
    assert CHECK_LOOKS == LOOKS


@pytest.mark.parametrize(
    ("word", "dim", "claims", "counts"),
    [
        ("jitter", 2, ["jitter"], ()),
        ("jitter", 2, ["jitter", "latin-hypercube", "overall/disk ~ 3/2"], ()),
        ("jitter", 2, [], ()),
        ("jitter", 2, ["axis/best ~ 2"], ()),
        ("random", 2, ["random"], [2 * k for k in range(2, 22)]),
        ("random", 1, ["random"], range(2, 102)),
        ("random", 10, ["random"], ()),
    ],
)
def test_levels_add_up(word, dim, claims, counts):
    """Every test at every look, and one search for faults at each N: 1e-5 together."""
    state = run_check([word], dim, claims, counts=counts, budget=1e-3)
    tests = sum(len(s) for by_n in state.spectra.values() for s in by_n.values())
    tests += sum(len(v) for by_n in state.variances.values() for v in by_n.values())
    tests += len(state.design.rate_claims)
    if not claims:
        tests = sum(len(m.frequencies) for m in state.measurements)
    assert tests > 0
    faults = len(state.measurements) * (_bias_level(state) + COINCIDENCE_LEVEL)
    assert tests * LOOKS * state.level + faults <= FALSE_ALARM * (1 + 1e-9)
    assert state.level > 0
    assert _bias_level(state) > 0


def test_predictions_are_for_the_n_of_the_sampler_only():
    jitter = parse_sampler("jitter", 2)
    assert spectrum_predictions(jitter, 15, [(1, 0)]) is None
    assert variance_predictions(jitter, 15, [probe(2, 1, (1,))]) == {}
    assert spectrum_predictions(parse_sampler("isotropic:2", 2), 16, [(1, 0)]) is None


@pytest.mark.parametrize("name", ["multi-jitter", "correlated-multi-jitter", "latin-hypercube"])
@pytest.mark.parametrize("n", [256, 65536, 1 << 22])
def test_spectra_are_predicted_to_their_bound(name, n):
    """The bound is relative; plain sums lose it for correlated multi-jitter from 2^10 on."""
    sampler = parse_sampler(name, 2)
    wanted = [(1, 0), (2, 0), (1, 1), (round(n**0.5) + 1, 0)]
    found = spectrum_predictions(sampler, n, wanted)
    for m in wanted:
        exact = float(scaled_power(sampler, sampler.counts_at(n), m))
        assert abs(n * found[m] - exact) <= 1e-13 * exact


def test_comparisons_of_a_correct_and_of_a_wrong_sampler():
    """False alarm below 1e-7 (26 intervals of level 1e-9); wrong at (1, 0) by a factor above 4."""
    measurement = Measurement(16, ((1, 0), (1, 1)), (probe(2, 1, (1,)), probe(2, 2, (1, 2))))
    jitter, rooks = parse_sampler("jitter", 2), parse_sampler("latin-hypercube", 2)
    grow(measurement, CatalogueSource(jitter), 3, 1024)
    for sampler, wrong in ((jitter, False), (rooks, True)):
        spectrum = spectrum_predictions(sampler, 16, measurement.frequencies)
        variances = variance_predictions(sampler, 16, measurement.integrands)
        found = comparisons(measurement, spectrum, variances, 1e-9)
        assert len(found) == 4
        assert (overall_outcome(found) == "fails") == wrong
        assert {c.what for c in found if c.outcome == "fails"} == (
            {"spectrum", "variance"} if wrong else set()
        )


def test_an_interval_without_errors():
    assert comparisons(Measurement(4, ((1,),), ()), {}, {}, 0.1) == []
    assert update(Moments(), 0.0).count == 1
