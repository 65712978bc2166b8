"""Checks as a whole: what is decided, when they end, what they say of a source.

A correct design is contradicted or called faulty with a probability of at most 1e-5 a check.
"""

from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.checking import checks, trials
from specrate.numerics.checking.check_documents import check, document
from specrate.numerics.checking.checks import run_check
from specrate.numerics.checking.designs import design
from specrate.numerics.checking.judgements import FIRST, judgements
from specrate.numerics.point_sources.child_processes import Limits, OutOfTime
from specrate.numerics.point_sources.pointfiles import write_text
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def own(name):
    return f"{SAMPLERS}:{name}"


def kinds(found):
    return [f["kind"] for f in found["faults"]]


def test_axis_and_generic_regions_are_told_apart():
    """scipy's Latin hypercube: N P_S is near 0 along the axes, 1 off them; chance below 1e-6."""
    found = check("scipy.stats.qmc:LatinHypercube", 2, ["n-rooks"], (), [64], budget=60)
    for region, limits in (("1", (0, 0.01)), ("2", (0, 0.01)), ("1,2", (0.4, 2.5))):
        (rows,) = [r["spectrum"] for r in found["regions"] if r["region"] == region]
        low = [r for r in rows if max(map(abs, r["frequency"])) == 1]
        assert low
        assert all(limits[0] < r["scaled_power"]["estimate"] < limits[1] for r in low)


def test_scipy_latin_hypercube_is_consistent_with_n_rooks():
    found = check("scipy.stats.qmc:LatinHypercube", 2, ["n-rooks"], (), [16], budget=60)
    assert found["verdict"] == "consistent"
    assert found["matches"] == ["latin-hypercube"]


@pytest.mark.parametrize("word", ["jitter", own("jitter")])
def test_jitter_is_consistent_with_jitter(word):
    found = check(word, 2, ["jitter"], (), [16], budget=60)
    assert (found["verdict"], found["matches"]) == ("consistent", ["jitter"])
    assert found["budget_needed"] is None


def test_a_sampler_that_answered_may_be_slow():
    found = check(own("hanging_from_100"), 2, ["random"], counts=[16, 144], budget=6)
    assert found["verdict"] == "inconclusive"
    assert found["faults"] == []
    assert found["plan"]["ended"] == "budget"
    waiting = [x for x in found["left_out"] if "had not answered" in x["why"]]
    assert len(waiting) == 1
    assert waiting[0]["what"].startswith("more realisations of N = ")


@pytest.mark.parametrize(
    ("n", "seconds", "drawn", "budget", "blamed"),
    [
        (16, 9.0, 0, 10.0, True),
        (16, 3.4, 0, 10.0, True),
        (16, 3.3, 0, 10.0, False),  # the child took long to start
        (16, 9.0, 1, 10.0, False),  # it answered once
        (16, 0.4, 0, 0.5, False),  # too short a time to say anything
        (None, 9.0, 0, 10.0, False),  # a library was imported
        (16, 59.0, 0, 60.0, True),
        (16, 59.0, 0, 61.0, False),  # one call has 60 seconds, which are not over
    ],
)
def test_who_is_to_blame_for_a_deadline(n, seconds, drawn, budget, blamed):
    asked = design([own("jitter")], 2, [], [], 0)
    limits = Limits(min(60.0, budget))
    state = checks.State(asked, 1e-5, [], (), budget, limits)
    evidence = {"seconds": seconds, "drawn": drawn} | ({} if n is None else {"n": n})
    checks._blame(state, OutOfTime("late", evidence))
    assert [f.kind for f in state.faults] == ["hangs"] * blamed
    assert state.unanswered == (None if blamed else {"n": n, "seconds": seconds})


def test_a_slow_import_is_no_fault(tmp_path):
    (tmp_path / "slow.py").write_text("import time\ntime.sleep(1000)\n")
    found = check(f"{tmp_path / 'slow.py'}:points", 2, ["random"], budget=2)
    assert (found["verdict"], found["faults"]) == ("inconclusive", [])
    told = {x["what"]: x["why"] for x in found["left_out"]}
    why = "the sampler was being loaded when the budget was spent"
    assert told["all measurements"] == why


