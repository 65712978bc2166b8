"""Steps that the kernel must refuse, all that they use being accepted."""

import pytest
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check


def refused(claim: Claim, reason: by.Reason, *uses: Step, because: str | None = None) -> None:
    """Refused, and for this reason where one is named: another would make the test say nothing."""
    for step in uses:
        check(step)
    with pytest.raises(Refused, match=because):
        check(Step(claim, reason, uses))
