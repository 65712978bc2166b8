"""What combs add above their first alias."""

import pytest
from specrate.theory.combs import combs_of
from specrate.theory.expansions import expand
from specrate.theory.kernels import Alphabet
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, sympy

d = symbol("d")


def test_combs_of_a_regular_grid():
    """On w of d axes: mean N · N^(−w/d) from N^(1/d) on."""
    sampler = parse_sampler("regular", d)
    axis, middle, generic = regions(sampler.layout)
    w = middle.dimension
    for region, height in ((axis, 1 - 1 / d), (middle, 1 - w / d), (generic, Integer(0))):
        assert expand(sampler.kernel, sampler.layout, region).terms == ()
        (comb,) = combs_of(sampler.kernel, sampler.layout, region)
        assert comb.threshold == 1 / d
        assert sympy.simplify(comb.height - height) == 0
        assert (comb.constant, comb.scale) == (1, 1)


def test_a_comb_beside_other_terms_stands_on_one_axis():
    alphabet = Alphabet(("N", "n"))
    n = alphabet.count("n")
    half = alphabet.comb(n).scaled(alphabet.number(1) / 2)
    mixed = alphabet.over(0, half + alphabet.one().scaled(alphabet.number(1) / 2))
    layout = parse_sampler("jitter", 3).layout
    with pytest.raises(ValueError, match="group of one axis"):
        combs_of(mixed, layout, region_of_support(layout, (1, 2)))
