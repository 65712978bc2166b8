"""Mutants of the proofs of Section 6 up to Table 1: every one that a trial refutes is rejected.

Power: the tally of refuted mutants is asserted, so that a harness that finds none fails.
"""

from collections.abc import Callable

import pytest
import sympy
from mutant_trials import Cases, assert_refuted_mutants_are_rejected
from specrate.proofs.attacking.mutations import Mutant
from specrate.proofs.theorems import (
    axis_terms,
    classes,
    integrand_rows,
    jitter_bounds,
    lattice_powers,
    lattice_rates,
    lattice_sums,
    multi_jitter_bounds,
    plateaus,
    profile_limits,
)
from specrate.proofs.trusted.kernel import Step

PROOFS: Cases = (
    ("cosine", jitter_bounds.cosine_pade, 13, 10),
    ("jitter from below", jitter_bounds.jitter_from_below, 14, 5),
    ("multi-jitter", multi_jitter_bounds.multi_jitter_from_below, 20, 6),
    ("multi-jitter from above", multi_jitter_bounds.multi_jitter_from_above, 20, 8),
    ("correlated multi-jitter", multi_jitter_bounds.correlated_wave, 22, 8),
    ("Latin hypercube", plateaus.lhs_flat_across, 17, 5),
    ("wave across", plateaus.wave_across, 20, 6),
    ("wave along", plateaus.wave_along, 19, 7),
    ("wave", lattice_rates.wave, 18, 10),
    ("jump", lambda: lattice_powers.jump()[1], 3, 15),
    ("telescope", lattice_sums.telescoped, 11, 12),
    ("harmonic", lattice_sums.harmonic_from_below, 10, 8),
    ("classes", classes.from_below, 8, 4),
    ("comb", profile_limits.comb, 10, 12),
    ("interval", integrand_rows.interval_decay, 6, 12),
    ("Eq. 20", axis_terms.bound_where_rows_meet, 165, 3),
)


_LAST = 12
"""Steps of a proof whose mutants are tried, from its end."""


def _is_tried(mutant: Mutant) -> bool:
    """Whether a trial ends soon: no sum to infinity, whose mutants diverge slowly."""
    c = mutant.step.claim
    sums = c.left.atoms(sympy.Sum) | c.right.atoms(sympy.Sum)
    return not any(s.has(sympy.oo) for s in sums)


@pytest.mark.parametrize(("name", "proof", "every", "least"), PROOFS, ids=[c[0] for c in PROOFS])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    assert_refuted_mutants_are_rejected(name, proof, every, least, 3, _LAST, _is_tried)
