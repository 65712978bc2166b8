"""Mutants of the proofs of Section 6 up to Table 1: every one that a trial refutes is rejected.

Power: the tally of refuted mutants is asserted, so that a harness that finds none fails.
"""

from collections.abc import Callable

import pytest
import sympy
from specrate.proofs.attacking.mutations import Mutant, mutants, steps_of
from specrate.proofs.attacking.trials import refuted
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
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check

PROOFS: tuple[tuple[str, Callable[[], Step], int, int], ...] = (
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


def _accepted(step: Step) -> bool:
    try:
        check(step)
    except Refused:
        return False
    return True


@pytest.mark.parametrize(("name", "proof", "every", "least"), PROOFS, ids=[c[0] for c in PROOFS])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    last = steps_of(proof())[:_LAST]
    found = [m for s in last for m in mutants(s) if _is_tried(m)][::every]
    false = [m for m in found if refuted(m.step.claim, trials=3)]
    for mutant in false:
        assert not _accepted(mutant.step), (name, mutant.change, str(mutant.step.claim))
    assert len(false) >= least
