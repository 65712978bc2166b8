"""Sections 3 to 5 of the ledger: attacks on what is proved, shifted point sets, and mutants."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mutant_trials import Cases, assert_refuted_mutants_are_rejected
from specrate.numerics.integrands.protocol import mp
from specrate.proofs.attacking.trials import Point, refuted, value
from specrate.proofs.entries import section3, section4, section5
from specrate.proofs.entry import Entry, recheck
from specrate.proofs.theorems import (
    constant_integrand,
    deltas,
    homogenisation,
    line_estimators,
    point_readings,
    polar,
    shifts,
    variance,
)
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step

ENTRIES = (*section3.ENTRIES, *section4.ENTRIES, *section5.ENTRIES)
PROVED = tuple(
    e for e in ENTRIES if e.holds is not None and e.number not in ("7", "homogenisation")
)
"""All but those whose double integrals take seconds; the whole ledger's test has them."""


@given(st.sampled_from(range(len(PROVED))), st.integers(0, 2**32))
def test_no_trial_refutes_what_is_proved(place: int, seed: int) -> None:
    holds = PROVED[place].holds
    assert holds is not None
    assert not refuted(holds, seed, trials=1)


@pytest.mark.parametrize("entry", PROVED, ids=lambda e: e.number)
def test_another_claim_is_refuted_by_a_trial_and_by_the_kernel(entry: Entry) -> None:
    """A claim with nothing to try it at would pass every trial."""
    assert entry.holds is not None
    shift = 10**6 if entry.holds.relation == "<=" else -1
    wrong = replace(entry.holds, left=entry.holds.left + shift)
    assert refuted(wrong, 0, trials=1)
    with pytest.raises(Refused):
        recheck(replace(entry, holds=wrong))


@given(st.integers(1, 4), st.integers(1, 4), st.integers(1, 4), st.integers(0, 10**6))
def test_the_variance_of_shifted_points_is_the_sum_over_frequencies(
    modes: int, points: int, surplus: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    shifts_, k = 2 * modes + surplus, np.arange(1, modes + 1)
    a, phase = rng.normal(size=modes), rng.uniform(0, 7, (modes, points))
    turns = np.arange(1, shifts_ + 1)[:, None] * k / shifts_
    errors = np.array(
        [(a[:, None] * np.cos(phase + 2 * np.pi * t[:, None])).sum() / points for t in turns]
    )
    spectrum = abs(np.exp(1j * phase).mean(axis=1)) ** 2
    assert np.isclose(errors.var(), (a**2 / 2 * spectrum).sum(), rtol=1e-9, atol=1e-15)
    assert abs(errors.mean()) < 1e-12


def test_the_claim_of_the_variance_is_that_sum() -> None:
    """Both sides at numbers: three points at 0 or together elsewhere, two frequencies."""
    a, weight = (0.5, -1.25), (0.25, 0.75)
    claim = variance.variance().claim
    named = {s.name: s for s in claim.free}
    table = {("a", mp.mpf(k)): mp.mpf(v) for k, v in enumerate(a, 1)}
    table |= {("w", mp.mpf(w)): mp.mpf(v) for w, v in enumerate(weight, 1)}
    # the phases of a realisation are those of its number, so that all points are one
    table |= {("p", mp.mpf(w)): mp.mpf(w) for w in (1, 2)}
    sizes = {named[s]: mp.mpf(v) for s, v in (("M", 5), ("K", 2), ("N", 3), ("W", 2))}
    with mp.workdps(20):
        for side in (claim.left, claim.right):
            found = value(side, Point(sizes, lambda: mp.mpf(0), dict(table)))
            assert abs(found - (0.5**2 + 1.25**2) / 2) < 1e-12


@given(st.integers(2, 9), st.integers(0, 10**6))
def test_a_shift_costs_x_its_rate(n: int, seed: int) -> None:
    """On a grid of places, and on 20 000 sets.

    The measured variance has a relative standard deviation of at most 0.01: 0.2 is 20 of them. The
    variance without the shift is 1/(2n − 1) of this one, at most a third.
    """
    places = (np.arange(400) + 0.5) / 400
    u, v = np.meshgrid(places, places)
    rng = np.random.default_rng(seed)
    exact = (2 * n - 1) / (12 * n**3)
    last = ((1 / n - 1) * (u - 0.5) + v - 0.5).var()
    assert np.isclose((last + (n - 1) / (12 * n**2)) / n**2, exact, rtol=1e-3)
    cells = (np.arange(n) + rng.uniform(size=(20000, n))) / n
    errors = ((cells + rng.uniform(size=(20000, 1))) % 1).mean(axis=1) - 0.5
    assert np.isclose(errors.var(), exact, rtol=0.2)


CASES: Cases = (
    ("parseval", shifts.parseval, 127, 12),
    ("variance", variance.variance, 499, 5),
    ("unbiased", variance.unbiased, 307, 3),
    ("delta", deltas.of_a_point, 7, 26),
    ("constant", constant_integrand.head, 29, 8),
    ("averages", polar.radial_averages, 61, 6),
    ("directions", polar.directions, 61, 6),
    ("unshifted", homogenisation.unshifted, 23, 12),
    ("bounded", point_readings.bounded_spectrum, 23, 2),
    ("lines", line_estimators.estimator, 97, 3),
    ("long lines", line_estimators.long_line, 7, 6),
    ("plane", line_estimators.volume_of_the_plane, 13, 17),
)


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    assert_refuted_mutants_are_rejected(name, proof, every, least, trials=2)
