"""Kernels in real space: the Fourier transforms of the measures give the kernel back."""

from itertools import permutations
from math import pi, prod, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.exact_variances.axis_measures import (
    UNIFORM,
    AxisMeasure,
    OutOfReach,
    measure_terms,
)
from specrate.numerics.expected_spectra.spectra import scaled_power
from specrate.theory.kernels import Alphabet, Factor
from specrate.theory.layouts import Layout, grouped
from specrate.theory.samplers import Sampler, parse_sampler
from specrate.theory.symbolic import Integer
from strategies import block_samplers, catalogue_samplers, frequencies


def transform(measure: AxisMeasure, m: int) -> float:
    """∫ cos(2π m h) over the measure; a triangle is the square of an interval 1/n, under *."""
    if measure == UNIFORM:
        return float(m == 0)
    on_comb = float(m % measure.spacings == 0)
    if measure.strata == 0 or m == 0:
        return on_comb
    n = measure.strata
    return on_comb * (n * sin(pi * (m % n) / n) / (pi * m)) ** 2


@st.composite
def samplers_with_counts(draw: st.DrawFn):
    dim = draw(st.integers(1, 3))
    sampler = draw(st.one_of(catalogue_samplers(dim), block_samplers(dim, largest_factor=1)))
    assert sampler.counts_at is not None
    return sampler, sampler.counts_at(draw(st.integers(1, 5000)))


@given(case=samplers_with_counts(), data=st.data())
def test_measures_give_the_spectrum_back(case, data):
    """In the mean over the exchanges of coordinates, for which products are sorted."""
    sampler, counts = case
    m = data.draw(frequencies(int(sampler.dim)))
    orders = list(permutations(m))
    terms = measure_terms(sampler, counts)
    wanted = sum(float(scaled_power(sampler, counts, order)) for order in orders)
    values = [
        float(coefficient) * prod(map(transform, measures, order))
        for measures, coefficient in terms.items()
        for order in orders
    ]
    size = sum(map(abs, values))
    assert sum(values) == pytest.approx(wanted, rel=1e-9, abs=1e-12 * size)


@given(case=samplers_with_counts())
def test_the_mean_itself_has_no_variance(case):
    """Every measure has mass 1: for f = 1 the coefficients add up to zero, exactly."""
    assert sum(measure_terms(*case).values()) == 0


def test_jitter_is_a_triangle_less_than_the_point():
    sampler = parse_sampler("jitter", 2)
    point, triangle = AxisMeasure(1, 0), AxisMeasure(1, 10)
    assert measure_terms(sampler, {"N": 100, "n": 10}) == {(point,) * 2: 1, (triangle,) * 2: -1}


def test_one_stratum_is_no_stratum():
    """sinc²(m/1) = [m = 0]: one point of jitter is one random point."""
    jitter, random = parse_sampler("jitter", 2), parse_sampler("random", 2)
    assert measure_terms(jitter, {"N": 1, "n": 1}) == measure_terms(random, {"N": 1})


def test_teeth_of_correlated_multi_jitter():
    """[m | a] sinc²(a/m) is [a = 0], [m | a] sinc²(a/N) a comb of m triangles."""
    sampler = parse_sampler("correlated-multi-jitter:3x5", 2)
    found = {m for key in measure_terms(sampler, {"N": 15, "m": 3, "n": 5}) for m in key}
    teeth = {AxisMeasure(3, 15), AxisMeasure(5, 15)}
    triangles = {AxisMeasure(1, 3), AxisMeasure(1, 5), AxisMeasure(1, 15)}
    assert found == {UNIFORM, AxisMeasure(1, 0)} | teeth | triangles


def one_axis(factor: Factor, alphabet: Alphabet) -> Sampler:
    return Sampler("x", "x", Layout(grouped((Integer(1),))), alphabet.over(0, factor), None, "")


def test_atoms_that_are_no_teeth_are_refused():
    alphabet = Alphabet(("n",))
    n = alphabet.count("n")
    twice = alphabet.sinc2(n) * alphabet.sinc2(n)
    with pytest.raises(OutOfReach, match="at most one comb and one sinc²"):
        measure_terms(one_axis(twice, alphabet), {"n": 3})
    askew = alphabet.comb(n) * alphabet.sinc2(n + 1)
    with pytest.raises(OutOfReach, match="must divide the count of its sinc²: got 3, 4"):
        measure_terms(one_axis(askew, alphabet), {"n": 3})
