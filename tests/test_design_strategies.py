"""Strategies of designs: every family and integrand occurs, names parse, N are admissible."""

import pytest
from hypothesis import HealthCheck, Phase, find, given, settings
from hypothesis import strategies as st
from specrate.numerics.falsification.design_strategies import (
    NamedSampler,
    counts,
    integrands,
    layouts,
)
from specrate.numerics.integrands.grammar import CATALOGUE, parse_integrand
from specrate.theory.errors import InputError
from specrate.theory.samplers import FAMILIES, FURTHER_FAMILIES, parse_sampler

_FIND = settings(
    max_examples=2000,
    database=None,
    derandomize=True,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)
PLACED = [f for f in (*FAMILIES, *FURTHER_FAMILIES) if f.name != "isotropic"]


@given(
    st.one_of(st.none(), st.integers(1, 10)).flatmap(lambda d: st.tuples(st.just(d), layouts(d)))
)
def test_layouts_parse_and_have_points(drawn):
    dim, layout = drawn
    assert dim in (None, layout.dim)
    assert layout.sampler.dim == layout.dim
    assert layout.sampler.counts_at is not None


@pytest.mark.parametrize("family", [f.name for f in PLACED])
def test_every_family_occurs(family):
    found = find(layouts(), lambda x: x.sampler.family == family, settings=_FIND)
    assert found.sampler.family == family


def test_layouts_reach_the_corners():
    assert find(layouts(4), lambda x: x.name.count("+") == 3, settings=_FIND).dim == 4
    find(layouts(2), lambda x: "x" in x.name.partition(":")[2], settings=_FIND)


@given(layouts(), st.data())
def test_counts_are_admissible(layout, data):
    n = data.draw(counts(layout))
    assert 2 <= n <= 4096
    assert layout.sampler.counts_at(n)["N"] == n


def test_counts_reach_both_ends():
    squares = {n * n for n in range(2, 65)}
    for n in (4, 9, 4096):
        found = find(counts(NamedSampler("jitter", 2)), lambda c, n=n: c == n, settings=_FIND)
        assert found in squares
    assert find(counts(parse_sampler("random", 2), 7, 7), lambda _: True, settings=_FIND) == 7


def test_counts_that_there_are_none_of_are_refused():
    with pytest.raises(InputError, match=r"jitter must have an N in 5\.\.8"):
        counts(NamedSampler("jitter", 2), 5, 8)


@given(st.integers(1, 4).flatmap(lambda d: st.tuples(st.just(d), integrands(d))))
def test_integrands_parse_and_read_back(drawn):
    dim, text = drawn
    f = parse_integrand(text, dim)
    assert f.dim == dim
    assert parse_integrand(f.name, dim) == f


@pytest.mark.parametrize("entry", [e.name for e in CATALOGUE])
def test_every_integrand_occurs_with_each_of_its_keys(entry):
    keys = next(e.keys for e in CATALOGUE if e.name == entry)
    for key in keys:
        found = find(
            integrands(2),
            lambda t, key=key: t.partition(":")[0] == entry and f"{key}=" in t,
            settings=_FIND,
        )
        assert found.startswith(entry)
    assert find(integrands(2), lambda t: t == entry, settings=_FIND) == entry
