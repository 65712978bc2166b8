"""Mutants of proofs: the kernel rejects every one that a trial, without the kernel, refutes.

Power: the tally of refuted mutants is asserted, so that a harness that finds none fails.
"""

from collections import Counter
from collections.abc import Callable

import pytest
from specrate.proofs import exponential_sums, products, radial, sines, single_direction
from specrate.proofs.grammar import Refused
from specrate.proofs.kernel import Step, check
from specrate.proofs.mutations import mutants, steps_of
from specrate.proofs.trials import refuted

CASES: tuple[tuple[str, Callable[[], Step], int, int], ...] = (
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
    found = [m for step in steps_of(proof()) for m in mutants(step)][::every]
    tally: Counter[str] = Counter()
    for mutant in found:
        if not refuted(mutant.step.claim, trials=4):
            tally["not refuted"] += 1
            continue
        assert not _accepted(mutant.step), (name, mutant.change, str(mutant.step.claim))
        tally["rejected"] += 1
    assert tally["rejected"] >= least, tally


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_step_of_a_proof_is_refuted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    for step in steps_of(proof()):
        assert not refuted(step.claim, trials=2), (name, str(step.claim))
