"""Designs of known truth: true claims are not contradicted, and which verdicts are wrong.

A design whose claims hold is contradicted or called invalid with a probability of at most 1e-5.
"""

import pytest
from short_validation import is_short, short_form
from specrate.numerics.checking.known_truths import (
    FAILING,
    HOLDING,
    TRUTHS,
    KnownTruth,
    is_wrong,
    reasons_of,
)
from specrate.numerics.checking.validation import title


@pytest.mark.parametrize("truth", [t for t in HOLDING if is_short(t)], ids=title)
def test_true_claims_are_never_contradicted(truth, tmp_path):
    found = short_form(truth, tmp_path)
    assert found["verdict"] in ("consistent", "inconclusive")
    assert not reasons_of(found)


def test_there_are_ten_of_each_and_no_two_have_one_title():
    assert min(len(HOLDING), len(FAILING)) >= 10
    assert len({title(t) for t in TRUTHS}) == len(TRUTHS)
    assert all(t.holds for t in HOLDING)
    assert not any(t.holds for t in FAILING)


HOLDS = KnownTruth("a", "random", 2, ("random",))
FAILS = KnownTruth("b", "random", 2, ("jitter",), ("bias on axis 2", "region 1"))


@pytest.mark.parametrize(
    ("truth", "verdict", "reasons", "wrong"),
    [
        (HOLDS, "consistent", (), False),
        (HOLDS, "inconclusive", (), False),
        (HOLDS, "contradicted", ("region 1",), True),
        (HOLDS, "invalid", ("bias",), True),
        (FAILS, "consistent", (), True),
        (FAILS, "inconclusive", (), False),
        (FAILS, "contradicted", ("region 1",), False),
        (FAILS, "contradicted", ("region 2",), True),
        (FAILS, "invalid", ("bias", "bias on axis 2"), False),
        (FAILS, "invalid", ("bias", "bias on axis 1"), True),
    ],
)
def test_which_verdicts_are_wrong(truth, verdict, reasons, wrong):
    assert is_wrong(truth, verdict, frozenset(reasons)) is wrong


def test_reasons_are_the_faults_and_the_witnesses():
    document = {
        "faults": [
            {"kind": "bias", "evidence": {"axes": [2, 3]}},
            {"kind": "hangs", "evidence": {"n": 16}},
        ],
        "claims": [
            {"holds": False, "witness": {"what": "N P_S(m)", "region": "1,2"}},
            {"holds": False, "witness": {"what": "variance", "region": None}},
            {"holds": False, "witness": {"what": "exponent"}},
            {"holds": True, "witness": None},
            {"holds": None, "witness": None},
        ],
    }
    kinds = {"bias", "bias on axis 2", "bias on axis 3", "hangs"}
    assert reasons_of(document) == kinds | {"region 1,2", "variance", "exponent"}
