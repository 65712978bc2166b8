"""Low-frequency expansions: the terms kept are those of the exact spectrum."""

from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.spectra import counts_by_growth, scaled_power
from specrate.numerics.integrands.protocol import mp
from specrate.theory.combs import combs_of
from specrate.theory.expansions import FULL, Powers, expand
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import every_sampler, supports

d = symbol("d")


def monomial_symmetric(partition, squares):
    """M_λ of the squares: the sum over distinct monomials with the exponents λ."""
    if partition and partition[0] < 0:
        return sympy.prod([x ** -exact(partition[0]) for x in squares])
    if not partition:
        return Integer(1)
    if len(partition) == 1:
        return sum(x ** exact(partition[0]) for x in squares)
    assert partition[0] == partition[1]
    return sum((x * y) ** exact(partition[0]) for x, y in combinations(squares, 2))


def exact(part):
    return Rational(part.numerator, part.denominator)


def value_of_series(series, layout, m, n):
    """Σ C M(m²) N^-decay at one frequency."""
    total = mp.mpf(0)
    for term in series.terms:
        product = Integer(1)
        for g, partition in zip(layout.groups, term.powers.partitions, strict=True):
            first = int(g.first) - 1
            squares = [Integer(k) ** 2 for k in m[first : first + int(g.size)] if k]
            if squares:
                product *= monomial_symmetric(partition, squares)
        number = sympy.N(term.constant * product, mp.dps + 5)
        total += mp.mpmathify(number) * mp.power(n, -mp.mpmathify(sympy.N(term.decay, mp.dps)))
    return total


@given(every_sampler(), st.data())
def test_series_is_the_spectrum_at_low_frequencies(sampler, data):
    """At fixed m as N → ∞ their ratio tends to 1, where no count stays fixed and combs are out."""
    layout = sampler.layout
    if any(g.exponent == 0 for g in layout.growth.values()):
        return  # with a fixed count the series in m/n does not converge to its first terms
    support = data.draw(supports(sampler))
    series = expand(sampler.kernel, layout, region_of_support(layout, support))
    m = [0] * int(sampler.dim)
    for i in support:
        m[i - 1] = data.draw(st.integers(1, 3))
    if not series.terms:
        assert combs_of(sampler.kernel, layout, region_of_support(layout, support))
        return
    with mp.workdps(700):
        n = mp.mpf(10) ** 240
        counts = counts_by_growth(layout, n)
    with mp.workdps(40):
        ratio = scaled_power(sampler, counts, m) / value_of_series(series, layout, m, n)
        assert abs(ratio - 1) < mp.mpf(10) ** -8


@given(st.integers(1, 6), st.data())
def test_angular_means_are_moments_of_the_sphere(w, data):
    """Mean of M_λ(m²)/|m|^degree from Gaussian moments, E x^2k = (2k − 1)!!."""
    partition = data.draw(
        st.sampled_from([p for p in [(), (1,), (2,), (1, 1), FULL] if p == FULL or len(p) <= w])
    )
    parts = (1,) * w if partition == FULL else partition
    degree = 2 * sum(parts)
    gaussian = sympy.prod([sympy.factorial2(2 * k - 1) for k in parts]) if parts else Integer(1)
    terms = sympy.binomial(w, len(parts))
    radius = sympy.prod([w + 2 * j for j in range(degree // 2)])  # E |x|^degree
    powers = Powers((partition,))
    assert powers.degree((Integer(w),)) == degree
    assert sympy.simplify(powers.angular_mean((Integer(w),)) - terms * gaussian / radius) == 0


@given(st.integers(1, 6), st.fractions(Fraction(1, 8), 2, max_denominator=8), st.data())
def test_angular_means_of_fractional_powers(w, part, data):
    """Mean of Σ |x_i|^2k/|x|^2k, Σ |x_i x_j|^2k/|x|^4k and ∏, E |x|^p = 2^(p/2) Γ(p/2 + 1/2)/√π."""
    partition = data.draw(st.sampled_from([(part,), (-part,), *([(part, part)] if w > 1 else [])]))
    size = w if partition[0] < 0 else len(partition)
    gamma, degree = sympy.gamma, 2 * exact(part) * size
    gaussian = (
        2 ** exact(part) * gamma(exact(part) + Rational(1, 2)) / sympy.sqrt(sympy.pi)
    ) ** size
    radius = 2 ** (degree / 2) * gamma((w + degree) / 2) / gamma(Rational(w, 2))
    expected = sympy.binomial(w, size) * gaussian / radius
    powers = Powers((partition,))
    assert powers.degree((Integer(w),)) == degree
    assert float(powers.angular_mean((Integer(w),))) == pytest.approx(float(expected), rel=1e-12)


def test_angular_means_keep_a_symbolic_size():
    w = symbol("w")
    assert Powers(((1,),)).angular_mean((w,)) == 1
    mean = Powers(((1, 1),)).angular_mean((w,))
    assert sympy.simplify(mean - (w - 1) / (2 * (w + 2))) == 0


def test_powers_are_written():
    assert Powers(((1,),)).text(("x",)) == "sum_x m_i^2"
    assert Powers(((1, 1), (2,))).text(("x", "y")) == "sum_x m_i^2 m_j^2 sum_y m_i^4"
    assert Powers((FULL,)).text(("x",)) == "prod_x m_i^2"
    assert Powers(((), ())).text(("x", "y")) == "1"
    half = Fraction(1, 2)
    assert Powers(((half,),)).text(("x",)) == "sum_x |m_i|"
    assert Powers(((half / 2, half / 2),)).text(("x",)) == "sum_x |m_i|^(1/2) |m_j|^(1/2)"
    assert Powers(((3 * half,), (-half,))).text(("x", "y")) == "sum_x |m_i|^3 prod_y |m_i|"
    assert Powers(((2 * half,),)).text(("x",)) == "sum_x m_i^2"


def test_multi_jitter_2d_series_has_the_exact_coefficients():
    """(π²/3)(m_1² + m_2²)/n² to leading order, n = √N."""
    sampler = parse_sampler("multi-jitter", 2)
    series = expand(sampler.kernel, sampler.layout, region_of_support(sampler.layout, (1, 2)))
    terms = {t.powers.partitions: (t.degree, t.decay, t.constant) for t in series.terms}
    assert terms[((1,),)] == (2, 1, sympy.pi**2 / 3)


def test_latin_hypercube_is_flat_off_the_axes():
    sampler = parse_sampler("latin-hypercube", d)
    for region in regions(sampler.layout)[1:]:
        (term,) = expand(sampler.kernel, sampler.layout, region).terms
        assert (term.degree, term.decay, term.constant) == (0, 0, 1)
