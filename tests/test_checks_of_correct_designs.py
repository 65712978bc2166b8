"""Checks of correct designs: they are never contradicted.

A correct design is contradicted or called faulty with a probability of at most 1e-5 a check.
"""

from pathlib import Path

import pytest
from specrate.numerics.checking import checks
from specrate.numerics.checking.check_documents import check
from specrate.numerics.checking.designs import design, ladder

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def own(name):
    return f"{SAMPLERS}:{name}"


NEVER_CONTRADICTED = (
    ("jitter", 2, "jitter"),
    ("random", 2, "random"),
    ("multi-jitter", 2, "overall/disk ~ 3/2"),
    ("n-rooks", 2, "overall/anisotropic-gaussian:sigma=(1/10,2/5) ~ 1"),
    ("n-rooks", 2, "overall/anisotropic-gaussian:sigma=(1/2,1/3) ~ 1"),
    ("correlated-multi-jitter", 2, "correlated-multi-jitter"),
    ("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:1+2"),
    ("latin-hypercube", 10, "latin-hypercube"),
    ("jitter", 10, "jitter"),
    ("jitter", 1, "jitter"),
    ("jitter", 2, "overall/gaussian:sigma=0.1 ~ 2"),
    ("random", 2, "overall/disk:radius=0.1 ~ 1"),
    ("regular", 2, "overall/gaussian:sigma=0.3 ~ 3"),
    (own("jitter"), 2, "jitter"),
    (own("shuffled_jitter"), 3, "jitter"),
    (own("rooks"), 2, "latin-hypercube"),
    ("scipy.stats.qmc:LatinHypercube", 2, "n-rooks"),
)


@pytest.mark.parametrize(("word", "dim", "claim"), NEVER_CONTRADICTED)
def test_correct_designs_are_never_contradicted(monkeypatch, word, dim, claim):
    """128 realisations at every N below 2000: as many as a contradiction takes."""
    monkeypatch.setattr(checks, "MOST", 128)
    counts = ()
    if "~" in claim:
        counts = [n for n in ladder(design([word], dim, [claim], [], 0), []) if n < 2000]
    found = check(word, dim, [claim], (), counts, budget=60)
    assert found["verdict"] in ("consistent", "inconclusive")
    assert found["faults"] == []
    assert {s["replicates"] for s in found["plan"]["ladder"]} == {128}


def test_rare_values_do_not_contradict():
    """A box of volume 1e-4 is missed by all of 128 x 16 points with a probability of 0.8."""
    for seed in range(4):
        found = check("random", 2, ["random"], ["box:side=0.01"], [16], 0.2, seed)
        assert found["verdict"] in ("consistent", "inconclusive")