def test_what_a_sampler_prints_is_drained():
    found = check(own("chattering"), 2, ["random"], counts=[16], budget=60)
    assert found["verdict"] == "consistent"


def test_a_command_is_a_source():
    """Text of six digits is quantised; nothing else is wrong with it."""
    found = check(
        "cmd:awk 'BEGIN{srand({seed}); for (i = 0; i < {n}; i++) print rand(), rand()}'",
        2,
        ["random"],
        counts=[16],
        budget=60,
    )
    assert kinds(found) == ["quantised coordinates"]
    assert found["faults"][0]["evidence"]["spacing"] == 1e-6
    assert "17 significant digits" in found["faults"][0]["remedy"]
    assert found["claims"][0]["holds"] is not False


@pytest.mark.parametrize("name", ["jitter", "raising", "legacy"])
def test_no_child_is_left(name):
    state = run_check([own(name)], 2, ["jitter"], counts=[16], budget=5)
    assert state.design.source.process.running is None
    with pytest.raises(InputError, match="must name an attribute"):
        run_check([own("absent")], 2)


def test_a_file_of_equal_realisations(tmp_path):
    points = np.repeat(stream(91).random((1, 16, 2)), 10, axis=0)
    write_text(tmp_path / "equal.txt", points)
    found = check(str(tmp_path / "equal.txt"), 2, ["random"], budget=5)
    assert found["verdict"] == "invalid"
    assert "duplicate realisations" in kinds(found)


def test_a_file_of_several_realisations(tmp_path):
    """128 of random points: n-rooks is refuted along the axes, random is not."""
    path = tmp_path / "points.txt"
    write_text(path, stream(92).random((128, 16, 2)))
    assert check(str(path), 2, ["n-rooks"], budget=5)["verdict"] == "contradicted"
    found = check(str(path), 2, ["random"], budget=600)
    assert found["verdict"] == "inconclusive"
    assert {(p["n"], p["replicates"]) for p in found["points"]} == {(16, 128)}
    assert found["plan"]["ended"] == "decided"  # no waiting for realisations that will not come


@pytest.mark.parametrize("claims", [[], ["random"], ["axis/best ~ 1"]])
def test_a_file_of_one_realisation_decides_nothing(tmp_path, claims):
    """It is homogenised by random shifts, which the document says."""
    words = []
    for n in (16, 64, 256):
        words.append(str(tmp_path / f"{n}.txt"))
        write_text(words[-1], stream(93).random((1, n, 2)))
    found = check(words, 2, claims, budget=60)
    assert found["verdict"] == "inconclusive"
    assert found["faults"] == []
    told = {row["what"]: row["why"] for row in found["left_out"]}
    assert "moved by random shifts" in told["variance over realisations at N = 16, 64, 256"]
    assert {(p["replicates"], p["realisations"]) for p in found["points"]} == {(1024, 1)}
    assert all(p["raw_variance"] is p["bias"] is None for p in found["points"])
    assert [c["holds"] for c in found["claims"]] == [None] * len(claims)
    assert all(r["measured"]["slope"] for r in found["rates"])
    rows = [row for region in found["regions"] for row in region["spectrum"]]
    assert all(r["scaled_power"]["high"] is r["agrees"] is None for r in rows)
    assert all(r["scaled_power"]["low"] == 0 for r in rows)
    if claims != ["axis/best ~ 1"]:
        assert "one realisation" in told["spectrum at N = 16, 64, 256"]
        assert rows


def test_claims_are_not_judged_on_a_frozen_sampler():
    """128 equal realisations are one: their spectrum agrees with nothing."""
    found = check(own("frozen"), 2, ["random", "jitter"], budget=60)
    assert [c["holds"] for c in found["claims"]] == [None, None]
    assert found["matches"] == []
    assert {(p["replicates"], p["realisations"]) for p in found["points"]} == {(128, 1)}


