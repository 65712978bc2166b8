"""Orders of sums of regions and classes: smaller orders are refused, and so are false mutants.

Power: the tally of refuted mutants is asserted, so that a harness that finds none fails.
"""

import pytest
from mutant_trials import assert_refuted_mutants_are_rejected
from specrate.proofs.theorems import point_rates, two_classes
from specrate.proofs.theorems.tactics import ONE
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check


@pytest.mark.parametrize(("is_worst", "every"), [(True, 151), (False, 171)])
def test_no_refuted_mutant_is_accepted(is_worst: bool, every: int) -> None:
    proof = point_rates.eq_24 if is_worst else point_rates.eq_25
    name = "Eq. 24" if is_worst else "Eq. 25"
    assert_refuted_mutants_are_rejected(name, lambda: proof(is_worst), every, 5, 3, 12)


@pytest.mark.parametrize("is_worst", [True, False])
def test_a_sum_of_regions_has_no_smaller_order(is_worst: bool) -> None:
    """Eqs. 24-26 as the orders of their fast parts alone are refused."""
    for proof in (point_rates.eq_24, point_rates.eq_25, point_rates.eq_26):
        found = proof(is_worst)
        c = found.claim
        faster = Claim(c.left, "Theta", point_rates.N ** (-2 * ONE), c.given, c.along)
        with pytest.raises(Refused):
            check(Step(faster, found.reason, found.uses))


def test_the_faster_class_does_not_decide() -> None:
    """V_1 + V_2 as the order of V_2, r_1 < r_2, is refused."""
    found = two_classes.order("b<q", "b<q")
    c, power = found.claim, -1 - two_classes.rate(2, "b<q")
    faster = Claim(c.left, "Theta", point_rates.N**power, c.given, c.along)
    with pytest.raises(Refused):
        check(Step(faster, found.reason, found.uses))
