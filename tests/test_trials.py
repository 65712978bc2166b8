"""Budgets as caps: chunks that shrink and N that are dropped, by a clock that only work moves.

A realisation of N points takes as many seconds of that clock as the case says, and nothing else
takes any.
"""

from math import inf

import numpy as np
import pytest
from specrate.numerics.checking import checks, trials
from specrate.numerics.checking.check_documents import document
from specrate.numerics.checking.checks import Execution, Step
from specrate.numerics.checking.designs import design
from specrate.numerics.checking.judgements import FIRST, State
from specrate.numerics.checking.trials import grow_to, tried
from specrate.numerics.measuring import measurements
from specrate.numerics.measuring.measurements import Measurement
from specrate.numerics.point_sources import catalogue_source
from specrate.numerics.point_sources.child_processes import Limits
from specrate.theory.errors import InputError


class Clock:
    """A time that passes as points are drawn."""

    def __init__(self, cost, first=0.0):
        self.now, self.cost, self.first, self.drawn = 0.0, cost, first, []

    def __call__(self):
        return self.now

    def generate(self, sampler, counts, replicates, rng):
        """Uniform points, that take their time."""
        n = counts["N"]
        self.now += replicates * self.cost(n) + (0.0 if self.drawn else self.first)
        self.drawn.append((n, replicates))
        return rng.random((replicates, n, int(sampler.dim)))


@pytest.fixture
def clocked(monkeypatch):
    """A check of random points whose realisations cost so much, and its clock."""

    def start(cost, budget, counts=(16, 64, 256), first=0.0, claims=("random",)):
        clock = Clock(cost, first)
        monkeypatch.setattr(catalogue_source, "generate", clock.generate)
        for module in (measurements, trials, checks):
            monkeypatch.setattr(module, "perf_counter", clock)
        asked = design(["random"], 2, claims, [], 0)
        state = State(asked, 1e-5, [], tuple(counts), budget, Limits(deadline=budget))
        checks._prepare(state, counts)
        return state, clock

    return start


def replicates(state):
    return [m.replicates for m in state.measurements]


def test_what_costs_nothing_is_drawn_in_whole_chunks(clocked):
    state, clock = clocked(lambda n: 1e-5, 10.0)
    assert tried(state, 10.0) == state.measurements
    assert [m.chunks for m in state.measurements] == [[2, 2, 60], [2], [2]]
    for m in state.measurements:
        assert grow_to(state, m, 256, 10.0)
    assert [m.chunks for m in state.measurements] == [
        [2, 2, 60, 64, 64, 64],
        *[[2] + [64] * 3 + [62]] * 2,
    ]
    assert clock.now < 0.01


def test_costly_counts_are_dropped_and_said(clocked):
    """As box DPPs: 1 ms at N = 16, 64 ms at 64 and 4 s at 256, so that 128 last 8 s at N = 64."""
    state, clock = clocked(lambda n: 1e-3 * (n / 16) ** 3, 5.0)
    kept = tried(state, 5.0)
    assert [m.n for m in kept] == [16]
    assert replicates(state)[0] == 64
    assert 2 <= replicates(state)[1] <= 16
    assert replicates(state)[2] == 0
    assert clock.now == pytest.approx(64 * 1e-3 + replicates(state)[1] * 0.064)
    told = {x["what"]: x["why"] for x in document(state)["left_out"]}
    assert (
        "budget of 5 s: about 0.064 s a realisation, of which a first round has 128"
        in told["N = 64"]
    )
    assert "about 4.1 s a realisation" in told["N = 256"]


def test_a_budget_that_suffices_drops_nothing(clocked):
    """A round is 128 (0.001 + 0.008 + 0.064) s = 9.3 s."""
    state, _ = clocked(lambda n: 1e-3 * (n / 16) ** 1.5, 15.0)
    assert [m.n for m in tried(state, 15.0)] == [16, 64, 256]
    assert not any(m.dropped for m in state.measurements)


@pytest.mark.parametrize("budget", [1.0, 10.0])
@pytest.mark.parametrize("power", [0.0, 1.0, 3.0])
@pytest.mark.parametrize("cost", [0.002, 0.01, 0.2])
def test_the_budget_is_a_cap(clocked, budget, power, cost):
    """Late come at most the first two realisations: of the smallest N, whose cost nothing tells,
    and of the second, if its cost rises faster than N."""
    state, clock = clocked(lambda n: cost * (n / 16) ** power, budget)
    checks._measure(state, lambda text: None)
    late = max(clock.now - budget, 0.0)
    assert late <= 2 * cost * (4**power if power > 1 else 1)
    assert clock.now >= 0.4 * budget or state.ended == "decided"


