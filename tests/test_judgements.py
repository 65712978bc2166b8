"""Judgements: what is judged, on which realisations, and what budget would decide."""

import pytest
from specrate.numerics.checking.designs import all_frequencies, all_integrands, design
from specrate.numerics.checking.judgements import (
    State,
    judgements,
    matching,
    rate_points,
    seconds_needed,
)
from specrate.numerics.checking.verdicts import spectrum_predictions, variance_predictions
from specrate.numerics.measuring.measurements import Measurement, grow
from specrate.numerics.measuring.probes import probe
from specrate.numerics.point_sources.catalogue_source import CatalogueSource
from specrate.numerics.point_sources.child_processes import Limits
from specrate.theory.samplers import parse_sampler


def state_of(word, claims, counts, replicates=128):
    asked = design([word], 2, claims, [], 0)
    state = State(asked, 1e-9, [], (), 10.0, Limits())
    for n in counts:
        m = Measurement(n, all_frequencies(asked, n), all_integrands(asked))
        grow(m, CatalogueSource(parse_sampler(word, 2)), 0, replicates)
        state.measurements.append(m)
    for claim in asked.claims:
        if claim.text in ("jitter", "random"):
            sampler = claim.sampler
            spectra = {
                m.n: spectrum_predictions(sampler, m.n, m.frequencies) for m in state.measurements
            }
            exact = {
                m.n: variance_predictions(sampler, m.n, m.integrands) for m in state.measurements
            }
            state.spectra[claim.text], state.variances[claim.text] = spectra, exact
    return state


def outcomes(state):
    return [j.outcome for j in judgements(state)]


def test_claims_are_judged_each():
    """False alarms below 1e-7 (80 intervals of level 1e-9)."""
    state = state_of("jitter", ["random", "jitter", "axis/best ~ 3"], [16, 64])
    assert outcomes(state)[0] == "fails"
    assert outcomes(state)[1] != "fails"
    assert outcomes(state)[2] == "open"  # two N make no slope


def test_frozen_sets_are_not_judged():
    state = state_of("jitter", ["random"], [16])
    state.measurements[0].distinct = 1
    assert outcomes(state) == ["open"]
    assert matching(state) == []
    integrands = (probe(2, 1, (1,)),)
    assert len(rate_points(state, integrands, 0.05)) == 1  # their variances are described
    assert rate_points(state, integrands, 0.05, asymptotic=True) == []


def test_matching_finds_the_sampler_and_keeps_its_predictions():
    state = state_of("jitter", [], [16, 64], 2048)
    found = {sampler.name: outcome for sampler, outcome in matching(state)}
    assert found["jitter"] != "fails"
    assert {name for name, outcome in found.items() if outcome != "fails"} == {"jitter"}
    assert set(state.candidates) == {(name, n) for name in found for n in (16, 64)}
    kept = dict(state.candidates)
    matching(state)
    assert all(state.candidates[at] is kept[at] for at in kept)


def test_no_budget_decides_what_is_over():
    state = state_of("jitter", ["jitter"], [16])
    found = judgements(state)
    assert seconds_needed(state, found) > 1
    state.ended = "interrupted"
    assert seconds_needed(state, found) is None


@pytest.mark.parametrize("replicates", [1, 64])
def test_too_few_realisations_make_no_point(replicates):
    state = state_of("jitter", ["axis/best ~ 3"], [16, 64, 256], replicates)
    assert rate_points(state, state.measurements[0].integrands, 0.05) == []
    assert outcomes(state) == ["open"]
