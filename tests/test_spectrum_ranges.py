"""Ranges of N·P_S outside a box: the exact spectrum lies in them."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.expected_spectra.spectrum_ranges import outside_ranges
from specrate.theory.errors import InputError
from specrate.theory.kernels import Alphabet
from specrate.theory.layouts import Layout, grouped
from specrate.theory.samplers import Sampler, parse_sampler
from specrate.theory.symbolic import Integer
from strategies import block_samplers, catalogue_samplers


@st.composite
def samplers_with_counts(draw: st.DrawFn):
    dim = draw(st.integers(1, 3))
    names = ["box-dpp", "cloaked:1/2", "cloaked:3/2"] + ["difference-jitter"] * (dim == 1)
    other_shapes = st.sampled_from(names)
    sampler = draw(
        st.one_of(
            catalogue_samplers(dim),
            block_samplers(dim, largest_factor=1),
            other_shapes.map(lambda name: parse_sampler(name, dim)),
        )
    )
    assert sampler.counts_at is not None
    return sampler, sampler.counts_at(draw(st.integers(1, 500)))


def placed(ranges, m):
    """The range of the frequency's support and teeth."""
    support = tuple(i for i, k in enumerate(m, 1) if k)
    of_support = [r for r in ranges if r.support == support]
    spacings = {i: c for r in of_support for i, c in r.teeth.items()}
    on = {i for i, c in spacings.items() if m[i - 1] % c == 0}
    (found,) = [r for r in of_support if set(r.teeth) == on]
    return found


@given(case=samplers_with_counts(), half=st.integers(0, 60), data=st.data())
def test_the_spectrum_lies_in_its_range(case, half, data):
    sampler, counts = case
    size = st.one_of(st.integers(0, half + 200), st.sampled_from(sorted(counts.values())))
    signs = st.sampled_from([-1, 0, 1, 2])
    dim = int(sampler.dim)
    m = [data.draw(size) * data.draw(signs) for _ in range(dim)]
    assume(max(map(abs, m)) > half)
    found = placed(outside_ranges(sampler, counts, half), m)
    power = counts["N"] * float(power_array(sampler, counts, np.array([m]))[0])
    assert found.lower * (1 - 1e-12) <= power <= found.upper * (1 + 1e-12)


def test_ranges_shrink_to_the_plateau():
    """Jitter with n = 10 beyond H = 999: N·P_S is within (n/(1000 π))² below 1.

    The range of a product of balls reaches beyond those of its factors, here to half of that.
    """
    sampler = parse_sampler("jitter", 2)
    for r in outside_ranges(sampler, {"N": 100, "n": 10}, 999):
        sinc2 = (10 / (1000 * np.pi)) ** 2
        assert r.lower == pytest.approx(1 - sinc2, rel=1e-12)
        assert 1 - 1e-12 < r.upper < 1 + 0.51 * sinc2


def test_a_grid_has_nothing_off_its_teeth():
    """And all of its power where every coordinate of the support is on them."""
    sampler = parse_sampler("regular:2x5", 2)
    for r in outside_ranges(sampler, {"N": 10, "n1": 2, "n2": 5}, 7):
        assert set(r.teeth.values()) <= {2, 5}
        assert r.lower == r.upper == (10 if set(r.teeth) == set(r.support) else 0)


def test_two_combs_on_an_axis_are_refused():
    alphabet = Alphabet(("n", "N"))
    both = alphabet.over(0, alphabet.comb(alphabet.count("n")))
    both = both + alphabet.over(0, alphabet.comb(alphabet.count("N")))
    sampler = Sampler("x", "x", Layout(grouped((Integer(1),))), both, None, "")
    with pytest.raises(InputError, match=r"combs of one spacing: got \[2, 3\]"):
        outside_ranges(sampler, {"n": 2, "N": 3}, 1)
