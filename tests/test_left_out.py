"""What a check leaves out is said, with its reason, and survives a replay."""

import json

import numpy as np
import pytest
from specrate.numerics import check
from specrate.numerics.checking.check_documents import document
from specrate.numerics.checking.checks import Execution, Step, run_check
from specrate.numerics.point_sources.pointfiles import write_text
from specrate.numerics.streams import stream


def told(document):
    return {x["what"]: x["why"] for x in document["left_out"]}


def test_an_n_that_the_source_moved_is_named_also_on_replay(tmp_path):
    first = check("jitter", 2, ["jitter"], counts=[17], budget=0.2)
    assert told(first)["N = 17"] == "the source honours 16 there"
    (tmp_path / "a.json").write_text(json.dumps(first))
    again = check([], 2, plan=tmp_path / "a.json")
    assert again["left_out"] == first["left_out"]


def test_an_integrand_without_an_exact_variance_is_named():
    found = check("jitter", 4, ["jitter"], ["ball"], budget=0.5)
    key = "exact variance of ball:radius=0.3 under jitter"
    assert "more than three dimensions" in told(found)[key]


def test_files_that_are_used_up_ask_for_no_budget(tmp_path):
    write_text(tmp_path / "p.txt", stream(1, 2).random((20, 16, 2)))
    found = check(str(tmp_path / "p.txt"), 2, ["random"])
    assert found["verdict"] == "inconclusive"
    assert found["budget_needed"] is None
    assert "more realisations" in told(found)


def test_a_decay_faster_than_claimed_is_explained():
    again = Execution(tuple(Step(n, 512, 512, 512) for n in (16, 64, 256, 1024)))
    found = document(run_check(["latin-hypercube"], 2, ["axis/best ~ 1"], again=again))
    assert found["claims"][0]["holds"] is None
    assert "crossover" in told(found)["a decision on axis/best ~ 1"]


@pytest.mark.parametrize("dim", [2, 5])
def test_supports_that_are_not_probed_are_named(dim):
    found = check("random", dim, ["random"], counts=[32], budget=0.2)
    assert ("spectra on other supports" in told(found)) == (dim > 3)
    assert ("variances on other supports" in told(found)) == (dim > 3)
    assert np.isfinite(found["seconds"])