def test_commas_in_utk_text_are_an_unusable_input(tmp_path):
    path = tmp_path / "commas.txt"
    path.write_text("0.1,0.2\n0.3,0.4\n")
    with pytest.raises(InputError, match=r"comma at line 1 of .*commas.txt"):
        check(str(path), 2, ["random"])


def test_n_is_moved_to_what_the_source_honours():
    found = check(own("jitter"), 2, ["latin-hypercube"], (), [50, 17], budget=60)
    assert [step["n"] for step in found["plan"]["ladder"]] == [16, 49]
    with pytest.raises(InputError, match="must have realisations of the N checked"):
        check("random", 2, ["jitter"], (), [50])


@pytest.mark.parametrize("dim", [1, 3, 10])
def test_other_dimensions(dim):
    found = check("random", dim, ["random"], budget=0.2)
    assert found["verdict"] != "contradicted"
    assert found["plan"]["dim"] == dim
    sizes = {len(r["region"].split(",")) for r in found["regions"]}
    assert sizes == {size for size in (1, 2, 3, dim) if size <= dim}


def test_integrands_are_measured_besides_the_probes():
    found = check("jitter", 2, ["jitter"], ["disk", "gaussian:sigma=0.2"], [16, 64], 0.3)
    rows = {(p["integrand"], p["n"]): p for p in found["points"]}
    for name in ("disk:radius=0.3", "gaussian:sigma=0.2"):
        for n in (16, 64):
            assert float(rows[name, n]["exact"]) > 0
            assert rows[name, n]["variance"]["low"] > 0
    predicted = {r["integrand"]: r["predicted"]["exponent"] for r in found["rates"]}
    assert predicted["disk:radius=0.3"] == "3/2"


def test_a_slow_sampler_ends_with_the_budget():
    found = check(own("slow"), 2, ["random"], budget=2)
    drawn = sum(max(step["replicates"], step["attempted"]) for step in found["plan"]["ladder"])
    assert drawn <= 41  # of 50 ms each, the last one begun within the two seconds
    assert found["verdict"] == "inconclusive"
    assert found["faults"] == []
    assert found["budget_needed"]["seconds"] > 2


def test_an_interruption_keeps_what_was_measured(monkeypatch):
    """Control-C when the first N has been measured, and two realisations of each other one."""
    whole = trials.grow

    def grow(m, source, seed, replicates, *arguments):
        if m.n > 16 and replicates == FIRST:
            raise KeyboardInterrupt
        whole(m, source, seed, replicates, *arguments)

    monkeypatch.setattr(trials, "grow", grow)
    state = run_check([own("rooks")], 2, ["latin-hypercube"], budget=60)
    assert state.ended == "interrupted"
    assert state.measurements[0].replicates == FIRST
    assert all(m.replicates < FIRST for m in state.measurements[1:])
    assert state.design.source.process.running is None
    found = document(state)
    assert found["interrupted"]
    assert found["verdict"] == "inconclusive"
    assert {p["replicates"] for p in found["points"] if p["n"] == 16} == {FIRST}
    assert "the check was interrupted" in {x["why"] for x in found["left_out"]}


@pytest.mark.parametrize("budget", [0, -1, float("inf"), float("nan")])
def test_the_budget_must_be_positive(budget):
    with pytest.raises(InputError, match="--budget must be a positive number"):
        run_check(["random"], 2, budget=budget)


def test_without_claims_it_says_what_matches():
    found = check("multi-jitter", 2, counts=[16], budget=60)
    assert (found["verdict"], found["matches"]) == ("consistent", ["multi-jitter"])
    assert check("multi-jitter", 2, budget=0.01)["verdict"] == "inconclusive"


def test_several_claims_are_judged_each():
    state = run_check(["jitter"], 2, ["latin-hypercube", "jitter"], counts=[16], budget=5)
    wrong, right = judgements(state)
    assert (wrong.claim.text, wrong.outcome) == ("latin-hypercube", "fails")
    assert (right.claim.text, right.outcome != "fails") == ("jitter", True)
