"""Paces: how long a chunk may be, what an N will cost, and how many N a budget has time for."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.measuring.paces import SLICE, TRIED, chunk_length, foretold_cost, within

COSTS = st.floats(1e-9, 1e6)


@pytest.mark.parametrize(
    ("size", "cost", "left", "budget", "length"),
    [
        (64, None, 1.0, 1.0, TRIED),
        (1, None, 1.0, 1.0, 1),
        (64, None, -1.0, 1.0, TRIED),  # what has never been measured is tried
        (64, 1e-4, 5.0, 10.0, 64),
        (64, 0.1, 5.0, 10.0, 16),  # 2.5 s hold 25
        (64, 0.1, 1.0, 10.0, 8),  # 10 fit
        (64, 3.0, 5.0, 10.0, 1),  # more than a slice, but it ends in time
        (64, 6.0, 5.0, 10.0, 0),
        (64, 1e-4, 0.0, 10.0, 0),
        (64, 1e-4, -1.0, 10.0, 0),
        (64, 0.0, 1.0, 10.0, 64),
    ],
)
def test_chunks(size, cost, left, budget, length):
    assert chunk_length(size, cost, left, budget) == length


@given(st.sampled_from([1, 2, 16, 64]), COSTS, st.floats(-1, 100), st.floats(1e-3, 100))
def test_a_chunk_ends_in_time_and_takes_its_slice(size, cost, left, budget):
    found = chunk_length(size, cost, left, budget)
    assert found * cost <= max(left, 0.0) * (1 + 1e-12)
    assert found <= 1 or found * cost <= SLICE * budget * (1 + 1e-12)
    assert (found >= 1) == (cost <= left)
    assert found & (found - 1) == 0


def test_costs_are_foretold_by_a_power_of_n():
    assert foretold_cost([], 16) is None
    assert foretold_cost([(16, 0.5)], 64) == 0.5
    assert foretold_cost([(16, 0.5)], 64, 1.0) == 2.0
    cubic = [(n, 1e-6 * n**3) for n in (4, 16, 64)]
    assert foretold_cost(cubic, 256) == pytest.approx(1e-6 * 256**3)
    falling = [(16, 2.0), (64, 1.0)]  # the first was slow to start
    assert foretold_cost(falling, 256) == 1.0
    assert foretold_cost([(16, 0.0), (64, 1.0)], 256) == 1.0


def test_a_chance_jump_of_the_clock_is_no_power_of_twenty():
    assert foretold_cost([(16, 1e-6), (17, 1.0)], 34) == pytest.approx(2.0**3.5)


def test_how_many_costs_are_within_a_budget():
    assert within([1.0, 2.0, 4.0], 7.0) == 3
    assert within([1.0, 2.0, 4.0], 6.9) == 2
    assert within([10.0, 0.0], 1.0) == 1  # the smallest is kept whatever it costs
    assert within([1.0], -1.0) == 1
