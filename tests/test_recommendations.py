"""Recommendations agree with the convergence tables; the partitions are all there."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.admissible import admissible_counts, law_text
from specrate.theory.dominance import dominates
from specrate.theory.errors import InputError
from specrate.theory.orders import Order
from specrate.theory.partitions import partitions
from specrate.theory.recommendations import document, recommend, shortfall_text
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational
from specrate.theory.tables import table

BELL = {1: 1, 2: 2, 3: 5, 4: 15, 5: 52, 6: 203}
INTEGER_PARTITIONS = {1: 1, 2: 2, 3: 3, 4: 5, 5: 7, 6: 11}


def judged(wanted, dim):
    return {(a.layout, a.axes): a for a in recommend(wanted, dim).alternatives}


@pytest.mark.parametrize("integrand", ["worst", "best", "product:k=2", "ball"])
@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("region", ["axis", "generic", "overall"])
def test_orders_are_those_of_the_tables(dim, region, integrand):
    found = recommend([f"{region}/{integrand} ~ 2"], dim)
    named = "axis" if (dim, region) == (1, "generic") else region
    compared = 0
    for a in found.alternatives:
        rows = table([a.layout], [dim], [integrand], constants=False).rows
        orders = [r.order for r in rows if r.region == named]
        if len(orders) == 1:
            assert a.reached[0].order == orders[0], a.layout
            compared += 1
    assert compared >= 3


@given(
    st.sampled_from(["worst", "best", "p=9/2"]),
    st.sampled_from(["axis", "generic", "1,2", "3"]),
    st.fractions(Fraction(1, 2), 4, max_denominator=6),
    st.integers(0, 2),
)
def test_a_rate_is_reached_or_short_by_the_quotient(integrand, region, exponent, log):
    wanted = Order(Rational(exponent.numerator, exponent.denominator), Integer(log))
    for a in recommend([f"{region}/{integrand} ~ {exponent} log {log}"], 3).alternatives:
        (r,) = a.reached
        assert (r.shortfall is None) == dominates(wanted, r.order)
        if r.shortfall is not None:
            assert wanted * r.shortfall == r.order


def test_a_scene_with_two_different_regions_gets_a_block_for_each():
    found = recommend(["1,3/worst ~ 3/2", "2/best ~ 3"], 3)
    assert found.layout is not None
    assert (found.layout.layout, found.layout.axes) == ("uncorrelated-jitter:2+1", (1, 3, 2))
    assert [r.region for r in found.layout.reached] == ["within {1,2}", "within {3}"]
    assert sum(a.reaches_all for a in found.alternatives) == 1


def test_multi_jitter_reaches_what_no_block_layout_does():
    found = recommend(["axis/best ~ 3", "generic/worst ~ 3/2"], 2)
    names = [a.layout for a in found.alternatives if a.reaches_all]
    assert "multi-jitter" in names
    assert not {"jitter", "latin-hypercube", "random"} & set(names)
    (jitter,) = (a for a in found.alternatives if a.layout == "jitter")
    (short,) = jitter.failing
    assert (short.wanted.region, shortfall_text(short.shortfall)) == ("axis", "N")


def test_the_freest_in_n_comes_first():
    found = recommend(["axis/worst ~ 3/2"], 2)
    reaching = [a for a in found.alternatives if a.reaches_all]
    assert reaching[0].layout == "latin-hypercube"
    assert [a.admitted for a in reaching] == sorted((a.admitted for a in reaching), reverse=True)


def test_a_grid_comes_after_random_layouts_and_with_a_warning():
    found = recommend(["axis/best ~ 3", "generic/worst ~ 3/2"], 2)
    names = [a.layout for a in found.alternatives if a.reaches_all]
    assert names == ["multi-jitter", "correlated-multi-jitter", "regular"]
    for a in found.alternatives:
        assert (a.warning is not None) == a.is_comb == (a.layout == "regular")
        if a.warning is not None:
            assert "aliasing: a regular grid's errors oscillate" in a.warning
            assert "power at multiples of n" in a.warning


def test_nothing_reaches_an_impossible_rate():
    found = recommend(["generic/worst ~ 9"], 2)
    assert found.layout is None
    assert document(found)["regions"] == []
    assert all(a.failing for a in found.alternatives)


def test_a_vanishing_variance_is_reached_by_the_grid_alone():
    found = recommend(["axis/best ~ oo"], 2)
    assert {a.layout for a in found.alternatives if a.reaches_all} >= {"regular"}
    (random,) = (a for a in found.alternatives if a.layout == "random")
    assert shortfall_text(random.failing[0].shortfall) == "more than any power of N"


def test_axes_of_an_integrand_are_handed_out_too():
    found = recommend(["overall/bernoulli:k=2,axes=(1,3) ~ 2"], 3)
    assert found.layout is not None
    assert found.layout.axes == (1, 3, 2)
    (other,) = (a for a in found.alternatives if a.layout.endswith(":1+2"))
    assert not other.reaches_all


def test_logarithms_count():
    tie = "generic/p=4 ~ 2"  # b = q = 2 for jitter: N^-2 log N
    jitter = judged([tie], 2)["jitter", (1, 2)]
    assert shortfall_text(jitter.failing[0].shortfall) == "log N"
    assert jitter.reached[0].condition == "b = q: a logarithm"
    assert judged([tie + " log 1"], 2)["jitter", (1, 2)].reaches_all


@pytest.mark.parametrize("dim", BELL)
def test_partitions_are_all_there(dim):
    alike = list(partitions(dim))
    apart = list(partitions(dim, [frozenset({i}) for i in range(1, dim + 1)]))
    assert len(alike) == INTEGER_PARTITIONS[dim]
    assert len({tuple(sorted(map(len, p))) for p in alike}) == INTEGER_PARTITIONS[dim]
    assert len(apart) == len(set(apart)) == BELL[dim]


@given(st.integers(1, 9), st.data())
def test_partitions_hold_every_axis_once(dim, data):
    named = data.draw(st.lists(st.frozensets(st.integers(1, dim), min_size=1), max_size=2))
    found = list(partitions(dim, named))
    assert found
    assert len(set(found)) == len(found)
    for blocks in found:
        assert sorted(a for b in blocks for a in b) == list(range(1, dim + 1))


def test_beyond_six_dimensions_a_named_region_stays_whole():
    found = recommend(["1,3/worst ~ 3/2", "2/best ~ 3"], 10)
    assert found.layout is not None
    assert found.layout.layout == "uncorrelated-jitter:2+1+7"
    assert any("beyond 6" in x.why for x in found.left_out)


@pytest.mark.parametrize(
    ("name", "dim", "law"),
    [
        ("random", 3, "any N >= 2"),
        ("jitter", 3, "N = t^3, t >= 2"),
        ("multi-jitter", 6, "N = t^6, t >= 2"),
        ("uncorrelated-jitter:1+2+3", 6, "N = t^6, t >= 2"),
        ("jitter:2x3", 2, "N = 6, 24, 54, 96, ..."),
        ("jitter", 11, "N = t^11, t >= 2"),
    ],
)
def test_admissible_counts(name, dim, law):
    sampler = parse_sampler(name, dim)
    counts = admissible_counts(sampler)
    assert law_text(sampler, counts) == law
    assert sampler.counts_at is not None
    assert all(sampler.counts_at(n)["N"] == n for n in counts)


@pytest.mark.parametrize(
    ("wanted", "dim", "rule"),
    [
        ([], 2, "needs a wanted rate"),
        (["jitter"], 2, "a wanted rate is"),
        (["within/best ~ 3"], 3, "a region of this sampler is .* or a support such as 1 or 1,3"),
        (["within/best ~ 3"], 2, "a region of this sampler is .* or a support such as 1 or 1,2"),
        (["within/best ~ 3"], 1, "a region of this sampler is .* or a support such as 1: got"),
        (["axis/best ~ 3"], 0, "a dimension of at least 1: got 0"),
        (["4/best ~ 3"], 3, "distinct coordinates in 1..3"),
        (["overall/bernoulli:k=2,axes=(1,4) ~ 2"], 3, "axes must be in 1..3"),
    ],
)
def test_what_cannot_be_wanted(wanted, dim, rule):
    with pytest.raises(InputError, match=rule):
        recommend(wanted, dim)


def test_only_the_wanted_region_limits_the_class():
    """p = 3/2 is too small for pairs of axes, on which nothing is wanted."""
    jitter = judged(["axis/p=3/2 ~ 1"], 3)["jitter", (1, 2, 3)]
    assert jitter.reached[0].order == Order(Rational(7, 6))
    assert not judged(["w=2/p=3/2 ~ 1"], 3)
