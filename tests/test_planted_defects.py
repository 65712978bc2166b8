"""Planted defects and false claims are found, for the right reason.

They are of a size that 256 realisations of 64 points showed with every one of 20 seeds.
"""

import pytest
from short_validation import is_short, short_form
from specrate.numerics.checking.known_truths import FAILING, is_wrong, reasons_of
from specrate.numerics.checking.validation import title


@pytest.mark.parametrize("truth", [t for t in FAILING if is_short(t)], ids=title)
def test_defects_and_false_claims_are_found_for_the_right_reason(truth, tmp_path):
    found = short_form(truth, tmp_path)
    assert found["verdict"] in ("contradicted", "invalid")
    assert not is_wrong(truth, found["verdict"], reasons_of(found))
