"""Mutants of a proof against the kernel: each that a trial refutes must be refused."""

from collections import Counter
from collections.abc import Callable

import pytest
from specrate.proofs.attacking.mutations import Mutant, mutants, steps_of
from specrate.proofs.attacking.trials import refuted
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check

Cases = tuple[tuple[str, Callable[[], Step], int, int], ...]
"""Name, proof, one in how many of its mutants is tried, and how many rejections there must be."""


def assert_refuted_mutants_are_rejected(
    name: str,
    proof: Callable[[], Step],
    every: int,
    least: int,
    trials: int,
    steps: int | None = None,
    is_tried: Callable[[Mutant], bool] = lambda _: True,
) -> None:
    """Fail if the kernel takes a mutant that a trial refutes, or too few are refuted.

    Of all steps, or the first so many that ``steps_of`` lists, and of mutants that are to be tried.
    """
    chosen = steps_of(proof())[:steps]
    found = [m for step in chosen for m in mutants(step) if is_tried(m)][::every]
    tally: Counter[str] = Counter()
    for mutant in found:
        if not refuted(mutant.step.claim, trials=trials):
            tally["not refuted"] += 1
            continue
        try:
            check(mutant.step)
        except Refused:
            tally["rejected"] += 1
        else:
            pytest.fail(f"{name}: accepted {mutant.change}, {mutant.step.claim}")
    assert tally["rejected"] >= least, (name, tally, len(found))
