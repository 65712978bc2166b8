"""The document of a check: complete, JSON all through, and the same when its plan is replayed."""

import json
from pathlib import Path

import pytest
from specrate.numerics.checking.check_documents import check, read_plan
from specrate.numerics.point_sources import sampler_processes
from specrate.numerics.point_sources.child_processes import Limits, Overdue
from specrate.numerics.point_sources.pointfiles import write_text
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")

FIELDS = {
    "verdict",
    "faults",
    "regions",
    "blocks",
    "rates",
    "points",
    "claims",
    "matches",
    "left_out",
    "n_range",
    "level",
    "false_alarm",
    "plan",
    "seconds",
}


def timeless(value):
    """Without fields whose name contains seconds."""
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if "seconds" not in k}
    return [timeless(v) for v in value] if isinstance(value, list) else value


def text_of(found):
    return json.dumps(timeless(found), allow_nan=False)


CASES = (
    ("jitter", 2, ["jitter"], ["disk"], 0.1),
    ("random", 2, ["latin-hypercube", "axis/best ~ 1"], [], 0.1),
    ("multi-jitter", 2, ["overall/disk ~ 3/2"], [], 0.1),
    ("scipy.stats.qmc:Sobol", 3, [], [], 3.0),
    (f"{SAMPLERS}:half_jitter", 2, ["jitter"], [], 20.0),
    (f"{SAMPLERS}:centred_rooks", 2, ["n-rooks"], [], 20.0),
    (f"{SAMPLERS}:frozen", 2, [], [], 20.0),
    (f"{SAMPLERS}:raising", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:raising_late", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:fewer", 2, ["latin-hypercube"], [], 20.0),
    (f"{SAMPLERS}:segfaulting", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:leaving", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:enormous", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:refusing", 2, ["random"], [], 20.0),
    (f"{SAMPLERS}:hanging", 2, ["random"], [], 2.5),
    (f"{SAMPLERS}:hanging_from_100", 2, ["random"], [], 1.5),
    (f"{SAMPLERS}:slow", 2, ["random"], [], 1.5),
    (f"{SAMPLERS}:jitter", 2, ["jitter"], [], 1e-3),
)


@pytest.mark.parametrize(("word", "dim", "claims", "integrands", "budget"), CASES)
def test_replay_gives_the_same_document(tmp_path, word, dim, claims, integrands, budget):
    found = check(word, dim, claims, integrands, budget=budget, seed=7)
    assert set(found) >= FIELDS
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(found, allow_nan=False))
    again = check([], dim, plan=path)
    assert text_of(again) == text_of(found)


def test_a_plan_alone_replays_too(tmp_path):
    found = check("jitter", 2, ["jitter"], ["disk"], budget=0.1, seed=7)
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(found["plan"]))
    assert text_of(check("jitter", 2, plan=path)) == text_of(found)


@pytest.mark.parametrize("answers", [0, 1, 3, 4, 5, 7, 100])
def test_wherever_the_budget_ends_it_is_replayed(tmp_path, monkeypatch, answers):
    """One answer when the sampler is loaded, one for each of 3 N, one drawn twice, then draws."""
    whole = sampler_processes._heard

    def heard(process):
        nonlocal answers
        answers -= 1
        if answers < 0:
            process.limits = Limits(deadline=0.0)
            raise Overdue
        return whole(process)

    with monkeypatch.context() as patched:
        patched.setattr(sampler_processes, "_heard", heard)
        found = check(f"{SAMPLERS}:jitter", 2, ["jitter"], budget=60, seed=7)
    assert found["verdict"] == "inconclusive"
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(found, allow_nan=False))
    assert text_of(check([], 2, plan=path)) == text_of(found)


def test_what_a_budget_cut_short_is_replayed(tmp_path):
    """A sampler that is asked nothing on replay could not say more."""
    found = check(f"{SAMPLERS}:hanging_from_100", 2, ["random"], counts=[16], budget=20, seed=7)
    plan = found["plan"] | {"ended": "budget", "unanswered": {"n": 100, "seconds": 1.0}}
    plan["ladder"], plan["asked"] = [], [100]
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(plan))
    again = check([], 2, plan=path)
    assert (again["verdict"], again["faults"], again["n_range"]) == ("inconclusive", [], None)
    assert again["plan"] == plan | {"frequencies": {}, "fitted": 0}