def test_the_last_chunk_shrinks_to_what_is_left(clocked):
    """0.01 s each: of 1 s, a quarter is 25 realisations; 16 are drawn, then 8, 4, 2, 1."""
    state, clock = clocked(lambda n: 0.01, 1.0, counts=(16,))
    checks._measure(state, lambda text: None)
    lengths = [r for _, r in clock.drawn]
    assert lengths[:2] == [2, 2]
    assert max(lengths) == 16
    assert sorted(lengths[-3:], reverse=True) == lengths[-3:]
    assert replicates(state)[0] == sum(lengths)
    assert 0.95 <= clock.now <= 1.0


def test_a_slow_start_drops_nothing(clocked):
    """Three seconds for an import, then 10 µs each."""
    state, _ = clocked(lambda n: 1e-5, 10.0, first=3.0)
    assert [m.n for m in tried(state, 10.0)] == [16, 64, 256]
    assert [m.chunks for m in state.measurements] == [[2, 1, 1, 60], [2], [2]]


def test_what_is_cheap_by_the_chunk_is_kept(clocked, monkeypatch):
    """A chunk of N = 64 takes 40 ms whatever its length: by two realisations, 20 ms each."""
    state, clock = clocked(lambda n: 1e-5, 2.0, counts=(16, 64))
    generate = clock.generate

    def by_the_chunk(sampler, counts, replicates, rng):
        clock.now += 0.04 if counts["N"] > 16 else 0.0
        return generate(sampler, counts, replicates, rng)

    monkeypatch.setattr(catalogue_source, "generate", by_the_chunk)
    assert [m.n for m in tried(state, 2.0)] == [16, 64]
    assert 2 < replicates(state)[1] <= 64


def test_after_the_end_nothing_is_tried(clocked):
    state, _ = clocked(lambda n: 1.0, 1.0)
    assert tried(state, 1.0) == state.measurements
    assert replicates(state) == [2, 0, 0]
    assert not any(m.dropped for m in state.measurements)


def test_dropped_counts_are_not_judged_and_are_replayed(clocked):
    state, _ = clocked(lambda n: 1e-3 * (n / 16) ** 3, 5.0)
    checks._measure(state, lambda text: None)
    first = document(state)
    assert first["n_range"] == [16, 16]
    compared = {
        row["n"] for r in first["regions"] for row in r["spectrum"] if row["agrees"] is not None
    }
    assert compared == {16}
    rows = first["plan"]["ladder"]
    assert [bool(r["dropped"]) for r in rows] == [False, True, True]
    steps = tuple(
        Step(r["n"], r["replicates"], r["attempted"], r["shifts"],
             tuple(m.chunks), r["dropped"])
        for r, m in zip(rows, state.measurements, strict=True)
    )  # fmt: skip
    again, _ = clocked(lambda n: 0.0, inf)
    again.measurements.clear()
    checks._replay(again, Execution(steps, state.ended))
    assert [m.chunks for m in again.measurements] == [m.chunks for m in state.measurements]
    assert [m.power for m in again.measurements] == [m.power for m in state.measurements]
    assert [m.dropped for m in again.measurements] == [m.dropped for m in state.measurements]


def test_chunks_of_a_catalogue_sampler_have_streams_of_their_own(clocked):
    """Two chunks that were one stream would repeat their first points."""
    state, _ = clocked(lambda n: 1e-5, 10.0, counts=(16,))
    (m,) = state.measurements
    for target in (2, 4, 68, FIRST):
        grow_to(state, m, target, 10.0)
    points = np.concatenate(m.kept)
    assert m.chunks == [2, 2, 64, 60]
    assert len(np.unique(points[:, 0, 0])) == FIRST


def test_one_realisation_of_a_large_n_is_not_begun_if_it_cannot_end():
    m = Measurement(16, (), (), cost=2.0)
    asked = design(["random"], 2, ["random"], [], 0)
    state = State(asked, 1e-5, [], (), 1.0, Limits(deadline=1.0))
    assert not grow_to(state, m, FIRST, -inf)
    assert m.attempted == 0


def test_counts_out_of_reach_of_a_generator_are_dropped_unless_asked_for():
    """Box DPPs of several dimensions are drawn up to N = 256."""
    for counts in ((), (27, 729)):
        asked = design(["box-dpp"], 3, ["box-dpp"], [], 0)
        state = State(asked, 1e-5, [], counts, 1e9, Limits())
        state.measurements += [Measurement(n, (), ()) for n in (27, 729)]
        if counts:
            with pytest.raises(InputError, match="drawn up to N = 256"):
                tried(state, inf)
            continue
        assert [m.n for m in tried(state, inf)] == [27]
        assert "drawn up to N = 256" in state.measurements[1].dropped
        assert state.measurements[1].attempted == 0
