"""Layouts: the groups of a sampler are its coordinates, its strata fill its blocks."""

import pytest
from hypothesis import given
from specrate.theory.layouts import AxisGroup, Growth, Layout, grouped, spelled
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, sympy
from strategies import block_samplers, dims, samplers

d = symbol("d")


@given(samplers())
def test_groups_are_all_coordinates_in_order(sampler):
    layout = sampler.layout
    axes = [int(g.first) + i for g in layout.groups for i in range(int(g.size))]
    assert axes == list(range(1, int(layout.dim) + 1))


@given(samplers())
def test_blocks_are_runs_of_groups(sampler):
    layout = sampler.layout
    assert [g for members in layout.blocks for g in members] == list(range(len(layout.groups)))


@given(dims.flatmap(block_samplers))
def test_each_block_holds_n_cells(sampler):
    """In a block the exponents of its axes sum to 1 and the constants multiply to 1."""
    layout = sampler.layout
    for index, members in enumerate(layout.blocks, 1):
        exponent, constant = Integer(0), Integer(1)
        for j, g in enumerate(members, 1):
            law = layout.growth[f"n{index}_{j}"]
            exponent += law.exponent * layout.groups[g].size
            constant *= law.constant ** layout.groups[g].size
        assert exponent == 1
        assert sympy.simplify(constant) == 1


@given(samplers())
def test_n_grows_as_n(sampler):
    assert sampler.layout.growth["N"] == Growth(Integer(1))


@pytest.mark.parametrize(
    ("first", "size", "text"),
    [(1, 1, "1"), (2, 2, "2,3"), (3, 4, "3,4,5,6"), (1, 5, "1..5"), (4, d - 3, "4..d")],
)
def test_coordinates_are_spelled(first, size, text):
    assert spelled(Integer(first), sympy.sympify(size)) == text
    assert AxisGroup(sympy.sympify(size), Integer(first)).coordinates == text


def test_symbolic_layout():
    layout = parse_sampler("uncorrelated-jitter:1+2+(d-3)", d).layout
    assert layout.dim == d
    assert layout.blocks == ((0,), (1,), (2,))
    assert [layout.block_coordinates(b) for b in range(3)] == ["1", "2,3", "4..d"]
    assert [str(r) for r in layout.assumptions] == ["d >= 4"]


def test_grouped_numbers_the_axes():
    first, second = grouped((Integer(2), d - 2), (0, 1))
    assert (first.first, second.first) == (1, 3)
    assert (first.block, second.block) == (0, 1)
    assert Layout((first, second)).dim == d