def test_a_late_fault_is_replayed_at_its_place(tmp_path):
    """It shows at the third N, when the first two have grown: the plan says how far each came."""
    found = check(f"{SAMPLERS}:raising_late", 2, ["random"], budget=20, seed=3)
    assert found["faults"][0]["kind"] == "exception"
    steps = found["plan"]["ladder"]
    assert sum(s["attempted"] > s["replicates"] for s in steps) == 1
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(found))
    assert text_of(check([], 2, plan=path)) == text_of(found)


def test_files_replay_too(tmp_path):
    write_text(tmp_path / "points.txt", stream(94).random((70, 16, 2)))
    found = check(str(tmp_path / "points.txt"), 2, ["random"], budget=1)
    (tmp_path / "plan.json").write_text(json.dumps(found))
    assert text_of(check([], 2, plan=tmp_path / "plan.json")) == text_of(found)
    step = {"n": 16, "replicates": 70, "attempted": 70, "shifts": 70}
    (row,) = found["plan"]["ladder"]
    assert row == row | step
    assert sum(length * times for length, times in row["chunks"]) == row["replicates"]


def test_shifts_of_a_frozen_file_replay(tmp_path):
    write_text(tmp_path / "points.txt", stream(95).random((1, 16, 2)))
    found = check(str(tmp_path / "points.txt"), 2, ["random"], budget=20)
    (tmp_path / "plan.json").write_text(json.dumps(found))
    assert text_of(check([], 2, plan=tmp_path / "plan.json")) == text_of(found)
    step = {"n": 16, "replicates": 1, "attempted": 1, "shifts": 1024}
    (row,) = found["plan"]["ladder"]
    assert row == row | step
    assert sum(length * times for length, times in row["chunks"]) == row["replicates"]


def test_seeds_matter():
    one, other = (check("jitter", 2, ["jitter"], (), [16], 0.05, seed) for seed in (1, 2))
    assert one["points"][0]["variance"] != other["points"][0]["variance"]


def test_variances_stand_beside_raw_ones():
    """Jitter is unbiased: raw MSE and raw variance agree; the bias is 0 within 6 errors."""
    found = check("jitter", 2, ["jitter"], (), [16], 0.3)
    for row in found["points"]:
        assert row["raw_variance"]["estimate"] == pytest.approx(row["raw_mse"]["estimate"], rel=0.2)
        bias = row["bias"]
        assert abs(bias["estimate"]) < 3.1 * (bias["high"] - bias["estimate"])
        assert row["variance"]["low"] <= row["variance"]["estimate"] <= row["variance"]["high"]


def test_a_contradiction_has_a_witness_that_can_be_read():
    found = check("random", 2, ["latin-hypercube"], budget=10)
    (claim,) = found["claims"]
    witness = claim["witness"]
    assert (witness["what"], witness["region"], witness["at"]) == ("N P_S(m)", "1", [1, 0])
    assert witness["measured"]["low"] > witness["predicted"]
    assert claim["failing"]["tests"] <= claim["failing"]["of"]


@pytest.mark.parametrize("text", ["", "{", "[]", "3", '{"plan": 3}', '{"sources": []}'])
def test_what_is_no_plan(tmp_path, text):
    path = tmp_path / "plan.json"
    path.write_text(text)
    with pytest.raises(InputError, match="must hold a check document or its plan") as caught:
        read_plan(path)
    assert "\n" not in str(caught.value)


def test_a_plan_of_another_version(tmp_path):
    plan = check("random", 2, [], (), [4], 0.01)["plan"]
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(plan | {"specrate": "0.0.0"}))
    with pytest.raises(InputError, match="must come from this version"):
        check([], 2, plan=path)
    for row in ({"n": 16}, 3):
        path.write_text(json.dumps(plan | {"ladder": [row]}))
        with pytest.raises(InputError, match="steps that lack one of n, replicates, attempted, sh"):
            check([], 2, plan=path)
    with pytest.raises(InputError, match="must be readable"):
        check([], 2, plan=tmp_path / "absent.json")


@pytest.mark.parametrize("claims", ["jitter", ["jitter", 3], None])
def test_claims_that_are_no_list_of_texts_are_refused(claims):
    with pytest.raises(InputError, match="claims must be a list of texts: got"):
        check("jitter", 2, claims)
