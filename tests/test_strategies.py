"""The strategies are tested too: a fuzz test is worth what its inputs are."""

from hypothesis import HealthCheck, Phase, find, given, settings
from hypothesis import strategies as st
from specrate.theory.regions import region_of_support, touched
from specrate.theory.samplers import FAMILIES, parse_sampler
from specrate.theory.strata import parse_strata
from specrate.theory.symbolic import Integer
from strategies import (
    LARGEST_DIM,
    block_samplers,
    block_sizes,
    catalogue_names,
    dims,
    frequencies,
    samplers,
    strata,
    strata_texts,
    supports,
)

_FIND = settings(
    max_examples=2000,
    database=None,
    derandomize=True,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)


@given(dims, st.data())
def test_block_sizes_are_compositions(dim, data):
    assert sum(data.draw(block_sizes(dim))) == dim


@given(dims, st.data())
def test_strata_grow_to_one_cell_per_point(axes, data):
    laws = data.draw(strata(axes)).growth
    assert sum(law.exponent for law in laws) == 1
    product = Integer(1)
    for law in laws:
        product *= law.constant
    assert product.simplify() == 1


@given(dims, st.data())
def test_strata_texts_are_in_the_grammar(axes, data):
    assert sum(parse_strata(data.draw(strata_texts(axes)), axes).powers) > 0


@given(samplers(), st.data())
def test_samplers_have_a_kernel_and_supports_fit(sampler, data):
    assert sampler.kernel is not None
    assert 1 <= int(sampler.dim) <= LARGEST_DIM
    support = data.draw(supports(sampler))
    assert region_of_support(sampler.layout, support).dimension == len(support)


@given(dims, st.data())
def test_frequencies_are_not_zero(dim, data):
    m = data.draw(frequencies(dim))
    assert len(m) == dim
    assert any(m)


def test_catalogue_names_are_all_families():
    names = set().union(*(catalogue_names(d) for d in range(1, LARGEST_DIM + 1)))
    assert names == {f.name for f in FAMILIES} - {"uncorrelated-jitter", "isotropic"}
    for dim in range(1, LARGEST_DIM + 1):
        for name in catalogue_names(dim):
            assert parse_sampler(name, dim).dim == dim


def test_samplers_reach_every_family():
    for family in {f.name for f in FAMILIES} - {"isotropic"}:
        found = find(samplers(), lambda s, family=family: s.family == family, settings=_FIND)
        assert found.family == family


def test_samplers_reach_the_corners():
    find(samplers(), lambda s: s.dim == LARGEST_DIM, settings=_FIND)
    find(block_samplers(5), lambda s: len(s.layout.blocks) == 5, settings=_FIND)
    find(
        block_samplers(3),
        lambda s: any(law.exponent == 0 for law in s.layout.growth.values()),
        settings=_FIND,
    )


def test_supports_reach_within_and_across():
    sampler = parse_sampler("uncorrelated-jitter:1+2+3", 6)
    for blocks in (1, 2, 3):
        find(
            supports(sampler),
            lambda u, blocks=blocks: (
                len(touched(sampler.layout, region_of_support(sampler.layout, u).counts)) == blocks
            ),
            settings=_FIND,
        )
