"""Mutants of proofs: the kernel rejects every one that a trial, without the kernel, refutes.

Power: the tally of refuted mutants is asserted, so that a harness that finds none fails.
"""

from collections.abc import Callable

import pytest
from mutant_trials import Cases, assert_refuted_mutants_are_rejected
from specrate.proofs.attacking.mutations import steps_of
from specrate.proofs.attacking.trials import refuted
from specrate.proofs.theorems import exponential_sums, products, radial, sines, single_direction
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check

CASES: Cases = (
    ("sines", sines.jitter_envelope, 1, 200),
    ("products", products.jitter_envelope_in_d, 29, 20),
    ("waves", exponential_sums.latin_hypercube, 37, 10),
    ("jitter", exponential_sums.jitter_on_an_axis, 17, 15),
    ("direction", single_direction.each_direction, 41, 5),
    ("rate", lambda: radial.rate("b>q"), 131, 10),
    ("tie", lambda: radial.order("b=q"), 131, 10),
)


def _accepted(step: Step) -> bool:
    try:
        check(step)
    except Refused:
        return False
    return True


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    assert_refuted_mutants_are_rejected(name, proof, every, least, trials=4)


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_step_of_a_proof_is_refuted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    for step in steps_of(proof()):
        assert not refuted(step.claim, trials=2), (name, str(step.claim))
