"""Regions partition the frequency vectors, in any layout."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.errors import InputError
from specrate.theory.regions import label, region_of_support, regions, select, touched
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer
from strategies import block_samplers, frequencies, samplers

d = symbol("d")


def counts_of(layout, m):
    """How many coordinates of m are nonzero in each group."""
    return tuple(
        sum(m[i] != 0 for i in range(int(g.first) - 1, int(g.first) - 1 + int(g.size)))
        for g in layout.groups
    )


@given(samplers(), st.data())
def test_every_frequency_lies_in_exactly_one_region(sampler, data):
    layout = sampler.layout
    everything = regions(layout)
    m = data.draw(frequencies(int(sampler.dim)))
    matching = [r for r in everything if r.counts == counts_of(layout, m)]
    assert len(matching) == 1
    support = tuple(i + 1 for i, k in enumerate(m) if k)
    assert region_of_support(layout, support).counts == matching[0].counts
    assert region_of_support(layout, support).label == matching[0].label
    assert matching[0].dimension == len(support)


@given(samplers())
def test_regions_are_distinct_and_as_many_as_the_groups_allow(sampler):
    layout = sampler.layout
    everything = regions(layout)
    assert len({r.counts for r in everything}) == len(everything)
    expected = 1
    for g in layout.groups:
        expected *= int(g.size) + 1
    assert len(everything) == expected - 1


few_dims = st.integers(1, 6)
"""Enumerating regions costs 2^d; labels repeat themselves beyond a few dimensions."""


@given(few_dims.flatmap(block_samplers))
def test_labels_are_distinct_and_select_their_region(sampler):
    everything = regions(sampler.layout)
    assert len({r.label for r in everything}) == len(everything)
    for region in everything:
        assert region in select(sampler.layout, region.label)


@given(few_dims.flatmap(block_samplers))
def test_within_and_across_are_everything(sampler):
    layout = sampler.layout
    everything = regions(layout)
    blocks = [len(touched(layout, r.counts)) for r in everything]
    if len(layout.blocks) == 1:
        assert set(blocks) == {1}
        return
    within, across = select(layout, "within"), select(layout, "across")
    assert {r.counts for r in within} == {
        r.counts for r, b in zip(everything, blocks, strict=True) if b == 1
    }
    assert len(within) + len(across) == len(everything)


@given(few_dims.flatmap(block_samplers))
def test_small_supports_come_first_and_across_last(sampler):
    layout = sampler.layout
    places = [
        (len(touched(layout, r.counts)) > 1, touched(layout, r.counts)[0], r.dimension)
        for r in regions(layout)
        if len(touched(layout, r.counts)) == 1
    ]
    assert places == sorted(places)
    crossing = [len(touched(layout, r.counts)) > 1 for r in regions(layout)]
    assert crossing == sorted(crossing)


@pytest.mark.parametrize("value", range(2, 9))
@pytest.mark.parametrize("name", ["jitter", "latin-hypercube", "uncorrelated-jitter:1+2+(d-3)"])
def test_symbolic_regions_at_a_number_are_a_partition(name, value):
    """Σ over symbolic regions of the values they stand for is every region once."""
    if "+" in name and value < 4:
        return
    layout = parse_sampler(name, d).layout
    found = [
        counts for r in regions(layout) for counts in values_of(layout, r.counts, Integer(value))
    ]
    sizes = [int(g.size.subs(d, value)) for g in layout.groups]
    expected = 1
    for size in sizes:
        expected *= size + 1
    assert len(found) == len(set(found)) == expected - 1


def values_of(layout, counts, value):
    """The numbers of axes that a symbolic region stands for at d = value."""
    options = [()]
    for g, count in zip(layout.groups, counts, strict=True):
        size = int(g.size.subs(d, value))
        if count.is_Integer:
            choices = [int(count)] if int(count) <= size else []
        elif count == g.size:
            choices = [size] if size >= 2 else []  # 1 of 1 is the region of one axis
        else:
            choices = list(range(2, size))
        options = [(*o, c) for o in options for c in choices]
    return options


@pytest.mark.parametrize(
    ("name", "dim", "word", "labels"),
    [
        ("jitter", 3, "overall", ["axis", "w=2", "generic"]),
        ("jitter", 3, "axis", ["axis"]),
        ("jitter", 3, "w=1", ["axis"]),
        ("jitter", 3, "w=2", ["w=2"]),
        ("jitter", 3, "w=3", ["generic"]),
        ("jitter", 3, "2", ["axis"]),
        ("jitter", 3, "1,3", ["w=2"]),
        ("jitter", 3, " 3 , 1 ", ["w=2"]),
        ("jitter:2x3", 2, "axis", ["1", "2"]),
        ("jitter:2x3", 2, "1", ["1"]),
        ("jitter:2x3", 2, "1,2", ["1,2"]),
        (
            "uncorrelated-jitter:1+2",
            3,
            "within",
            ["within {1}", "within {2,3} at axis", "within {2,3}"],
        ),
        ("uncorrelated-jitter:1+2", 3, "within {2,3}", ["within {2,3}"]),
        ("uncorrelated-jitter:1+2", 3, "generic", ["across 1,2,3"]),
        ("uncorrelated-jitter:1+2", 3, "1,2", ["across 1,1 of {2,3}"]),
    ],
)
def test_grammar(name, dim, word, labels):
    assert [r.label for r in select(parse_sampler(name, dim).layout, word)] == labels


def test_within_lists_each_block():
    found = select(parse_sampler("uncorrelated-jitter:1+2", 3).layout, "within")
    assert [r.label for r in found] == ["within {1}", "within {2,3} at axis", "within {2,3}"]


@pytest.mark.parametrize(
    ("name", "dim", "word"),
    [
        ("jitter", 3, ""),
        ("jitter", 3, "w=4"),
        ("jitter", 3, "4"),
        ("jitter", 3, "0"),
        ("jitter", 3, "1,1"),
        ("jitter", 3, "1,"),
        ("jitter", 3, "within"),
        ("jitter", 3, "across"),
        ("jitter", 3, "²"),
        ("jitter", 3, "diagonal"),
        ("uncorrelated-jitter:1+2", 3, "within {1,2}"),
    ],
)
def test_what_names_no_region_is_one_line_of_complaint(name, dim, word):
    with pytest.raises(InputError) as caught:
        select(parse_sampler(name, dim).layout, word)
    assert "\n" not in str(caught.value)


def test_coordinates_need_a_number_as_dimension():
    with pytest.raises(InputError, match="needs a number as dimension"):
        region_of_support(parse_sampler("jitter", d).layout, (1,))


def test_too_many_regions_are_refused():
    layout = parse_sampler("jitter:" + "x".join(str(k) for k in range(2, 17)), 15).layout
    with pytest.raises(InputError, match="at most 20000 regions: got 32768"):
        regions(layout)


def test_symbolic_labels_and_assumptions():
    found = regions(parse_sampler("jitter", d).layout)
    assert [r.label for r in found] == ["axis", "1<w<d", "generic"]
    assert [str(a) for a in found[1].assumptions] == ["w >= 2", "d >= w + 1"]
    assert label(parse_sampler("jitter", 3).layout, (Integer(2),)) == "w=2"
