"""Multilinear forms of spectra: the kernel's polynomial again, with exact vertices."""

from dataclasses import replace
from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.coefficients import element_fraction
from specrate.numerics.expected_spectra.spectra import support_counts
from specrate.numerics.expected_spectra.spectrum_forms import (
    Interpolation,
    Variable,
    spectrum_form,
)
from specrate.theory.samplers import parse_sampler
from specrate.theory.shapes import SINC2
from strategies import every_sampler, supports


def interpolated(polynomial, values):
    if not isinstance(polynomial, Interpolation):
        return polynomial
    x = values[polynomial.variable]
    at_one, at_zero = (interpolated(p, values) for p in (polynomial.at_one, polynomial.at_zero))
    return x * at_one + (1 - x) * at_zero


def form_value(form, values):
    total = form.constant
    for p in form.products:
        value = 1.0
        for f in p.factors:
            value *= 1 - interpolated(f, values) if p.complement else interpolated(f, values)
        total += p.coefficient * (1 - value if p.complement else value)
    return total


def variables_of(atom, axis, counts):
    combs = [Variable(axis, int(element_fraction(c, counts)), True) for c in atom.combs]
    return combs + [
        Variable(axis, int(element_fraction(c, counts)), False, shape=shape)
        for shape, c in atom.shapes
    ]


def axes_and_terms(sampler, counts, support):
    """Of each term the coefficient, and its factor on every coordinate: (number, variables)."""
    taken = support_counts(sampler.layout, support)
    axes = [group for group, k in enumerate(taken) for _ in range(k)]
    return [
        (
            element_fraction(term.coefficient, counts),
            [
                [
                    (element_fraction(c, counts), variables_of(atom, axis, counts))
                    for c, atom in dict(term.factors)[group].terms
                ]
                for axis, group in enumerate(axes)
                if group in dict(term.factors)
            ],
        )
        for term in sampler.kernel.restrict(taken)
    ]


@given(every_sampler().filter(lambda s: s.counts_at is not None), st.data())
def test_the_form_is_the_kernel(sampler, data):
    """As a polynomial: any sinc² may have any value, only 0 on the teeth of its own comb."""
    counts = sampler.counts_at(data.draw(st.integers(2, 3000)))
    support = data.draw(supports(sampler))
    terms = axes_and_terms(sampler, counts, support)
    variables = {v for _, fs in terms for factor in fs for _, vs in factor for v in vs}
    values = {}
    for v in sorted(variables, key=lambda v: (not v.comb, v.axis, v.count, str(v.shape))):
        number = st.sampled_from((0.0, 1.0)) if v.comb else st.floats(0, 1)
        on_tooth = values.get(replace(v, comb=True, shape=SINC2)) == 1 and not v.comb
        values[v] = 0.0 if on_tooth else data.draw(number)
    expected = size = 0.0
    for coefficient, factors in terms:
        parts = [[float(c) * prod(values[v] for v in vs) for c, vs in f] for f in factors]
        expected += float(coefficient) * prod(map(sum, parts))
        size += abs(float(coefficient)) * prod(sum(map(abs, p)) for p in parts)
    form = form_of(sampler, counts, *support)
    assert set(form.variables) <= variables
    assert form_value(form, values) == pytest.approx(expected, abs=1e-13 * (1 + size))


def form_of(sampler, counts, *support):
    return spectrum_form(
        sampler.kernel, support_counts(sampler.layout, support), tuple(counts.items())
    )


@pytest.mark.parametrize("name", ["multi-jitter", "multi-jitter:8x16", "latin-hypercube"])
def test_on_an_axis_only_the_fine_strata_remain(name):
    sampler = parse_sampler(name, 2)
    form = form_of(sampler, {"N": 100, "s": 10, "m": 10, "n": 10}, 1)
    assert form.variables == (Variable(0, 100, False),)
    (fine,) = form.variables
    assert form.products[0].factors == (Interpolation(fine, 0.0, 1.0),)
    assert (form.constant, form.products[0].coefficient) == (0.0, 1.0)


def test_linear_terms_of_correlated_multi_jitter_vanish_exactly():
    """With one coarse sinc² at 0 and all others at 1 the polynomial is 0, at any strata."""
    sampler = parse_sampler("correlated-multi-jitter:8x16", 2)
    counts = {"N": 21 * 10**7, "m": 21, "n": 10**7}
    form = form_of(sampler, counts, 1, 2)
    low = {v: float(not v.comb) for v in form.variables}
    assert form_value(form, low) == 0
    for coarse in (Variable(0, 21, False), Variable(1, 10**7, False)):
        assert coarse in low
        assert form_value(form, {**low, coarse: 0.0}) == 0
    fine = Variable(0, counts["N"], False)
    assert form_value(form, {**low, fine: 0.0}) == 1


def test_white_noise_is_constant():
    for support in ((1,), (1, 2, 3)):
        form = form_of(parse_sampler("random", 3), {"N": 7}, *support)
        assert form.variables == ()
        assert form_value(form, {}) == 1


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_powers_of_sinc_squared(dim):
    """(1 − ∏ A)²: a square of a variable is two variables."""
    jitter = parse_sampler("jitter", dim)
    squared = replace(jitter, kernel=jitter.kernel * jitter.kernel)
    form = form_of(squared, {"N": 5**dim, "n": 5}, *range(1, dim + 1))
    assert {v.occurrence for v in form.variables} == {1, 2}
    values = dict.fromkeys(form.variables, 0.25)
    assert form_value(form, values) == pytest.approx((1 - 0.25**dim) ** 2, rel=1e-14)
