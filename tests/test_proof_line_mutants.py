"""Mutants of the proofs on lines, segments and Appendices A and B, and of their refutations.

The kernel rejects every mutant that a trial, without the kernel, refutes. Power: the tally of
refuted mutants is asserted, so that a harness that finds none fails.
"""

from collections.abc import Callable
from dataclasses import replace

import pytest
import sympy
from mutant_trials import Cases, assert_refuted_mutants_are_rejected
from specrate.proofs.entries import appendix_a, appendix_b, lines
from specrate.proofs.entry import Entry, recheck
from specrate.proofs.theorems import (
    appendix_spectra,
    best_case,
    cone_sums,
    directions,
    flats,
    rays,
    segments,
    worst_direction,
)
from specrate.proofs.theorems.tactics import ONE
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check

_ENTRIES: tuple[Entry, ...] = (
    *lines.ENTRIES, *lines.BEYOND, *appendix_a.ENTRIES, *appendix_b.ENTRIES,
)  # fmt: skip

CASES: Cases = (
    ("segments", segments.segment_of_a_wave, 3, 10),
    ("sphere mean", segments.sphere_mean, 61, 5),
    ("weights", directions.inverse_variance, 1, 20),
    ("equal shares", directions.equal_shares, 3, 10),
    ("random directions", directions.random_directions_order, 11, 5),
    ("best case", best_case.best_order, 61, 2),
    ("rays", rays.each_ray, 251, 2),
    ("far frequencies", rays.far_frequencies, 101, 2),
    ("cones", cone_sums.one_direction_apart, 11, 5),
    ("axis of a cube", cone_sums.along_axis, 7, 5),
    ("monomial", lambda: appendix_spectra.monomial(flats.d - 1, ONE), 401, 2),
    ("two regions", lambda: worst_direction.order_of_two("best"), 401, 1),
)


def _accepted(step: Step) -> bool:
    try:
        check(step)
    except (Refused, RecursionError):
        return False
    return True


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    assert_refuted_mutants_are_rejected(name, proof, every, least, trials=4)


@pytest.mark.parametrize("entry", [e for e in _ENTRIES if e.refutation], ids=lambda e: e.number)
def test_what_is_refuted_is_not_provable_from_what_holds(entry: Entry) -> None:
    verdict = recheck(entry)
    assert verdict.refutation is not None
    assert entry.printed is not None
    for reason in (by.Combine((ONE,)), by.Order(), by.Order((ONE,)), by.Instance(())):
        if entry.proof is not None:
            with pytest.raises(Refused):
                check(Step(entry.printed, reason, (entry.proof(),)))


@pytest.mark.parametrize("entry", [e for e in _ENTRIES if e.refutation], ids=lambda e: e.number)
def test_a_witness_elsewhere_is_refused(entry: Entry) -> None:
    assert entry.refutation is not None
    step = entry.refutation()
    reason = step.reason
    assert isinstance(reason, by.Counterexample)
    if not reason.values:
        return
    key, value = reason.values[0]
    moved = ((key, -value - 1 if isinstance(value, sympy.Expr) and key.is_Symbol else value),)
    if moved == reason.values[:1]:
        return
    with pytest.raises(Refused):
        check(replace(step, reason=by.Counterexample((*moved, *reason.values[1:]))))
