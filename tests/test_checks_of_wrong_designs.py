"""Checks of wrong designs: they are contradicted, and the region at fault is named.

They are off by factors that 128 realisations tell apart with a probability above 1 - 1e-6.
"""

from pathlib import Path

import pytest
from specrate.numerics.checking.check_documents import check

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def own(name):
    return f"{SAMPLERS}:{name}"


@pytest.mark.parametrize(
    ("word", "dim", "claim", "region"),
    [
        (own("half_jitter"), 2, "jitter", "2"),
        (own("half_jitter"), 3, "jitter", "2"),
        (own("wide_jitter"), 2, "jitter", "1"),
        ("random", 2, "latin-hypercube", "1"),
        ("jitter", 2, "latin-hypercube", "1"),
        (own("rooks"), 2, "jitter", "1"),
        ("latin-hypercube", 2, "multi-jitter", "1,2"),
        ("multi-jitter", 2, "correlated-multi-jitter", "1,2"),
        ("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:2+1", "1"),
        ("random", 10, "latin-hypercube", "1"),
        ("jitter", 1, "random", "1"),
    ],
)
def test_wrong_designs_are_contradicted_and_the_region_named(word, dim, claim, region):
    found = check(word, dim, [claim], budget=60)  # stops when decided
    assert found["verdict"] == "contradicted"
    assert found["faults"] == []
    (told,) = found["claims"]
    assert told["holds"] is False
    assert told["witness"]["region"] == region


def test_a_triple_that_no_pair_shows_is_found():
    """x + y - z = 0 modulo 1: F(1, 1, -1) is 1 in all realisations, so that no shift was drawn."""
    found = check(own("coupled"), 3, ["random"], budget=20)
    assert found["verdict"] == "invalid"
    assert {f["kind"] for f in found["faults"]} == {"not homogenised"}
    (told,) = found["claims"]
    assert told["holds"] is False
    assert told["witness"]["region"] == "1,2,3"


def test_only_the_region_at_fault_disagrees():
    """x is stratified, y is not: rows of the axis 1 agree, some of the axis 2 do not."""
    found = check(own("half_jitter"), 2, ["jitter"], budget=20)
    agrees = {r["region"]: [s["agrees"] for s in r["spectrum"]] for r in found["regions"]}
    assert all(agrees["1"])
    assert not all(agrees["2"])


@pytest.mark.parametrize(
    ("word", "claim"),
    [
        ("random", "overall/disk ~ 3/2"),
        ("jitter", "axis/best ~ 3"),
        ("jitter", "overall/disk ~ 2"),
        ("latin-hypercube", "generic/best ~ 2"),
        (own("half_jitter"), "2/best ~ 2"),
    ],
)
def test_exponents_that_are_too_large_are_contradicted(word, claim):
    found = check(word, 2, [claim], budget=20)
    assert found["verdict"] == "contradicted"
    assert found["claims"][0]["witness"]["what"] == "exponent"
    assert found["n_range"] == [16, 4096]


@pytest.mark.parametrize(
    ("word", "claim"), [("jitter", "overall/disk ~ 1"), (own("half_jitter"), "1/best ~ 1")]
)
def test_too_small_an_exponent_is_not_confirmed(word, claim):
    assert check(word, 2, [claim], budget=0.5)["verdict"] == "inconclusive"
